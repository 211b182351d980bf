//! How readable a case is.

use spherule_kernel::{Ray, Sphere};

/// The weight of a sphere besides its numbers.
const OF_A_SPHERE: u64 = 256;
/// The weight of oddities, above that of all common numbers: a point for a sphere, a negative radius, NaN or infinity.
const ODD: u64 = 128;

/// The less, the sooner a case is read: few spheres, zeros, integers of few bits, numbers of common size.
#[must_use]
pub fn weight(ray: &Ray, spheres: &[Sphere]) -> u64 {
    let point = |v: spherule_kernel::Vec3| v.to_array().iter().map(|&x| of_number(x)).sum::<u64>();
    let ends = [(ray.t_min, 0.0), (ray.t_max, f32::INFINITY)];
    let end = |(end, usual): (f32, f32)| if end == usual { 0 } else { 8 + of_number(end) };
    let odd = |radius: f32| if radius > 0.0 { 0 } else { ODD };
    let sphere = |s: &Sphere| OF_A_SPHERE + point(s.center) + of_number(s.radius) + odd(s.radius);
    point(ray.origin)
        + point(ray.direction)
        + ends.into_iter().map(end).sum::<u64>()
        + spheres.iter().map(sphere).sum::<u64>()
}

/// Bits of the significand, and powers of two away from one.
fn of_number(x: f32) -> u64 {
    if x == 0.0 {
        return u64::from(x.is_sign_negative());
    }
    if !x.is_finite() {
        return ODD;
    }
    let (value, negative) = (f64::from(x.abs()), u64::from(x < 0.0));
    let fraction = value.to_bits() & ((1 << 52) - 1);
    let bits = if fraction == 0 { 1 } else { 53 - u64::from(fraction.trailing_zeros()) };
    let exponent = (value.to_bits() >> 52).abs_diff(1023);
    let broken = if value.fract() == 0.0 { 0 } else { 4 };
    2 * bits + exponent + negative + broken
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_read_sooner_weighs_less() {
        let order = [0.0, 1.0, -1.0, 2.0, 3.0, 0.5, 10.0, 0.1, 0.3e-20];
        for pair in order.windows(2) {
            assert!(of_number(pair[0]) <= of_number(pair[1]), "{pair:?}");
        }
    }
}
