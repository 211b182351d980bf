//! A packet of a group: its rays, the planes around them, and what they have hit so far.
//!
//! # Method
//!
//! A sphere is tested in single precision first. The test gives each lane an s that no answer is below, the *entry*,
//! and an s that the answer is surely not above (`root_interval.rs`). A lane keeps one sphere, its *pending*
//! one, which the tier tests when the traversal is through, for all lanes at once. Only where two
//! spheres may both be a lane's closest does the tier test earlier.

use super::effort::Effort;
use super::frustum::Sides;
use crate::Accuracy;
use crate::accuracy::{RayLanes, Squares, is_closer, test_lanes};
use crate::bvh::source::{SphereLanes, SphereSource};
use crate::bvh::traverse::prepared_ray::PreparedLanes;
use crate::bvh::traverse::root_interval::{Pass, RootInterval};
use crate::count::count;
use crate::geometry::hit::HitPacket;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere_columns::SphereColumns;
use crate::lanes::{LaneArray, LaneMask, Lanes, WIDTH};
use crate::numeric::axes::axes;
use crate::query::Query;
use crate::scale::rays::ScaledRays;

/// A packet in flight.
#[derive(Clone, Copy)]
pub(super) struct PacketState<'a, L: Lanes> {
    /// The rays themselves: read again where the tier tests.
    packet: &'a RayPacket<L::Array>,
    /// The rays, prepared; the end of their interval from above is `best`.
    pub(super) rays: PreparedLanes<L>,
    /// Whether the bounds cover all of its rays, and all are [`forward`](PreparedLanes::forward).
    pub(super) covered: bool,
    /// Whether rays of the packet may begin at another point than their origin.
    pub(super) moved: bool,
    /// The planes around these rays alone.
    pub(super) sides: Sides,
    /// The greatest depth, as a tree or a list counts it, that a ray still goes to.
    pub(super) depth: f32,
    /// Rays that may yet hit something closer.
    pub(super) live: L::Mask,
    /// The s beyond which no root counts any more.
    pub(super) best: L,
    /// An s below which the pending sphere has no root; NaN if no sphere is pending.
    entry: L,
    /// The pending sphere's place in the structure, as bits.
    place: L,
    /// That place, if all lanes have the same pending sphere.
    shared: Option<u32>,
    /// The closest answer of the tier so far, and the index of its sphere, as bits.
    t: L,
    sphere: L,
}

impl<'a, L: Lanes> PacketState<'a, L> {
    /// For a packet; `scaled` are its rays as the structure sees them.
    #[inline(always)]
    pub(super) fn new(packet: &'a RayPacket<L::Array>, scaled: &ScaledRays<L>) -> Self {
        count!(GroupPacket);
        let (live, t_min) = (scaled.rays.live, scaled.rays.t_min);
        let (zero, rays) = (t_min.like(0.0), PreparedLanes::as_they_are(scaled));
        Self {
            packet,
            rays,
            covered: !(live & !(rays.covered & zero.le(t_min))).any(),
            moved: false,
            sides: Sides::NONE,
            depth: f32::INFINITY,
            live,
            best: rays.end[1],
            entry: zero.like(f32::NAN),
            place: zero,
            shared: None,
            t: zero.like(f32::INFINITY),
            sphere: zero.like(f32::from_bits(HitPacket::<L::Array>::NO_SPHERE)),
        }
    }

    #[inline(always)]
    pub(super) fn token(&self) -> L::Token {
        self.best.token()
    }

    /// Begins once more, before all else, as [`PreparedLanes::of_any_size`] says.
    #[inline(always)]
    pub(super) fn begin_again(
        &mut self,
        rays: &RayLanes<L>,
        scene: (f32, f32),
        tier: (Squares, bool),
    ) {
        self.rays = PreparedLanes::of_any_size(rays, scene, tier);
        let shift = self.rays.time.shift;
        (self.best, self.moved) = (self.rays.end[1], shift.like(0.0).lt(shift).any());
        self.covered = !(self.live & !(self.rays.covered & self.rays.forward(rays.t_min))).any();
    }

    /// As [`begin_again`](Self::begin_again), for rays that are seen as they are.
    #[inline(always)]
    pub(super) fn approach(&mut self, scene: (f32, f32), tier: (Squares, bool)) {
        self.begin_again(&RayLanes::load(self.token(), self.packet), scene, tier);
    }

    /// Takes answers that are known, after all else.
    #[inline(always)]
    pub(super) fn take_known<Q: Query>(&mut self, answer: &Q::Packet<L::Array>) {
        [self.t, self.sphere] = Q::lanes::<L>(self.token(), answer);
        self.shorten::<Q>();
    }

