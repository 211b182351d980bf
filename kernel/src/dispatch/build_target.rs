//! The one level that there is without `std`: what the build's target guarantees.

use crate::geometry::many::ManyRays;
use crate::geometry::ray_packet::RayPacket;

/// Sixteen lanes; one where the target has no vectors. Arrays in their place would be as slow, and six times as long.
#[cfg(any(target_feature = "sse2", target_feature = "neon", target_feature = "simd128"))]
pub(crate) type BuildLanes = wide::f32x16;
/// Sixteen lanes; one where the target has no vectors. Arrays in their place would be as slow, and six times as long.
#[cfg(not(any(target_feature = "sse2", target_feature = "neon", target_feature = "simd128")))]
pub(crate) type BuildLanes = f32;

/// Fills packets with rays.
#[inline(never)]
pub(crate) fn fill(rays: &ManyRays<'_>, packets: &mut [RayPacket]) {
    rays.fill::<wide::f32x16>((), 0, packets);
}
