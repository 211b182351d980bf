//! Rays and spheres of short integers, what is true of them, and sets of them.

use crate::accuracy::constants::Constants;
use crate::accuracy::exact::estimate::Estimate;
use crate::exact::{QuadraticTerms, Root};
use crate::proofs::toy::floats::{Format, Toy, power_of_two};
use crate::proofs::toy::pairs;
use core::cmp::Ordering;
use std::vec::Vec;

/// o, d, c, r.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case {
    pub(super) o: [i64; 3],
    pub(super) d: [i64; 3],
    pub(super) c: [i64; 3],
    pub(super) r: i64,
}

/// a, b and D of a case, exactly.
#[derive(Clone, Copy, Debug)]
pub(super) struct Truth {
    pub(super) a: i64,
    pub(super) b: i64,
    pub(super) discriminant: i64,
}

impl Case {
    pub(super) fn truth(&self) -> Truth {
        let Self { o, d, c, r } = *self;
        let p = [c[0] - o[0], c[1] - o[1], c[2] - o[2]];
        let x = [d[1] * p[2] - d[2] * p[1], d[2] * p[0] - d[0] * p[2], d[0] * p[1] - d[1] * p[0]];
        let dot = |v: [i64; 3], w: [i64; 3]| v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
        let a = dot(d, d);
        Truth { a, b: dot(d, p), discriminant: a * r * r - dot(x, x) }
    }

    pub(super) fn terms(&self) -> QuadraticTerms {
        let single = |v: [i64; 3]| v.map(|x| x as f32);
        QuadraticTerms::new(single(self.o), single(self.d), single(self.c), self.r as f32)
    }

    pub(super) fn estimate<F: Format>(&self, constants: &Constants) -> Estimate<Toy<F>> {
        let lanes = |v: [i64; 3]| [lane(v[0]), lane(v[1]), lane(v[2])];
        Estimate::new(lanes(self.o), lanes(self.d), lanes(self.c), lane(self.r), constants)
    }
}

pub(super) fn lane<F: Format>(x: i64) -> Toy<F> {
    Toy::new(x as f64)
}

impl Truth {
    /// How `t` compares with a root, both being real numbers: t a - b with -+sqrt D.
    pub(super) fn compare(&self, t: f64, root: Root) -> Ordering {
        // t = fraction 2^-scale
        let exponent = (t.to_bits() >> 52 & 0x7ff) as i32 - 1075;
        if t == 0.0 || !t.is_finite() {
            return match t {
                0.0 => self.compare_scaled(0, 0, root),
                _ if t > 0.0 => Ordering::Greater,
                _ => Ordering::Less,
            };
        }
        let magnitude = i128::from(t.to_bits() & ((1 << 52) - 1) | 1 << 52);
        let zeros = magnitude.trailing_zeros() as i32;
        let (fraction, exponent) = (magnitude >> zeros, exponent + zeros);
        let fraction = if t < 0.0 { -fraction } else { fraction };
        match exponent {
            0.. => self.compare_scaled(fraction << exponent, 0, root),
            _ => self.compare_scaled(fraction, -exponent as u32, root),
        }
    }

    pub(super) fn compare_scaled(&self, fraction: i128, scale: u32, root: Root) -> Ordering {
        let past_middle = fraction * i128::from(self.a) - (i128::from(self.b) << scale);
        let squares =
            (past_middle * past_middle).cmp(&(i128::from(self.discriminant) << (2 * scale)));
        match root {
            Root::Near if past_middle > 0 => Ordering::Greater,
            Root::Near if past_middle == 0 => 0.cmp(&self.discriminant).reverse(),
            Root::Near => squares.reverse(),
            Root::Far if past_middle < 0 => Ordering::Less,
            Root::Far if past_middle == 0 => 0.cmp(&self.discriminant),
            Root::Far => squares,
        }
    }

    /// A root, near enough for figures.
    pub(super) fn about(&self, root: Root) -> f64 {
        let [a, b, d] = [self.a, self.b, self.discriminant].map(|x| x as f64);
        match root {
            Root::Near => (b - d.sqrt()) / a,
            Root::Far => (b + d.sqrt()) / a,
        }
    }

    /// A root, correctly rounded: from a number near it by steps to neighbours, across midpoints.
    pub(super) fn rounded<F: Format>(&self, root: Root) -> f64 {
        if self.compare(0.0, root).is_eq() {
            return 0.0;
        }
        let mut t = F::round(self.about(root));
        loop {
            let (below, above) = (neighbour::<F>(t, -1.0), neighbour::<F>(t, 1.0));
            let (low, high) = ((below + t) / 2.0, (t + above) / 2.0);
            let even = t.to_bits() >> (53 - F::BITS) & 1 == 0;
            match (self.compare(low, root), self.compare(high, root)) {
                (Ordering::Greater, _) => t = below,
                (_, Ordering::Less) => t = above,
                (Ordering::Equal, _) if !even => t = below,
                (_, Ordering::Equal) if !even => t = above,
                _ => return t,
            }
        }
    }
}

/// The next number of a format, up or down.
pub(super) fn neighbour<F: Format>(t: f64, direction: f64) -> f64 {
    if t == 0.0 {
        return direction * power_of_two(-200);
    }
    let step = t.abs() * direction;
    let (near, far) = (F::round(t + step * F::U * 0.75), F::round(t + step * F::U * 1.5));
    if near == t { far } else { near }
}

/// Integers of at most so many bits times a power of two, from 0 to `end`.
pub(super) fn short_integers(bits: u32, end: i64) -> Vec<i64> {
    let short = |x: &i64| *x == 0 || 64 - x.leading_zeros() - x.trailing_zeros() <= bits;
    (0..=end).filter(short).collect()
}

pub(super) fn signed(numbers: &[i64]) -> Vec<i64> {
    numbers.iter().filter(|x| **x != 0).map(|x| -x).chain(numbers.iter().copied()).collect()
}

/// All cases in a plane, of numbers of `bits` bits: centres up to `end`, radii up to half as much again, and origins
/// `far` from them.
pub(super) fn plane(bits: u32, far: &[i64], end: i64, mut work: impl FnMut(&Case)) {
    let top = 1 << bits;
    let directions = short_integers(bits, 2 * top - 2);
    let (centers, origins) = (signed(&short_integers(bits, end)), signed(far));
    let radii = short_integers(bits, end + end / 2);
    for &dx in directions.iter().filter(|x| **x >= top) {
        for &dy in directions.iter().filter(|y| **y <= dx) {
            for (cx, cy) in pairs(&centers, &centers) {
                for (ox, oy) in pairs(&origins, &origins) {
                    // The other half is this one from behind.
                    if (cx - ox, cy - oy) >= (0, 0) {
                        for &r in &radii {
                            work(&Case { o: [ox, oy, 0], d: [dx, dy, 0], c: [cx, cy, 0], r });
                        }
                    }
                }
            }
        }
    }
}

/// All cases in space, of numbers of `bits` bits up to `end`, from the coordinates' origin.
pub(super) fn space(bits: u32, end: i64, mut work: impl FnMut(&Case)) {
    let numbers = short_integers(bits, end);
    let both = signed(&numbers);
    for &dx in numbers.iter().filter(|x| **x > end / 2) {
        for (dy, dz) in pairs(&numbers, &numbers).filter(|(y, z)| *y <= dx && z <= y) {
            for (cx, cy) in pairs(&both, &both) {
                for (cz, r) in pairs(&numbers, &numbers) {
                    work(&Case { o: [0; 3], d: [dx, dy, dz], c: [cx, cy, cz], r });
                }
            }
        }
    }
}
