//! Where a scene is looked at from, in the words of a person: angles and points, not vectors of a
//! plane. A view becomes the kernel's camera when the size of the picture is known.

use spherule_kernel::Vec3;

/// Perspective by its vertical angle, parallel by its height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// The vertical field of view in degrees.
    Perspective {
        /// Degrees, above 0 and below 180.
        fov: f32,
    },
    /// The height of the picture in the units of the scene.
    Parallel {
        /// Above 0.
        height: f32,
    },
}

/// An eye, what it looks at, and through which lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the eye is.
    pub eye: Vec3,
    /// The point in the middle of the picture.
    pub target: Vec3,
    /// Which way is up; not parallel to the line of sight.
    pub up: Vec3,
    /// Perspective or parallel.
    pub lens: Lens,
}
