//! Pairs: one sphere for each ray.

use crate::Accuracy;
use crate::accuracy::{RayLanes, all_finite, test_lanes};
use crate::geometry::hit::HitPacket;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::SpherePacket;
use crate::lanes::{LaneMask, Lanes};
use crate::numeric::axes::axes;

/// Tests ray `i` against sphere `i` alone; the sphere index of a hit is its lane.
///
/// Returns bit for bit what [`Intersect::closest_hit_lanes`](crate::Intersect::closest_hit_lanes)
/// finds for that ray in a list of that sphere. Cost: no filter; the tier's price for every packet.
///
/// ```
/// use spherule_kernel::{Exact, Ray, RayPacket, SpherePacket, Vec3, f32x8, pair_lanes};
///
/// let rays = RayPacket::<[f32; 8]>::new(&[Ray::new(Vec3::ZERO, Vec3::Z)]);
/// let spheres = SpherePacket::<[f32; 8]>::new(&[[0.0, 0.0, 5.0, 1.0].into()]);
/// assert_eq!(pair_lanes::<f32x8>(Exact, (), &rays, &spheres).t()[0], 4.0);
/// ```
#[must_use]
#[inline(always)]
pub fn pair_lanes<L: Lanes>(
    tier: impl Accuracy,
    token: L::Token,
    rays: &RayPacket<L::Array>,
    spheres: &SpherePacket<L::Array>,
) -> HitPacket<L::Array> {
    let rays = RayLanes::<L>::load(token, rays);
    let center = axes!(i => L::load(token, &spheres.center[i]));
    let radius = L::load(token, &spheres.radius);
    let (zero, infinity) = (radius.like(0.0), radius.like(f32::INFINITY));
    let active = rays.live & all_finite(center) & zero.le(radius) & radius.lt(infinity);
    let t = test_lanes(tier, &rays, center, radius, active, infinity, false);
    let mut hits = HitPacket::none();
    hits.t = t.store();
    let (met, indices) = (t.lt(infinity).bits(), hits.sphere.as_mut());
    for lane in 0..L::COUNT {
        if met >> lane & 1 == 1
            && let Some(index) = indices.get_mut(lane)
        {
            *index = lane as u32;
        }
    }
    hits
}

/// [`pair_lanes`], packet by packet.
#[inline(always)]
pub(crate) fn each_pair<L: Lanes>(
    tier: impl Accuracy,
    token: L::Token,
    rays: &[RayPacket<L::Array>],
    spheres: &[SpherePacket<L::Array>],
    hits: &mut [HitPacket<L::Array>],
) {
    let count = rays.len().min(spheres.len()).min(hits.len());
    for place in 0..count {
        if let (Some(rays), Some(spheres), Some(hits)) =
            (rays.get(place), spheres.get(place), hits.get_mut(place))
        {
            *hits = pair_lanes::<L>(tier, token, rays, spheres);
        }
    }
}
