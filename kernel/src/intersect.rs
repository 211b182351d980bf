//! Rays against lists of spheres: nearest hit, any hit, pairs, and both roots.

use crate::accuracy::RayLanes;
use crate::filter::{BLOCK, FilterGroup, FilterRays, GROUP};
use crate::{
    Accuracy, Hit, HitPacket, LaneMask, Lanes, Ray, RayPacket, Sphere, SpherePacket, Spheres,
};

/// The nearest hit of every ray: the smallest accepted t, and among equals the lowest index.
///
/// `hits[i]` is overwritten with what `rays[i]` meets; packets past the end of the shorter slice
/// are left alone.
pub fn nearest<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    hits: &mut [HitPacket<L>],
) {
    for hit in hits.iter_mut().take(rays.len()) {
        *hit = HitPacket::none();
    }
    for_candidates(token, rays, hits, &spheres, |packet, hit, first, group| {
        nearest_in_group::<A, L>(token, packet, &spheres, first, group, hit);
        false
    });
}

/// Whether every ray meets anything: lane `i` in bit `i` of `met[k]` for `rays[k]`.
pub fn any<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    met: &mut [u32],
) {
    for bits in met.iter_mut().take(rays.len()) {
        *bits = 0;
    }
    for_candidates(token, rays, met, &spheres, |packet, bits, first, group| {
        any_in_group::<A, L>(token, packet, &spheres, first, group, bits)
    });
}

/// The nearest hit of one ray, by the one-lane form of [`nearest`].
#[must_use]
pub fn nearest_hit<A: Accuracy>(ray: &Ray, spheres: Spheres<'_>) -> Option<Hit> {
    let mut hits = [HitPacket::none()];
    nearest::<A, f32>((), &[RayPacket::new(&[*ray])], spheres, &mut hits);
    hits[0].hit(0)
}

/// Ray `i` against sphere `i` alone; the sphere index of a hit is its lane.
#[must_use]
pub fn pairs<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &RayPacket<L>,
    spheres: &SpherePacket<L>,
) -> HitPacket<L> {
    let rays = RayLanes::load(token, rays);
    let center = spheres.center.each_ref().map(|array| L::load(token, array));
    let radius = L::load(token, &spheres.radius);
    let t = accepted::<A, L>(token, &rays, &A::prepare(&rays), center, radius);
    let mut hits = HitPacket::<L>::none();
    hits.t = t.store();
    for (lane, id) in hits.sphere.as_mut().iter_mut().enumerate() {
        let hit = t.lt(L::splat(token, f32::INFINITY)).bits() >> lane & 1 == 1;
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
    let rays = RayLanes::load((), &RayPacket::<f32>::new(&[line]));
    if !rays.live || !sphere.is_valid() {
        return None;
    }
    let roots = A::roots(&A::prepare(&rays), sphere.center.to_array(), sphere.radius);
    // Adding zero turns -0 into +0.
    roots.meets.then_some([roots.near + 0.0, roots.far + 0.0])
}

/// Calls `resolve` for each packet and group of spheres that the filter does not rule out, with
/// the index of the group's first sphere; where it returns true the packet wants no more.
#[inline(always)]
fn for_candidates<L: Lanes, R>(
    token: L::Token,
    rays: &[RayPacket<L>],
    results: &mut [R],
    spheres: &Spheres<'_>,
    resolve: impl Fn(&RayPacket<L>, &mut R, usize, &FilterGroup) -> bool,
) {
    let mut block = [FilterGroup::EMPTY; BLOCK];
    for first in (0..spheres.len()).step_by(BLOCK * GROUP) {
        // Prepare the next spheres once for all packets.
        let groups = (spheres.len() - first).div_ceil(GROUP).min(BLOCK);
        for (index, group) in block.iter_mut().take(groups).enumerate() {
            *group = FilterGroup::prepare(spheres, first + index * GROUP);
        }

        for (packet, result) in rays.iter().zip(results.iter_mut()) {
            let filter = FilterRays::new(token, &RayLanes::load(token, packet));
            for (index, group) in block.iter().take(groups).enumerate() {
                if filter.may_meet_any(group)
                    && resolve(packet, result, first + index * GROUP, group)
                {
                    break;
                }
            }
        }
    }
}

/// The accepted t of rules 1 to 4, `+inf` where there is none.
#[inline(always)]
fn accepted<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &RayLanes<L>,
    prepared: &A::Prepared<L>,
    center: [L; 3],
    radius: L,
) -> L {
    let (zero, largest) = (L::splat(token, 0.0), L::splat(token, f32::MAX));
    let within = |t: L| rays.t_min.le(t) & t.le(rays.t_max) & t.abs().le(largest);
    let roots = A::roots(prepared, center, radius);
    // Adding zero turns -0 into +0.
    let (near, far) = (roots.near + zero, roots.far + zero);
    let coordinates = (center[0].abs().le(largest))
        & (center[1].abs().le(largest))
        & (center[2].abs().le(largest));
    let valid = coordinates & zero.le(radius) & radius.le(largest);
    let met = rays.live & valid & roots.meets;
    let infinity = L::splat(token, f32::INFINITY);
    L::select(met & within(near), near, L::select(met & within(far), far, infinity))
}

#[inline(never)]
fn nearest_in_group<A: Accuracy, L: Lanes>(
    token: L::Token,
    packet: &RayPacket<L>,
    spheres: &Spheres<'_>,
    first: usize,
    group: &FilterGroup,
    hit: &mut HitPacket<L>,
) {
    let rays = RayLanes::load(token, packet);
    let filter = FilterRays::new(token, &rays);
    let prepared = A::prepare(&rays);
    let mut best = L::load(token, &hit.t);
    for slot in 0..GROUP {
        let Some(sphere) = spheres.get(first + slot) else { break };
        if !filter.may_meet(group, slot) {
            continue;
        }
        let center = sphere.center.to_array().map(|x| L::splat(token, x));
        let t = accepted::<A, L>(token, &rays, &prepared, center, L::splat(token, sphere.radius));
        // Spheres come in the order of their indices, so an equal t is no improvement.
        let mut nearer = t.lt(best).bits();
        best = L::select(t.lt(best), t, best);
        while nearer != 0 {
            let lane = nearer.trailing_zeros() as usize;
            if let Some(id) = hit.sphere.as_mut().get_mut(lane) {
                *id = (first + slot) as u32;
            }
            nearer &= nearer - 1;
        }
    }
    hit.t = best.store();
}

#[inline(never)]
fn any_in_group<A: Accuracy, L: Lanes>(
    token: L::Token,
    packet: &RayPacket<L>,
    spheres: &Spheres<'_>,
    first: usize,
    group: &FilterGroup,
    met: &mut u32,
) -> bool {
    let rays = RayLanes::load(token, packet);
    let filter = FilterRays::new(token, &rays);
    let prepared = A::prepare(&rays);
    let infinity = L::splat(token, f32::INFINITY);
    for slot in 0..GROUP {
        let Some(sphere) = spheres.get(first + slot) else { break };
        if !filter.may_meet(group, slot) {
            continue;
        }
        let center = sphere.center.to_array().map(|x| L::splat(token, x));
        let t = accepted::<A, L>(token, &rays, &prepared, center, L::splat(token, sphere.radius));
        *met |= t.lt(infinity).bits();
    }
    rays.live.bits() & !*met == 0
}
