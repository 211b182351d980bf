//! A tier's roots against the exact ones.
//!
//! A tier's promise is put as a backward error. Its answer must be an exact answer for a sphere whose squared radius
//! differs by no more than the tier's error, and t may also be off by a few roundings. So the exact oracle answers
//! twice, for a slightly smaller sphere and for a slightly larger one. If the line misses both, the tier must miss; if
//! it meets both, the tier must hit; and the tier's roots must lie between those of the two spheres. This holds from
//! head-on to grazing, and needs no float arithmetic of the tier. `Exact` gets no such band.

use spherule_kernel::{Ray, Sphere, Tier};
use spherule_referee::aim::double;
use spherule_referee::random::dot;
use spherule_tests::oracle;

/// Half an ulp of 1.
const U: f64 = 1.0 / 16_777_216.0;
/// The domain: radius and distance up to 2^40, radius from 2^-40, direction 2^-20 to 2^20 long.
const REACH: f64 = 1_099_511_627_776.0;
const LENGTH: f64 = 1_048_576.0;

/// Judges the roots of a line that the tier found.
///
/// # Panics
/// If they break what the tier promises.
pub fn judge(tier: Tier, ray: &Ray, sphere: &Sphere, found: Option<[f32; 2]>) {
    let band = match tier {
        // The textbook form: p.p - r^2 and b^2 are rounded at the size of |p|^2.
        Tier::Fast => Band {
            radii: f64::INFINITY,
            square_error: |radius, distance| 24.0 * U * (radius * radius + distance * distance),
            further_error: |distance| 8.0 * U * distance,
        },
        // The unit direction is rounded too; t_m has a larger error than b.
        Tier::Geometric => Band {
            radii: f64::INFINITY,
            square_error: |radius, distance| 28.0 * U * (radius * radius + distance * distance),
            further_error: |distance| 16.0 * U * distance,
        },
        // Closest point first: at any distance up to 2^20 radii, the error is one of r^2 alone.
        Tier::Stable => Band {
            radii: LENGTH,
            square_error: |radius, _| 32.0 * U * radius * radius,
            further_error: |_| 0.0,
        },
        // The roots of real arithmetic, correctly rounded, whatever the input.
        Tier::Exact => {
            let exact = oracle::roots(ray, sphere);
            let bits = |roots: Option<[f32; 2]>| roots.map(|roots| roots.map(f32::to_bits));
            let is_exact = bits(found) == bits(exact);
            assert!(is_exact, "exact: {found:?} for {exact:?}: {ray:?} {sphere:?}");
            return;
        }
        other => unreachable!("no promise of {other:?}"),
    };
    band.judge(tier.as_str(), ray, sphere, found);
}

/// How far a tier may be from the exact roots, in the domain that the `f32` tiers share.
struct Band {
    /// How many radii away a sphere may be.
    radii: f64,
    /// The error of the squared radius, from radius and distance.
    square_error: fn(f64, f64) -> f64,
    /// The error of t besides, in multiples of the direction's length, from the distance.
    further_error: fn(f64) -> f64,
}

/// |c - o| and |d|, accurate enough to tell what is promised.
fn lengths(ray: &Ray, sphere: &Sphere) -> (f64, f64) {
    let [o, d, c] = [ray.origin, ray.direction, sphere.center].map(double);
    let p = [0, 1, 2].map(|axis| c[axis] - o[axis]);
    (dot(p, p).sqrt(), dot(d, d).sqrt())
}

/// Whether radius, distance and direction lie in the domain.
#[must_use]
pub fn in_domain(ray: &Ray, sphere: &Sphere) -> bool {
    let (distance, length) = lengths(ray, sphere);
    (1.0 / REACH..=REACH).contains(&f64::from(sphere.radius))
        && distance <= REACH
        && (1.0 / LENGTH..=LENGTH).contains(&length)
}

