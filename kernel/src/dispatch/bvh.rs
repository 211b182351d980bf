//! The walks of the [tree](crate::bvh) at a level chosen at run time.

use super::{Level, Packet};
use crate::bvh::{
    any as any_in_lanes, any_coherent as any_coherent_in_lanes, nearest as nearest_in_lanes,
    nearest_coherent as nearest_coherent_in_lanes,
};
use crate::{Accuracy, Bvh, HitPacket, RayPacket, Spheres};
use fearless_simd::{Simd, f32x16};

/// [`crate::bvh::nearest`] at `level`.
pub fn nearest<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    hits: &mut [HitPacket<Packet>],
) {
    #[inline(always)]
    fn at<S: Simd, A: Accuracy>(
        simd: S,
        rays: &[RayPacket<Packet>],
        spheres: Spheres<'_>,
        bvh: &Bvh<'_>,
        hits: &mut [HitPacket<Packet>],
    ) {
        nearest_in_lanes::<A, f32x16<S>>(simd, rays, spheres, bvh, hits);
    }
    fearless_simd::dispatch!(level.0, simd => at::<_, A>(simd, rays, spheres, bvh, hits));
}

/// [`crate::bvh::any`] at `level`.
pub fn any<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    met: &mut [u32],
) {
    #[inline(always)]
    fn at<S: Simd, A: Accuracy>(
        simd: S,
        rays: &[RayPacket<Packet>],
        spheres: Spheres<'_>,
        bvh: &Bvh<'_>,
        met: &mut [u32],
    ) {
        any_in_lanes::<A, f32x16<S>>(simd, rays, spheres, bvh, met);
    }
    fearless_simd::dispatch!(level.0, simd => at::<_, A>(simd, rays, spheres, bvh, met));
}

/// [`crate::bvh::nearest_coherent`] at `level`.
pub fn nearest_coherent<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    hits: &mut [HitPacket<Packet>],
) {
    #[inline(always)]
    fn at<S: Simd, A: Accuracy>(
        simd: S,
        rays: &[RayPacket<Packet>],
        spheres: Spheres<'_>,
        bvh: &Bvh<'_>,
        hits: &mut [HitPacket<Packet>],
    ) {
        nearest_coherent_in_lanes::<A, f32x16<S>>(simd, rays, spheres, bvh, hits);
    }
    fearless_simd::dispatch!(level.0, simd => at::<_, A>(simd, rays, spheres, bvh, hits));
}

/// [`crate::bvh::any_coherent`] at `level`.
pub fn any_coherent<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    met: &mut [u32],
) {
    #[inline(always)]
    fn at<S: Simd, A: Accuracy>(
        simd: S,
        rays: &[RayPacket<Packet>],
        spheres: Spheres<'_>,
        bvh: &Bvh<'_>,
        met: &mut [u32],
    ) {
        any_coherent_in_lanes::<A, f32x16<S>>(simd, rays, spheres, bvh, met);
    }
    fearless_simd::dispatch!(level.0, simd => at::<_, A>(simd, rays, spheres, bvh, met));
}
