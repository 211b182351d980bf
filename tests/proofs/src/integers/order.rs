//! Comparisons of roots against integers: square roots of two thousand bits more.

use crate::exact::Quadratic;
use crate::exact::{QuadraticTerms, Root, compare_roots};
use crate::proofs::climb::Random;
use crate::proofs::integers::units;
use core::cmp::Ordering;
use num_bigint::BigInt;
use std::vec::Vec;

const ROOTS: [Root; 2] = [Root::Near, Root::Far];

/// Ray and two spheres: o, d, c and r, c and r.
type Numbers = [f32; 14];

/// Both numerators b -+ sqrt D in 2^-2000, cut; `None` if the line misses.
fn numerators(o: &[BigInt], d: &[BigInt], c: &[BigInt], r: &BigInt) -> Option<[BigInt; 2]> {
    let dot = |v: &[BigInt], w: &[BigInt]| v.iter().zip(w).map(|(v, w)| v * w).sum::<BigInt>();
    let p: Vec<BigInt> = c.iter().zip(o).map(|(c, o)| c - o).collect();
    let b = dot(d, &p);
    let discriminant = &b * &b - dot(d, d) * (dot(&p, &p) - r * r);
    if discriminant < BigInt::ZERO {
        return None;
    }
    let (root, b) = ((discriminant << 4000_u32).sqrt(), b << 2000_u32);
    Some([&b - &root, b + root])
}

/// Compares all roots of both spheres; returns how many are equal, and how many comparisons there were.
fn check(numbers: &Numbers) -> (usize, usize) {
    let exact: Vec<BigInt> = numbers.iter().map(|&x| units(x)).collect();
    let (o, d) = (&exact[..3], &exact[3..6]);
    let [ox, oy, oz, dx, dy, dz, ax, ay, az, r, bx, by, bz, s] = *numbers;
    let (o32, d32) = ([ox, oy, oz], [dx, dy, dz]);
    let of = [([ax, ay, az], r), ([bx, by, bz], s)];
    let terms = of.map(|(c, r)| QuadraticTerms::new(o32, d32, c, r));
    let meets = terms.map(|terms| Quadratic::new(&terms).is_some());
    let [first, second] = terms;
    let truths = [6, 10].map(|at| numerators(o, d, &exact[at..at + 3], &exact[at + 3]));
    assert_eq!(meets, truths.each_ref().map(Option::is_some));
    let [Some(one), Some(other)] = truths else { return (0, 0) };
    let mut equal = 0;
    for (i, root) in ROOTS.into_iter().enumerate() {
        for (j, of_other) in ROOTS.into_iter().enumerate() {
            let difference = &one[i] - &other[j];
            let expected = match difference.magnitude().bits() {
                0..=2 => Ordering::Equal,
                _ => difference.cmp(&BigInt::ZERO),
            };
            let compared = compare_roots((&first, root), (&second, of_other));
            assert_eq!(compared, expected, "{root:?} and {of_other:?} of {numbers:?}");
            equal += usize::from(expected == Ordering::Equal);
        }
    }
    (equal, 4)
}

/// A line on which four signs are all needed, and shared roots: small integers.
#[test]
fn small_integers() {
    let mut random = Random(31);
    let (mut equal, mut compared) = (0, 0);
    for _ in 0..60_000 {
        let mut numbers = [(); 14].map(|()| random.below(5) as f32 - 2.0);
        numbers[3] += 3.0;
        numbers[9] = random.below(5) as f32;
        numbers[13] = random.below(5) as f32;
        let (same, all) = check(&numbers);
        (equal, compared) = (equal + same, compared + all);
    }
    assert!(equal > 200 && compared > 20_000, "{equal} of {compared}");
}

/// Any bits; the second sphere is the first, moved by an ulp or so.
#[test]
fn any_exponents_and_neighbours() {
    let mut random = Random(32);
    let mut compared = 0;
    for round in 0..6000 {
        let (low, high) = [(-149, 127), (-40, 40), (-3, 3)][round % 3];
        let mut numbers = [(); 14].map(|()| random.wide(low, high));
        // Towards the first sphere, which is large enough.
        for i in 0..3 {
            numbers[3 + i] = (numbers[6 + i] - numbers[i]).clamp(-f32::MAX, f32::MAX);
        }
        if numbers[3..6] == [0.0; 3] || numbers.iter().any(|x| !x.is_finite()) {
            continue;
        }
        numbers[9] = numbers[9].abs();
        if random.below(4) != 0 {
            for i in 10..14 {
                let step = random.below(5) as i32 - 2;
                let moved = f32::from_bits(numbers[i - 4].to_bits().wrapping_add_signed(step));
                numbers[i] = if moved.is_finite() { moved } else { numbers[i - 4] };
            }
        }
        numbers[13] = numbers[13].abs();
        compared += check(&numbers).1;
    }
    assert!(compared > 5000, "{compared}");
}