    /// Tests the spheres `places` of a block of sixteen; returns whether any ray may end sooner than
    /// before. Counts the effort.
    #[inline(always)]
    pub(super) fn meet<Q: Query>(
        &mut self,
        tier: impl Accuracy,
        source: &impl SphereSource,
        block: (u32, &SphereColumns<'_>),
        places: u32,
        effort: &mut Effort,
    ) -> bool {
        if tier.spread() == 0.0 {
            return self.meet_each::<Q, false>(tier, source, block, places, effort);
        }
        L::out_of_line(
            self.token(),
            #[inline(always)]
            || self.meet_each::<Q, true>(tier, source, block, places, effort),
        )
    }

    #[inline(always)]
    fn meet_each<Q: Query, const SPREADS: bool>(
        &mut self,
        tier: impl Accuracy,
        source: &impl SphereSource,
        block: (u32, &SphereColumns<'_>),
        mut places: u32,
        effort: &mut Effort,
    ) -> bool {
        let mut changed = false;
        while places != 0 {
            let place = places.trailing_zeros() as usize;
            places &= places - 1;
            changed |= self.meet_one::<Q, SPREADS>(tier, source, block, place, effort);
        }
        changed
    }

    #[inline(always)]
    fn meet_one<Q: Query, const SPREADS: bool>(
        &mut self,
        tier: impl Accuracy,
        source: &impl SphereSource,
        (number, spheres): (u32, &SphereColumns<'_>),
        place: usize,
        effort: &mut Effort,
    ) -> bool {
        count!(PacketSphere);
        let (token, spread) = (self.token(), tier.spread());
        let PreparedLanes { origin, direction, absolute_error, time, start, end, .. } = self.rays;
        let center = axes!(i => L::splat(token, spheres.center[i][place % WIDTH]));
        let radius = L::splat(token, spheres.radius[place % WIDTH]);
        let pass = Pass::new(origin, direction, absolute_error, center, radius);
        let mut near = self.live & pass.may_hit::<SPREADS>(start[0], self.best, spread);
        if SPREADS && source.is_tree() {
            near = near & pass.meets_box();
        }
        if !near.any() {
            return false;
        }
        effort.roots(near.bits().count_ones());

        count!(PacketRoots);
        let RootInterval { candidates, entry, bound } =
            pass.root_interval::<SPREADS>(start, [end[0], self.best], time.raise(tier), spread);
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
            effort.test(both.bits().count_ones());
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

    /// Tests the pending spheres of the lanes `active`, which have none afterwards.
    #[inline(always)]
    fn settle<Q: Query>(
        &mut self,
        tier: impl Accuracy,
        source: &impl SphereSource,
        active: L::Mask,
    ) {
        let token = self.token();
        let rays = RayLanes::load(token, self.packet);
        let SphereLanes { center, radius, index } =
            SphereLanes::gather(source, self.place, self.shared);
        let t = test_lanes(tier, &rays, center, radius, active, self.t, Q::ANY);
        self.take(tier, source, active, t, index);
        self.entry = L::select(active, self.entry.like(f32::NAN), self.entry);
        self.shorten::<Q>();
    }

    /// Takes the answers of the lanes `active` that are closer.
    #[inline(always)]
    fn take(
        &mut self,
        tier: impl Accuracy,
        source: &impl SphereSource,
        active: L::Mask,
        t: L,
        sphere: L,
    ) {
        let found = active & t.lt(t.like(f32::INFINITY));
        let mut nearer = found & t.lt(self.t);
        let mut equal = (found & t.le(self.t) & self.t.le(t)).bits();
        if equal != 0 {
            let (tied, ours, theirs) = (t.store(), self.sphere.store(), sphere.store());
            let mut closer = 0_u32;
            while equal != 0 {
                let lane = equal.trailing_zeros() as usize;
                equal &= equal - 1;
                let indices = [theirs.get(lane).to_bits(), ours.get(lane).to_bits()];
                let (ray, t) = (self.packet.ray(lane), tied.get(lane));
                let is_closer = is_closer(tier, &source.spheres(), &ray, t, indices);
                closer |= u32::from(is_closer) << lane;
            }
            nearer = nearer | L::mask(t.token(), closer);
        }
        self.t = L::select(nearer, t, self.t);
        self.sphere = L::select(nearer, sphere, self.sphere);
    }

    /// Takes the hits so far as the ends of the rays.
    #[inline(always)]
    fn shorten<Q: Query>(&mut self) {
        let infinity = self.t.like(f32::INFINITY);
        if Q::ANY {
            let occluded = self.t.lt(infinity);
            self.live = self.live & !occluded;
            self.best = L::select(occluded, -infinity, self.best);
            self.entry = L::select(occluded, self.entry.like(f32::NAN), self.entry);
        } else {
            let bound = self.rays.time.after(self.t);
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
