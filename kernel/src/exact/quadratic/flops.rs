//! What one lane costs at worst, counted.
//!
//! An addition to an expansion of n terms is n two-sums of 6 operations, a product 17 before its
//! two additions. With every expansion as long as it can be, that bounds the whole; exponents do
//! not let it come so far. `+ - *` are counted, and each conversion to `f64`, which stands
//! for the addition in an estimate; comparisons, negations and conversions from `f64` are not.

extern crate std;

use super::{Quadratic, Root};
use crate::exact::expansion::Float;
use crate::testing::climb::{Random, climb};
use core::cell::Cell;
use core::hint::black_box;
use core::ops::{Add, Mul, Neg, Sub};
use std::{println, thread_local, time::Instant};

thread_local! {
    static COUNT: Cell<u32> = const { Cell::new(0) };
}

fn counted(value: f64) -> Counting {
    COUNT.set(COUNT.get() + 1);
    Counting(value)
}

/// Double precision that counts.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Counting(f64);

impl Float for Counting {
    const ZERO: Self = Self(0.0);
    const SPLITTER: Self = Self(<f64 as Float>::SPLITTER);
}

impl From<f64> for Counting {
    fn from(value: f64) -> Self {
        Self(value)
    }
}

impl From<Counting> for f64 {
    fn from(value: Counting) -> Self {
        counted(value.0).0
    }
}

impl Add for Counting {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        counted(self.0 + other.0)
    }
}

impl Sub for Counting {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        counted(self.0 - other.0)
    }
}

impl Mul for Counting {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        counted(self.0 * other.0)
    }
}

impl Neg for Counting {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// Stated in the documentation of [`Exact`](crate::Exact), and proven below.
const STATED: u32 = 26_000;

type Numbers = [f32; 10];

fn both_roots<F: Float>(numbers: &Numbers) -> Option<[f32; 2]> {
    let [ox, oy, oz, dx, dy, dz, cx, cy, cz, r] = *numbers;
    let quadratic = Quadratic::<F>::new([ox, oy, oz], [dx, dy, dz], [cx, cy, cz], r.abs())?;
    Some([quadratic.rounded(Root::Near), quadratic.rounded(Root::Far)])
}

fn flops(numbers: &Numbers) -> f64 {
    COUNT.set(0);
    let found = both_roots::<Counting>(numbers);
    let bits = |roots: Option<[f32; 2]>| roots.map(|roots| roots.map(f32::to_bits));
    assert_eq!(bits(found), bits(both_roots::<f64>(numbers)), "counting changes nothing");
    f64::from(COUNT.get())
}

/// Any exponents; a few exponents; a lattice, of tangents and ties; large r, so that D is positive.
fn start(random: &mut Random) -> Numbers {
    let kind = random.below(6);
    let (low, high) =
        [(-126, 127), (-60, 60), (-30, 30), (-126, 127), (0, 1), (0, 3)][kind as usize];
    let mut numbers = [(); 10].map(|()| random.wide(low, high));
    match kind {
        3 => numbers[9] = random.wide(100, 127),
        4 | 5 => numbers = numbers.map(|x| ((x * 4.0) as i32) as f32 * 1.5),
        _ => {}
    }
    if random.below(3) == 0 {
        // A centre so placed that roots are where one can round either way.
        let t = f32::from_bits(random.wide(-2, 30).to_bits() & 0xffff_f000);
        for i in 0..3 {
            numbers[6 + i] = numbers[i] + t * numbers[3 + i];
        }
    }
    numbers.map(|x| if x.is_finite() { x } else { f32::MAX })
}

#[test]
fn one_lane_costs_no_more_than_stated() {
    let random_start = |random: &mut Random| {
        // Also across exponents, which climbing leaves alone: the best of many beginnings.
        let draws = [(); 40].map(|()| start(random));
        draws.into_iter().max_by(|a, b| flops(a).total_cmp(&flops(b))).unwrap_or([1.0; 10])
    };
    let (worst, numbers) = climb(21, 60, 200, random_start, flops);
    // The best of many: the machine may be busy.
    let time = |_| {
        let begun = Instant::now();
        for _ in 0..50 {
            black_box(both_roots::<f64>(black_box(&numbers)));
        }
        begun.elapsed().as_nanos() / 50
    };
    let nanoseconds = (0..50).map(time).min().unwrap_or(0);
    println!("the dearest lane found: {worst} flops, {nanoseconds} ns: {numbers:?}");
    assert!(10_000.0 < worst && worst <= f64::from(STATED), "{worst}");
}

/// Whatever the numbers.
#[test]
fn longest_expansions_bound_the_cost() {
    let adds = |terms: u32| 6 * terms * (terms - 1) / 2;
    let products = |count: u32| 17 * count;
    let square = |terms: u32| products(terms * (terms + 1) / 2) + terms * (terms - 1) / 2;
    let discriminant = 3 * (4 + adds(4) + square(4)) + 6 + products(3) + adds(66);
    let (slope, power) = (6 + adds(6), 3 * (adds(2) + square(2)) + 1 + adds(19));
    let compare = 1 + 3 * (3 + adds(3) + square(3)) + products(9) + adds(37) + adds(18);
    // The terms of three estimates; a is computed beside, with six.
    let whole = 6 + discriminant + slope + power + 66 + 6 + 19 + 2 * compare;
    println!("no lane can cost more than {whole} flops");
    assert!(whole <= STATED, "{whole}");
}
