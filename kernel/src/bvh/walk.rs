//! Rays through the tree, each on its own way.
//!
//! # Method
//!
//! A ray keeps a stack of boxes that it has yet to look into, the nearest on top, each with the s
//! at which it is entered. A step takes one from the stack: a node's children are tested all at
//! once, and those that are met go onto the stack; a leaf's spheres are tested all at once, and
//! those that may be the nearest go onto a list. When a hit is surely nearer than what was known,
//! boxes entered later are dropped from the stack. When a ray is through, its list - one sphere,
//! seldom more - goes among the questions to the tier (`bvh/resolve.rs`).
//!
//! As many rays as there are lanes are under way, and step together: all take a box; those that took
//! a node test it, then they push; those that took a leaf test that. So few branches depend on
//! one ray, which the processor cannot guess, and the chains of some fifty cycles that a step
//! is overlap. Where a ray has ended another takes its place, of the same packet or the
//! next. (Packet by packet, most of its rays have ended long before the slowest: of 16 some 5 were under
//! way on 7,381 spheres.)

use super::answers::{Answers, Any, Nearest};
use super::ray_walk::Walk;
use super::resolve::{Questions, RayPlace, settle_outside};
use super::slabs::Slabs;
use super::stack::Met;
use super::{Bvh, LEAF, NO_CHILD, WIDTH};
use crate::accuracy::RayLanes;
use crate::{Accuracy, Hit, HitPacket, LaneArray, LaneMask, Lanes, RayPacket, Spheres};

/// The nearest hit of every ray: what [`nearest`](crate::nearest) returns, from a tree.
///
/// `hits[i]` is overwritten with what `rays[i]` meets; packets past the end of the shorter slice
/// are left alone. `spheres` is the list that `bvh` was built from; what happens with another
/// stands at [`Bvh`].
///
/// Domain and guarantee: see the [module](crate::bvh). Cost: by the logarithm of the number of
/// spheres, where they do not overlap much; rays that the bounds do not cover, and spheres above
/// 2^40, cost as without a tree. Stack: some 3 KiB a lane.
#[inline(always)]
pub fn nearest<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    hits: &mut [HitPacket<L>],
) {
    if bvh.count != spheres.len() {
        return crate::nearest::<A, L>(token, rays, spheres, hits);
    }
    let rays = rays.get(..hits.len()).unwrap_or(rays);
    L::out_of_line(
        token,
        #[inline(always)]
        || walk::<A, L, _>(token, rays, spheres, bvh, &mut Nearest::<L>(hits)),
    );
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
    if bvh.count != spheres.len() {
        return crate::any::<A, L>(token, rays, spheres, met);
    }
    let rays = rays.get(..met.len()).unwrap_or(rays);
    L::out_of_line(
        token,
        #[inline(always)]
        || walk::<A, L, _>(token, rays, spheres, bvh, &mut Any(met)),
    );
}

/// The rays that are under way, and what they are about to look into.
struct UnderWay<L: Lanes> {
    walks: <L::Array as LaneArray>::Each<Walk>,
    /// The walks that are under way, then those that have ended.
    order: <L::Array as LaneArray>::Each<u32>,
    nodes: <L::Array as LaneArray>::Each<Step>,
    /// What the rays that look into nodes meet there.
    entered: <L::Array as LaneArray>::Each<Met>,
    leaves: <L::Array as LaneArray>::Each<Step>,
}

/// A walk that looks into a node or a leaf.
#[derive(Clone, Copy)]
struct Step {
    walk: u32,
    child: u32,
}

/// Puts `value` behind the first `count` of a list, and counts it if it is `wanted`.
#[inline(always)]
fn append<T>(list: &mut [T], count: &mut usize, value: T, wanted: bool) {
    if let Some(place) = list.get_mut(*count) {
        *place = value;
        *count += usize::from(wanted);
    }
}

