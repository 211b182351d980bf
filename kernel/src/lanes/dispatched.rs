//! Sixteen lanes of the crate `fearless_simd`, whose instruction set is chosen at run time: in one register here, in
//! several in [`joined`].
//!
//! The token is the crate's own: a value of it is the proof that the CPU has the instructions, so that all this needs
//! no `unsafe` here. Code that computes with such lanes must be inlined into a function that was compiled for the
//! instruction set (`vectorize`); a function or closure that is not inlined stays right, but is many times slower.
//! Hence `#[inline(always)]` on all of it, and [`Lanes::out_of_line`] where a call is wanted.

mod columns;
mod in_order;
pub(crate) mod joined;

use super::{DoubleLanes, LaneMask, Lanes};
use core::fmt::Debug;
use core::ops::{BitAnd, BitOr, Not};
use fearless_simd::{
    Select, Simd, SimdBase, SimdFloat, SimdMask, SimdNarrow, SimdWiden, f32x16, f64x8, mask32x16,
    mask64x8,
};

/// A mask of `fearless_simd`.
#[derive(Clone, Copy, Debug)]
pub struct DispatchedMask<M>(M);

impl<M: BitAnd<Output = M>> BitAnd for DispatchedMask<M> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl<M: BitOr<Output = M>> BitOr for DispatchedMask<M> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl<M: Not<Output = M>> Not for DispatchedMask<M> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

#[inline(never)]
fn vectorized_call<S: Simd, R>(simd: S, work: impl FnOnce() -> R) -> R {
    simd.vectorize(work)
}

/// What single and double precision share.
macro_rules! shared_lane_operations {
    ($element:ident) => {
        #[inline(always)]
        fn token(self) -> S {
            fearless_simd::ExtractToken::token(&self)
        }

        #[inline(always)]
        fn splat(token: S, value: $element) -> Self {
            <Self as fearless_simd::SimdFrom<$element, S>>::simd_from(token, value)
        }

        #[inline(always)]
        fn sqrt(self) -> Self {
            SimdFloat::sqrt(self)
        }

        #[inline(always)]
        fn lt(self, other: Self) -> Self::Mask {
            DispatchedMask(SimdBase::simd_lt(self, other))
        }

        #[inline(always)]
        fn le(self, other: Self) -> Self::Mask {
            DispatchedMask(SimdBase::simd_le(self, other))
        }

        #[inline(always)]
        fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
            mask.0.select(yes, no)
        }

        #[inline(always)]
        fn abs(self) -> Self {
            SimdBase::abs(self)
        }
    };
}

macro_rules! dispatched_mask {
    ($mask:ident) => {
        impl<S: Simd> LaneMask for DispatchedMask<$mask<S>> {
            #[inline(always)]
            fn bits(self) -> u32 {
                self.0.to_bitmask() as u32
            }

            #[inline(always)]
            fn any(self) -> bool {
                self.0.any_true()
            }
        }
    };
}

dispatched_mask!(mask32x16);

impl<S: Simd> Lanes for f32x16<S> {
    const COUNT: usize = 16;
    type Token = S;
    type Array = [f32; 16];
    type Mask = DispatchedMask<mask32x16<S>>;
    type Double = f64x8<S>;

    shared_lane_operations!(f32);

    #[inline(always)]
    fn load(token: S, array: &[f32; 16]) -> Self {
        SimdBase::load_array_ref(token, array)
    }

    #[inline(always)]
    fn store(self) -> [f32; 16] {
        self.to_array()
    }

    #[inline(always)]
    fn columns(token: S, row: impl Fn(usize) -> [f32; 8]) -> [[f32; 16]; 8] {
        columns::of_rows(token, row)
    }

    #[inline(always)]
    fn mask(token: S, bits: u32) -> Self::Mask {
        // Bits past the last lane are not looked at.
        DispatchedMask(SimdMask::from_bitmask(token, u64::from(bits) & 0xffff))
    }

    #[inline(always)]
    fn filter_mul_add(self, factor: Self, addend: Self) -> Self {
        SimdFloat::mul_add(self, factor, addend)
    }

    #[inline(always)]
    fn filter_max(self, other: Self) -> Self {
        SimdBase::max(self, other)
    }

    #[inline(always)]
    fn compress(self, mask: Self::Mask) -> Self {
        SimdBase::compress(self, mask.0)
    }

    #[inline(always)]
    fn bits_in_order(token: S, bits: u32, order: u64) -> u32 {
        in_order::bits(token, bits, order)
    }

    #[inline(always)]
    fn le_in_order(self, other: Self, _: usize, order: u64) -> u32 {
        in_order::le(Lanes::token(self), self, other, order)
    }

    #[inline(always)]
    fn filter_greatest(self) -> f32 {
        SimdBase::reduce_max(self)
    }

    #[inline(always)]
    fn widen(self, part: usize) -> f64x8<S> {
        let (low, high) = SimdWiden::widen(self);
        if part == 0 { low } else { high }
    }

    #[inline(always)]
    fn narrow(array: &mut [f32; 16], part: usize, doubles: f64x8<S>) {
        let singles = SimdNarrow::narrow(doubles, doubles).to_array();
        // Not `copy_from_slice`, which is a call in a build without link-time optimisation.
        let first = part.wrapping_mul(8) % 16;
        let mut lane = 0;
        while lane < 8 {
            array[first + lane] = singles[lane];
            lane += 1;
        }
    }

    #[inline(always)]
    fn out_of_line<R>(token: S, work: impl FnOnce() -> R) -> R {
        vectorized_call(token, work)
    }
}

dispatched_mask!(mask64x8);

impl<S: Simd> DoubleLanes for f64x8<S> {
    const COUNT: usize = 8;
    type Token = S;
    type Mask = DispatchedMask<mask64x8<S>>;

    shared_lane_operations!(f64);
}
