//! Sums and products of lanes with their rounding errors: nothing is lost.
//!
//! Built from `+ - *` alone: a fused multiply-add would be shorter, but it is not fused on every
//! target, and where it is not the error term would silently be zero.

use crate::Lanes;
use core::ops::{Add, Sub};

/// `high + low = a + b` exactly, with `high` the rounded sum (Knuth; Møller 1965).
///
/// Domain: the sum does not overflow, and neither number is `f32::MAX` or its opposite. Underflow does no harm: sums
/// that small are exact.
#[inline(always)]
pub(crate) fn two_sum<T: Copy + Add<Output = T> + Sub<Output = T>>(a: T, b: T) -> (T, T) {
    let high = a + b;
    let b_part = high - a;
    let a_part = high - b_part;
    (high, (a - a_part) + (b - b_part))
}

/// 2^s + 1 with s half of the bits of a precision, rounded up; u is 2^-bits.
const fn splitter(unit_roundoff: f32) -> f32 {
    let bits = 127 - (unit_roundoff.to_bits() >> 23);
    f32::from_bits((127 + bits.div_ceil(2)) << 23) + 1.0
}

/// A number and its two halves of at most 12 significant bits each, so that products of halves
/// are exact (Veltkamp, in Dekker 1971).
#[derive(Clone, Copy, Debug)]
pub(crate) struct VeltkampSplit<L> {
    pub(crate) value: L,
    pub(crate) high: L,
    pub(crate) low: L,
}

impl<L: Lanes> VeltkampSplit<L> {
    /// 2^12 + 1.
    const SPLITTER: f32 = splitter(L::UNIT_ROUNDOFF);

    /// Domain: `|value|` below 2^115.
    #[inline(always)]
    pub(crate) fn new(value: L) -> Self {
        let scaled = value * value.like(Self::SPLITTER);
        let high = scaled - (scaled - value);
        Self { value, high, low: value - high }
    }

    /// `high + low = self * other` exactly, with `high` the rounded product (Dekker 1971).
    ///
    /// Domain: the product is below 2^127, and zero or at least 2^-102.
    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> (L, L) {
        let product = self.value * other.value;
        let error = (self.high * other.high - product)
            + self.high * other.low
            + self.low * other.high
            + self.low * other.low;
        (product, error)
    }

    /// `high + low = self^2` exactly.
    #[inline(always)]
    pub(crate) fn squared(self) -> (L, L) {
        let square = self.value * self.value;
        let cross = self.high * self.low;
        ((square), (self.high * self.high - square) + (cross + cross) + self.low * self.low)
    }
}

#[cfg(all(test, proofs))]
mod tests {
    use super::{VeltkampSplit, two_sum};
    use crate::proofs::climb::Random;

    /// Double precision holds a sum of singles exactly where their sizes are within 2^28.
    #[test]
    fn a_sum_loses_nothing() {
        let mut random = Random(1);
        for _ in 0..1_000_000 {
            let (a, b) = (random.wide(-14, 14), random.wide(-14, 14));
            let (high, low) = two_sum(a, b);
            assert_eq!(high.to_bits(), (a + b).to_bits());
            assert_eq!(
                f64::from(high) + f64::from(low),
                f64::from(a) + f64::from(b),
                "{a:e} {b:e}"
            );
        }
        // Far apart, and among subnormals.
        assert_eq!(two_sum(f32::MAX / 2.0, f32::from_bits(1)), (f32::MAX / 2.0, f32::from_bits(1)));
        assert_eq!(two_sum(f32::from_bits(3), f32::from_bits(2)), (f32::from_bits(5), 0.0));
    }

    /// Double precision holds every product of two singles exactly.
    #[test]
    fn a_product_loses_nothing() {
        let mut random = Random(2);
        for round in 0..1_000_000 {
            // The whole domain: the product at least 2^-102.
            let a = random.wide(-50, 113);
            let b = if round % 2 == 0 { random.wide(-50, 12) } else { random.wide(-1, 1) };
            let (high, low) = VeltkampSplit::new(a).times(VeltkampSplit::new(b));
            assert_eq!(high.to_bits(), (a * b).to_bits());
            assert_eq!(
                f64::from(high) + f64::from(low),
                f64::from(a) * f64::from(b),
                "{a:e} {b:e}"
            );
            let a = random.wide(-50, 62);
            let (high, low) = VeltkampSplit::new(a).squared();
            assert_eq!(high.to_bits(), (a * a).to_bits());
            assert_eq!(f64::from(high) + f64::from(low), f64::from(a) * f64::from(a), "{a:e}");
        }
        let zero = VeltkampSplit::new(0.0_f32).times(VeltkampSplit::new(3.0));
        assert_eq!(zero, (0.0, 0.0));
    }
}