/// Meets all rays with all spheres.
#[inline(always)]
fn walk<A: Accuracy, L: Lanes, N: Answers<L>>(
    token: L::Token,
    packets: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    answers: &mut N,
) {
    let none = Step { walk: 0, child: NO_CHILD };
    let mut under_way = UnderWay::<L> {
        walks: L::Array::each(Walk::NEW),
        order: L::Array::each(0),
        nodes: L::Array::each(none),
        entered: L::Array::each(Met::NOTHING),
        leaves: L::Array::each(none),
    };
    let (walks, order) = (under_way.walks.as_mut(), under_way.order.as_mut());
    let (nodes, entered) = (under_way.nodes.as_mut(), under_way.entered.as_mut());
    let leaves = under_way.leaves.as_mut();
    let mut questions = Questions::<L>::none();
    for (number, place) in order.iter_mut().enumerate() {
        *place = number as u32;
    }

    let mut packet = 0;
    let mut slabs = None;
    let mut waiting = 0;
    let mut count = 0;
    loop {
        // Rays begin in the place of those that have ended.
        while count < L::COUNT {
            if waiting == 0 {
                let Some(rays) = packets.get(packet) else { break };
                let begun = begin::<A, L>(token, rays, packet, spheres, bvh, answers);
                waiting = begun.judged;
                slabs = Some(begun);
                packet += 1;
                continue;
            }
            let ray = RayPlace { packet: packet - 1, lane: waiting.trailing_zeros() as usize };
            waiting &= waiting - 1;
            if let (Some(slabs), Some(&number)) = (&slabs, order.get(count))
                && let Some(walk) = walks.get_mut(number as usize)
            {
                walk.begin(slabs, ray, answers.limit(ray.packet, ray.lane), bvh.root);
            }
            count += 1;
        }
        if count == 0 {
            break;
        }

        let (mut in_nodes, mut in_leaves) = (0, 0);
        for &number in order.iter().take(count) {
            let Some(walk) = walks.get_mut(number as usize) else { continue };
            let child = walk.stack.pop();
            let leaf = child & LEAF != 0;
            append(nodes, &mut in_nodes, Step { walk: number, child }, !leaf);
            append(leaves, &mut in_leaves, Step { walk: number, child: child & !LEAF }, leaf);
        }

        for (step, met) in nodes.iter().zip(&mut *entered).take(in_nodes) {
            let Some(walk) = walks.get(step.walk as usize) else { continue };
            let Some(node) = bvh.nodes.get(step.child as usize) else { continue };
            *met = walk.enter::<A, L>(token, node);
        }
        for (step, met) in nodes.iter().zip(&*entered).take(in_nodes) {
            let Some(walk) = walks.get_mut(step.walk as usize) else { continue };
            let Some(node) = bvh.nodes.get(step.child as usize) else { continue };
            if N::ANY {
                walk.stack.push::<L, false>(token, met, &node.child);
            } else {
                walk.stack.push::<L, true>(token, met, &node.child);
            }
        }

        // Those whose leaf may hold a hit move to the front.
        let mut candidates = 0;
        for at in 0..in_leaves {
            let Some(&step) = leaves.get(at) else { continue };
            let Some(walk) = walks.get(step.walk as usize) else { continue };
            let Some(leaf) = bvh.leaves.get(step.child as usize) else { continue };
            let spheres = walk.filter::<A, L>(token, leaf);
            append(leaves, &mut candidates, step, spheres != 0);
        }
        for step in leaves.iter().take(candidates) {
            let Some(walk) = walks.get_mut(step.walk as usize) else { continue };
            let Some(leaf) = bvh.leaves.get(step.child as usize) else { continue };
            let leaf = (leaf, step.child * WIDTH as u32);
            walk.meet::<A, L, _>(token, packets, bvh, leaf, &mut questions, answers);
        }

        // Those that have ended move behind the others.
        let mut left = 0;
        for at in 0..count {
            let (Some(&number), Some(&first)) = (order.get(at), order.get(left)) else { continue };
            let goes_on = !walks.get(number as usize).is_none_or(
                #[inline(always)]
                |walk| walk.stack.is_empty(),
            );
            let swapped = if goes_on { [number, first] } else { [first, number] };
            for (place, number) in [left, at].into_iter().zip(swapped) {
                if let Some(place) = order.get_mut(place) {
                    *place = number;
                }
            }
            left += usize::from(goes_on);
        }
        for &number in order.iter().take(count).skip(left) {
            let Some(walk) = walks.get_mut(number as usize) else { continue };
            walk.end::<A, L, _>(token, packets, bvh, &mut questions, answers);
        }
        count = left;
    }
    questions.ask::<A>(token, answers);
}

/// Makes a packet's rays ready, and answers for those that do not go into the tree.
#[inline(always)]
fn begin<A: Accuracy, L: Lanes>(
    token: L::Token,
    packet: &RayPacket<L>,
    place: usize,
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    answers: &mut impl Answers<L>,
) -> Slabs<L> {
    answers.clear(place);
    let rays = RayLanes::<L>::load(token, packet);
    let mut slabs = Slabs::<L>::new::<A>(&rays, bvh.extent);
    let rest = rays.live.bits() & !slabs.judged;
    if rest != 0 {
        meet_all::<A, L>(token, packet, place, spheres, rest, answers);
    }
    if !bvh.outside.is_empty() {
        L::out_of_line(
            token,
            #[inline(always)]
            || settle_outside::<A, L>(&rays, bvh.outside, slabs.judged, place, answers),
        );
    }
    if bvh.root == NO_CHILD {
        slabs.judged = 0;
    }
    slabs
}

/// Rays that the bounds do not cover, those in `lanes`, against all spheres.
#[inline(always)]
fn meet_all<A: Accuracy, L: Lanes>(
    token: L::Token,
    packet: &RayPacket<L>,
    place: usize,
    spheres: Spheres<'_>,
    lanes: u32,
    answers: &mut impl Answers<L>,
) {
    let asked = L::mask(token, lanes);
    let mut rays = *packet;
    let never = L::splat(token, f32::NAN);
    rays.t_min = L::select(asked, L::load(token, &rays.t_min), never).store();
    let mut found = [HitPacket::<L>::none()];
    crate::nearest::<A, L>(token, &[rays], spheres, &mut found);
    for (lane, (&t, &sphere)) in found[0].t().iter().zip(found[0].spheres()).enumerate() {
        if lanes >> lane & 1 == 1 && t < f32::INFINITY {
            answers.take(place, lane, Hit { t, sphere });
        }
    }
}
