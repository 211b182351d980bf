//! Every operation of every width against the same operation of one lane, bit for bit.

use crate::lanes::{DoubleLanes, LaneArray, LaneMask, Lanes};
use crate::proofs::climb::Random;
use crate::{f32x4, f32x8, f32x16};
use std::vec::Vec;

const SPECIALS: [f32; 14] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f32::from_bits(1),
    f32::from_bits(0x8000_0001),
    f32::from_bits(0x007f_ffff),
    f32::MIN_POSITIVE,
    f32::MAX,
    f32::MIN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    f32::from_bits(0xffc0_1234),
];

fn number(random: &mut Random) -> f32 {
    match random.below(4) {
        0 => SPECIALS[random.below(14) as usize],
        1 => random.wide(-2, 2),
        _ => f32::from_bits(random.bits() as u32),
    }
}

/// NaN is NaN, whichever.
fn same(lane: f32, scalar: f32) -> bool {
    lane.to_bits() == scalar.to_bits() || lane.is_nan() && scalar.is_nan()
}

fn array<L: Lanes>(numbers: &[f32]) -> L::Array {
    let mut array = L::Array::filled(0.0);
    array.as_mut().copy_from_slice(numbers);
    array
}

/// A number a lane.
fn numbers<L: Lanes>(random: &mut Random) -> Vec<f32> {
    (0..L::COUNT).map(|_| number(random)).collect()
}

fn singles<L: Lanes<Token = ()>>() {
    let mut random = Random(41);
    for _ in 0..20_000 {
        let [a, b, c] = [(); 3].map(|()| numbers::<L>(&mut random));
        let [x, y, z] = [&a, &b, &c].map(|numbers| L::load((), &array::<L>(numbers)));
        let check = |name: &str, lanes: L, scalar: &dyn Fn(f32, f32, f32) -> f32| {
            for (lane, &found) in lanes.store().as_ref().iter().enumerate() {
                let expected = scalar(a[lane], b[lane], c[lane]);
                assert!(same(found, expected), "{name} {:e} {:e}: {found:e}", a[lane], b[lane]);
            }
        };
        check("load", x, &|a, _, _| a);
        check("+", x + y, &|a, b, _| a + b);
        check("-", x - y, &|a, b, _| a - b);
        check("*", x * y, &|a, b, _| a * b);
        check("/", x / y, &|a, b, _| a / b);
        check("neg", -x, &|a, _, _| -a);
        check("sqrt", x.sqrt(), &|a, _, _| a.sqrt());
        check("abs", x.abs(), &|a, _, _| a.abs());
        check("splat", L::splat((), a[0]), &|_, _, _| a[0]);
        check("like", x.like(b[0]), &|_, _, _| b[0]);
        check("select lt", L::select(x.lt(y), z, x), &|a, b, c| if a < b { c } else { a });
        check("select le", L::select(x.le(y), z, x), &|a, b, c| if a <= b { c } else { a });
        let both = x.lt(y) & !y.le(z) | z.lt(x);
        let bits = (0..L::COUNT).fold(0, |bits, i| {
            let not_le = b[i].is_nan() || c[i].is_nan() || b[i] > c[i];
            bits | u32::from((a[i] < b[i]) & not_le | (c[i] < a[i])) << i
        });
        assert_eq!((both.bits(), both.any()), (bits, bits != 0));

        for (lane, &sum) in x.filter_mul_add(y, z).store().as_ref().iter().enumerate() {
            let (fused, plain) = (a[lane].mul_add(b[lane], c[lane]), a[lane] * b[lane] + c[lane]);
            assert!(same(sum, fused) || same(sum, plain), "filter_mul_add: {sum:e}");
        }
        for (lane, &larger) in x.filter_max(y).store().as_ref().iter().enumerate() {
            let (a, b) = (a[lane], b[lane]);
            let either = same(larger, a) || same(larger, b);
            assert!(either && (larger >= a && larger >= b || a.is_nan() || b.is_nan()));
        }
    }
}

/// `widen` of every part, every operation in double precision, and `narrow` of every part.
fn doubles<L: Lanes<Token = ()>>() {
    let mut random = Random(42);
    let count = L::Double::COUNT;
    assert_eq!(L::PARTS * count, L::COUNT);
    for _ in 0..20_000 {
        let [a, b] = [(); 2].map(|()| numbers::<L>(&mut random));
        let [x, y] = [&a, &b].map(|numbers| L::load((), &array::<L>(numbers)));
        // Sums and quotients have bits below those of single precision: narrowing must round.
        type Operation<D> = fn(D, D) -> D;
        let operations: [(Operation<L::Double>, Operation<f64>); 10] = [
            (|x, _| x, |x, _| x),
            (|x, y| x + y, |x, y| x + y),
            (|x, y| x - y, |x, y| x - y),
            (|x, y| x * y, |x, y| x * y),
            (|x, y| x / y, |x, y| x / y),
            (|x, _| -x, |x, _| -x),
            (|x, _| DoubleLanes::sqrt(x), |x, _| f64::sqrt(x)),
            (|x, _| DoubleLanes::abs(x), |x, _| f64::abs(x)),
            (|x, y| DoubleLanes::select(x.lt(y), x * y, y), |x, y| if x < y { x * y } else { y }),
            (
                |x, y| DoubleLanes::select(x.le(y), y, x.like(0.1)),
                |x, y| if x <= y { y } else { 0.1 },
            ),
        ];
        for (index, (lanes, scalar)) in operations.into_iter().enumerate() {
            let marks: Vec<f32> = (0..L::COUNT).map(|lane| lane as f32).collect();
            let mut found = array::<L>(&marks);
            for part in (0..L::PARTS).rev() {
                L::narrow(&mut found, part, lanes(x.widen(part), y.widen(part)));
                // The parts before this one are as they were.
                assert_eq!(found.as_ref()[..part * count], marks[..part * count]);
            }
            for (lane, &found) in found.as_ref().iter().enumerate() {
                let expected = scalar(f64::from(a[lane]), f64::from(b[lane])) as f32;
                let (a, b) = (a[lane], b[lane]);
                assert!(same(found, expected), "{index}, {a:e} {b:e}: {found:e}, not {expected:e}");
            }
        }
        for part in 0..L::PARTS {
            let (less, bits) = (x.widen(part).lt(y.widen(part)), x.lt(y).bits());
            assert_eq!(less.bits(), bits >> (part * count) & ((1 << count) - 1));
        }
    }
}

#[test]
fn every_width_computes_what_one_lane_does() {
    fn both<L: Lanes<Token = ()>>() {
        std::println!("{} lanes", L::COUNT);
        singles::<L>();
        doubles::<L>();
    }
    both::<f32>();
    both::<f32x4>();
    both::<f32x8>();
    both::<f32x16>();
}
