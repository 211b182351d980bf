//! A packet of a bundle: its rays, the planes around them, and what they have met so far.
//!
//! # Method
//!
//! A sphere is met in single precision first: an s that no answer of a lane is below, its *entry*,
//! and one that the answer is surely not above (`bracket.rs`). A lane keeps one sphere, its *pending*
//! one, about which the tier is asked when all is walked, for all lanes at once. Only where two
//! spheres may both be a lane's nearest is the tier asked before.

use super::answers::Nearest;
use super::approach::{Approach, RayTime, far_away};
use super::bracket::{Bracket, Passed};
use super::frustum::Sides;
use super::resolve::{ask, settle_outside, sphere_at};
use super::{Bvh, BvhLeaf, WIDTH};
use crate::accuracy::RayLanes;
use crate::axes::axes;
use crate::{Accuracy, HitPacket, LaneMask, Lanes, RayPacket};

/// A packet under way.
#[derive(Clone, Copy)]
pub(super) struct Member<'a, L: Lanes> {
    /// The rays themselves: read again where the tier is asked.
    packet: &'a RayPacket<L>,
    /// Whether the bounds cover all of its rays, and all start at t >= 0.
    pub(super) covered: bool,
    /// Whether its rays may begin elsewhere than they say.
    pub(super) moved: bool,
    /// The planes around these rays alone.
    pub(super) sides: Sides,
    /// The greatest depth that one of them still goes to.
    pub(super) depth: f32,
    /// Rays that may yet meet something nearer.
    pub(super) live: L::Mask,
    /// o'.
    pub(super) origin: [L; 3],
    /// n.
    pub(super) direction: [L; 3],
    time: RayTime<L>,
    /// As [`Approach::aside`].
    pub(super) aside: L,
    /// The interval starts in between: an s below, and an s above.
    start: [L; 2],
    /// It ends above.
    end: L,
    /// No root beyond counts any more: an s.
    pub(super) best: L,
    /// Of the pending sphere: no root is below; NaN where there is none.
    entry: L,
    /// Its place in the leaves, as bits.
    place: L,
    /// That place, where all pending spheres are one.
    shared: Option<u32>,
    /// The nearest answer of the tier so far, and the index of its sphere, as bits.
    t: L,
    sphere: L,
}

impl<'a, L: Lanes> Member<'a, L> {
    #[inline(always)]
    pub(super) fn new(token: L::Token, packet: &'a RayPacket<L>) -> Self {
        let rays = RayLanes::load(token, packet);
        let Approach { judged, origin, direction, time, aside, start, end: [end, best] } =
            Approach::as_it_is(&rays);
        let forward = L::splat(token, 0.0).le(rays.t_min);
        Self {
            packet,
            covered: !(rays.live & !(judged & forward)).any(),
            moved: false,
            sides: Sides::NONE,
            depth: f32::INFINITY,
            live: rays.live,
            origin,
            direction,
            time,
            aside,
            start,
            end,
            best,
            entry: L::splat(token, f32::NAN),
            place: L::splat(token, 0.0),
            shared: None,
            t: L::splat(token, f32::INFINITY),
            sphere: L::splat(token, f32::from_bits(HitPacket::<L>::NO_SPHERE)),
        }
    }

    /// Begins nearer to a tree of that extent, before all else.
    #[inline(always)]
    fn approach(&mut self, extent: f32) {
        let rays = RayLanes::load(self.aside.token(), self.packet);
        let Approach { origin, time, aside, start, end: [end, best], .. } =
            Approach::as_it_is(&rays).nearer(&rays, extent);
        (self.origin, self.time, self.aside) = (origin, time, aside);
        (self.start, self.end, self.best) = (start, end, best);
        self.moved = true;
    }

    /// Meets the spheres that no node leads to.
    #[inline(always)]
    pub(super) fn meet_outside<A: Accuracy, const ANY: bool>(&mut self, outside: &[BvhLeaf]) {
        let token = self.aside.token();
        let mut hits = [HitPacket::<L>::none()];
        let rays = RayLanes::load(token, self.packet);
        let mut nearest = Nearest::<L>(&mut hits);
        settle_outside::<A, L>(&rays, outside, self.live.bits(), 0, &mut nearest);
        self.t = L::load(token, &hits[0].t);
        let mut spheres = L::Array::default();
        for (bits, index) in spheres.as_mut().iter_mut().zip(hits[0].sphere.as_ref()) {
            *bits = f32::from_bits(*index);
        }
        self.sphere = L::load(token, &spheres);
        self.shorten::<ANY>();
    }

