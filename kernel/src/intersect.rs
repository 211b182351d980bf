//! Rays against lists of spheres: nearest hit, any hit, pairs, and both roots.

use crate::accuracy::{RayLanes, all_finite};
use crate::axes::axes;
use crate::filter::{BLOCK_SPHERES, FilterBlock, FilterGroup, FilterRays, GROUP};
use crate::{
    Accuracy, Hit, HitPacket, LaneMask, Lanes, Ray, RayPacket, Sphere, SpherePacket, Spheres,
};

/// The nearest hit of every ray: the smallest accepted t, and among equals the lowest index.
///
/// `hits[i]` is overwritten with what `rays[i]` meets; packets past the end of the shorter slice
/// are left alone. t counts in multiples of each ray's own direction.
///
/// Domain: every bit pattern; invalid rays and spheres meet nothing, and change nothing for their
/// neighbours. Guarantee: what the tier `A` promises for one ray and one sphere; the same bits in
/// every lane width, alone or beside any other ray, for spheres in any order (`Fast`, and `Stable`
/// outside its domain: in the given order).
///
/// Cost: some 8 operations a ray and sphere that miss each other, and the tier's price for the
/// others. Preparing 128 spheres costs as much as testing one packet against them: pass many
/// packets in one call. Stack: some 3 KiB.
#[inline(always)]
pub fn nearest<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    hits: &mut [HitPacket<L>],
) {
    L::out_of_line(
        token,
        #[inline(always)]
        || nearest_here::<A, L>(token, rays, &spheres, hits),
    );
}

/// [`nearest`], compiled into its caller.
#[inline(always)]
fn nearest_here<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: &Spheres<'_>,
    hits: &mut [HitPacket<L>],
) {
    for hit in hits.iter_mut().take(rays.len()) {
        *hit = HitPacket::<L>::none();
    }
    for_candidates(
        token,
        rays,
        hits,
        spheres,
        #[inline(always)]
        |_| L::mask(token, 0),
        #[inline(always)]
        |hit, candidates| nearest_in_group::<A, L>(token, candidates, hit),
    );
}

/// Whether every ray meets anything: lane `i` in bit `i` of `met[k]` for `rays[k]`.
///
/// True exactly where [`nearest`] finds a hit; cheaper, since a ray that has met something is
/// done. Otherwise as `nearest`.
#[inline(always)]
pub fn any<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    met: &mut [u32],
) {
    L::out_of_line(
        token,
        #[inline(always)]
        || any_here::<A, L>(token, rays, &spheres, met),
    );
}

/// [`any`], compiled into its caller.
#[inline(always)]
fn any_here<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: &Spheres<'_>,
    met: &mut [u32],
) {
    for bits in met.iter_mut().take(rays.len()) {
        *bits = 0;
    }
    for_candidates(
        token,
        rays,
        met,
        spheres,
        #[inline(always)]
        |bits| L::mask(token, *bits),
        #[inline(always)]
        |bits, candidates| any_in_group::<A, L>(token, candidates, bits),
    );
}

/// The nearest hit of one ray, by the one-lane form of [`nearest`]: the reference, and the form for
/// targets without SIMD. With it, pass packets.
#[must_use]
pub fn nearest_hit<A: Accuracy>(ray: &Ray, spheres: Spheres<'_>) -> Option<Hit> {
    let mut hits = [HitPacket::<f32>::none()];
    nearest::<A, f32>((), &[RayPacket::<f32>::new(&[*ray])], spheres, &mut hits);
    hits[0].hit(0)
}

/// Ray `i` against sphere `i` alone; the sphere index of a hit is its lane.
///
/// Bit for bit what [`nearest`] finds for that ray in a list of that sphere. No filter: the tier's
/// price for every packet.
#[must_use]
#[inline(always)]
pub fn pairs<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &RayPacket<L>,
    spheres: &SpherePacket<L>,
) -> HitPacket<L> {
    let rays = RayLanes::load(token, rays);
    let center = axes!(i => L::load(token, &spheres.center[i]));
    let radius = L::load(token, &spheres.radius);
    let (zero, infinity) = (radius.like(0.0), radius.like(f32::INFINITY));
    let asked = rays.live & all_finite(center) & zero.le(radius) & radius.lt(infinity);
    let t = A::first_root(&rays, &A::prepare(&rays), center, radius, asked, infinity);
    let t = L::select(asked, t, infinity);
    let mut hits = HitPacket::<L>::none();
    hits.t = t.store();
    for (lane, id) in hits.sphere.as_mut().iter_mut().enumerate() {
        let hit = t.lt(infinity).bits() >> lane & 1 == 1;
        *id = if hit { lane as u32 } else { HitPacket::<L>::NO_SPHERE };
    }
    hits
}

