//! Rays through the tree, each on its own way.
//!
//! # Method
//!
//! A ray keeps a stack of boxes that it has yet to look into, the nearest on top, each with the s
//! at which it is entered. A step takes one from the stack: a node's children are tested all at
//! once, and those that are met go onto the stack; a leaf's spheres are tested all at once, and
//! those that may be the nearest go onto a list. When a hit is surely nearer than what was known,
//! boxes entered later are dropped from the stack. When all rays of a packet are through, the tier is
//! asked about the lists (`bvh/resolve.rs`), which hold one sphere a ray, seldom more.
//!
//! Four rays are under way in turn, and step together: all take a box, all test, all push. Each
//! branch waits for a chain of some fifty cycles; so the chains overlap, and a wrong guess is
//! known early. (Round robin, one whole step a ray: no gain. Eight or sixteen rays: no more.)

use super::ray_walk::{Met, Walk};
use super::resolve::{List, settle, settle_outside, take};
use super::slabs::Slabs;
use super::{Bvh, LEAF, NO_CHILD, WIDTH};
use crate::accuracy::RayLanes;
use crate::intersect::lanes_of_bits;
use crate::{Accuracy, HitPacket, LaneMask, Lanes, RayPacket, Spheres};

/// The nearest hit of every ray: what [`nearest`](crate::nearest) returns, from a tree.
///
/// `hits[i]` is overwritten with what `rays[i]` meets; packets past the end of the shorter slice
/// are left alone. `spheres` is the list that `bvh` was built from; what happens with another
/// stands at [`Bvh`].
///
/// Domain and guarantee: see the [module](crate::bvh). Cost: by the logarithm of the number of
/// spheres, where they do not overlap much; rays that the bounds do not cover, and spheres above
/// 2^40, cost as without a tree. Stack: some 12 KiB.
#[inline(always)]
pub fn nearest<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    hits: &mut [HitPacket<L>],
) {
    L::out_of_line(
        token,
        #[inline(always)]
        || nearest_one_by_one::<A, L>(token, rays, &spheres, bvh, hits),
    );
}

#[inline(always)]
fn nearest_one_by_one<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: &Spheres<'_>,
    bvh: &Bvh<'_>,
    hits: &mut [HitPacket<L>],
) {
    if bvh.count != spheres.len() {
        return brute_force::<A, L>(token, rays, spheres, hits);
    }
    let mut under_way = UnderWay::NEW;
    for (packet, hit) in rays.iter().zip(hits.iter_mut()) {
        *hit = HitPacket::<L>::none();
        meet::<A, L, false>(token, packet, spheres, bvh, &mut under_way, hit);
    }
}

/// Whether every ray meets anything: what [`any`](crate::any) returns, from a tree.
///
/// Lane `i` in bit `i` of `met[k]` for `rays[k]`. True exactly where [`nearest`] finds a hit;
/// cheaper, since a ray that has surely met something is done. Otherwise as `nearest`.
#[inline(always)]
pub fn any<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    met: &mut [u32],
) {
    L::out_of_line(
        token,
        #[inline(always)]
        || any_one_by_one::<A, L>(token, rays, &spheres, bvh, met),
    );
}

#[inline(always)]
fn any_one_by_one<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: &Spheres<'_>,
    bvh: &Bvh<'_>,
    met: &mut [u32],
) {
    if bvh.count != spheres.len() {
        return crate::any::<A, L>(token, rays, *spheres, met);
    }
    let mut under_way = UnderWay::NEW;
    for (packet, met) in rays.iter().zip(met.iter_mut()) {
        let mut hit = HitPacket::<L>::none();
        let sure = meet::<A, L, true>(token, packet, spheres, bvh, &mut under_way, &mut hit);
        let found = L::load(token, &hit.t).lt(L::splat(token, f32::INFINITY));
        *met = sure | found.bits();
    }
}

/// How many rays of a packet are under way in turn.
const TOGETHER: usize = 4;

/// What is kept from one packet to the next, so that it is cleared once.
#[derive(Clone, Copy, Debug)]
struct UnderWay {
    walks: [Walk; TOGETHER],
    /// For every lane its candidates, and its best.
    lists: [(List, f32); MOST_LANES],
}

impl UnderWay {
    const NEW: Self =
        Self { walks: [Walk::NEW; TOGETHER], lists: [(List::EMPTY, f32::INFINITY); MOST_LANES] };
}

/// More lanes have no type.
const MOST_LANES: usize = 32;