/// Whether every structure promises the bits of `Stable` for this sphere: in the contract's domain, where no square of `Fast` and
/// `Geometric` underflows either. An invalid sphere is hit by no tier.
#[must_use]
pub fn is_stable_in_structures(ray: &Ray, sphere: &Sphere) -> bool {
    let (distance, _) = lengths(ray, sphere);
    let is_tiny = 0.0 < distance && distance < 1.0 / REACH;
    !sphere.is_valid() || in_domain(ray, sphere) && !is_tiny
}

impl Band {
    fn judge(&self, tier: &str, ray: &Ray, sphere: &Sphere, found: Option<[f32; 2]>) {
        let (distance, length) = lengths(ray, sphere);
        let radius = f64::from(sphere.radius);
        if !in_domain(ray, sphere) || distance > self.radii * radius {
            return;
        }
        let error = (self.square_error)(radius, distance);
        let smaller = (radius * radius - error).max(0.0).sqrt() as f32;
        let larger = (radius * radius + error).sqrt() as f32;
        let exact = |radius: f32| oracle::roots(ray, &Sphere { radius, ..*sphere });
        let within = exact(smaller.next_down());
        let around = exact(larger.next_up());

        let say = || {
            format!("{tier}: {found:?} where {within:?} and {around:?} bound: {ray:?} {sphere:?}")
        };
        let Some([first, last]) = around else {
            assert!(found.is_none(), "false hit, {}", say());
            return;
        };
        let Some([near, far]) = found else {
            assert!(within.is_none(), "false miss, {}", say());
            return;
        };
        // In any case between first and last; where the line meets the smaller sphere, not between its roots.
        let [inner_near, inner_far] = within.unwrap_or([last, first]);
        let between = |low: f32, t: f32, high: f32| {
            let few_roundings = 8.0 * U * f64::from(t).abs() + 1e-44;
            let slack = few_roundings + (self.further_error)(distance) / length;
            f64::from(low) - slack <= f64::from(t) && f64::from(t) <= f64::from(high) + slack
        };
        assert!(between(first, near, inner_near), "entry, {}", say());
        assert!(between(inner_far, far, last), "exit, {}", say());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::Vec3;
    use std::panic::catch_unwind;

    const RAY: Ray = Ray::new(Vec3::new(0.0, 0.0, -5.0), Vec3::new(0.0, 0.0, 2.0));
    const BALL: Sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };

    #[test]
    fn the_exact_roots_pass_and_at_a_tangent_both_decisions() {
        let tangent = Sphere { center: Vec3::X, ..BALL };
        judge(Tier::Stable, &RAY, &BALL, Some([2.0, 3.0]));
        judge(Tier::Stable, &RAY, &Sphere { center: Vec3::X * 2.0, ..BALL }, None);
        judge(Tier::Stable, &RAY, &tangent, Some([2.5, 2.5]));
        judge(Tier::Stable, &RAY, &tangent, None);
    }

    #[test]
    fn what_breaks_the_promise_is_seen() {
        let beside = Sphere { center: Vec3::X * 1.0001, ..BALL };
        let sixteen_ulps_off = 2.0 + 16.0 * f32::EPSILON * 2.0;
        for (expected, tier, sphere, found) in [
            ("false miss", Tier::Stable, BALL, None),
            ("false hit", Tier::Stable, beside, Some([2.5, 2.5])),
            ("entry", Tier::Stable, BALL, Some([sixteen_ulps_off, 3.0])),
            ("exact", Tier::Exact, BALL, Some([2.0_f32.next_up(), 3.0])),
            // The exit is the entry.
            ("exit", Tier::Fast, BALL, Some([2.0, 2.0])),
        ] {
            let judged = catch_unwind(|| judge(tier, &RAY, &sphere, found));
            let message = judged.expect_err(expected).downcast::<String>().expect("a message");
            assert!(message.contains(expected), "{expected}: {message}");
        }
    }
}
