//! Where the interval of a spawned ray begins, and whether a tier sees the sphere there.

use super::side::{Side, terms};
use crate::accuracy::Tier;
use crate::geometry::ray::Ray;
use crate::geometry::sphere::Sphere;
use crate::lanes::Lanes;
use crate::linear::roots;
use crate::numeric::axes::{axes, dot, largest};
use crate::numeric::power_of_point::power_of;
use crate::numeric::rounding::DOUBLE_U as U;
use core::cmp::Ordering;
use glam::Vec3;

/// Where the interval begins: 2^-42 r from the origin, or a little more, but above zero.
#[inline(always)]
pub(super) fn start_of<L: Lanes>(direction: [L; 3], radius: L) -> L {
    let start = radius * radius.like(NEAREST) / largest(direction);
    start.filter_max(radius.like(f32::from_bits(1)))
}

/// 2^-42: an interval begins at least so many radii from the origin.
const NEAREST: f32 = 1.0 / (1_u64 << 42) as f32;

/// 2^-20: a ray goes back if the cosine of direction and normal is below minus this.
const BACK: f64 = 8.0 * f32::EPSILON as f64;

/// Whether `tier` sees `sphere` where a ray starts that begins on its side `to`.
pub(super) fn sees_start(
    tier: Tier,
    ray: &Ray,
    sphere: &Sphere,
    to: Side,
    outward: [f64; 3],
) -> bool {
    let d = ray.direction.to_array().map(f64::from);
    let is_seen = |t: f32| ray.t_min <= t && t < f32::INFINITY;
    match to {
        // A ray that goes back meets the sphere, as it should. (If it goes back by less, it passes over the sphere from a step
        // above.)
        Side::Outside if dot(d, outward) < -BACK * libm::sqrt(dot(d, d)) => false,
        Side::Outside => {
            (tier != Tier::Exact || !goes_away(ray, sphere))
                && roots(tier, ray, sphere).is_some_and(|both| both.into_iter().any(is_seen))
        }
        Side::Inside if tier == Tier::Exact && is_deep(ray, sphere) => false,
        // Where a tier's squares leave the range of numbers, it sees nothing from anywhere.
        Side::Inside => match roots(tier, ray, sphere) {
            Some([near, far]) => {
                is_seen(near) || (far < ray.t_min && !is_rounded_to_zero(far, ray, sphere))
            }
            None => {
                ray.direction.length_squared().is_normal()
                    && (sphere.radius * sphere.radius).is_normal()
            }
        },
    }
}

/// Whether a far root is zero because it is rounded: that of another tier may be zero by cancellation.
fn is_rounded_to_zero(far: f32, ray: &Ray, sphere: &Sphere) -> bool {
    far == 0.0 && roots(Tier::Exact, ray, sphere).is_none_or(|[_, far]| far == 0.0)
}

/// Whether the far side is surely not before t_min: the origin is deeper than t_min |d| <= t_min √3 max |d_i|.
fn is_deep(ray: &Ray, sphere: &Sphere) -> bool {
    let r = f64::from(sphere.radius);
    let [x, c] = [ray.origin, sphere.center].map(|v| v.to_array().map(f64::from));
    let (power, margin) = power_of(x, c, r);
    let start = f64::from(ray.t_min) * f64::from(largest(ray.direction.to_array()));
    power < -(margin + DEEP * r * start)
}

/// 2√3, and a little more for what is rounded.
pub(super) const DEEP: f64 = 3.5;

/// Whether a ray goes away from the centre of `sphere` where it starts, or around it: d.(o - c) >= 0.
fn goes_away(ray: &Ray, sphere: &Sphere) -> bool {
    let d = ray.direction.to_array().map(f64::from);
    let q = from_center(ray.origin, sphere);
    let (slope, size) = (dot(d, q), dot(d.map(f64::abs), q.map(f64::abs)));
    // A coordinate of q is off by u, a product and two sums by 3u.
    if slope.abs() > 8.0 * U * size {
        slope > 0.0
    } else {
        terms(ray.origin, ray.direction, sphere).start()[1] != Ordering::Less
    }
}

/// A point as seen from the centre, every coordinate rounded once.
fn from_center(point: Vec3, sphere: &Sphere) -> [f64; 3] {
    axes!(i => f64::from(point[i]) - f64::from(sphere.center()[i]))
}
