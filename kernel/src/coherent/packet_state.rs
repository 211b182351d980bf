//! A packet of a group: its rays, the planes around them, and what they have hit so far.
//!
//! # Method
//!
//! A sphere is tested in single precision first: an s that no answer of a lane is below, its *entry*,
//! and one that the answer is surely not above (`root_interval.rs`). A lane keeps one sphere, its *pending*
//! one, which the tier tests when the traversal is through, for all lanes at once. Only where two
//! spheres may both be a lane's closest does the tier test before.

use super::frustum::Sides;
use crate::Accuracy;
use crate::accuracy::{RayLanes, test_lanes};
use crate::bvh::traverse::deferred::{SphereSource, test_outside};
use crate::bvh::traverse::prepared_ray::{PreparedLanes, RayTime, far_away};
use crate::bvh::traverse::root_interval::{Pass, RootInterval, SphereColumns};
use crate::geometry::hit::HitPacket;
use crate::geometry::ray::RayPacket;
use crate::lanes::{LaneArray, LaneMask, Lanes, WIDTH};
use crate::numeric::axes::axes;
use crate::query::{ClosestHit, Query};

/// A packet in flight.
#[derive(Clone, Copy)]
pub(super) struct PacketState<'a, L: Lanes> {
    /// The rays themselves: read again where the tier tests.
    packet: &'a RayPacket<L::Array>,
    /// Whether the bounds cover all of its rays, and all start at t >= 0.
    pub(super) covered: bool,
    /// Whether its rays may begin elsewhere than they say.
    pub(super) moved: bool,
    /// The planes around these rays alone.
    pub(super) sides: Sides,
    /// The greatest depth, as a frustum or a list counts it, that one of them still goes to.
    pub(super) depth: f32,
    /// Rays that may yet meet something nearer.
    pub(super) live: L::Mask,
    /// o'.
    pub(super) origin: [L; 3],
    /// n.
    pub(super) direction: [L; 3],
    time: RayTime<L>,
    /// As [`PreparedLanes::absolute_error`].
    pub(super) absolute_error: L,
    /// The interval starts in between: an s below, and an s above.
    start: [L; 2],
    /// It ends above.
    end: L,
    /// No root beyond counts any more: an s.
    pub(super) best: L,
    /// Of the pending sphere: no root is below; NaN where there is none.
    entry: L,
    /// Its place in the structure, as bits.
    place: L,
    /// That place, where all pending spheres are one.
    shared: Option<u32>,
    /// The nearest answer of the tier so far, and the index of its sphere, as bits.
    t: L,
    sphere: L,
}

impl<'a, L: Lanes> PacketState<'a, L> {
    #[inline(always)]
    pub(super) fn new(packet: &'a RayPacket<L::Array>, rays: &RayLanes<L>) -> Self {
        let token = rays.t_min.token();
        let PreparedLanes {
            covered,
            origin,
            direction,
            time,
            absolute_error,
            start,
            end: [end, best],
        } = PreparedLanes::as_they_are(rays);
        let forward = L::splat(token, 0.0).le(rays.t_min);
        Self {
            packet,
            covered: !(rays.live & !(covered & forward)).any(),
            moved: false,
            sides: Sides::NONE,
            depth: f32::INFINITY,
            live: rays.live,
            origin,
            direction,
            time,
            absolute_error,
            start,
            end,
            best,
            entry: L::splat(token, f32::NAN),
            place: L::splat(token, 0.0),
            shared: None,
            t: L::splat(token, f32::INFINITY),
            sphere: L::splat(token, f32::from_bits(HitPacket::<L::Array>::NO_SPHERE)),
        }
    }

