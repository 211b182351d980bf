//! The point of a sphere that a hit stands for, and one just off it for secondary rays.
//!
//! The hit point o + t d in `f32` lies inside the sphere as often as outside, and so a ray from it may
//! meet the sphere that it starts on; and from afar t is rounded to more than the sphere's size. So t only says
//! which of the two roots was hit. The point is computed from the sphere's centre, in double precision, and moved off
//! the sphere along the normal by a distance for which no tier sees the sphere again.
//!
//! # The point
//!
//! With p = c - o, a = d.d, b = d.p and D = a r^2 - |d x p|^2, the roots are t = (b -+ sqrt D) / a, and
//!
//! ```text
//! t d - p = (d x (d x p) -+ d sqrt D) / a
//! ```
//!
//! is the point as seen from the centre. d x p loses some 2^-51 |d| |p|, so a normal is off by some 2^-50 |p| / r: 2^-27 from
//! 10^7 radii away.
//!
//! # The distance
//!
//! With u = 2^-24, r the radius and P the point: every tier decides a shadow ray that leaves the
//! sphere by the sign of q.q - r^2 (or p.p - r^2), computed from p = c - o. Its rounding errors
//! add up to less than 8 u r^2: 2u for the coordinates of p, 3u for products and sums on each
//! side, 1u for the difference. That is a height of at most 4 u r. Rounding the starting point to
//! `f32` costs at most sqrt 3 u |P|. [`LIFT`] covers both with a factor to spare; the test that
//! no tier shadows itself, a ground of radius 10^6 among its spheres, is in
//! `tui/tests/program/shadows.rs`.

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
        let (center, direction) = (sphere.center.as_dvec3(), ray.direction.as_dvec3());
        let radius = f64::from(sphere.radius);

        // The unit normal that points out of the sphere, and the point under it.
        let outward = if radius > 0.0 {
            let from_origin = center - ray.origin.as_dvec3();
            let across = direction.cross(from_origin);
            let a = direction.length_squared();
            // `Fast` may hit what the line misses.
            let half_chord = (a * (radius * radius) - across.length_squared()).max(0.0).sqrt();
            // The near root, if t is what that is rounded to, or nearer to it than to the far one.
            let b = direction.dot(from_origin);
            let [near, far] = [(b - half_chord) / a, (b + half_chord) / a];
            let off = |root: f64| (f64::from(t) - root).abs();
            let is_near = near as f32 == t || off(near) <= off(far);
            let half_chord = if is_near { -half_chord } else { half_chord };
            (direction.cross(across) + half_chord * direction) / a
        } else {
            -direction
        };
        let scale = 1.0 / outward.length_squared().sqrt();
        let point = center + radius * scale * outward;

        // Turn it to the viewer, and step off the sphere to that side.
        let normal = outward * if outward.dot(direction) > 0.0 { -scale } else { scale };
        let size = point.abs().max_element().max(radius);
        let lifted = point + LIFT * size * normal;
        Self { origin: lifted.as_vec3(), normal: normal.as_vec3() }
    }

    /// The ray to the light and the cosine of its angle to the normal; `None` if the surface
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
        // if the difference of two roots is lost.
        let ray = Ray { origin: self.origin, direction, t_min: f32::MIN_POSITIVE, t_max };
        (cosine > 0.0).then_some((ray, cosine))
    }
}
