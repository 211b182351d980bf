//! The walks of the [tree](crate::bvh) at a level chosen at run time.

use super::{Level, Packet};
use crate::{Accuracy, Bvh, HitPacket, RayPacket, Spheres};

/// [`crate::bvh::nearest`] at `level`.
pub fn nearest<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    hits: &mut [HitPacket<Packet>],
) {
    A::tree_nearest(level, rays, spheres, bvh, hits);
}

/// [`crate::bvh::any`] at `level`.
pub fn any<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    met: &mut [u32],
) {
    A::tree_any(level, rays, spheres, bvh, met);
}

/// [`crate::bvh::nearest_coherent`] at `level`.
pub fn nearest_coherent<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    hits: &mut [HitPacket<Packet>],
) {
    A::tree_nearest_coherent(level, rays, spheres, bvh, hits);
}

/// [`crate::bvh::any_coherent`] at `level`.
pub fn any_coherent<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    met: &mut [u32],
) {
    A::tree_any_coherent(level, rays, spheres, bvh, met);
}