    /// Begins nearer to a tree of that extent, before all else.
    #[inline(always)]
    fn approach(&mut self, extent: f32) {
        let rays = RayLanes::load(self.absolute_error.token(), self.packet);
        let PreparedLanes { origin, time, absolute_error, start, end: [end, best], .. } =
            PreparedLanes::as_they_are(&rays).nearer(&rays, extent);
        (self.origin, self.time, self.absolute_error) = (origin, time, absolute_error);
        (self.start, self.end, self.best) = (start, end, best);
        self.moved = true;
    }

    /// Tests the spheres that every ray must be tested against.
    #[inline(always)]
    pub(super) fn test_outside<Q: Query>(
        &mut self,
        tier: impl Accuracy,
        source: &impl SphereSource,
    ) {
        let token = self.absolute_error.token();
        let mut hits = HitPacket::none();
        let rays = RayLanes::load(token, self.packet);
        test_outside::<L, ClosestHit>(tier, &rays, source, self.live.bits(), &mut hits);
        self.t = L::load(token, &hits.t);
        let mut spheres = L::Array::filled(0.0);
        let indices = hits.sphere.as_ref();
        for lane in 0..L::COUNT {
            if let Some(&index) = indices.get(lane) {
                spheres.set(lane, f32::from_bits(index));
            }
        }
        self.sphere = L::load(token, &spheres);
        self.shorten::<Q>();
    }

