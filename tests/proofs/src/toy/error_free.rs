//! Sums and products without error over all numbers of short formats, those outside of the domains included.

use crate::numeric::error_free::{VeltkampSplit, two_sum};
use crate::proofs::toy::floats::{Format, Toy, power_of_two};
use std::println;
use std::vec::Vec;

// Numbers may be farther apart than twice their bits.
const LEAST: i32 = -8;
const GREATEST: i32 = 8;
// The control is split as if it had two bits less.
const RANGE: Option<[i32; 2]> = Some([LEAST, GREATEST]);
formats! {
    Three: 3, Self, EXPONENTS: Option<[i32; 2]> = RANGE;
    Four: 4, Self, EXPONENTS: Option<[i32; 2]> = RANGE;
    Five: 5, Self, EXPONENTS: Option<[i32; 2]> = RANGE;
    Control: 5, Self, EXPONENTS: Option<[i32; 2]> = RANGE, MARGIN: f64 = 4.0;
}

/// Every finite number of a format.
fn numbers<F: Format>() -> Vec<Toy<F>> {
    let tiny = power_of_two(LEAST + 1 - F::BITS as i32);
    let half = 1 << (F::BITS - 1);
    let subnormal = (0..half).map(|fraction| f64::from(fraction) * tiny);
    let normal = (0..=GREATEST - LEAST).flat_map(|exponent| {
        (half..2 * half).map(move |fraction| f64::from(fraction) * tiny * power_of_two(exponent))
    });
    let numbers: Vec<f64> = subnormal.chain(normal).collect();
    numbers.iter().flat_map(|&x| [Toy::new(x), Toy::new(-x)]).collect()
}

/// Whether a number is an integer of at most so many bits, times a power of two.
fn has_bits(x: f64, bits: u32) -> bool {
    x.to_bits() << 12 << (bits - 1) == 0
}

/// Counts pairs whose sum is exact, whose sum overflows, and whose sum is not exact, for no reason that the sum itself
/// gives.
fn sums<F: Format>() -> [u64; 3] {
    let greatest = F::round(power_of_two(GREATEST + 1) * (1.0 - F::U));
    let mut counts = [0; 3];
    for a in numbers::<F>() {
        for b in numbers::<F>() {
            let (high, low) = two_sum(a, b);
            let sum = a.get() + b.get();
            if F::round(sum).is_infinite() {
                counts[1] += 1;
                assert!(!(high.get() + low.get()).is_finite(), "{a:?} + {b:?} overflows silently");
            } else if high.get() + low.get() == sum {
                counts[0] += 1;
                assert_eq!(high.get(), F::round(sum), "{a:?} + {b:?}");
            } else {
                counts[2] += 1;
                let largest = a.get().abs().max(b.get().abs());
                assert!(largest == greatest, "{a:?} + {b:?} = {high:?} + {low:?}");
                assert!(!low.get().is_finite(), "{a:?} + {b:?} is wrong silently");
            }
        }
    }
    counts
}

/// Counts products and squares in the domain, those of them that are not exact, and those below the domain; returns the
/// largest error of the latter too, in the least number.
fn products<F: Format>() -> ([u64; 3], f64) {
    let tiny = power_of_two(LEAST + 1 - F::BITS as i32);
    let half = F::BITS.div_ceil(2) as i32;
    // As 2^115, 2^127 and 2^-102 are for `f32`.
    let factors = power_of_two(GREATEST - half);
    let (large, small) = (power_of_two(GREATEST), power_of_two(LEAST + F::BITS as i32));
    let (mut counts, mut error) = ([0; 3], 0.0_f64);
    let splits: Vec<_> = numbers::<F>()
        .into_iter()
        .filter(|x| x.get().abs() < factors)
        .map(|x| (x.get(), VeltkampSplit::new(x)))
        .collect();
    for (a, one) in &splits {
        let (high, low) = (one.high.get(), one.low.get());
        assert_eq!(high + low, *a);
        let bits = (F::BITS - half as u32, half as u32 - 1);
        if F::MARGIN == 1.0 {
            assert!(has_bits(high, bits.0) && has_bits(low, bits.1), "{one:?}");
        }
        let products = splits.iter().map(|(b, other)| (a * b, one.times(*other)));
        for (truth, (high, low)) in products.chain([(a * a, one.squared())]) {
            if truth.abs() >= large {
                continue;
            }
            assert_eq!(high.get(), F::round(truth));
            let off = (high.get() + low.get() - truth).abs();
            if truth == 0.0 || truth.abs() >= small {
                counts[0] += 1;
                counts[1] += u64::from(off != 0.0);
            } else {
                counts[2] += 1;
                error = error.max(off / tiny);
            }
        }
    }
    (counts, error)
}

/// A sum overflows in a step between if one of the numbers is the greatest of all, or its opposite, though the sum
/// itself is in range.
#[test]
fn sums_of_all_short_floats() {
    for (bits, [exact, over, within]) in
        [(3, sums::<Three>()), (4, sums::<Four>()), (5, sums::<Five>())]
    {
        println!("{bits} bits: {exact} exact, {over} overflow, {within} only within");
        assert!(exact > 10_000 && over > 100 && within > 0);
    }
    let (_, low) = two_sum(1.5 * (f32::MAX - f32::MAX.next_down()), -f32::MAX);
    assert!(!low.is_finite(), "{low}");
}

#[test]
fn products_of_all_short_floats() {
    for (bits, ([inside, wrong, below], error)) in
        [(3, products::<Three>()), (4, products::<Four>()), (5, products::<Five>())]
    {
        println!(
            "{bits} bits: {inside} exact; {below} below the domain, off by {error} of the least number"
        );
        assert!(wrong == 0, "{bits} bits: {wrong} are not exact");
        assert!(1.0 < error && error <= 2.5, "{error}");
    }
    let ([_, wrong, _], _) = products::<Control>();
    assert!(wrong > 0, "halves that are too long do no harm");
    // Halves may be larger than the number: the square is in range, that of its upper half is not.
    let (square, low) = VeltkampSplit::new(18_446_744_073_709_551_616.0_f32.next_down()).squared();
    assert!(square.is_finite() && !low.is_finite(), "{square} {low}");
}
