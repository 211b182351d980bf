//! Whether a line touches a sphere in one point, decided exactly.
//!
//! D = b^2 - a (p.p - r^2) as a sum of products of four numbers each. Every number is a multiple of 2^-149 below 2^128, so
//! every product is one of 2^-596 and below 2^520, and double precision holds each, and its rounding error, without loss.

use crate::aim::double;
use crate::exact_sum::Sum;
use spherule_kernel::{Ray, Sphere, discriminant};

/// Whether D = 0; false for invalid input.
pub(crate) fn is_tangent(ray: &Ray, sphere: &Sphere) -> bool {
    discriminant(ray, sphere)
        .is_some_and(|(d, bound)| d.abs() <= bound && discriminant_is_zero(ray, sphere))
}

fn discriminant_is_zero(ray: &Ray, sphere: &Sphere) -> bool {
    let [o, d, c] = [ray.origin, ray.direction, sphere.center].map(double);
    let r = f64::from(sphere.radius);
    // Products of two are exact in 48 bits.
    let b: Vec<f64> = (0..3).flat_map(|i| [d[i] * c[i], -d[i] * o[i]]).collect();
    let a = d.map(|x| x * x);
    let of_axis = |i: usize| [c[i] * c[i], -2.0 * c[i] * o[i], o[i] * o[i]];
    let square: Vec<f64> = (0..3).flat_map(of_axis).chain([-r * r]).collect();

    let mut sum = Sum::default();
    for x in &b {
        b.iter().for_each(|y| sum.add_product(*x, *y));
    }
    for x in a {
        square.iter().for_each(|y| sum.add_product(-x, *y));
    }
    sum.sign().is_eq()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families::{FAMILIES, Family};

    #[test]
    fn tangents_are_told_from_their_neighbours() {
        let tangents = |family: &Family| {
            family.cases(500).filter(|case| is_tangent(&case.ray, &case.sphere)).count()
        };
        assert_eq!(tangents(&FAMILIES[5]), 500);
        // A tangent remains one if its origin moves along the ray.
        assert!(tangents(&FAMILIES[6]) < 10);
    }
}