/// Meets one packet's rays with all spheres; answers with the lanes that surely meet something,
/// where that is all that is asked.
#[inline(always)]
fn meet<A: Accuracy, L: Lanes, const ANY: bool>(
    token: L::Token,
    packet: &RayPacket<L>,
    spheres: &Spheres<'_>,
    bvh: &Bvh<'_>,
    UnderWay { walks, lists }: &mut UnderWay,
    hits: &mut HitPacket<L>,
) -> u32 {
    let rays = RayLanes::<L>::load(token, packet);
    let live = rays.live.bits();
    let slabs = Slabs::<L>::new::<A>(&rays, bvh.extent);
    for (list, _) in lists.iter_mut().take(L::COUNT) {
        list.count = 0;
    }
    let mut met = 0;

    let mut waiting = slabs.judged;
    let mut under_way = 0_u32;
    for (place, walk) in walks.iter_mut().enumerate() {
        if waiting != 0 {
            walk.begin(&slabs, waiting.trailing_zeros() as usize, bvh.root);
            waiting &= waiting - 1;
            under_way |= 1 << place;
        }
    }
    let mut boxes = [(0_usize, 0_u32); TOGETHER];
    let mut in_nodes = [Met::NOTHING; TOGETHER];
    let mut in_leaves = [0_u32; TOGETHER];
    while under_way != 0 {
        // Nodes from the front, leaves from the back.
        let (mut nodes, mut leaves) = (0, TOGETHER);
        let mut left = under_way;
        while left != 0 {
            let place = left.trailing_zeros() as usize % TOGETHER;
            left &= left - 1;
            let walk = &mut walks[place];
            let child = loop {
                if let Some(child) = walk.next() {
                    break child;
                }
                if walk.met {
                    met |= 1 << walk.lane;
                } else if let Some(list) = lists.get_mut(walk.lane) {
                    *list = (walk.list, walk.best);
                }
                if waiting == 0 {
                    under_way &= !(1 << place);
                    break NO_CHILD;
                }
                walk.begin(&slabs, waiting.trailing_zeros() as usize, bvh.root);
                waiting &= waiting - 1;
            };
            if child & LEAF == 0 {
                boxes[nodes % TOGETHER] = (place, child);
                nodes += 1;
            } else if child != NO_CHILD {
                leaves -= 1;
                boxes[leaves % TOGETHER] = (place, child & !LEAF);
            }
        }
        for (&(place, child), met) in boxes.iter().zip(&mut in_nodes).take(nodes) {
            if let Some(node) = bvh.nodes.get(child as usize) {
                walks[place % TOGETHER].enter::<A, L>(token, node, met);
            }
        }
        for (&(place, child), spheres) in boxes.iter().zip(&mut in_leaves).skip(leaves) {
            if let Some(leaf) = bvh.leaves.get(child as usize) {
                *spheres = walks[place % TOGETHER].filter::<A, L>(token, leaf);
            }
        }
        for (&(place, child), met) in boxes.iter().zip(&in_nodes).take(nodes) {
            if let Some(node) = bvh.nodes.get(child as usize) {
                walks[place % TOGETHER].push_sorted::<L>(token, met, &node.child);
            }
        }
        for (&(place, child), spheres) in boxes.iter().zip(&in_leaves).skip(leaves) {
            if *spheres != 0
                && let Some(leaf) = bvh.leaves.get(child as usize)
            {
                let walk = &mut walks[place % TOGETHER];
                walk.meet::<A, L, ANY>(token, packet, bvh, leaf, child * WIDTH as u32, hits);
            }
        }
    }
    settle::<A, L>(token, &rays, bvh.leaves, lists.get(..L::COUNT).unwrap_or(&[]), hits);

    let judged = slabs.judged & !met;
    if !bvh.outside.is_empty() && judged != 0 {
        L::out_of_line(
            token,
            #[inline(always)]
            || settle_outside::<A, L>(token, &rays, bvh.outside, judged, hits),
        );
    }
    let rest = live & !slabs.judged;
    if rest != 0 {
        L::out_of_line(
            token,
            #[inline(always)]
            || meet_all::<A, L>(token, packet, spheres, rest, hits),
        );
    }
    met
}

/// All rays against all spheres, in a function of its own.
#[inline(always)]
fn brute_force<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: &Spheres<'_>,
    hits: &mut [HitPacket<L>],
) {
    L::out_of_line(
        token,
        #[inline(always)]
        || crate::nearest::<A, L>(token, rays, *spheres, hits),
    );
}

/// Rays that the bounds do not cover, those in `lanes`, against all spheres.
#[inline(always)]
fn meet_all<A: Accuracy, L: Lanes>(
    token: L::Token,
    packet: &RayPacket<L>,
    spheres: &Spheres<'_>,
    lanes: u32,
    hits: &mut HitPacket<L>,
) {
    let asked = lanes_of_bits::<L>(token, lanes);
    let mut rays = *packet;
    let never = L::splat(token, f32::NAN);
    rays.t_min = L::select(asked, L::load(token, &rays.t_min), never).store();
    let mut found = [HitPacket::<L>::none()];
    brute_force::<A, L>(token, &[rays], spheres, &mut found);
    for (lane, (&t, &index)) in found[0].t().iter().zip(found[0].spheres()).enumerate() {
        if lanes >> lane & 1 == 1 && t < f32::INFINITY {
            take(hits, lane, t, index);
        }
    }
}
