//! Searches for how much of each bound is used.

mod beside_fast;
mod boxes;
mod estimate;
mod filter;
mod leaves;
mod range_limits;
mod stable;
#[cfg(feature = "alloc")]
mod work;

use crate::accuracy::RayLanes;
use crate::{Ray, RayPacket, Sphere, Vec3};

/// o, d, c, r.
type Numbers = [f32; 10];
type Vector = [f64; 3];

fn numbers(
    [ox, oy, oz]: [f32; 3],
    [dx, dy, dz]: [f32; 3],
    [cx, cy, cz]: [f32; 3],
    r: f32,
) -> Numbers {
    [ox, oy, oz, dx, dy, dz, cx, cy, cz, r]
}

/// With the direction times `length`, and all else times `size`.
fn scaled<const N: usize>(mut numbers: [f32; N], size: f32, length: f32) -> [f32; N] {
    for (index, number) in numbers.iter_mut().enumerate() {
        *number *= if (3..6).contains(&index) { length } else { size };
    }
    numbers
}

/// The line, as a ray without a beginning, and the sphere.
fn line(numbers: &Numbers) -> (Ray, Sphere) {
    let [ox, oy, oz, dx, dy, dz, cx, cy, cz, r] = *numbers;
    let ray = Ray::new(Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz));
    let sphere = Sphere { center: Vec3::new(cx, cy, cz), radius: r.abs() };
    (Ray { t_min: f32::NEG_INFINITY, ..ray }, sphere)
}

/// The ray in one lane.
fn lane(ray: &Ray) -> RayLanes<f32> {
    RayLanes::load((), &RayPacket::<[f32; 1]>::new(&[*ray]))
}

/// d, p and r in double precision, which counts as the truth beside an error in single precision.
fn wide(ray: &Ray, sphere: &Sphere) -> (Vector, Vector, f64) {
    let wide = |v: Vec3| v.to_array().map(f64::from);
    let (o, c) = (wide(ray.origin), wide(sphere.center));
    (wide(ray.direction), [0, 1, 2].map(|i| c[i] - o[i]), f64::from(sphere.radius))
}

fn dot(v: Vector, w: Vector) -> f64 {
    v[0] * w[0] + v[1] * w[1] + v[2] * w[2]
}

fn square(v: Vector) -> f64 {
    dot(v, v)
}

fn cross(v: Vector, w: Vector) -> Vector {
    [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]]
}

/// How far a line passes a point, where cancellation does not matter.
fn distance(o: [f32; 3], d: [f32; 3], c: [f32; 3]) -> f64 {
    let (d, p) = (d.map(f64::from), [0, 1, 2].map(|i| f64::from(c[i]) - f64::from(o[i])));
    let b = dot(d, p);
    (square(p) - b * b / square(d).max(1e-30)).max(0.0).sqrt()
}

/// A score that is a number.
fn or_none(used: f64) -> f64 {
    if used.is_finite() { used } else { -1.0 }
}
