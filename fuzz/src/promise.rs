//! A tier's roots against the exact ones.
//!
//! What a tier promises is put as a backward error: its answer must be an exact answer for a
//! sphere whose squared radius differs by no more than the tier's error, and t may besides be off
//! by a few roundings. So the exact oracle is asked twice, for a sphere a little smaller and one a
//! little larger: where both are missed the tier must miss, where both are met it must hit, and
//! its roots must lie between theirs. That holds from head-on to grazing, and asks nothing of the
//! float arithmetic that is on trial.

use spherule_kernel::{Accuracy, Fast, Ray, Sphere, Stable};
use spherule_tests::oracle;

/// Half an ulp of 1.
const U: f64 = 1.0 / 16_777_216.0;
/// The domain: radius and distance up to 2^40, radius from 2^-40, direction 2^-20 to 2^20 long.
const REACH: f64 = 1_099_511_627_776.0;
const LENGTH: f64 = 1_048_576.0;

/// What a tier promises in its domain.
pub trait Promise: Accuracy {
    /// How many radii away a sphere may be.
    const RADII: f64;

    /// The error of the squared radius, from radius and distance.
    fn square_error(radius: f64, distance: f64) -> f64;

    /// The error of t besides, in multiples of the direction's length.
    fn further_error(distance: f64) -> f64;
}

/// The textbook form: p.p - r^2 and b^2 are rounded at the size of |p|^2.
impl Promise for Fast {
    const RADII: f64 = f64::INFINITY;

    fn square_error(radius: f64, distance: f64) -> f64 {
        24.0 * U * (radius * radius + distance * distance)
    }

    fn further_error(distance: f64) -> f64 {
        8.0 * U * distance
    }
}

/// Closest point first: whatever the distance, up to 2^20 radii, the error is one of r^2 alone.
impl Promise for Stable {
    const RADII: f64 = LENGTH;

    fn square_error(radius: f64, _: f64) -> f64 {
        32.0 * U * radius * radius
    }

    fn further_error(_: f64) -> f64 {
        0.0
    }
}

/// |c - o| and |d|, near enough to tell what is promised.
fn lengths(ray: &Ray, sphere: &Sphere) -> (f64, f64) {
    let length = |v: [f64; 3]| (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    let (o, c) = (ray.origin.to_array(), sphere.center.to_array());
    let p = [0, 1, 2].map(|axis| f64::from(c[axis]) - f64::from(o[axis]));
    (length(p), length(ray.direction.to_array().map(f64::from)))
}

/// Whether the tier promises anything for this pair.
#[must_use]
pub fn in_domain<A: Promise>(ray: &Ray, sphere: &Sphere) -> bool {
    let radius = f64::from(sphere.radius);
    let (distance, length) = lengths(ray, sphere);
    (1.0 / REACH..=REACH).contains(&radius)
        && distance <= REACH.min(A::RADII * radius)
        && (1.0 / LENGTH..=LENGTH).contains(&length)
}

/// Judges the roots that the tier found, where it promises anything.
///
/// # Panics
/// Where the promise is broken.
pub fn judge<A: Promise>(ray: &Ray, sphere: &Sphere, found: Option<[f32; 2]>) {
    if !in_domain::<A>(ray, sphere) {
        return;
    }
    let (distance, length) = lengths(ray, sphere);
    let radius = f64::from(sphere.radius);
    let error = A::square_error(radius, distance);
    let smaller = (radius * radius - error).max(0.0).sqrt() as f32;
    let larger = (radius * radius + error).sqrt() as f32;
    let exact = |radius: f32| oracle::roots(ray, &Sphere { radius, ..*sphere });
    let within = exact(smaller.next_down());
    let around = exact(larger.next_up());

    let say = || {
        format!("{}: {found:?} where {within:?} and {around:?} bound: {ray:?} {sphere:?}", A::NAME)
    };
    let Some([first, last]) = around else {
        assert!(found.is_none(), "false hit, {}", say());
        return;
    };
    let Some([near, far]) = found else {
        assert!(within.is_none(), "false miss, {}", say());
        return;
    };
    // Between first and last in any case; where the smaller sphere is met, outside its roots.
    let [inner_near, inner_far] = within.unwrap_or([last, first]);
    let between = |low: f32, t: f32, high: f32| {
        let few_roundings = 8.0 * U * f64::from(t).abs() + 1e-44;
        let slack = few_roundings + A::further_error(distance) / length;
        f64::from(low) - slack <= f64::from(t) && f64::from(t) <= f64::from(high) + slack
    };
    assert!(between(first, near, inner_near), "entry, {}", say());
    assert!(between(inner_far, far, last), "exit, {}", say());
}

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::Vec3;

    const RAY: Ray = Ray::new(Vec3::new(0.0, 0.0, -5.0), Vec3::new(0.0, 0.0, 2.0));
    const BALL: Sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };

    #[test]
    fn the_exact_roots_pass() {
        judge::<Stable>(&RAY, &BALL, Some([2.0, 3.0]));
        judge::<Stable>(&RAY, &Sphere { center: Vec3::X * 2.0, ..BALL }, None);
    }

    #[test]
    fn at_a_tangent_both_decisions_pass() {
        let tangent = Sphere { center: Vec3::X, ..BALL };
        judge::<Stable>(&RAY, &tangent, Some([2.5, 2.5]));
        judge::<Stable>(&RAY, &tangent, None);
    }

    #[test]
    #[should_panic(expected = "false miss")]
    fn a_false_miss_is_seen() {
        judge::<Stable>(&RAY, &BALL, None);
    }

    #[test]
    #[should_panic(expected = "false hit")]
    fn a_false_hit_is_seen() {
        let beside = Sphere { center: Vec3::X * 1.0001, ..BALL };
        judge::<Stable>(&RAY, &beside, Some([2.5, 2.5]));
    }

    #[test]
    #[should_panic(expected = "entry")]
    fn an_entry_sixteen_ulps_off_is_seen() {
        judge::<Stable>(&RAY, &BALL, Some([2.0 + 16.0 * f32::EPSILON * 2.0, 3.0]));
    }

    #[test]
    #[should_panic(expected = "exit")]
    fn an_exit_that_is_the_entry_is_seen() {
        judge::<Fast>(&RAY, &BALL, Some([2.0, 2.0]));
    }
}
