//! Where positions are counted from: zero, or the first sphere where all are far from zero.
//!
//! The kernel computes in single precision, of 24 bits. On a map in metres, 5,400 km from its zero, the last bit is
//! half a metre: trees and houses would be on a lattice of such steps, and the light on smaller things would be lost.
//! Files state double precision. So where the first spheres together are much farther from zero than they are wide,
//! positions are counted from the first sphere, in double precision, before they are rounded. Everything in the program
//! then has the numbers that it would have near zero.

use glam::DVec3;

/// How many spheres tell how wide things are: a file is read once, and the spheres that follow are not known.
pub(super) const FIRST: usize = 16;

/// Spheres are far if they are more than so many times as far from zero as they are wide. Nearer ones keep their
/// numbers, which people know, and have 12 bits more than this width.
const FAR: f64 = 4096.0;

/// Positions counted from an origin this far away, or farther, might leave single precision at the other end of its
/// range.
const TOO_FAR: f64 = 1e30;

/// The origin of positions, for a scene that begins with spheres at `centers`, with `radii` as far as these are known
/// (NaN: not known). It is a point of single precision: few digits, for people.
pub(super) fn origin(centers: &[DVec3], radii: &[f32]) -> DVec3 {
    let Some(&first) = centers.first() else { return DVec3::ZERO };
    let bounds = |least: fn(DVec3, DVec3) -> DVec3| centers.iter().copied().fold(first, least);
    let known = radii.iter().copied().fold(0.0, f32::max);
    let width = (bounds(DVec3::max) - bounds(DVec3::min)).max_element().max(2.0 * f64::from(known));
    let distance = bounds(|a, b| a.abs().min(b.abs())).abs().max_element();
    // Spheres without a radius at one place do not tell how wide things are.
    let is_far = width > 0.0 && distance > FAR * width && distance < TOO_FAR;
    if is_far { first.as_vec3().as_dvec3() } else { DVec3::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOUSE: DVec3 = DVec3::new(500_000.125, 5_400_000.3, 310.0);

    #[test]
    fn a_house_on_a_map_is_far_and_a_molecule_is_not() {
        let walls = [HOUSE, HOUSE + DVec3::X, HOUSE - 7.0 * DVec3::Z];
        assert_eq!(origin(&walls, &[]), DVec3::new(500_000.125, 5_400_000.5, 310.0));
        let water = [DVec3::new(30.0, 80.0, -70.0), DVec3::new(31.0, 80.0, -70.0)];
        assert_eq!(origin(&water, &[]), DVec3::ZERO);
    }

    #[test]
    fn what_is_wide_is_not_far() {
        assert_eq!(origin(&[HOUSE, HOUSE + DVec3::splat(1400.0)], &[]), DVec3::ZERO);
        assert_ne!(origin(&[HOUSE, HOUSE + DVec3::splat(1300.0)], &[]), DVec3::ZERO);
        assert_eq!(origin(&[HOUSE, DVec3::ZERO, HOUSE], &[]), DVec3::ZERO);
        assert_eq!(origin(&[HOUSE, HOUSE], &[f32::NAN, 700.0]), DVec3::ZERO);
        assert_ne!(origin(&[HOUSE, HOUSE], &[f32::NAN, 600.0]), DVec3::ZERO);
    }

    #[test]
    fn what_may_be_at_both_ends_of_the_range_stays() {
        let at = |x: f64| [DVec3::new(x, 0.0, 0.0), DVec3::new(x, 1e20, 0.0)];
        assert_eq!(origin(&at(1.1e30), &[]), DVec3::ZERO);
        assert_eq!(origin(&at(f32::MAX.into()), &[]), DVec3::ZERO);
        let origin = origin(&at(0.9e30), &[]);
        assert!(
            origin.x > 8e29 && (DVec3::splat(-f64::from(f32::MAX)) - origin).as_vec3().is_finite()
        );
    }

    #[test]
    fn where_nothing_tells_a_width_positions_stay() {
        assert_eq!(origin(&[], &[]), DVec3::ZERO);
        assert_eq!(origin(&[HOUSE, HOUSE], &[f32::NAN, 0.0]), DVec3::ZERO);
    }
}
