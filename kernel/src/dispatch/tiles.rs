//! The [tile lists](crate::tiles) at a level chosen at run time.

use super::{Level, Packet};
use crate::{Accuracy, DepthOrder, HitPacket, RayPacket, Spheres};

/// [`crate::tiles::nearest`] at `level`.
pub fn nearest<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    order: &DepthOrder<'_>,
    lists: &mut [u32],
    hits: &mut [HitPacket<Packet>],
) {
    A::tiles_nearest(level, rays, spheres, order, lists, hits);
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
    A::tiles_any(level, rays, spheres, order, lists, met);
}
