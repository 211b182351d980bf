//! The one level that there is without `std`: what the build's target guarantees.

use crate::Accuracy;
use crate::geometry::camera::tiles::CameraTiles;
use crate::geometry::hit::HitPacket;
use crate::geometry::many::ManyRays;
use crate::geometry::ray::RayPacket;
use crate::lanes::Lanes;
use crate::query::{ClosestHit, Query};
use crate::structures::Traverse;
use crate::trace::Trace;
use core::slice::{from_mut, from_ref};

/// Sixteen lanes; one where the target has no vectors. Arrays in their place would be as slow, and six times as long.
#[cfg(any(target_feature = "sse2", target_feature = "neon", target_feature = "simd128"))]
pub(crate) type BuildLanes = wide::f32x16;
/// Sixteen lanes; one where the target has no vectors. Arrays in their place would be as slow, and six times as long.
#[cfg(not(any(target_feature = "sse2", target_feature = "neon", target_feature = "simd128")))]
pub(crate) type BuildLanes = f32;

/// Answers packets in the lanes of the build.
pub(crate) fn of_the_build<S: Traverse + ?Sized, Q: Query>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    rays: &[RayPacket],
    answers: &mut [Q::Packet<[f32; 16]>],
) {
    if BuildLanes::COUNT == RayPacket::COUNT {
        structure.in_lanes::<wide::f32x16, Q>(tier, (), trace, rays, answers);
        return;
    }
    for (packet, answer) in rays.iter().zip(answers.iter_mut()) {
        *answer = Q::none::<[f32; 16]>();
        for lane in 0..RayPacket::COUNT {
            let ray = [RayPacket::new(&[packet.ray(lane)])];
            let mut one = [Q::none::<[f32; 1]>()];
            structure.in_lanes::<f32, Q>(tier, (), trace, &ray, &mut one);
            Q::put(answer, lane, Q::one(&one[0], 0));
        }
    }
}

/// Fills packets with rays.
#[inline(never)]
pub(crate) fn fill(rays: ManyRays<'_>, packets: &mut [RayPacket]) {
    rays.fill::<wide::f32x16>((), 0, packets);
}

/// What a camera's tiles hit, in the lanes of the build.
pub(crate) fn tiles_of_the_build<S: Traverse + ?Sized>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    tiles: CameraTiles<'_>,
    rays: &mut [RayPacket],
    hits: &mut [HitPacket],
) {
    if BuildLanes::COUNT == RayPacket::COUNT {
        return structure.tiles_in_lanes::<wide::f32x16>(tier, (), trace, tiles, rays, hits);
    }
    let CameraTiles { camera, size: (width, height), corners } = tiles;
    for ((packet, hits), &(x, y)) in rays.iter_mut().zip(hits.iter_mut()).zip(corners) {
        *packet = camera.packet(x, y, width, height);
        structure.in_packets::<ClosestHit>(tier, trace, from_ref(packet), from_mut(hits));
    }
}
