//! The [tile lists](crate::tiles) at a level chosen at run time.

use super::{Level, Packet};
use crate::tiles::{any as any_in_lanes, nearest as nearest_in_lanes};
use crate::{Accuracy, DepthOrder, HitPacket, RayPacket, Spheres};
use fearless_simd::{Simd, f32x16};

/// [`crate::tiles::nearest`] at `level`.
pub fn nearest<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    order: &DepthOrder<'_>,
    lists: &mut [u32],
    hits: &mut [HitPacket<Packet>],
) {
    #[inline(always)]
    fn at<S: Simd, A: Accuracy>(
        simd: S,
        rays: &[RayPacket<Packet>],
        spheres: Spheres<'_>,
        order: &DepthOrder<'_>,
        lists: &mut [u32],
        hits: &mut [HitPacket<Packet>],
    ) {
        nearest_in_lanes::<A, f32x16<S>>(simd, rays, spheres, order, lists, hits);
    }
    fearless_simd::dispatch!(level.0, simd => at::<_, A>(simd, rays, spheres, order, lists, hits));
}

/// [`crate::tiles::any`] at `level`.
pub fn any<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    order: &DepthOrder<'_>,
    lists: &mut [u32],
    met: &mut [u32],
) {
    #[inline(always)]
    fn at<S: Simd, A: Accuracy>(
        simd: S,
        rays: &[RayPacket<Packet>],
        spheres: Spheres<'_>,
        order: &DepthOrder<'_>,
        lists: &mut [u32],
        met: &mut [u32],
    ) {
        any_in_lanes::<A, f32x16<S>>(simd, rays, spheres, order, lists, met);
    }
    fearless_simd::dispatch!(level.0, simd => at::<_, A>(simd, rays, spheres, order, lists, met));
}