    /// Meets sphere `place` of leaf `leaf`; answers whether any ray may end sooner than before.
    #[inline(always)]
    pub(super) fn meet<A: Accuracy, const ANY: bool>(
        &mut self,
        bvh: &Bvh<'_>,
        (number, leaf): (u32, &BvhLeaf),
        place: usize,
    ) -> bool {
        let token = self.aside.token();
        let center = axes!(i => L::splat(token, leaf.center[i][place % WIDTH]));
        let radius = L::splat(token, leaf.radius[place % WIDTH]);
        let passed = Passed::new(self.origin, self.direction, self.aside, center, radius);
        let near = self.live & passed.may_meet::<A>(self.start[0], self.best);
        if !near.any() {
            return false;
        }

        let Bracket { candidates, entry, bound } =
            passed.bracket::<A>(self.start, [self.end, self.best], self.time.blur());
        let mut candidates = near & candidates;
        if ANY {
            let sure = candidates & bound.lt(bound.like(f32::INFINITY));
            self.t = L::select(sure, self.t.like(0.0), self.t);
            self.shorten::<ANY>();
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
                || self.settle::<A, ANY>(bvh.leaves, both),
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

    /// Asks the tier about the pending spheres of the lanes `asked`, which have none then.
    #[inline(always)]
    fn settle<A: Accuracy, const ANY: bool>(&mut self, leaves: &[BvhLeaf], asked: L::Mask) {
        let token = self.aside.token();
        let rays = RayLanes::load(token, self.packet);
        let Asked { center, radius, index } = Asked::new(leaves, self.place, self.shared);
        let t = ask::<A, L>(&rays, center, radius, asked, self.t);
        self.take(asked, t, index);
        self.entry = L::select(asked, self.entry.like(f32::NAN), self.entry);
        self.shorten::<ANY>();
    }

    /// Takes the answers of the lanes `asked` that are nearer, or as near and of a lower index.
    #[inline(always)]
    fn take(&mut self, asked: L::Mask, t: L, sphere: L) {
        let found = asked & t.lt(t.like(f32::INFINITY));
        let mut nearer = found & t.lt(self.t);
        let equal = (found & t.le(self.t) & self.t.le(t)).bits();
        if equal != 0 {
            let (ours, theirs) = (self.sphere.store(), sphere.store());
            let mut lower = L::Array::default();
            for (lower, (ours, theirs)) in
                lower.as_mut().iter_mut().zip(ours.as_ref().iter().zip(theirs.as_ref()))
            {
                *lower = if theirs.to_bits() < ours.to_bits() { 1.0 } else { 0.0 };
            }
            let lower = t.like(0.0).lt(L::load(t.token(), &lower));
            nearer = nearer | (found & t.le(self.t) & lower);
        }
        self.t = L::select(nearer, t, self.t);
        self.sphere = L::select(nearer, sphere, self.sphere);
    }

    /// Takes the hits so far as the ends of the rays.
    #[inline(always)]
    fn shorten<const ANY: bool>(&mut self) {
        let infinity = self.t.like(f32::INFINITY);
        if ANY {
            let met = self.t.lt(infinity);
            self.live = self.live & !met;
            self.best = L::select(met, -infinity, self.best);
            self.entry = L::select(met, self.entry.like(f32::NAN), self.entry);
        } else {
            let bound = self.time.after(self.t);
            self.best = L::select(bound.lt(self.best), bound, self.best);
        }
    }

    /// Asks about what is pending; after that, [`Member::hits`] and [`Member::met`] are the answers.
    #[inline(always)]
    pub(super) fn finish<A: Accuracy, const ANY: bool>(&mut self, leaves: &[BvhLeaf]) {
        let pending = self.live & self.entry.le(self.best);
        if pending.any() {
            self.settle::<A, ANY>(leaves, pending);
        }
    }

    /// The nearest hits.
    #[inline(always)]
    pub(super) fn hits(&self) -> HitPacket<L> {
        let mut hits = HitPacket::<L>::none();
        hits.t = self.t.store();
        let spheres = self.sphere.store();
        for (index, bits) in hits.sphere.as_mut().iter_mut().zip(spheres.as_ref()) {
            *index = bits.to_bits();
        }
        hits
    }

    /// Which rays have met anything, a bit each.
    #[inline(always)]
    pub(super) fn met(&self) -> u32 {
        self.t.lt(self.t.like(f32::INFINITY)).bits()
    }
}

/// Lets new members begin nearer to a tree of that extent, where any of their rays are far away: in place,
/// since a choice between two members costs a tenth of a bundle's time.
#[inline(always)]
pub(super) fn approach<A: Accuracy, L: Lanes>(members: &mut [Member<'_, L>], extent: f32) {
    let Some(first) = members.first() else { return };
    let token = first.aside.token();
    let mut far = far_away(first.live, first.aside, extent);
    for member in members.iter().skip(1) {
        far = far | far_away(member.live, member.aside, extent);
    }
    if A::SPREAD > 0.0 || !far.any() {
        return;
    }
    L::out_of_line(
        token,
        #[inline(always)]
        || {
            for member in members {
                member.approach(extent);
            }
        },
    );
}

/// One sphere a lane.
struct Asked<L: Lanes> {
    center: [L; 3],
    radius: L,
    /// As bits.
    index: L,
}

impl<L: Lanes> Asked<L> {
    /// The spheres whose places in the leaves are the bits of `places`, or the `shared` one.
    #[inline(always)]
    fn new(leaves: &[BvhLeaf], places: L, shared: Option<u32>) -> Self {
        let token = places.token();
        if let Some((sphere, index)) = shared.and_then(
            #[inline(always)]
            |place| sphere_at(leaves, place),
        ) {
            return Self {
                center: axes!(i => L::splat(token, sphere.center[i])),
                radius: L::splat(token, sphere.radius),
                index: L::splat(token, f32::from_bits(index)),
            };
        }

        let places = places.store();
        let mut center: [L::Array; 3] = Default::default();
        let (mut radius, mut index) = (L::Array::default(), L::Array::default());
        for lane in 0..L::COUNT {
            let Some(place) = places.as_ref().get(lane) else { continue };
            let Some((sphere, number)) = sphere_at(leaves, place.to_bits()) else { continue };
            let [x, y, z] = &mut center;
            for (array, value) in [
                (x, sphere.center.x),
                (y, sphere.center.y),
                (z, sphere.center.z),
                (&mut radius, sphere.radius),
                (&mut index, f32::from_bits(number)),
            ] {
                if let Some(element) = array.as_mut().get_mut(lane) {
                    *element = value;
                }
            }
        }
        Self {
            center: axes!(i => L::load(token, &center[i])),
            radius: L::load(token, &radius),
            index: L::load(token, &index),
        }
    }
}
