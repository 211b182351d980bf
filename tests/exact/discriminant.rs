//! The value and bound that `discriminant` returns, against the truth.

use super::{count, first};
use num_bigint::BigInt;
use spherule_kernel::discriminant;
use spherule_referee::case::Case;
use spherule_referee::families::FAMILIES;
use spherule_tests::oracle;

/// `x` in units of 2^-1074, which every `f64` is a multiple of.
fn double_units(x: f64) -> BigInt {
    assert!(x.is_finite(), "{x} is no multiple of anything");
    let (exponent, fraction) = (x.to_bits() >> 52 & 0x7ff, x.to_bits() & ((1 << 52) - 1));
    let magnitude = match exponent {
        0 => BigInt::from(fraction),
        _ => BigInt::from(fraction | 1 << 52) << (exponent - 1),
    };
    if x.is_sign_negative() { -magnitude } else { magnitude }
}

/// The control: the bound is not so large that no error could exceed it.
#[test]
fn the_discriminant_is_within_its_bound() {
    let (mut done, mut rounded, mut beyond_a_part) = (0_u64, 0_u64, 0_u64);
    for family in FAMILIES {
        for index in 0..count() {
            let Case { ray, sphere } = family.case(first() + index);
            let truth = oracle::discriminant(&ray, &sphere);
            let found = discriminant(&ray, &sphere);
            assert_eq!(found.is_some(), truth.is_some(), "{ray:?} {sphere:?}");
            let (Some((value, bound)), Some(truth)) = (found, truth) else { continue };
            // From units of 2^-596.
            let truth: BigInt = truth << (1074 - 596_u32);
            let error = (double_units(value) - truth).magnitude().clone();
            let bound = double_units(bound).magnitude().clone();
            assert!(error <= bound, "{value} of {ray:?} {sphere:?}: {error} > {bound}");
            done += 1;
            rounded += u64::from(error != 0_u32.into());
            beyond_a_part += u64::from(error * 16_u32 > bound);
        }
    }
    println!(
        "{done} discriminants, {rounded} rounded, {beyond_a_part} by a sixteenth of the bound"
    );
    assert!(done > 0 && rounded * 4 > done && beyond_a_part * 100 > done);
}
