//! Packets that look the same way, walked through the tree together.
//!
//! # Method
//!
//! Up to four packets - 64 rays of 16 lanes - go down the tree as one bundle: a node's children are
//! tested against the bundle's [frustum](super::frustum), not against rays, nearest first; so are the
//! spheres of a leaf, and those inside against the narrower planes of each packet; what is left
//! is tested against the packet's rays, a ray a lane (`member.rs`). The depth beyond which nothing
//! matters shrinks with every hit.
//!
//! A bundle is walked so if its rays start at t >= 0, run the same way along an axis, and are
//! narrow (`course.rs`); others go one by one ([`nearest`](super::nearest)).

use super::bounds::most;
use super::course::Course;
use super::frustum::Inside;
use super::member::{Member, approach};
use super::{Bvh, DEPTH, LEAF, NO_CHILD, WIDTH};
use crate::{Accuracy, HitPacket, LaneMask, Lanes, RayPacket, Spheres};

/// How many packets go together.
const BUNDLE: usize = 4;
/// As in `walk.rs`.
const STACK: usize = 256;
const _: () = assert!(STACK >= (WIDTH - 1) * DEPTH + WIDTH);

/// The nearest hit of every ray, as [`nearest`](super::nearest), for rays that look the same way:
/// the rays of a camera, a tile of the picture a packet, or shadow rays to one light.
///
/// The answers are those of `nearest`, for any rays; rays that do not look the same way cost some
/// percent more than there.
#[inline(always)]
pub fn nearest_coherent<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    hits: &mut [HitPacket<L>],
) {
    let mut walk = BundleWalk::new();
    let nobody = RayPacket::<L>::inactive();
    for (rays, hits) in rays.chunks(BUNDLE).zip(hits.chunks_mut(BUNDLE)) {
        let mut members = members_of::<L>(token, rays, &nobody);
        let Some(members) = members.get_mut(..rays.len()) else { continue };
        if bvh.count == spheres.len() && walk.bundle::<A, L, false>(token, members, bvh) {
            for (member, hits) in members.iter().zip(hits) {
                *hits = member.hits();
            }
        } else {
            super::nearest::<A, L>(token, rays, spheres, bvh, hits);
        }
    }
}

/// Whether every ray meets anything, as [`any`](super::any), for rays that look the same way.
#[inline(always)]
pub fn any_coherent<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    met: &mut [u32],
) {
    let mut walk = BundleWalk::new();
    let nobody = RayPacket::<L>::inactive();
    for (rays, met) in rays.chunks(BUNDLE).zip(met.chunks_mut(BUNDLE)) {
        let mut members = members_of::<L>(token, rays, &nobody);
        let Some(members) = members.get_mut(..rays.len()) else { continue };
        if bvh.count == spheres.len() && walk.bundle::<A, L, true>(token, members, bvh) {
            for (member, met) in members.iter().zip(met) {
                *met = member.met();
            }
        } else {
            super::any::<A, L>(token, rays, spheres, bvh, met);
        }
    }
}

/// The members of a bundle; those past its end are `nobody`.
#[inline(always)]
fn members_of<'a, L: Lanes>(
    token: L::Token,
    rays: &'a [RayPacket<L>],
    nobody: &'a RayPacket<L>,
) -> [Member<'a, L>; BUNDLE] {
    let [a, b, c, d] = match *rays {
        [ref a, ref b, ref c, ref d] => [a, b, c, d],
        [ref a, ref b, ref c] => [a, b, c, nobody],
        [ref a, ref b] => [a, b, nobody, nobody],
        [ref a] => [a, nobody, nobody, nobody],
        _ => [nobody; BUNDLE],
    };
    [Member::new(token, a), Member::new(token, b), Member::new(token, c), Member::new(token, d)]
}

/// The boxes that are yet to be looked into, the nearest on top.
struct BundleWalk {
    depths: [f32; STACK],
    children: [u32; STACK],
    top: usize,
}

impl BundleWalk {
    fn new() -> Self {
        Self { depths: [0.0; STACK], children: [NO_CHILD; STACK], top: 0 }
    }

    /// Walks one bundle; false, and nothing done, where its rays do not look the same way.
    #[inline(always)]
    fn bundle<A: Accuracy, L: Lanes, const ANY: bool>(
        &mut self,
        token: L::Token,
        members: &mut [Member<'_, L>],
        bvh: &Bvh<'_>,
    ) -> bool {
        approach::<A, L>(members, bvh.extent);
        let Some(course) = Course::of::<A, L>(members, bvh) else { return false };
        let Some(mut frustum) = course.enclose(members) else { return false };
        if !bvh.outside.is_empty() {
            for member in &mut *members {
                member.meet_outside::<A, ANY>(bvh.outside);
            }
            frustum.end = course.end(members);
        }

        for member in &mut *members {
            member.depth = if member.live.any() { frustum.end } else { f32::NEG_INFINITY };
        }
        self.depths[0] = f32::NEG_INFINITY;
        self.children[0] = bvh.root;
        self.top = 1;
        let mut inside = Inside { places: 0, depths: [0.0; WIDTH] };
        while let Some(below) = self.top.checked_sub(1) {
            self.top = below;
            let at = below & (STACK - 1);
            let (depth, child) = (self.depths[at], self.children[at]);
            if depth > frustum.end {
                continue;
            }
            if child & LEAF == 0 {
                if let Some(node) = bvh.nodes.get(child as usize) {
                    frustum.enter::<L>(token, node, &mut inside);
                    self.push(&inside, &node.child);
                }
                continue;
            }
            let number = child & !LEAF;
            let Some(leaf) = bvh.leaves.get(number as usize) else { continue };
            let places = frustum.look::<L>(token, leaf);
            if places == 0 {
                continue;
            }
            let mut any_changed = false;
            for member in &mut *members {
                // (3 % of the time of u10k, 6 % of u1m's.)
                if depth > member.depth {
                    continue;
                }
                let mut places = places & member.sides.look::<L>(token, leaf);
                let mut changed = false;
                while places != 0 {
                    let place = places.trailing_zeros() as usize;
                    places &= places - 1;
                    changed |= member.meet::<A, ANY>(bvh, (number, leaf), place);
                }
                if changed {
                    member.depth = course.end(core::slice::from_ref(&*member));
                    any_changed = true;
                }
            }
            if any_changed {
                frustum.end = f32::NEG_INFINITY;
                for member in &*members {
                    frustum.end = most(frustum.end, member.depth);
                }
            }
        }
        for member in members {
            member.finish::<A, ANY>(bvh.leaves);
        }
        true
    }

    #[inline(always)]
    fn push(&mut self, inside: &Inside, children: &[u32; WIDTH]) {
        let base = self.top;
        let mut places = inside.places;
        while places != 0 {
            let place = places.trailing_zeros() as usize % WIDTH;
            places &= places - 1;
            let depth = inside.depths[place];
            // Sink below what is nearer.
            let mut at = self.top;
            while at > base && self.depths[(at - 1) & (STACK - 1)] < depth {
                self.depths[at & (STACK - 1)] = self.depths[(at - 1) & (STACK - 1)];
                self.children[at & (STACK - 1)] = self.children[(at - 1) & (STACK - 1)];
                at -= 1;
            }
            self.depths[at & (STACK - 1)] = depth;
            self.children[at & (STACK - 1)] = children[place];
            self.top += 1;
        }
    }
}
