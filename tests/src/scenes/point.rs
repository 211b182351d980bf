//! Points and directions in double precision: scenes are made of them, and rounded once.

use spherule_kernel::Vec3;
use spherule_referee::random::Random;
use std::f64::consts::TAU;

/// A point, or a direction.
pub(super) type Point = [f64; 3];

pub(super) fn rounded(point: Point) -> Vec3 {
    Vec3::from_array(point.map(|coordinate| coordinate as f32))
}

pub(super) fn plus(a: Point, factor: f64, b: Point) -> Point {
    [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]]
}

pub(super) fn unit(a: Point) -> Point {
    let length = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    a.map(|x| x / length)
}

/// Uniform in a box.
pub(super) fn within(random: &mut Random, low: Point, high: Point) -> Point {
    [0, 1, 2].map(|axis| random.uniform(low[axis], high[axis]))
}

/// Uniform on the unit sphere.
pub(super) fn direction(random: &mut Random) -> Point {
    unit([(); 3].map(|()| normal(random)))
}

/// Normal, of mean 0 and variance 1 (Box and Muller).
pub(super) fn normal(random: &mut Random) -> f64 {
    let (radius, angle) = (1.0 - random.uniform(0.0, 1.0), random.uniform(0.0, 1.0) * TAU);
    (-2.0 * radius.ln()).sqrt() * angle.cos()
}
