//! One ray in flight: what it knows, and what it does with nodes and leaves.
//!
//! Spheres that come in another order than that of their s cost time, no memory: when the list of candidates is full, the
//! tier tests it.

use super::boxes::{BoxProbe, Boxes};
use super::deferred::{DeferredTests, RayPlace};
use super::prepared_packet::PreparedPacket;
use super::root_interval::RayProbe;
use super::stack::Stack;
use crate::Accuracy;
use crate::bvh::leaf::{Leaf, place_of};
use crate::bvh::node::{BvhNode, WIDTH, octant_of};
use crate::count::count;
use crate::geometry::hit::Hit;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::numeric::rounding::least;
use crate::query::Query;

/// How many candidates a ray can keep.
const MOST: usize = 8;

/// Spheres that may be a ray's closest, by their places in the leaves, until the tier tests them.
#[derive(Clone, Copy, Debug)]
struct Candidates {
    places: [u32; MOST],
    /// An s that no answer of that candidate is below.
    entries: [f32; MOST],
    count: usize,
}

impl Candidates {
    const NONE: Self = Self { places: [0; MOST], entries: [0.0; MOST], count: 0 };

    /// Drops candidates whose entry is past `best`, if there is no room for another; returns whether there is still none.
    #[inline(always)]
    fn is_full(&mut self, best: f32) -> bool {
        if self.count < MOST {
            return false;
        }
        let mut kept = 0;
        for at in 0..MOST {
            if self.entries[at] <= best {
                // The remainder tells the compiler that the place is there.
                self.entries[kept % MOST] = self.entries[at];
                self.places[kept % MOST] = self.places[at];
                kept += 1;
            }
        }
        self.count = kept;
        kept == MOST
    }

    #[inline(always)]
    fn push(&mut self, place: u32, entry: f32) {
        // `get_mut`, since the compiler loses the bound of an index by `count` on its way here.
        if let (Some(to), Some(at)) =
            (self.places.get_mut(self.count), self.entries.get_mut(self.count))
        {
            (*to, *at) = (place, entry);
            self.count += 1;
        }
    }
}

/// One ray in flight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayState {
    pub(crate) ray: RayPlace,
    /// Which packet in flight it is of; past all of them if it is of none.
    pub(crate) packet: u32,
    /// The octant of its direction.
    octant: u32,
    /// An s that some answer, or the end of the interval, is not above.
    best: f32,
    candidates: Candidates,
    pub(crate) stack: Stack,
}

impl RayState {
    /// The `packet` of a ray that is of none.
    pub(crate) const OF_NONE: u32 = u32::MAX;

    /// All zeros, so that an array of many is cleared, and not copied. A state is [cleared](Self::clear) before it is in
    /// flight.
    pub(crate) const NEW: Self = Self {
        ray: RayPlace::FIRST,
        packet: 0,
        octant: 0,
        best: 0.0,
        candidates: Candidates::NONE,
        stack: Stack::EMPTY,
    };

