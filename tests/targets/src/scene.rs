//! The lecture's scene and its camera.

use spherule_kernel::{Camera, Projection, Spheres, Vec3};

/// The width of the picture, in characters.
pub const WIDTH: u32 = 64;
/// Its height.
pub const HEIGHT: u32 = 28;

static X: [f32; 2] = [-0.9, 0.9];
static Y: [f32; 2] = [0.0, 0.2];
static Z: [f32; 2] = [-4.0, -5.0];
static RADIUS: [f32; 2] = [1.0, 0.9];

/// The two spheres.
#[must_use]
pub fn spheres() -> Option<Spheres<'static>> {
    Spheres::new(&X, &Y, &Z, &RADIUS).ok()
}

/// The camera; a character is twice as high as it is wide.
#[must_use]
pub fn camera(is_parallel: bool) -> Camera {
    let (corner, step) = (Vec3::new(-0.64, 0.56, -1.0), 0.02);
    let scale = if is_parallel { 4.0 } else { 1.0 };
    Camera {
        projection: if is_parallel {
            Projection::Parallel { direction: Vec3::new(0.0, 0.0, -1.0) }
        } else {
            Projection::Perspective { eye: Vec3::ZERO }
        },
        corner: scale * corner,
        step_x: Vec3::new(scale * step, 0.0, 0.0),
        step_y: Vec3::new(0.0, -2.0 * scale * step, 0.0),
    }
}
