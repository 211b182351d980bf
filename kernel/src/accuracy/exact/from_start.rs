//! The surface near the start of a ray, on a sphere that is large beside the way there: a ground.
//!
//! # Method
//!
//! As seen from the centre, a point of such a sphere is the difference of two large numbers: it is off by 2^-50 r, which
//! a small coordinate shows. As seen from the start it is not large: it is t d - p, whose p = c - o hardly rounds. So the
//! error is that of t, and the root that cancels in (b -+ sqrt D) / a is k / (b +- sqrt D), k = |p|^2 - r^2, without
//! cancellation. k is the power of the start, known to nearly all bits.

use crate::accuracy::surface::Line;
use crate::numeric::axes::axes;
use crate::numeric::power_of_point::power_of;
use crate::{Ray, Sphere};

/// u, of double precision.
const U: f64 = f64::EPSILON / 2.0;

/// The point of a root as seen from the centre, and what every coordinate may be off; `None` if the root does not
/// cancel, or if too little is known of D.
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

    // b +- sqrt D, both of one sign, and what it may be off: b 5u G, the root as in `Line::point`.
    let root = libm::sqrt(line.discriminant);
    let divisor = if is_near { line.slope + root } else { line.slope - root };
    let of_divisor = 5.0 * U * line.size + 1.25 * line.error / root + 2.0 * U * divisor.abs();
    if 8.0 * of_divisor >= divisor.abs() {
        return None;
    }
    // 1.25 covers the second order: 8 / 7, and what the bounds themselves round.
    let t = power / divisor;
    let of_t = 1.25 * (of_power + t.abs() * of_divisor) / divisor.abs() + 2.0 * U * t.abs();

    let (way, p) = (axes!(i => t * d[i]), axes!(i => c[i] - o[i]));
    let error = axes!(i => d[i].abs() * of_t + 4.0 * U * (way[i].abs() + p[i].abs()));
    Some((axes!(i => way[i] - p[i]), error))
}
