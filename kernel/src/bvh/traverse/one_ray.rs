//! One ray a call.
//!
//! # Method
//!
//! The ray is prepared in one lane, and looks into a node's sixteen boxes or a leaf's sixteen spheres at once. What
//! is left of a node are bits, the nearest first; where the ray enters its boxes is not kept: when a hit is closer than
//! what was known, the boxes of the nodes on the way are tested once more. So nothing large is
//! made for a ray: 256 bytes, not the 2 KiB of a stack that other traversals make once for many rays. At the end the tier
//! tests what may be the closest, one sphere after the other, in one lane.
//!
//! (By `Exact` at AVX2 on Zen 3 the rate is 0.70 to 1.33 times that of Embree's `rtcIntersect1` and `rtcOccluded1`, on
//! five scenes. Not measured at AVX-512. What limits it was not measured either: counters were not to be had.)

use super::boxes::{BoxProbe, Boxes};
use super::in_flight::test_from_afar;
use super::prepared_ray::{PreparedLanes, RayTime, far_away};
use super::root_interval::RayProbe;
use super::source::SphereSource;
use crate::Accuracy;
use crate::accuracy::{RayLanes, is_closer, test_one};
use crate::bvh::leaf::place_of;
use crate::bvh::node::{BvhNode, DEPTH, LEAF, NO_CHILD, WIDTH, octant_of};
use crate::bvh::tree::Bvh;
use crate::geometry::hit::Hit;
use crate::geometry::ray::{Ray, RayPacket};
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::linear;
use crate::numeric::axes::axes;
use crate::numeric::rounding::least;
use crate::query::Query;
use crate::scale::rays::ScaledRays;

/// How many candidates are kept.
const MOST: usize = 8;
/// How many frames there are: more than nodes lie one below the other.
const FRAMES: usize = 16;
const _: () = assert!(FRAMES > DEPTH);

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
    // A sphere by itself: to look at it costs as much as to test it.
    if let [_, u32::MAX, u32::MAX, u32::MAX] = bvh.indices
        && bvh.root != NO_CHILD
        && bvh.outside.is_empty()
    {
        search.places[0] = place_of(bvh.root & !LEAF, 0);
        search.count = 1;
        search.test::<L>(token);
        return Q::one(&search.answer, 0);
    }
    let mut prepared = PreparedLanes::as_they_are(&ScaledRays::new(&rays, bvh.scale.factor));
    // Fast and Geometric are off by so much more that nothing is gained: their rays are not moved.
    let far = !SPREADS && far_away(prepared.covered, prepared.absolute_error, bvh.extent);
    if !prepared.covered | far {
        prepared = again(&rays, bvh, !SPREADS);
    }
    if (!prepared.covered | !bvh.outside.is_empty()) && search.unusual(&rays, &mut prepared)
        || bvh.root == NO_CHILD
    {
        return Q::one(&search.answer, 0);
    }
    let prepared = &prepared;
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
    if bvh.root & LEAF != 0 {
        if !search.look::<L, SPREADS>(token, &mut spheres, time, bvh.root & !LEAF) {
            search.test::<L>(token);
        }
        return Q::one(&search.answer, 0);
    }

    let around = if SPREADS { prepared.spread_of_boxes(bvh.extent, spread) } else { 0.0 };
    let slabs = axes!(i => prepared.slab(i));
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
        let slot = if Q::ANY {
            let slot = u32::BITS - 1 - (left | 1).leading_zeros();
            left &= !(1 << slot);
            u64::from(slot)
        } else {
            let place = left.trailing_zeros();
            left &= left - 1;
            node.order[7 - octant] >> (4 * place % 64)
        };
        child = node.child[slot as usize % WIDTH];
    }
    search.test::<L>(token);
    Q::one(&search.answer, 0)
}

/// Which children of a node the ray enters, a bit each: the nearest first; by their slots where any hit will do.
#[inline(always)]
fn enter<L: Lanes, Q: Query>(
    token: L::Token,
    probe: &BoxProbe<L>,
    node: &BvhNode,
    down: [bool; 3],
    octant: usize,
) -> u32 {
    let mut met = 0;
    for part in 0..WIDTH / L::COUNT {
        let (these, _) = probe.enter(&Boxes::load(token, node, down, part));
        met |= these.bits() << (part * L::COUNT);
    }
    if Q::ANY { met } else { L::bits_in_order(token, met, node.order[7 - octant % 8]) }
}

/// Rays of any length, and from afar.
#[cold]
#[inline(never)]
fn again(rays: &RayLanes<f32>, bvh: &Bvh<'_>, moves: bool) -> PreparedLanes<f32> {
    let extent = if moves { Some(bvh.extent) } else { None };
    PreparedLanes::of_any_length(rays, bvh.scale.factor, extent)
}

/// A node on the way, and which of its children are left.
#[derive(Clone, Copy)]
struct Frame {
    node: u32,
    left: u32,
    best: f32,
}

