//! Points and directions in double precision: scenes and rays are made of them, and rounded once.

use spherule_referee::random::{Random, dot};

/// A point, or a direction.
pub type Point = [f64; 3];

/// `a` and so many times `b`.
#[must_use]
pub fn plus(a: Point, factor: f64, b: Point) -> Point {
    [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]]
}

/// The direction of length one.
#[must_use]
pub fn unit(a: Point) -> Point {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// Uniform in a box.
pub(crate) fn within(random: &mut Random, low: Point, high: Point) -> Point {
    [0, 1, 2].map(|axis| random.uniform(low[axis], high[axis]))
}

/// Uniform on the unit sphere.
pub(crate) fn direction(random: &mut Random) -> Point {
    unit([(); 3].map(|()| random.normal()))
}
