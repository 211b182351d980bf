//! Sums of doubles that are never rounded: expansion arithmetic (Shewchuk 1997, Adaptive Precision
//! Floating-Point Arithmetic and Fast Robust Geometric Predicates).
//!
//! An expansion stands for the exact sum of its terms. The terms do not overlap - each is smaller
//! than the least significant bit of the next - so the last term has the sign of the sum and is
//! within one unit in its last place of it.
//!
//! The theorems ask that nothing over- or underflows and that rounding is to nearest even. Who
//! uses this module shows the first; the second is Rust's assumption about the machine, and
//! [`float_environment_is_sound`](crate::float_environment_is_sound) tests it.

use core::cmp::Ordering;
use core::ops::{Add, Mul, Neg, Sub};

/// Double precision, or a type that behaves like it and counts.
pub(crate) trait Float:
    Copy
    + PartialOrd
    + From<f64>
    + Into<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
{
    const ZERO: Self;
    /// 2^27 + 1.
    const SPLITTER: Self;
}

impl Float for f64 {
    const ZERO: Self = 0.0;
    const SPLITTER: Self = 134_217_729.0;
}

/// `high + low = a + b` exactly, with `high` the rounded sum (Knuth).
#[inline]
fn two_sum<F: Float>(a: F, b: F) -> (F, F) {
    let high = a + b;
    let b_part = high - a;
    let a_part = high - b_part;
    (high, (a - a_part) + (b - b_part))
}

/// Halves of at most 26 bits (Veltkamp). Domain: below 2^996.
#[inline]
fn split<F: Float>(value: F) -> (F, F) {
    let scaled = F::SPLITTER * value;
    let high = scaled - (scaled - value);
    (high, value - high)
}

/// `high + low = a * b` exactly, with `high` the rounded product (Dekker): no fused operation,
/// which not every target has.
#[inline]
fn two_product<F: Float>(a: F, b: F) -> (F, F) {
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    let rest = product - a_high * b_high;
    let rest = (rest - a_low * b_high) - a_high * b_low;
    (product, a_low * b_low - rest)
}

/// An exact sum of at most `N` doubles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expansion<F, const N: usize> {
    /// Ordered by magnitude, not overlapping, none zero.
    terms: [F; N],
    length: usize,
}

impl<F: Float, const N: usize> Expansion<F, N> {
    /// The empty sum.
    pub(crate) const fn zero() -> Self {
        Self { terms: [F::ZERO; N], length: 0 }
    }

    /// The terms, smallest first.
    pub(crate) fn terms(&self) -> &[F] {
        self.terms.get(..self.length).unwrap_or(&[])
    }

    /// Adds `value` (Shewchuk's Grow-Expansion, leaving out zeros).
    ///
    /// Each call makes the expansion at most one term longer: the caller counts its calls and
    /// asks for as large an `N`.
    pub(crate) fn add(&mut self, value: F) {
        let (mut carry, mut kept) = (value, 0);
        for index in 0..self.length.min(N) {
            let (high, low) = two_sum(carry, self.terms[index]);
            carry = high;
            if low != F::ZERO {
                self.terms[kept.min(index)] = low;
                kept += 1;
            }
        }
        if carry != F::ZERO {
            debug_assert!(kept < N, "an expansion longer than its caller proved");
            if let Some(term) = self.terms.get_mut(kept) {
                *term = carry;
                kept += 1;
            }
        }
        self.length = kept;
    }

    /// Adds `a * b`: two terms.
    pub(crate) fn add_product(&mut self, a: F, b: F) {
        let (high, low) = two_product(a, b);
        self.add(low);
        self.add(high);
    }

    /// Adds the square of an expansion of `n` terms: n (n + 1) terms.
    pub(crate) fn add_square(&mut self, terms: &[F]) {
        for (index, &term) in terms.iter().enumerate() {
            self.add_product(term, term);
            for &other in terms.iter().skip(index + 1) {
                self.add_product(term + term, other);
            }
        }
    }

    /// How the sum compares with zero.
    pub(crate) fn sign(&self) -> Ordering {
        let last = self.terms().last().copied().unwrap_or(F::ZERO);
        last.partial_cmp(&F::ZERO).unwrap_or(Ordering::Equal)
    }

    /// The sum within 4 u of itself, u = 2^-53: all but the last two terms are below u^2 of it.
    pub(crate) fn estimate(&self) -> f64 {
        self.terms().iter().fold(0.0, |sum, &term| sum + term.into())
    }
}

#[cfg(test)]
mod against_integers;