    /// Meets sphere `place` of block `number` of sixteen; returns whether any ray may end sooner than
    /// before.
    #[inline(always)]
    pub(super) fn meet<Q: Query>(
        &mut self,
        tier: impl Accuracy,
        source: &impl SphereSource,
        (number, spheres): (u32, &SphereColumns<'_>),
        place: usize,
    ) -> bool {
        let (token, spread) = (self.absolute_error.token(), tier.spread());
        let center = axes!(i => L::splat(token, spheres.center[i][place % WIDTH]));
        let radius = L::splat(token, spheres.radius[place % WIDTH]);
        let pass = Pass::new(self.origin, self.direction, self.absolute_error, center, radius);
        let near = self.live & pass.may_hit(self.start[0], self.best, spread);
        if !near.any() {
            return false;
        }

        let RootInterval { candidates, entry, bound } =
            pass.root_interval(self.start, [self.end, self.best], self.time.t_error(), spread);
        let mut candidates = near & candidates;
        if Q::ANY {
            let sure = candidates & bound.lt(bound.like(f32::INFINITY));
            self.t = L::select(sure, self.t.like(0.0), self.t);
            self.shorten::<Q>();
            candidates = candidates & !sure;
        } else {
            let nearer = candidates & bound.lt(self.best);
            self.best = L::select(nearer, bound, self.best);
        }
        let both = candidates & self.entry.le(self.best);
        if both.any() {
            L::out_of_line(
                token,
                #[inline(always)]
                || self.settle::<Q>(tier, source, both),
            );
            candidates = candidates & entry.le(self.best);
        }
        let place = number * WIDTH as u32 + place as u32;
        self.entry = L::select(candidates, entry, self.entry);
        self.place = L::select(candidates, self.place.like(f32::from_bits(place)), self.place);
        let others = self.entry.le(self.entry) & !candidates;
        self.shared = if others.any() { None } else { Some(place) };
        true
    }

    /// Tests the pending spheres of the lanes `asked`, which have none then.
    #[inline(always)]
    fn settle<Q: Query>(
        &mut self,
        tier: impl Accuracy,
        source: &impl SphereSource,
        asked: L::Mask,
    ) {
        let token = self.absolute_error.token();
        let rays = RayLanes::load(token, self.packet);
        let Pending { center, radius, index } = Pending::new(source, self.place, self.shared);
        let t = test_lanes(tier, &rays, center, radius, asked, self.t);
        self.take(asked, t, index);
        self.entry = L::select(asked, self.entry.like(f32::NAN), self.entry);
        self.shorten::<Q>();
    }

    /// Takes the answers of the lanes `asked` that are nearer, or as near and of a lower index.
    #[inline(always)]
    fn take(&mut self, asked: L::Mask, t: L, sphere: L) {
        let found = asked & t.lt(t.like(f32::INFINITY));
        let mut nearer = found & t.lt(self.t);
        let equal = (found & t.le(self.t) & self.t.le(t)).bits();
        if equal != 0 {
            let (ours, theirs) = (self.sphere.store(), sphere.store());
            let mut lower = L::Array::filled(0.0);
            for lane in 0..L::COUNT {
                if theirs.get(lane).to_bits() < ours.get(lane).to_bits() {
                    lower.set(lane, 1.0);
                }
            }
            let lower = t.like(0.0).lt(L::load(t.token(), &lower));
            nearer = nearer | (found & t.le(self.t) & lower);
        }
        self.t = L::select(nearer, t, self.t);
        self.sphere = L::select(nearer, sphere, self.sphere);
    }

    /// Takes the hits so far as the ends of the rays.
    #[inline(always)]
    fn shorten<Q: Query>(&mut self) {
        let infinity = self.t.like(f32::INFINITY);
        if Q::ANY {
            let met = self.t.lt(infinity);
            self.live = self.live & !met;
            self.best = L::select(met, -infinity, self.best);
            self.entry = L::select(met, self.entry.like(f32::NAN), self.entry);
        } else {
            let bound = self.time.after(self.t);
            self.best = L::select(bound.lt(self.best), bound, self.best);
        }
    }

    /// Tests what is pending, and returns the answers.
    #[inline(always)]
    pub(super) fn finish<Q: Query>(
        &mut self,
        tier: impl Accuracy,
        source: &impl SphereSource,
    ) -> Q::Packet<L::Array> {
        let pending = self.live & self.entry.le(self.best);
        if pending.any() {
            self.settle::<Q>(tier, source, pending);
        }
        Q::from_lanes::<L>(self.t, self.sphere)
    }
}

/// Lets new packets begin nearer to a scene of that extent, if any of their rays are far away: in place,
/// since a choice between two states costs a tenth of a group's time.
#[inline(always)]
pub(super) fn approach<L: Lanes>(states: &mut [PacketState<'_, L>], extent: f32, spread: f32) {
    let Some(first) = states.first() else { return };
    let token = first.absolute_error.token();
    let mut far = far_away(first.live, first.absolute_error, extent);
    for state in states.iter() {
        far = far | far_away(state.live, state.absolute_error, extent);
    }
    if spread > 0.0 || !far.any() {
        return;
    }
    L::out_of_line(
        token,
        #[inline(always)]
        || {
            for state in states {
                state.approach(extent);
            }
        },
    );
}

/// One sphere a lane.
struct Pending<L: Lanes> {
    center: [L; 3],
    radius: L,
    /// As bits.
    index: L,
}

impl<L: Lanes> Pending<L> {
    /// The spheres whose places are the bits of `places`, or the `shared` one.
    #[inline(always)]
    fn new(source: &impl SphereSource, places: L, shared: Option<u32>) -> Self {
        let token = places.token();
        if let Some(place) = shared
            && let Some((sphere, index)) = source.sphere_at(place)
        {
            return Self {
                center: axes!(i => L::splat(token, sphere.center[i])),
                radius: L::splat(token, sphere.radius),
                index: L::splat(token, f32::from_bits(index)),
            };
        }

        let places = places.store();
        let none = L::Array::filled(0.0);
        let (mut center, mut radius, mut index) = ([none; 3], none, none);
        for lane in 0..L::COUNT {
            let place = places.get(lane).to_bits();
            let Some((sphere, number)) = source.sphere_at(place) else { continue };
            for axis in 0..3 {
                center[axis].set(lane, sphere.center[axis]);
            }
            radius.set(lane, sphere.radius);
            index.set(lane, f32::from_bits(number));
        }
        Self {
            center: axes!(i => L::load(token, &center[i])),
            radius: L::load(token, &radius),
            index: L::load(token, &index),
        }
    }
}
