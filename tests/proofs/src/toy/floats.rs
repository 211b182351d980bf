//! Toy floats: floats of a few bits, so that the kernel's own code runs over all of them.
//!
//! Every operation is done in `f64` and rounded to nearest, ties to even. Two roundings in a row are as good as the
//! second alone if the first is to twice the bits of the second and two more (Figueroa 1995): that holds for `+ - *
//! /` and the root, for all formats of at most 25 bits. A quotient among subnormals has fewer bits, and is no nearer
//! to a tie. A fused multiply-add is computed by one rounding where `f64` holds the sum, which it does for a dozen
//! bits.
//!
//! Numbers of the kernel's source that follow from u do so here, by `Lanes::UNIT_ROUNDOFF`. Other numbers (2^40, and
//! what is added for underflow) are the same as in `f32`.

use crate::proofs::one_lane::one_lane;
use crate::{DoubleLanes, Lanes};
use core::fmt::Debug;
use core::marker::PhantomData;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A format of toy floats.
pub(crate) trait Format: Copy + Debug + 'static {
    /// Significant bits.
    const BITS: u32;
    /// The exponents of the least and of the greatest normal number; without them all that `f64` has.
    const EXPONENTS: Option<[i32; 2]> = None;
    /// Whether a multiply-add of the filters is fused.
    const FUSED: bool = false;
    /// What margins are multiplied by: less than 1 in controls.
    const MARGIN: f64 = 1.0;
    /// The format of the double-precision partner.
    type Double: Format;

    /// u.
    const U: f64 = 1.0 / (1_u64 << Self::BITS) as f64;

    /// The nearest number of the format, ties to even.
    #[inline(always)]
    fn round(x: f64) -> f64 {
        let dropped = 53 - Self::BITS;
        let bits = x.to_bits();
        let up = ((1_u64 << (dropped - 1)) - 1) + (bits >> dropped & 1);
        let rounded = f64::from_bits(bits.wrapping_add(up) & !((1 << dropped) - 1));
        let Some([least, greatest]) = Self::EXPONENTS else { return rounded };
        if rounded.abs() >= power_of_two(greatest + 1) {
            return f64::INFINITY.copysign(x);
        }
        if x.abs() < power_of_two(least) {
            // Added to this, a number loses what is below the least subnormal.
            let coarse = 1.5 * power_of_two(least + 1 - Self::BITS as i32 + 52);
            return (x + coarse) - coarse;
        }
        rounded
    }
}

pub(crate) const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// One lane of a format.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Toy<F> {
    value: f64,
    format: PhantomData<F>,
}

impl<F: Format> Toy<F> {
    /// The nearest number of the format.
    #[inline(always)]
    pub(crate) fn new(x: f64) -> Self {
        Self { value: F::round(x), format: PhantomData }
    }

    #[inline(always)]
    pub(crate) fn get(self) -> f64 {
        self.value
    }

    #[inline(always)]
    fn root(self) -> Self {
        Self::new(libm::sqrt(self.value))
    }

    /// The number itself, which the format must have.
    #[inline(always)]
    fn constant(x: f64) -> Self {
        let lane = Self::new(x);
        assert!(
            lane.value == x || F::MARGIN < 1.0 || x == f64::from(f32::MAX) || x.is_nan(),
            "{x:e} is too long"
        );
        lane
    }
}

macro_rules! operations {
    ($($operation:ident $name:ident $sign:tt),*) => {$(
        impl<F: Format> $operation for Toy<F> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self::new(self.value $sign other.value)
            }
        }
    )*};
}

operations!(Add add +, Sub sub -, Mul mul *, Div div /);

impl<F: Format> Neg for Toy<F> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl<F: Format> Lanes for Toy<F> {
    one_lane!(Lanes, get);
    const UNIT_ROUNDOFF: f32 = (F::U * F::MARGIN) as f32;
    type Double = Toy<F::Double>;

    #[inline(always)]
    fn splat((): (), value: f32) -> Self {
        Self::constant(f64::from(value))
    }

    #[inline(always)]
    fn store(self) -> [f32; 1] {
        [self.value as f32]
    }

    #[inline(always)]
    fn filter_mul_add(self, factor: Self, addend: Self) -> Self {
        if F::FUSED {
            Self::new(self.value * factor.value + addend.value)
        } else {
            self * factor + addend
        }
    }

    #[inline(always)]
    fn filter_max(self, other: Self) -> Self {
        if self.value > other.value { self } else { other }
    }

    #[inline(always)]
    fn widen(self, _: usize) -> Toy<F::Double> {
        Toy::constant(self.value)
    }

    #[inline(always)]
    fn narrow(array: &mut [f32; 1], _: usize, double: Toy<F::Double>) {
        array[0] = Self::new(double.value).value as f32;
    }
}

impl<F: Format> DoubleLanes for Toy<F> {
    one_lane!(DoubleLanes, get);
    const UNIT_ROUNDOFF: f64 = F::U * F::MARGIN;

    #[inline(always)]
    fn splat((): (), value: f64) -> Self {
        Self::constant(value)
    }
}