/// Entry and exit of the whole line, whatever the ray's interval: the smaller root first.
///
/// Nothing where the line misses the sphere, or where either is invalid.
#[must_use]
pub fn roots<A: Accuracy>(ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]> {
    let line = Ray { t_min: f32::NEG_INFINITY, t_max: f32::INFINITY, ..*ray };
    (line.is_live() && sphere.is_valid()).then(|| A::line_roots(&line, sphere))?
}

/// A packet, and a group of spheres that the filter could not rule out for it.
#[derive(Clone, Copy)]
pub(crate) struct Candidates<'a, L: Lanes> {
    pub(crate) rays: &'a RayLanes<L>,
    pub(crate) filter: &'a FilterRays<L>,
    pub(crate) group: &'a FilterGroup,
    pub(crate) spheres: &'a Spheres<'a>,
    /// The index of the group's first sphere.
    pub(crate) first: usize,
}

/// Calls `resolve` for each packet and group of spheres that the filter does not rule out, until
/// all of the packet's live lanes are `done`.
#[inline(always)]
pub(crate) fn for_candidates<L: Lanes, R>(
    token: L::Token,
    rays: &[RayPacket<L>],
    results: &mut [R],
    spheres: &Spheres<'_>,
    done: impl Fn(&R) -> L::Mask,
    resolve: impl Fn(&mut R, Candidates<'_, L>),
) {
    for first in (0..spheres.len()).step_by(BLOCK_SPHERES) {
        // The spheres are prepared once for all packets.
        let block = FilterBlock::new(spheres, first);
        for (packet, result) in rays.iter().zip(results.iter_mut()) {
            let mut rays = RayLanes::load(token, packet);
            rays.live = rays.live & !done(result);
            let mut filter = FilterRays::new(token, &rays, &block);
            for (group, first) in block.groups().iter().zip((first..).step_by(GROUP)) {
                if filter.may_meet_any(group) {
                    let candidates =
                        Candidates { rays: &rays, filter: &filter, group, spheres, first };
                    // What candidates need must not press on the registers of this loop.
                    L::out_of_line(
                        token,
                        #[inline(always)]
                        || resolve(result, candidates),
                    );
                    let live = rays.live & !done(result);
                    if !live.any() {
                        break;
                    }
                    filter.keep(live);
                }
            }
        }
    }
}

/// Calls `met` with every sphere of the group that the filter does not rule out by itself: its
/// index, and the t of rules 1 to 4, `+inf` where there is none. `met` answers with the largest t
/// that still matters, `limit` is the first.
#[inline(always)]
fn resolve<A: Accuracy, L: Lanes>(
    token: L::Token,
    candidates: Candidates<'_, L>,
    mut limit: L,
    mut met: impl FnMut(u32, L) -> L,
) {
    let Candidates { rays, filter, group, spheres, first } = candidates;
    let infinity = L::splat(token, f32::INFINITY);
    // Keeping this from one group to the next costs Fast 6 % and gains the others 2 %.
    let prepared = A::prepare(rays);
    for slot in 0..GROUP {
        let Some(sphere) = spheres.get(first + slot) else { return };
        let asked = rays.live & filter.may_meet(group, slot);
        if sphere.is_valid() && asked.any() {
            let center = axes!(i => L::splat(token, sphere.center[i]));
            let radius = L::splat(token, sphere.radius);
            let t = A::first_root(rays, &prepared, center, radius, asked, limit);
            limit = met((first + slot) as u32, L::select(asked, t, infinity));
        }
    }
}

#[inline(always)]
pub(crate) fn nearest_in_group<A: Accuracy, L: Lanes>(
    token: L::Token,
    candidates: Candidates<'_, L>,
    hit: &mut HitPacket<L>,
) {
    let mut best = L::load(token, &hit.t);
    let ids = &mut hit.sphere;
    resolve::<A, L>(
        token,
        candidates,
        best,
        #[inline(always)]
        |index, t| {
            // Spheres come in the order of their indices, so an equal t is no improvement.
            let nearer = t.lt(best);
            best = L::select(nearer, t, best);
            let mut nearer = nearer.bits();
            while nearer != 0 {
                if let Some(id) = ids.as_mut().get_mut(nearer.trailing_zeros() as usize) {
                    *id = index;
                }
                nearer &= nearer - 1;
            }
            best
        },
    );
    hit.t = best.store();
}

#[inline(always)]
pub(crate) fn any_in_group<A: Accuracy, L: Lanes>(
    token: L::Token,
    candidates: Candidates<'_, L>,
    met: &mut u32,
) {
    let infinity = L::splat(token, f32::INFINITY);
    resolve::<A, L>(
        token,
        candidates,
        infinity,
        #[inline(always)]
        |_, t| {
            *met |= t.lt(infinity).bits();
            infinity
        },
    );
}