/// A ray, and what it has found.
struct Search<'a, T, Q: Query> {
    tier: T,
    bvh: &'a Bvh<'a>,
    ray: &'a Ray,
    answer: Q::Packet<[f32; 1]>,
    places: [u32; MOST],
    entries: [f32; MOST],
    count: usize,
    best: f32,
}

impl<T: Accuracy, Q: Query> Search<'_, T, Q> {
    /// Rays that no bound covers, and spheres that no bound sees. Whether the ray is done.
    #[cold]
    #[inline(never)]
    fn unusual(&mut self, rays: &RayLanes<f32>, prepared: &mut PreparedLanes<f32>) -> bool {
        let Self { tier, bvh, ray, answer, .. } = self;
        let packet = RayPacket::new(core::slice::from_ref(*ray));
        if !bvh.outside.is_empty() {
            let (rays, answers) = (core::slice::from_ref(&packet), core::slice::from_mut(answer));
            linear::traverse_some::<f32, Q>(*tier, (), &bvh.outside(), rays, answers);
        }
        let limit = Q::limit::<[f32; 1]>(answer, 0);
        if limit == f32::NEG_INFINITY {
            return true;
        }
        if !prepared.covered {
            test_from_afar::<f32, Q>(*tier, (), bvh, (&packet, rays), answer);
            return true;
        }
        prepared.end[1] = least(prepared.time.after(limit), prepared.end[1]);
        false
    }

    /// Looks at the spheres of a leaf; whether the ray is done.
    #[inline(always)]
    fn look<L: Lanes, const SPREADS: bool>(
        &mut self,
        token: L::Token,
        probe: &mut RayProbe<L>,
        time: RayTime<f32>,
        number: u32,
    ) -> bool {
        let Some(leaf) = self.bvh.leaf(number) else { return false };
        for part in 0..WIDTH / L::COUNT {
            let lanes = leaf.lanes >> (part * L::COUNT);
            let pass = probe.pass(&leaf.columns, part);
            let may_hit = pass.may_hit::<SPREADS>(probe.start[0], probe.end[1], probe.spread);
            if may_hit.bits() & lanes == 0 {
                continue;
            }
            let RayProbe { start, end, raise, spread, .. } = *probe;
            let interval = pass.root_interval::<SPREADS>(start, end, raise, spread);
            let candidates = interval.candidates.bits();
            let (entries, bounds) = (interval.entry.store(), interval.bound.store());
            // Which sphere it is does not wait for its roots.
            let mut rest = may_hit.bits() & lanes;
            while rest != 0 {
                let lane = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                if candidates >> lane & 1 == 0 {
                    continue;
                }
                let (entry, bound) = (entries.get(lane), bounds.get(lane));
                if Q::ANY && bound < f32::INFINITY {
                    let any = Hit { t: 0.0, sphere: 0 };
                    Q::take::<[f32; 1]>(&mut self.answer, 0, any, |_| false);
                    return true;
                }
                if entry > self.best {
                    continue;
                }
                self.best = if bound < self.best { bound } else { self.best };
                self.push::<L>(
                    token,
                    time,
                    place_of(number, (part * L::COUNT + lane) as u32),
                    entry,
                );
            }
            probe.end[1] = L::splat(token, self.best);
        }
        false
    }

    /// Keeps a candidate.
    #[inline(always)]
    fn push<L: Lanes>(&mut self, token: L::Token, time: RayTime<f32>, place: u32, entry: f32) {
        while self.count > 0 && self.entries[(self.count - 1) % MOST] > self.best {
            self.count -= 1;
        }
        if self.count == MOST {
            self.test::<L>(token);
            let t = Q::limit::<[f32; 1]>(&self.answer, 0);
            self.best = least(time.after(t), self.best);
        }
        self.places[self.count % MOST] = place;
        self.entries[self.count % MOST] = entry;
        self.count = self.count % MOST + 1;
    }

    /// Has the tier test what is kept.
    #[inline(always)]
    fn test<L: Lanes>(&mut self, token: L::Token) {
        L::out_of_line(
            token,
            #[inline(always)]
            || self.test_here(),
        );
    }

    #[inline(always)]
    fn test_here(&mut self) {
        let Self { tier, bvh, ray, .. } = self;
        for at in 0..self.count {
            if self.entries[at % MOST] > self.best {
                continue;
            }
            let Some((sphere, index)) = bvh.sphere_at(self.places[at % MOST]) else { continue };
            let t = test_one(*tier, ray, &sphere);
            if t < f32::INFINITY {
                Q::take::<[f32; 1]>(
                    &mut self.answer,
                    0,
                    Hit { t, sphere: index },
                    #[inline(always)]
                    |old| is_closer(*tier, &bvh.spheres, ray, t, [index, old]),
                );
            }
        }
        self.count = 0;
    }
}

#[cfg(test)]
mod tests;
