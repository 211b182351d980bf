//! The point of a sphere that a hit stands for, and one just off it for secondary rays.
//!
//! The hit point o + t d in `f32` lies inside the sphere as often as outside (NUMERICS.md, section
//! 7), and so a ray from it may meet the sphere that it starts on. Here the point is computed in
//! double precision, put back onto the sphere along the radius, and moved off it along the normal
//! by a distance for which no tier sees the sphere again.
//!
//! # The distance
//!
//! With u = 2^-24, r the radius and P the point: every tier decides a shadow ray that leaves the
//! sphere by the sign of q.q - r^2 (or p.p - r^2), computed from p = c - o. Its rounding errors
//! add up to less than 8 u r^2: 2u for the coordinates of p, 3u for products and sums on each
//! side, 1u for the difference. That is a height of at most 4 u r. Rounding the starting point to
//! `f32` costs at most sqrt 3 u |P|. [`LIFT`] covers both with a factor to spare; the test that
//! no tier shadows itself, a ground of radius 10^6 among its spheres, is in `tests/shadows.rs`.

use crate::scene::{Light, Source};
use spherule_kernel::{Ray, Sphere, Vec3};

/// The distance from the sphere, in units of the larger of r and |P|: 32 u.
const LIFT: f64 = 32.0 / 16_777_216.0;

/// A point of a sphere, as shading sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Just off the sphere, on the side that the ray came from.
    pub origin: Vec3,
    /// Of length one, towards the side that the ray came from.
    pub normal: Vec3,
}

impl SurfacePoint {
    /// The point of `sphere` that `ray` meets at `t`.
    ///
    /// On a sphere of radius 0 the normal points back along the ray.
    #[must_use]
    #[inline]
    pub fn new(ray: &Ray, t: f32, sphere: &Sphere) -> Self {
        let wide = |v: Vec3| v.to_array().map(f64::from);
        let narrow = |v: [f64; 3]| Vec3::from_array(v.map(|x| x as f32));
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (center, direction) = (wide(sphere.center), wide(ray.direction));
        let (origin, t, radius) = (wide(ray.origin), f64::from(t), f64::from(sphere.radius));

        // The unit normal that points out of the sphere, and the point under it.
        let outward = if radius > 0.0 {
            [0, 1, 2].map(|i| origin[i] - center[i] + t * direction[i])
        } else {
            direction.map(|x| -x)
        };
        let scale = 1.0 / dot(outward, outward).sqrt();
        let point = [0, 1, 2].map(|i| center[i] + radius * scale * outward[i]);

        // Turn it to the viewer, and step off the sphere to that side.
        let scale = if dot(outward, direction) > 0.0 { -scale } else { scale };
        let normal = outward.map(|x| x * scale);
        let size = point.iter().fold(radius, |size, x| size.max(x.abs()));
        let lifted = [0, 1, 2].map(|i| point[i] + LIFT * size * normal[i]);
        Self { origin: narrow(lifted), normal: narrow(normal) }
    }

    /// The ray to the light and the cosine of its angle to the normal; nothing where the surface
    /// faces away.
    #[must_use]
    #[inline]
    pub fn towards(&self, light: &Light) -> Option<(Ray, f32)> {
        let (direction, t_max) = match light.source {
            Source::Direction(direction) => (direction, f32::INFINITY),
            Source::Position(position) => (position - self.origin, 1.0),
        };
        let cosine = self.normal.dot(direction) / direction.length();
        // The point lies off its sphere, so that has no root above zero; zero itself could be one
        // where the difference of two roots is lost.
        let ray = Ray { origin: self.origin, direction, t_min: f32::MIN_POSITIVE, t_max };
        (cosine > 0.0).then_some((ray, cosine))
    }
}
