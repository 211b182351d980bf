//! Rays and spheres of short integers: what the double-precision stage makes of them, where their roots are, and sets of them.

use crate::accuracy::constants::Constants;
use crate::accuracy::exact::estimate::Estimate;
use crate::exact::{QuadraticTerms, Root};
use crate::proofs::toy::case::{Case, Truth, lanes};
use crate::proofs::toy::floats::{Format, Toy, power_of_two};
use crate::proofs::toy::pairs;
use core::cmp::Ordering;
use std::vec::Vec;

impl Case {
    pub(super) fn terms(&self) -> QuadraticTerms {
        let [o, d, c] = [self.o, self.d, self.c].map(|v| v.map(|x| x as f32));
        QuadraticTerms::new(o, d, c, self.r as f32)
    }

    pub(super) fn estimate<F: Format>(&self, constants: &Constants) -> Estimate<Toy<F>> {
        let (center, radius) = self.sphere();
        Estimate::new(lanes(self.o), lanes(self.d), center, radius, constants)
    }
}

impl Truth {
    /// How `t` compares with a root, both being real numbers: t a - b with -+sqrt D.
    pub(super) fn compare(&self, t: f64, root: Root) -> Ordering {
        if !t.is_finite() {
            return t.total_cmp(&0.0);
        }
        // t = fraction 2^exponent = integer 2^-scale, in as few bits as there are.
        let (fraction, exponent) = libm::frexp(t);
        let integer = (fraction * (1_u64 << 53) as f64) as i128;
        let zeros = integer.trailing_zeros().min(53) as i32;
        let (integer, exponent) = (integer >> zeros, exponent - 53 + zeros);
        let (integer, scale) = match exponent {
            0.. => (integer << exponent, 0),
            _ => (integer, exponent.unsigned_abs()),
        };
        let past_middle = integer * i128::from(self.a) - (i128::from(self.b) << scale);
        let discriminant = i128::from(self.discriminant) << (2 * scale);
        // Squares with the signs of what is squared.
        (past_middle * past_middle.abs()).cmp(&match root {
            Root::Near => -discriminant,
            Root::Far => discriminant,
        })
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
                            work(&Case::in_plane([ox, oy], [dx, dy], [cx, cy], r));
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
