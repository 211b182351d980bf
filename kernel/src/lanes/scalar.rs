//! One lane: `f32`, with `f64` as its partner. The reference that every width equals.

use super::{DoubleLanes, LaneMask, Lanes};

impl LaneMask for bool {
    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self)
    }
}

impl Lanes for f32 {
    const COUNT: usize = 1;
    type Token = ();
    type Array = [f32; 1];
    type Mask = bool;
    type Double = f64;

    #[inline(always)]
    fn token(self) {}

    #[inline(always)]
    fn splat((): (), value: f32) -> Self {
        value
    }

    #[inline(always)]
    fn load((): (), array: &[f32; 1]) -> Self {
        array[0]
    }

    #[inline(always)]
    fn store(self) -> [f32; 1] {
        [self]
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        libm::sqrtf(self)
    }

    #[inline(always)]
    fn filter_mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    #[inline(always)]
    fn filter_max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self <= other
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    /// By the sign bit: comparing and subtracting are calls where there is no floating-point unit.
    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }

    #[inline(always)]
    fn out_of_line<R>((): (), work: impl FnOnce() -> R) -> R {
        super::plain_call(work)
    }

    #[inline(always)]
    fn compress(self, _: bool) -> Self {
        self
    }

    #[inline(always)]
    fn widen(self, _: usize) -> f64 {
        f64::from(self)
    }

    #[inline(always)]
    fn narrow(array: &mut [f32; 1], _: usize, double: f64) {
        array[0] = double as Self;
    }
}

impl DoubleLanes for f64 {
    const COUNT: usize = 1;
    type Token = ();
    type Mask = bool;

    #[inline(always)]
    fn token(self) {}

    #[inline(always)]
    fn splat((): (), value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }

    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self <= other
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}
