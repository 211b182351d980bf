//! From candidates to answers: where the tier is asked.
//!
//! Candidates of one packet's rays are asked about together, a ray a lane, one candidate each; a
//! ray that has more than its list can hold is asked about alone, a candidate a lane.

use super::{BvhLeaf, WIDTH};
use crate::accuracy::RayLanes;
use crate::axes::axes;
use crate::intersect::lanes_of_bits;
use crate::{Accuracy, Hit, HitArrays, HitPacket, LaneArray, LaneMask, Lanes, RayPacket, Sphere};
use glam::Vec3;

/// How many candidates a ray can keep.
pub(super) const LIST: usize = 8;

/// The spheres that may be a ray's nearest, by their places in the leaves.
#[derive(Clone, Copy, Debug)]
pub(super) struct List {
    places: [u32; LIST],
    /// No answer of that candidate is below.
    entries: [f32; LIST],
    pub(super) count: usize,
}

impl List {
    pub(super) const EMPTY: Self = Self { places: [0; LIST], entries: [0.0; LIST], count: 0 };

    /// Whether another has no room, after those were dropped whose entry is past `best`.
    #[inline(always)]
    pub(super) fn is_full(&mut self, best: f32) -> bool {
        if self.count < LIST {
            return false;
        }
        let mut kept = 0;
        for at in 0..LIST {
            if self.entries[at] <= best {
                self.entries[kept] = self.entries[at];
                self.places[kept] = self.places[at];
                kept += 1;
            }
        }
        self.count = kept;
        kept == LIST
    }

    #[inline(always)]
    pub(super) fn push(&mut self, place: u32, entry: f32) {
        if let (Some(to), Some(at)) =
            (self.places.get_mut(self.count), self.entries.get_mut(self.count))
        {
            *to = place;
            *at = entry;
            self.count += 1;
        }
    }

    /// Candidate `at`, unless its entry is past `best`.
    #[inline(always)]
    pub(super) fn get(&self, at: usize, best: f32) -> Option<u32> {
        let place = *self.places.get(at)?;
        (at < self.count && *self.entries.get(at)? <= best).then_some(place)
    }
}

/// The sphere at a place in the leaves, and its index.
#[inline(always)]
fn sphere_at(leaves: &[BvhLeaf], place: u32) -> Option<(Sphere, u32)> {
    let (leaf, lane) = (leaves.get(place as usize / WIDTH)?, place as usize % WIDTH);
    let [x, y, z] = axes!(i => leaf.center[i][lane]);
    Some((Sphere { center: Vec3::new(x, y, z), radius: leaf.radius[lane] }, leaf.index[lane]))
}

/// Spheres and their indices, one a lane, where there are any.
struct Asked<L: Lanes> {
    center: [L::Array; 3],
    radius: L::Array,
    index: <L::Array as LaneArray>::Ids,
    lanes: u32,
}

impl<L: Lanes> Asked<L> {
    #[inline(always)]
    fn none() -> Self {
        Self {
            center: Default::default(),
            radius: Default::default(),
            index: Default::default(),
            lanes: 0,
        }
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, leaves: &[BvhLeaf], place: u32) {
        let Some((sphere, index)) = sphere_at(leaves, place) else { return };
        let [x, y, z] = &mut self.center;
        for (array, value) in [
            (x, sphere.center.x),
            (y, sphere.center.y),
            (z, sphere.center.z),
            (&mut self.radius, sphere.radius),
        ] {
            if let Some(element) = array.as_mut().get_mut(lane) {
                *element = value;
            }
        }
        if let Some(element) = self.index.as_mut().get_mut(lane) {
            *element = index;
            self.lanes |= 1 << lane;
        }
    }

    /// The t of every lane that is asked, `+inf` where there is none.
    #[inline(always)]
    fn ask<A: Accuracy>(&self, rays: &RayLanes<L>, prepared: &A::Prepared<L>, limit: L) -> L {
        let token = limit.token();
        let asked = rays.live & lanes_of_bits::<L>(token, self.lanes);
        let center = axes!(i => L::load(token, &self.center[i]));
        let radius = L::load(token, &self.radius);
        let t = A::first_root(rays, prepared, center, radius, asked, limit);
        L::select(asked, t, limit.like(f32::INFINITY))
    }
}