    /// Makes the ray one of no packet, with nothing to look into.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.packet = Self::OF_NONE;
        self.stack.clear();
    }

    /// Begins with ray `ray`, of the packet in flight `packet`, which is `prepared`.
    #[inline(always)]
    pub(crate) fn begin<A: LaneArray>(
        &mut self,
        prepared: &PreparedPacket<A>,
        packet: u32,
        ray: RayPlace,
        root: u32,
    ) {
        self.ray = ray;
        self.packet = packet;
        self.octant = octant_of(axes!(i => prepared.down[i] >> (ray.lane % 32) & 1 == 1));
        self.best = prepared.end[1].get(ray.lane);
        self.candidates.count = 0;
        self.stack.begin(root);
    }

    /// The s up to which boxes matter.
    #[inline(always)]
    fn end_of_boxes<A: LaneArray>(&self, prepared: &PreparedPacket<A>) -> f32 {
        self.best + prepared.spread.get(self.ray.lane)
    }

    /// Lays the children of a node that the ray enters onto its stack; the nearest on top, except where any hit will
    /// do.
    #[inline(always)]
    pub(crate) fn enter<L: Lanes, Q: Query>(
        &mut self,
        token: L::Token,
        prepared: &PreparedPacket<L::Array>,
        (number, node): (u32, &BvhNode),
    ) {
        count!(RayNode);
        let lane = self.ray.lane;
        let best = self.end_of_boxes(prepared);
        let start = prepared.start[0].get(lane) - prepared.spread.get(lane);
        let down = axes!(i => self.octant >> i & 1 == 1);
        let probe = BoxProbe {
            inverse: axes!(i => L::splat(token, prepared.inverse[i].get(lane))),
            minus_inverse: axes!(i => L::splat(token, prepared.minus_inverse[i].get(lane))),
            minus_near: axes!(i => L::splat(token, prepared.minus_near[i].get(lane))),
            far: axes!(i => L::splat(token, prepared.far[i].get(lane))),
            start: L::splat(token, start),
            minus_end: L::splat(token, -best),
        };
        let (mut met, mut entries) = (0, [0.0; WIDTH]);
        for part in 0..WIDTH / L::COUNT {
            let (these, entry) = probe.enter(&Boxes::load(token, node, down, part));
            met |= these.bits() << (part * L::COUNT);
            entry.store().put_part(&mut entries, part);
        }
        let order = if Q::ANY { None } else { Some(node.order[self.octant as usize % 8]) };
        self.stack.push::<L>(token, (number, order), met, &entries);
    }

    #[inline(always)]
    fn probe<T: Accuracy, L: Lanes, Q: Query>(
        &self,
        tests: &DeferredTests<'_, T, L, Q>,
        prepared: &PreparedPacket<L::Array>,
    ) -> RayProbe<L> {
        let (token, lane) = (tests.token, self.ray.lane);
        let start = &prepared.start;
        RayProbe {
            origin: axes!(i => L::splat(token, prepared.origin[i].get(lane))),
            direction: axes!(i => L::splat(token, prepared.direction[i].get(lane))),
            start: [L::splat(token, start[0].get(lane)), L::splat(token, start[1].get(lane))],
            end: [L::splat(token, prepared.end[0].get(lane)), L::splat(token, self.best)],
            absolute_error: L::splat(token, prepared.absolute_error.get(lane)),
            raise: L::splat(token, prepared.time(lane).raise(tests.tier)),
            spread: tests.tier.spread(),
        }
    }

    /// Which spheres of a leaf to look at.
    #[inline(always)]
    pub(crate) fn may_hit<T: Accuracy, L: Lanes, Q: Query, const SPREADS: bool>(
        &self,
        tests: &DeferredTests<'_, T, L, Q>,
        prepared: &PreparedPacket<L::Array>,
        leaf: &Leaf<'_>,
    ) -> u32 {
        count!(RayLeaf);
        self.probe(tests, prepared).may_hit::<SPREADS>(leaf)
    }

    /// Looks at the spheres of leaf `number`.
    #[inline(always)]
    pub(crate) fn meet<T: Accuracy, L: Lanes, Q: Query, const SPREADS: bool>(
        &mut self,
        tests: &mut DeferredTests<'_, T, L, Q>,
        prepared: &PreparedPacket<L::Array>,
        number: u32,
    ) {
        let Some(leaf) = tests.bvh.leaf(number) else { return };
        count!(RayRoots);
        let before = self.best;
        let probe = self.probe(tests, prepared);
        for part in 0..WIDTH / L::COUNT {
            let interval = probe.root_interval::<SPREADS>(&leaf.columns, part);
            let (entries, bounds) = (interval.entry.store(), interval.bound.store());
            let mut candidates =
                interval.candidates::<Q>(leaf.lanes >> (part * L::COUNT), self.best);
            while candidates != 0 {
                let lane = candidates.trailing_zeros() as usize;
                candidates &= candidates - 1;
                let (entry, bound) = (entries.get(lane), bounds.get(lane));
                if Q::ANY && bound < f32::INFINITY {
                    if let Some(answer) = tests.answers.get_mut(self.ray.packet) {
                        let any = Hit { t: 0.0, sphere: 0 };
                        Q::take::<L::Array>(answer, self.ray.lane, any, |_| false);
                    }
                    self.candidates.count = 0;
                    self.stack.clear();
                    return;
                }
                if entry > self.best {
                    continue;
                }
                if bound < self.best {
                    self.best = bound;
                }
                if self.candidates.is_full(self.best) {
                    // There are too many to keep.
                    self.end(tests);
                    L::out_of_line(
                        tests.token,
                        #[inline(always)]
                        || tests.test(),
                    );
                    let t = tests.limit(self.ray);
                    self.best = least(prepared.time(self.ray.lane).after(t), self.best);
                }
                self.candidates.push(place_of(number, (part * L::COUNT + lane) as u32), entry);
            }
        }
        if self.best < before {
            self.stack.cull::<L>(tests.token, self.end_of_boxes(prepared));
        }
    }

    /// Puts the candidates among the deferred tests.
    #[inline(always)]
    pub(crate) fn end<T: Accuracy, L: Lanes, Q: Query>(
        &mut self,
        tests: &mut DeferredTests<'_, T, L, Q>,
    ) {
        for at in 0..self.candidates.count % (MOST + 1) {
            if self.candidates.entries[at] <= self.best {
                tests.add(self.ray, self.candidates.places[at]);
            }
        }
        self.candidates.count = 0;
    }
}
