//! Accumulators against integers of any size: every product of six `f32` is a multiple of 2^-1216.

use crate::exact::long_accumulator::{Product, SumOfEights};
use crate::proofs::climb::Random;
use crate::proofs::integers::units;
use core::cmp::Ordering;
use num_bigint::BigInt;
use std::vec::Vec;

fn check(sum: &SumOfEights, exact: &BigInt) {
    assert_eq!(sum.sign(), exact.cmp(&BigInt::ZERO));
    // Limb by limb, two's complement.
    let bits = (BigInt::from(1) << 2048_u32) + exact;
    let limbs: Vec<u64> = bits.iter_u64_digits().take(32).collect();
    assert_eq!(sum.limbs[..], limbs[..], "{exact}");
}

/// Any finite bits, or few of them, so that sums cancel.
fn single(random: &mut Random) -> f32 {
    let bits = random.bits() as u32;
    let value = match random.below(4) {
        0 => f32::from_bits(bits),
        1 => f32::from_bits(bits & 0x807f_ffff),
        2 => (bits >> 28) as f32,
        _ => f32::MAX,
    };
    if value.is_finite() { value } else { f32::MIN }
}

/// The product of numbers, and the same in units of 2^-1216.
fn product(numbers: &[f32]) -> BigInt {
    let units = numbers.iter().map(|&number| units(number));
    let places = 1216 - 149 * numbers.len();
    units.fold(BigInt::from(1), |product, factor| product * factor) << places
}

#[test]
fn sums_of_products_are_exact() {
    let mut random = Random(11);
    for _ in 0..3000 {
        let (mut sum, mut exact) = (SumOfEights::zero(), BigInt::ZERO);
        let mut added = Vec::new();
        for _ in 0..random.below(24) {
            let numbers = match added.len() {
                // What was added goes away again, or nearly.
                1.. if random.below(3) == 0 => {
                    let mut numbers: [f32; 6] = added[random.below(added.len() as u64) as usize];
                    numbers[0] = -numbers[0];
                    numbers
                }
                _ => [(); 6].map(|()| single(&mut random)),
            };
            added.push(numbers);
            let [a, b, c, d, e, f] = numbers.map(Product::of);
            let four = a.times(&b).times(&c.times(&d));
            match random.below(3) {
                0 => (sum.add_product(&four, &e.times(&f)), exact += product(&numbers)).1,
                1 => (sum.add(&four.negated()), exact -= product(&numbers[..4])).1,
                _ => (sum.add(&four.scaled(2)), exact += product(&numbers[..4]) << 2_u32).1,
            }
        }
        check(&sum, &exact);
    }
}

#[test]
fn squares_and_products_of_sums_are_exact() {
    let mut random = Random(12);
    for _ in 0..2000 {
        let some = [(); 4].map(|()| single(&mut random));
        let others = [(); 3].map(|()| single(&mut random));
        let (a, b) = (some.map(Product::of), others.map(Product::of));
        let total = |numbers: &[f32]| numbers.iter().map(|&x| units(x)).sum::<BigInt>();
        let mut sum = SumOfEights::zero();
        sum.add_square(&a, &b[0]);
        let exact = (total(&some).pow(2) * units(others[0])) << (1216 - 3 * 149);
        check(&sum, &exact);
        for (term, other) in a.iter().flat_map(|term| b.iter().map(move |other| (term, other))) {
            sum.add_product(term, other);
        }
        let wide = a.map(|term| term.times(&b[1]).times(&b[2]));
        let exact = exact
            + ((total(&some) * units(others[1]) * units(others[2])).pow(2) << (1216 - 6 * 149));
        sum.add_wide_square(&wide);
        check(&sum, &(exact + ((total(&some) * total(&others)) << (1216 - 2 * 149))));
    }
}

#[test]
fn estimates_are_close() {
    let mut random = Random(13);
    for _ in 0..5000 {
        let (mut sum, mut exact) = (SumOfEights::zero(), BigInt::ZERO);
        for _ in 0..random.below(4) {
            let numbers = [(); 4].map(|()| single(&mut random));
            let [a, b, c, d] = numbers.map(Product::of);
            sum.add_product(&a.times(&b), &c.times(&d));
            exact += product(&numbers);
        }
        // 53 bits, and an exponent, in units of 2^-1216.
        let (fraction, exponent) = libm::frexp(sum.estimate());
        let bits = (fraction * (1_u64 << 53) as f64) as i64;
        let estimate = BigInt::from(bits) << (exponent + 1216 - 53) as u32;
        let off = estimate - &exact;
        assert!(off.magnitude() << 52_u32 <= *exact.magnitude(), "{exact}");
    }
}

#[test]
fn midpoints_have_25_bits() {
    let mut random = Random(14);
    for _ in 0..5000 {
        let low = f32::from_bits(random.below(0x7f7f_ffff) as u32);
        let high = low.next_up();
        for (midpoint, sign) in [((low, high), 1), ((-high, -low), -1)] {
            let mut sum = SumOfEights::zero();
            sum.add(&Product::between(midpoint.0, midpoint.1));
            let both = (units(low) + units(high)) * sign;
            check(&sum, &(both << (1216 - 150)));
        }
    }
    let mut zero = SumOfEights::zero();
    zero.add(&Product::of_double(0.0));
    assert_eq!(zero.sign(), Ordering::Equal);
}