/// Takes a hit that is nearer, or as near and of a lower index.
#[inline(always)]
pub(crate) fn take<A: LaneArray>(hits: &mut HitArrays<A>, lane: usize, t: f32, index: u32) {
    if let (Some(best), Some(sphere)) =
        (hits.t.as_mut().get_mut(lane), hits.sphere.as_mut().get_mut(lane))
        && (t < *best || (t == *best && index < *sphere))
    {
        *best = t;
        *sphere = index;
    }
}

/// Asks about the candidates of all rays, a ray a lane.
#[inline(always)]
pub(super) fn settle<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &RayLanes<L>,
    leaves: &[BvhLeaf],
    lists: &[(List, f32)],
    hits: &mut HitPacket<L>,
) {
    let mut longest = 0;
    for (list, _) in lists {
        longest = longest.max(list.count);
    }
    if longest == 0 {
        return;
    }
    let prepared = A::prepare(rays);
    for at in 0..longest {
        let mut asked = Asked::<L>::none();
        for (lane, (list, best)) in lists.iter().enumerate().take(L::COUNT) {
            if let Some(place) = list.get(at, *best) {
                asked.put(lane, leaves, place);
            }
        }
        if asked.lanes == 0 {
            continue;
        }
        let limit = L::load(token, &hits.t);
        let t = asked.ask::<A>(rays, &prepared, limit);
        let t = t.store();
        let lanes = t.as_ref().iter().zip(asked.index.as_ref()).enumerate();
        for (lane, (&t, &index)) in lanes {
            if t < f32::INFINITY {
                take(hits, lane, t, index);
            }
        }
    }
}

/// Asks about the candidates of one ray, a candidate a lane: its nearest hit.
#[inline(always)]
pub(super) fn settle_one<A: Accuracy, L: Lanes>(
    token: L::Token,
    packet: &RayPacket<L>,
    lane: usize,
    leaves: &[BvhLeaf],
    list: &List,
) -> Option<Hit> {
    let ray = packet.ray(lane);
    let mut copies = RayPacket::<L>::inactive();
    for copy in 0..L::COUNT {
        copies.set(copy, &ray);
    }
    let rays = RayLanes::<L>::load(token, &copies);
    let prepared = A::prepare(&rays);
    let limit = L::splat(token, f32::INFINITY);
    let mut nearest: Option<Hit> = None;
    for from in (0..LIST).step_by(L::COUNT) {
        let mut asked = Asked::<L>::none();
        for lane in 0..L::COUNT.min(LIST) {
            if let Some(place) = list.get(from + lane, f32::INFINITY) {
                asked.put(lane, leaves, place);
            }
        }
        let t = asked.ask::<A>(&rays, &prepared, limit).store();
        for (&t, &sphere) in t.as_ref().iter().zip(asked.index.as_ref()) {
            if t < f32::INFINITY
                && nearest.is_none_or(
                    #[inline(always)]
                    |hit| t < hit.t || (t == hit.t && sphere < hit.sphere),
                )
            {
                nearest = Some(Hit { t, sphere });
            }
        }
    }
    nearest
}

/// Asks about spheres that every ray must be tested against, those in `lanes`.
#[inline(always)]
pub(super) fn settle_outside<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &RayLanes<L>,
    outside: &[BvhLeaf],
    lanes: u32,
    hits: &mut HitPacket<L>,
) {
    let asked = rays.live & lanes_of_bits::<L>(token, lanes);
    if !asked.any() {
        return;
    }
    let prepared = A::prepare(rays);
    let infinity = L::splat(token, f32::INFINITY);
    for leaf in outside {
        for place in 0..WIDTH {
            if leaf.radius[place] >= 0.0 {
                let center = axes!(i => L::splat(token, leaf.center[i][place]));
                let radius = L::splat(token, leaf.radius[place]);
                let limit = L::load(token, &hits.t);
                let t = A::first_root(rays, &prepared, center, radius, asked, limit);
                let t = L::select(asked, t, infinity).store();
                for (lane, &t) in t.as_ref().iter().enumerate() {
                    if t < f32::INFINITY {
                        take(hits, lane, t, leaf.index[place]);
                    }
                }
            }
        }
    }
}
