//! The surface near the start of a ray, on a sphere that is large compared with the way to the hit: a ground.
//!
//! # Method
//!
//! As seen from the centre, a point of such a sphere is the difference of two large numbers: it is off by 2^-50 r,
//! which shows in a small coordinate. As seen from the start, it is t d, which is not large; as seen from the centre,
//! t d - p, whose p = c - o hardly rounds. So its error is that of t. The root that cancels in (b -+ sqrt D) / a is
//! k / (b +- sqrt D), k = |p|^2 - r^2, without cancellation. k is the power of the start, known to nearly all bits.

use crate::accuracy::surface::Line;
use crate::numeric::axes::axes;
use crate::numeric::power_of_point::power_of;
use crate::numeric::rounding::DOUBLE_U as U;
use crate::{Ray, Sphere};

/// Returns the point of a root as seen from the centre, and a bound on the error of each coordinate; `None` if the root
/// does not cancel, or if too little is known of D.
pub(super) fn point(
    ray: &Ray,
    sphere: &Sphere,
    line: &Line<f64>,
    is_near: bool,
) -> Option<([f64; 3], [f64; 3])> {
    let [o, d, c] = [ray.origin, ray.direction, sphere.center].map(|v| v.to_array().map(f64::from));
    if line.error >= line.discriminant || (line.slope > 0.0) != is_near {
        return None;
    }
    let (power, margin) = power_of(o, c, f64::from(sphere.radius));
    let of_power = U * power.abs() + margin;

    // b +- sqrt D, both of one sign, and a bound on its error: 5u G for b, as in `Line::point` for
    // the root.
    let root = libm::sqrt(line.discriminant);
    let divisor = if is_near { line.slope + root } else { line.slope - root };
    let of_divisor = 5.0 * U * line.size + 1.25 * line.error / root + 2.0 * U * divisor.abs();
    if 8.0 * of_divisor >= divisor.abs() {
        return None;
    }
    // 1.25 covers the second order: 8 / 7, and the rounding of the bounds themselves.
    let t = power / divisor;
    let of_t = 1.25 * (of_power + t.abs() * of_divisor) / divisor.abs() + 2.0 * U * t.abs();

    let (way, p) = (axes!(i => t * d[i]), axes!(i => c[i] - o[i]));
    let error = axes!(i => d[i].abs() * of_t + 4.0 * U * (way[i].abs() + p[i].abs()));
    Some((axes!(i => way[i] - p[i]), error))
}
