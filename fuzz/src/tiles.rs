//! A camera made of a scene's rays: tiles against one lane, bit for bit.

use spherule_kernel::{Camera, Projection, Ray, Tier};
use spherule_referee::bytes::AimedScene;
use spherule_tests::variants::{Frame, assert_same_tiles};

/// Traces a picture through the first ray, in steps towards other rays.
///
/// # Panics
/// If an answer or a ray differs.
pub fn check(scene: &AimedScene) {
    let AimedScene { rays, spheres, .. } = scene;
    let ray = |index: usize| rays[index % rays.len()];
    let Ray { origin, direction, .. } = rays[0];
    // The more spheres, the smaller the steps: from pixels that are far apart to those that rounding merges.
    let small = (-2.0 * spheres.len() as f32).exp2();
    let (step_x, step_y) = (small * ray(1).direction, small * ray(2).origin);
    for (projection, corner) in [
        (Projection::Perspective { eye: origin }, direction),
        (Projection::Parallel { direction }, origin),
    ] {
        let camera = Camera { projection, corner, step_x, step_y };
        let size = (5 + rays.len() as u32, 8);
        let frame = Frame { camera, from: (0, 0), count: size, size };
        assert_same_tiles(&[Tier::Exact], &frame, spheres);
    }
}
