//! Expansions against integers of any size: every double is a multiple of 2^-1074.

extern crate std;

use super::{Expansion, two_product, two_sum};
use crate::testing::climb::Random;
use core::cmp::Ordering;
use num_bigint::BigInt;
use std::vec::Vec;

/// `value` in units of 2^-1074.
fn units(value: f64) -> BigInt {
    let (bits, magnitude) = (value.to_bits(), value.to_bits() & (u64::MAX >> 1));
    let (exponent, fraction) = (magnitude >> 52, magnitude & ((1 << 52) - 1));
    let units = match exponent {
        0 => BigInt::from(fraction),
        _ => BigInt::from(fraction | 1 << 52) << (exponent - 1),
    };
    if bits >> 63 == 1 { -units } else { units }
}

/// A double of a random size; often with few bits, so that sums cancel.
fn double(random: &mut Random, spread: u64) -> f64 {
    let exponent = 1023 - spread / 2 + random.below(spread);
    let fraction =
        random.bits() >> 12 >> (random.below(2) * 30) << (random.below(3) * 15) << 12 >> 12;
    let sign = random.bits() >> 63 << 63;
    if random.below(20) == 0 { 0.0 } else { f64::from_bits(sign | exponent << 52 | fraction) }
}

fn check<const N: usize>(sum: &Expansion<f64, N>, exact: &BigInt) {
    let terms = sum.terms();
    let total = terms.iter().fold(BigInt::ZERO, |total, &term| total + units(term));
    assert_eq!(&total, exact, "{terms:?}");
    for pair in terms.windows(2) {
        // Below the least significant bit of the next.
        let least = units(pair[1]).magnitude().trailing_zeros().unwrap_or(0);
        assert!(units(pair[0]).magnitude().bits() <= least, "{pair:?} overlap");
    }
    assert!(terms.iter().all(|&term| term != 0.0), "{terms:?}");
    assert_eq!(sum.sign(), exact.cmp(&BigInt::ZERO), "{terms:?}");
    // 4u = 2^-51.
    let off = units(sum.estimate()) - exact;
    assert!(off.magnitude() << 51_u32 <= *exact.magnitude(), "estimate of {terms:?}");
}

#[test]
fn two_terms_hold_a_sum_and_a_product() {
    let mut random = Random(11);
    for _ in 0..20_000 {
        let (a, b) = (double(&mut random, 500), double(&mut random, 500));
        let (high, low) = two_sum(a, b);
        assert_eq!((high, units(high) + units(low)), (a + b, units(a) + units(b)));
        let (high, low) = two_product(a, b);
        // Units of 2^-2148: the product of two units.
        let product = units(a) * units(b);
        assert_eq!((high, (units(high) + units(low)) << 1074_u32), (a * b, product));
    }
}

#[test]
fn sums_are_exact_and_their_estimates_close() {
    let mut random = Random(12);
    for round in 0..6000 {
        let spread = [4, 30, 100, 400][round % 4];
        let (mut sum, mut exact) = (Expansion::<f64, 40>::zero(), BigInt::ZERO);
        let mut added = Vec::<f64>::new();
        for _ in 0..random.below(20) {
            let value = match added.len() {
                // What was added goes away again, or nearly.
                1.. if random.below(3) == 0 => -added[random.below(added.len() as u64) as usize],
                _ => double(&mut random, spread),
            };
            sum.add(value);
            exact += units(value);
            added.push(value);
        }
        for _ in 0..random.below(8) {
            let (a, b) = (double(&mut random, spread), double(&mut random, spread));
            sum.add_product(a, b);
            exact += (units(a) * units(b)) >> 1074_u32;
        }
        check(&sum, &exact);
    }
}

#[test]
fn squares_of_expansions_are_exact() {
    let mut random = Random(13);
    for round in 0..4000 {
        let spread = [4, 60, 110][round % 3];
        let mut base = Expansion::<f64, 4>::zero();
        for _ in 0..4 {
            base.add(double(&mut random, spread));
        }
        let mut square = Expansion::<f64, 20>::zero();
        square.add_square(base.terms());
        let exact = base.terms().iter().fold(BigInt::ZERO, |sum, &term| sum + units(term));
        check(&square, &((&exact * &exact) >> 1074_u32));
    }
}

#[test]
fn opposites_cancel_to_nothing() {
    let mut sum = Expansion::<f64, 3>::zero();
    assert_eq!((sum.sign(), sum.estimate()), (Ordering::Equal, 0.0));
    for value in [1e200, 1.0, 1e-200, -1e200, -1.0, -1e-200] {
        sum.add(value);
    }
    assert_eq!((sum.sign(), sum.terms()), (Ordering::Equal, &[][..]));
    sum.add(-5e-324);
    assert_eq!((sum.sign(), sum.terms()), (Ordering::Less, &[-5e-324][..]));
}

/// As many terms as calls, and as n (n + 1): the lengths that `quadratic` counts are reached, by
/// numbers far enough apart; that none is exceeded, the assertion in `add` says in every test.
#[test]
fn expansions_grow_as_long_as_counted_and_no_longer() {
    let far_apart = |index: i32| f64::from_bits(((1023 + 60 * index) as u64) << 52);
    let mut sum = Expansion::<f64, 6>::zero();
    for index in [3, -2, 1, 0, 2, -1] {
        sum.add(far_apart(index));
    }
    assert_eq!(sum.terms().len(), 6);
    let (mut random, mut longest) = (Random(14), 0);
    for _ in 0..20_000 {
        let mut base = Expansion::<f64, 3>::zero();
        for index in -1..=1 {
            let fraction = f64::from_bits(random.bits() >> 12 | 1023 << 52);
            base.add(far_apart(3 * index) * fraction);
        }
        assert_eq!(base.terms().len(), 3);
        let mut square = Expansion::<f64, 12>::zero();
        square.add_square(base.terms());
        longest = longest.max(square.terms().len());
    }
    assert_eq!(longest, 12);
}
