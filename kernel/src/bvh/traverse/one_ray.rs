//! One ray a call.
//!
//! # Method
//!
//! The ray is prepared in one lane, and looks into a node's sixteen boxes or a leaf's sixteen spheres at once. Bits say which
//! children of a node are left, the nearest first. The s at which the ray enters their boxes are not kept: when a hit is
//! closer than what was known, the boxes of the nodes on the way are tested once more. So nothing large is made for a ray: 256
//! bytes, not the 2 KiB of a stack that other traversals make once for many rays. At the end the tier tests the spheres that
//! may be the closest, one after the other, in one lane. In a small tree a ray looks into all spheres, without boxes.
//!
//! The time goes to steps that wait for the one before, and to branches that cannot be predicted. So numbers of the ray stay
//! in registers from its preparation to its walk: a word that is read wider than it was written waits for memory, which took 5
//! to 8 % of a ray's time. (To look at four leaves at once, with one branch for all, took 1.1 to 1.2 times as long.)

mod found;

use self::found::{MOST, Search, goes_by_list};
use super::boxes::{BoxProbe, Boxes};
use super::prepared_ray::{PreparedLanes, far_away};
use super::ray_time::RayTime;
use super::root_interval::RayProbe;
use super::small_tree::{self, AT_ONCE};
use crate::Accuracy;
use crate::accuracy::{RayLanes, Squares};
use crate::bvh::leaf::place_of;
use crate::bvh::node::{BvhNode, FRAMES, LEAF, NO_CHILD, WIDTH, octant_of};
use crate::bvh::tree::Bvh;
use crate::count::count;
use crate::geometry::ray::Ray;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::{LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::query::Query;
use crate::scale::rays::ScaledRays;

/// Answers one ray.
#[inline(always)]
pub(crate) fn trace<L: Lanes, Q: Query>(
    token: L::Token,
    tier: impl Accuracy,
    bvh: &Bvh<'_>,
    ray: &Ray,
) -> Q::One {
    if tier.spread() == 0.0 {
        search::<_, L, Q, false>(token, tier, bvh, ray)
    } else {
        L::out_of_line(
            token,
            #[inline(always)]
            || search::<_, L, Q, true>(token, tier, bvh, ray),
        )
    }
}

#[inline(always)]
fn search<T: Accuracy, L: Lanes, Q: Query, const SPREADS: bool>(
    token: L::Token,
    tier: T,
    bvh: &Bvh<'_>,
    ray: &Ray,
) -> Q::One {
    let mut search = Search::<T, Q> {
        tier,
        bvh,
        ray,
        answer: Q::none::<[f32; 1]>(),
        places: [0; MOST],
        entries: [0.0; MOST],
        count: 0,
        best: 0.0,
    };
    let spread = if SPREADS { tier.spread() } else { 0.0 };
    let rays = RayLanes::<f32>::load((), &RayPacket::new(core::slice::from_ref(ray)));
    if !rays.live {
        return Q::one(&search.answer, 0);
    }
    // What a tier sees wrongly must not depend on how many rays a call has.
    if goes_by_list(bvh, SPREADS, tier.squares()) {
        return search.of_list();
    }
    // A tree of one sphere: to look at the sphere costs as much as to test it. (A refit may have made it no sphere, which only
    // its bounds would say: then no box has an extent. `Fast` and `Geometric` lose hits on lines that miss the box, as in every call.)
    if !SPREADS
        && let [_, u32::MAX, u32::MAX, u32::MAX] = bvh.indices
        && bvh.extent > 0.0
        && bvh.outside.is_empty()
    {
        search.places[0] = place_of(bvh.root & !LEAF, 0);
        search.count = 1;
        search.test::<L>(token);
        return Q::one(&search.answer, 0);
    }
    let scaled = ScaledRays::new(&rays, bvh.scale.factor);
    let mut prepared = PreparedLanes::from_there::<true>(&scaled);
    let mut along = (scaled.rays.direction, prepared.time.length);
    // `Fast` and `Geometric` are off by so much more that moving rays gains nothing: their rays are not moved.
    let far = (!SPREADS && far_away(prepared.covered, prepared.absolute_error, bvh.extent))
        | prepared.may_overflow(tier.squares(), bvh.scale.factor, bvh.extent);
    if !prepared.covered | far {
        // Copied number by number: copied as a whole, the numbers would go through memory on both paths.
        let PreparedLanes { covered, origin, direction, time, absolute_error, start, end } =
            again(ray, bvh, (tier.squares(), !SPREADS));
        let RayTime { per_t, shift, length } = time;
        prepared = PreparedLanes {
            covered,
            origin: axes!(i => origin[i]),
            direction: axes!(i => direction[i]),
            time: RayTime { per_t, shift, length },
            absolute_error,
            start: [start[0], start[1]],
            end: [end[0], end[1]],
        };
        along = (prepared.direction, 1.0);
    }
    if !prepared.covered | !bvh.outside.is_empty() {
        // From a copy, so that the numbers of other paths stay in registers.
        let PreparedLanes { covered, time, end, .. } = prepared;
        match search.unusual(covered, time, end[1]) {
            Some(end) => prepared.end[1] = end,
            None => return Q::one(&search.answer, 0),
        }
    }
    if bvh.root == NO_CHILD {
        return Q::one(&search.answer, 0);
    }
    let time = prepared.time;
    search.best = prepared.end[1];
    let start = &prepared.start;
    let mut spheres = RayProbe {
        origin: axes!(i => L::splat(token, prepared.origin[i])),
        direction: axes!(i => L::splat(token, prepared.direction[i])),
        start: [L::splat(token, start[0]), L::splat(token, start[1])],
        end: [L::splat(token, prepared.end[0]), L::splat(token, search.best)],
        absolute_error: L::splat(token, prepared.absolute_error),
        raise: L::splat(token, time.raise(tier)),
        spread,
    };
    if let Some(leaves) = small_tree::leaves(bvh) {
        let may_hit = search.may_hit::<L, SPREADS>(&spheres, leaves);
        if !Q::ANY && !SPREADS && may_hit.count_ones() <= AT_ONCE {
            search.keep(leaves, may_hit);
        } else if search.meet::<L, SPREADS>(token, &mut spheres, time, leaves, may_hit) {
            return Q::one(&search.answer, 0);
        }
        search.test::<L>(token);
        return Q::one(&search.answer, 0);
    }
    let around = if SPREADS { prepared.spread_of_boxes(bvh.extent, spread) } else { 0.0 };
    let slabs = axes!(i => prepared.slab(i, along.0[i], along.1));
    let down = axes!(i => slabs[i].down);
    let octant = octant_of(down) as usize % 8;
    let mut boxes = BoxProbe {
        inverse: axes!(i => L::splat(token, slabs[i].inverse)),
        minus_inverse: axes!(i => L::splat(token, -slabs[i].inverse)),
        minus_near: axes!(i => L::splat(token, slabs[i].minus_near)),
        far: axes!(i => L::splat(token, slabs[i].far)),
        start: L::splat(token, start[0] - around),
        minus_end: L::splat(token, -(search.best + around)),
    };

    let mut frames = [Frame { node: 0, left: 0, best: 0.0 }; FRAMES];
    let (mut top, mut child) = (0, bvh.root);
    let (mut number, mut node, mut left) = (0, &BvhNode::EMPTY, 0);
    'search: loop {
        if child & LEAF == 0 {
            if left != 0 {
                frames[top % FRAMES] = Frame { node: number, left, best: search.best };
                top = top % FRAMES + 1;
            }
            let Some(next) = bvh.nodes.get(child as usize) else { break };
            (number, node) = (child, next);
            left = enter::<L, Q>(token, &boxes, node, down, octant);
        } else {
            let before = search.best;
            if search.look::<L, SPREADS>(token, &mut spheres, time, child & !LEAF) {
                return Q::one(&search.answer, 0);
            }
            if search.best < before {
                boxes.minus_end = L::splat(token, -(search.best + around));
                if left != 0 {
                    left &= enter::<L, Q>(token, &boxes, node, down, octant);
                }
            }
        }
        while left == 0 {
            if top == 0 {
                break 'search;
            }
            top = (top - 1) % FRAMES;
            let frame = frames[top];
            let Some(next) = bvh.nodes.get(frame.node as usize) else { break 'search };
            (number, node, left) = (frame.node, next, frame.left);
            if search.best < frame.best {
                left &= enter::<L, Q>(token, &boxes, node, down, octant);
            }
        }
        child = node.child[nearest::<Q>(left, node, octant) % WIDTH];
        left = without::<Q>(left);
    }
    search.test::<L>(token);
    Q::one(&search.answer, 0)
}

/// The slot of the nearest of the children that are left.
#[inline(always)]
fn nearest<Q: Query>(left: u32, node: &BvhNode, octant: usize) -> usize {
    if Q::ANY {
        return (u32::BITS - 1 - (left | 1).leading_zeros()) as usize;
    }
    (node.order[7 - octant % 8] >> (4 * left.trailing_zeros() % 64)) as usize
}

/// The children that are left without the nearest.
#[inline(always)]
fn without<Q: Query>(left: u32) -> u32 {
    if Q::ANY {
        left & !(1 << (u32::BITS - 1 - (left | 1).leading_zeros()))
    } else {
        left & (left - 1)
    }
}

/// Which children of a node the ray enters, a bit each: the nearest first, or by their slots for any hit.
#[inline(always)]
fn enter<L: Lanes, Q: Query>(
    token: L::Token,
    probe: &BoxProbe<L>,
    node: &BvhNode,
    down: [bool; 3],
    octant: usize,
) -> u32 {
    count!(RayNode);
    let mut met = 0;
    for part in 0..WIDTH / L::COUNT {
        let (entry, leave) = probe.interval(&Boxes::load(token, node, down, part));
        let first = part * L::COUNT;
        met |= if Q::ANY {
            entry.le(leave).bits() << first
        } else {
            entry.le_in_order(leave, first, node.order[7 - octant % 8])
        };
    }
    met
}

/// Prepares rays of any length, and from afar. (From the ray as given, since what a call borrows must be in memory: that took
/// 1 to 4 % of a ray's time.)
#[cold]
#[inline(never)]
fn again(ray: &Ray, bvh: &Bvh<'_>, tier: (Squares, bool)) -> PreparedLanes<f32> {
    let rays = RayLanes::<f32>::load((), &RayPacket::new(core::slice::from_ref(ray)));
    PreparedLanes::of_any_size(&rays, (bvh.scale.factor, bvh.extent), tier)
}

/// A node on the way, and which of its children are left.
#[derive(Clone, Copy)]
struct Frame {
    node: u32,
    left: u32,
    best: f32,
}

#[cfg(all(test, proofs))]
mod tests;
