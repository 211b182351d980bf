//! Roots that can be computed by hand.

use crate::exact::quadratic::{Quadratic, QuadraticTerms, Root};

/// Both roots along x, from the origin, with `step` as the direction.
fn along_x(step: f32, center: f32, radius: f32) -> Option<[f32; 2]> {
    roots([0.0; 3], [step, 0.0, 0.0], [center, 0.0, 0.0], radius)
}

fn roots(o: [f32; 3], d: [f32; 3], c: [f32; 3], r: f32) -> Option<[f32; 2]> {
    let terms = QuadraticTerms::new(o, d, c, r);
    let quadratic = Quadratic::new(&terms)?;
    Some([quadratic.rounded(Root::Near), quadratic.rounded(Root::Far)])
}

const TWO_24: f32 = 16_777_216.0;
const TINY: f32 = f32::from_bits(1);

#[test]
fn a_line_through_the_centre() {
    assert_eq!(along_x(1.0, 3.0, 1.0), Some([2.0, 4.0]));
    assert_eq!(along_x(-2.0, 3.0, 1.0), Some([-2.0, -1.0]));
}

#[test]
fn a_tangent_is_a_hit_and_an_ulp_less_is_not() {
    let line = |radius: f32| roots([-3.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3], radius);
    assert_eq!(line(1.0), Some([3.0, 3.0]));
    assert_eq!(line(1.0_f32.next_down()), None);
    assert!(line(1.0_f32.next_up()).is_some_and(|[near, far]| near < 3.0 && 3.0 < far));
    // In no coordinate plane: |d x p|^2 = 9 * 9 * 81 with d = (1, 2, 2), p = 5 d + 9 (2, 1, -2).
    let at = |radius| roots([0.0; 3], [1.0, 2.0, 2.0], [23.0, 19.0, -8.0], radius);
    assert_eq!(at(27.0), Some([5.0, 5.0]));
    assert_eq!(at(27.0_f32.next_down()), None);
}

#[test]
fn a_radius_of_zero_is_a_point() {
    assert_eq!(along_x(1.0, 3.0, 0.0), Some([3.0, 3.0]));
    assert_eq!(roots([0.0, TINY, 0.0], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0], 0.0), None);
    assert_eq!(along_x(2.0, 0.0, 0.0).map(|t| t.map(f32::to_bits)), Some([0, 0]));
}

#[test]
fn ties_go_to_the_even_neighbour() {
    // 2^24 + 1 falls, 2^24 + 3 rises, as far root, near root, and behind.
    assert_eq!(along_x(1.0, TWO_24, 1.0).map(|t| t[1]), Some(TWO_24));
    assert_eq!(along_x(1.0, TWO_24, 3.0).map(|t| t[1]), Some(TWO_24 + 4.0));
    assert_eq!(along_x(1.0, TWO_24 + 4.0, 3.0).map(|t| t[0]), Some(TWO_24));
    assert_eq!(along_x(1.0, TWO_24 + 4.0, 1.0).map(|t| t[0]), Some(TWO_24 + 4.0));
    assert_eq!(along_x(1.0, -TWO_24, 1.0).map(|t| t[0]), Some(-TWO_24));
    assert_eq!(along_x(1.0, -TWO_24, 3.0).map(|t| t[0]), Some(-TWO_24 - 4.0));
}

#[test]
fn a_hair_beside_a_tie_is_none() {
    // The far root is 2^24 + sqrt(1 -+ e): just below and just above the midpoint.
    let beside = |offset: f32, radius: f32| {
        roots([0.0, offset, 0.0], [1.0, 0.0, 0.0], [TWO_24, 0.0, 0.0], radius).map(|t| t[1])
    };
    let hair = f32::from_bits(0x1f80_0000); // 2^-64
    assert_eq!(beside(0.0, 1.0), Some(TWO_24));
    assert_eq!(beside(0.0, 1.0_f32.next_up()), Some(TWO_24 + 2.0));
    assert_eq!(beside(hair, 3.0), Some(TWO_24 + 2.0));
    assert_eq!(beside(0.0, 3.0), Some(TWO_24 + 4.0));
}

#[test]
fn a_root_that_rounds_to_zero_is_plus_zero() {
    let over_2_127 = f32::from_bits((127 + 127) << 23);
    // (1 - (1 + 2^-23)) / 2^127 = -2^-150, a tie with -2^-149; and the same from the other side.
    let zero = |root: Option<f32>| assert_eq!(root.map(f32::to_bits), Some(0));
    zero(along_x(over_2_127, 1.0, 1.0_f32.next_up()).map(|t| t[0]));
    zero(along_x(-over_2_127, 1.0, 1.0_f32.next_up()).map(|t| t[1]));
    zero(along_x(over_2_127, 1.0, 1.0).map(|t| t[0]));
    // Three halves of the least number are a tie as well, and go to twice it.
    let three = 1.0 + 3.0 * f32::EPSILON;
    assert_eq!(along_x(over_2_127, 1.0, three).map(|t| t[0]), Some(-2.0 * TINY));
}

#[test]
fn the_last_number_and_infinity_meet_at_their_midpoint() {
    // f32::MAX + 2^103 = 2^128 (1 - 2^-25): a tie, and infinity is even.
    let half_ulp = f32::from_bits((127 + 103) << 23);
    assert_eq!(along_x(1.0, f32::MAX, half_ulp).map(|t| t[1]), Some(f32::INFINITY));
    assert_eq!(along_x(1.0, f32::MAX, half_ulp.next_down()).map(|t| t[1]), Some(f32::MAX));
    assert_eq!(along_x(-1.0, f32::MAX, half_ulp).map(|t| t[0]), Some(f32::NEG_INFINITY));
    assert_eq!(along_x(-1.0, f32::MAX, half_ulp.next_down()).map(|t| t[0]), Some(f32::MIN));
    assert_eq!(along_x(TINY, f32::MAX, 0.0), Some([f32::INFINITY; 2]));
}

#[test]
fn subnormal_roots_are_kept() {
    assert_eq!(along_x(1.0, 3.0 * TINY, TINY), Some([2.0 * TINY, 4.0 * TINY]));
    assert_eq!(along_x(2.0, 3.0 * TINY, 0.0), Some([2.0 * TINY; 2]));
    assert_eq!(along_x(TINY, 3.0 * TINY, TINY), Some([2.0, 4.0]));
}
