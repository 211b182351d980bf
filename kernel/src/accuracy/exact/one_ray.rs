//! One ray and one sphere: the method of [`exact`](super), without lanes.
//!
//! Not generic and called, not inlined: where doubles are calls of a library, one estimate is as long as all the rest.

use super::estimate::{Constants, Estimate};
use crate::exact::{Quadratic, QuadraticTerms, Root};
use crate::numeric::axes::axes;
use crate::{Ray, Sphere};

/// D and the roots, each with its bound.
#[inline(never)]
pub(super) fn estimate(ray: &Ray, sphere: &Sphere) -> Estimate<f64> {
    let (o, d, c) = (ray.origin.to_array(), ray.direction.to_array(), sphere.center.to_array());
    Estimate::new(
        axes!(i => f64::from(o[i])),
        axes!(i => f64::from(d[i])),
        axes!(i => f64::from(c[i])),
        f64::from(sphere.radius),
        &Constants::PROVEN,
    )
}

/// The t of rules 2 to 4, `+inf` if there is none, of a valid ray and a valid sphere; `+inf` where it is larger than
/// `limit`. `None` where doubles cannot decide.
#[inline(never)]
pub(super) fn decided(ray: &Ray, sphere: &Sphere, limit: f32) -> Option<f32> {
    let Estimate { discriminant, error, near, far } = estimate(ray, sphere);
    if discriminant < -error {
        return Some(f32::INFINITY);
    }
    if discriminant <= error {
        return None;
    }
    for (t, bound) in [near, far] {
        let (low, high) = ((t - bound) as f32, (t + bound) as f32);
        let is_out = high < ray.t_min || ray.t_max < low || limit < low;
        if is_out || low == f32::INFINITY || high == f32::NEG_INFINITY {
            continue;
        }
        // Adding zero turns -0 into +0.
        return if low == high { Some(low + 0.0) } else { None };
    }
    Some(f32::INFINITY)
}

/// Both roots of the line of a valid ray and a valid sphere; `None` if the line misses it.
#[inline(never)]
pub(super) fn line_roots(ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]> {
    let Estimate { discriminant, error, near, far } = estimate(ray, sphere);
    if discriminant < -error {
        return None;
    }
    let ends = |(t, bound): (f64, f64)| ((t - bound) as f32, (t + bound) as f32);
    let ((near, near_end), (far, far_end)) = (ends(near), ends(far));
    if error < discriminant && near == near_end && far == far_end {
        return Some([near + 0.0, far + 0.0]);
    }
    let quadratic = quadratic(ray, sphere)?;
    Some([quadratic.rounded(Root::Near), quadratic.rounded(Root::Far)])
}

/// The t of rules 2 to 4 by exact sums, `+inf` if there is none.
#[cold]
#[inline(never)]
pub(super) fn settled(ray: &Ray, sphere: &Sphere) -> f32 {
    let Some(quadratic) = quadratic(ray, sphere) else { return f32::INFINITY };
    for root in [Root::Near, Root::Far] {
        let t = quadratic.rounded(root);
        if ray.t_min <= t && t <= ray.t_max && t.is_finite() {
            return t;
        }
    }
    f32::INFINITY
}

/// The line and the sphere, for exact sums.
#[inline(never)]
pub(super) fn terms(ray: &Ray, sphere: &Sphere) -> QuadraticTerms {
    let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
    QuadraticTerms::new(origin, direction, sphere.center.to_array(), sphere.radius)
}

pub(super) fn quadratic(ray: &Ray, sphere: &Sphere) -> Option<Quadratic> {
    Quadratic::new(terms(ray, sphere))
}
