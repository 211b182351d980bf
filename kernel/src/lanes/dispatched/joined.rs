//! Sixteen lanes in several registers, for instruction sets whose registers are shorter.
//!
//! `fearless_simd` has vectors of sixteen lanes for every instruction set, and takes them apart for every operation
//! until each part is a register. With SSE2 that is 327 instructions for an addition, most of them copies in memory
//! that the compiler has to find needless one by one. Here registers stay apart, and the kernel compiles in 0.72 of the
//! time. Only vectors that go to memory and back are put together: part by part, by `as_chunks_mut`, they are copied
//! once more on the way (AVX2, camera rays: 0.92 of the rate).

use super::{columns, in_order};
use crate::lanes::{DoubleLanes, LaneMask, Lanes};
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
use fearless_simd::{
    ExtractToken, Select, Simd, SimdBase, SimdFloat, SimdFrom, SimdMask, f32x4, f32x8, f64x2,
    f64x4, mask32x4, mask32x8, mask64x2, mask64x4,
};

/// Vectors of `N` registers, or masks: the first lanes first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Joined<V, const N: usize>(pub(super) [V; N]);

/// Operators, register by register.
macro_rules! operators {
    ($count:literal, $registers:tt: $($operator:ident $method:ident)*) => {
        $(operators!(@one $count, $registers, $operator $method);)*
        operators!(@one $count, $registers, Neg neg, of one);
        operators!(@one $count, $registers, Not not, of one);
    };
    (@one $count:literal, [$($i:literal)*], $operator:ident $method:ident) => {
        impl<V: Copy + $operator<Output = V>> $operator for Joined<V, $count> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self([$(self.0[$i].$method(other.0[$i])),*])
            }
        }
    };
    (@one $count:literal, [$($i:literal)*], $operator:ident $method:ident, of one) => {
        impl<V: Copy + $operator<Output = V>> $operator for Joined<V, $count> {
            type Output = Self;
            #[inline(always)]
            fn $method(self) -> Self {
                Self([$(self.0[$i].$method()),*])
            }
        }
    };
}

operators!(2, [0 1]: Add add Sub sub Mul mul Div div BitAnd bitand BitOr bitor);
operators!(4, [0 1 2 3]: Add add Sub sub Mul mul Div div BitAnd bitand BitOr bitor);

/// What single and double precision share: a mask, comparisons, a square root.
macro_rules! masked {
    ($mask:ident of $lanes:literal, $count:literal [$($i:literal)*]) => {
        impl<S: Simd> LaneMask for Joined<$mask<S>, $count> {
            #[inline(always)]
            fn bits(self) -> u32 {
                0 $(| (self.0[$i].to_bitmask() as u32) << ($lanes * $i))*
            }

            #[inline(always)]
            fn any(self) -> bool {
                let any = self.0[0];
                $(let any = any | self.0[$i];)*
                any.any_true()
            }
        }
    };
    (operations $element:ident in $register:ident, $count:literal [$($i:literal)*]) => {
        #[inline(always)]
        fn token(self) -> S {
            ExtractToken::token(&self.0[0])
        }

        #[inline(always)]
        fn splat(token: S, value: $element) -> Self {
            // One by one: `[register; 4]` is a loop, until the compiler has unrolled it.
            let register = <$register<S> as SimdFrom<$element, S>>::simd_from(token, value);
            Self([$((register, $i).0),*])
        }

        #[inline(always)]
        fn sqrt(self) -> Self {
            Self([$(SimdFloat::sqrt(self.0[$i])),*])
        }

        #[inline(always)]
        fn lt(self, other: Self) -> Self::Mask {
            Joined([$(SimdBase::simd_lt(self.0[$i], other.0[$i])),*])
        }

        #[inline(always)]
        fn le(self, other: Self) -> Self::Mask {
            Joined([$(SimdBase::simd_le(self.0[$i], other.0[$i])),*])
        }

        #[inline(always)]
        fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
            Self([$(mask.0[$i].select(yes.0[$i], no.0[$i])),*])
        }

        #[inline(always)]
        fn abs(self) -> Self {
            Self([$(SimdBase::abs(self.0[$i])),*])
        }
    };
}

/// Lanes in `$count` registers of `$lanes` lanes each; what differs between two and four of them comes last.
macro_rules! joined {
    (
        $single:ident $mask:ident of $lanes:literal, $double:ident $double_mask:ident of $doubles:literal,
        $count:literal [$($i:literal)*], $($differs:item)*
    ) => {
        masked!($mask of $lanes, $count [$($i)*]);
        masked!($double_mask of $doubles, $count [$($i)*]);

        impl<S: Simd> DoubleLanes for Joined<$double<S>, $count> {
            const COUNT: usize = 8;
            type Token = S;
            type Mask = Joined<$double_mask<S>, $count>;

            masked!(operations f64 in $double, $count [$($i)*]);
        }

        impl<S: Simd> Lanes for Joined<$single<S>, $count> {
            const COUNT: usize = 16;
            type Token = S;
            type Array = [f32; 16];
            type Mask = Joined<$mask<S>, $count>;
            type Double = Joined<$double<S>, $count>;

            masked!(operations f32 in $single, $count [$($i)*]);

            #[inline(always)]
            fn columns(token: S, row: impl Fn(usize) -> [f32; 8]) -> [[f32; 16]; 8] {
                columns::of_rows(token, row)
            }

            #[inline(always)]
            fn mask(token: S, bits: u32) -> Self::Mask {
                // Bits past the last lane are not looked at.
                let part = |i: u32| u64::from(bits >> ($lanes * i) & ((1 << $lanes) - 1));
                Joined([$(SimdMask::from_bitmask(token, part($i))),*])
            }

            #[inline(always)]
            fn filter_mul_add(self, factor: Self, addend: Self) -> Self {
                Self([$(SimdFloat::mul_add(self.0[$i], factor.0[$i], addend.0[$i])),*])
            }

            #[inline(always)]
            fn filter_max(self, other: Self) -> Self {
                Self([$(SimdBase::max(self.0[$i], other.0[$i])),*])
            }

            #[inline(always)]
            fn filter_greatest(self) -> f32 {
                let greatest = self.0[0];
                $(let greatest = SimdBase::max(greatest, self.0[$i]);)*
                SimdBase::reduce_max(greatest)
            }

            #[inline(always)]
            fn bits_in_order(token: S, bits: u32, order: u64) -> u32 {
                in_order::bits(token, bits, order)
            }

            #[inline(always)]
            fn out_of_line<R>(token: S, work: impl FnOnce() -> R) -> R {
                super::vectorized_call(token, work)
            }

            $($differs)*
        }
    };
}

joined! {
    f32x8 mask32x8 of 8, f64x4 mask64x4 of 4, 2 [0 1],

    #[inline(always)]
    fn load(token: S, array: &[f32; 16]) -> Self {
        let (low, high) = token.split_f32x16(SimdBase::load_array_ref(token, array));
        Self([low, high])
    }

    #[inline(always)]
    fn store(self) -> [f32; 16] {
        Lanes::token(self).combine_f32x8(self.0[0], self.0[1]).to_array()
    }

    #[inline(always)]
    fn compress(self, mask: Self::Mask) -> Self {
        let token = Lanes::token(self);
        let all = token.combine_f32x8(self.0[0], self.0[1]);
        let mask = token.combine_mask32x8(mask.0[0], mask.0[1]);
        let (low, high) = token.split_f32x16(SimdBase::compress(all, mask));
        Self([low, high])
    }

    #[inline(always)]
    fn le_in_order(self, other: Self, _: usize, order: u64) -> u32 {
        in_order::of_halves(Lanes::token(self), self.le(other).0, order)
    }

    // Widens both parts and takes one: widening that part alone ran at 0.91 to 1.04 of the rate of coherent rays. (Doubles of one register,
    // in eight parts, ran at 0.79 to 1.00 with SSE2: fewer roots and divisions are under way at once.)
    #[inline(always)]
    fn widen(self, part: usize) -> Self::Double {
        let token = Lanes::token(self);
        let (a, b) = token.widen_f32x8(self.0[0]);
        let (c, d) = token.widen_f32x8(self.0[1]);
        Joined(if part == 0 { [a, b] } else { [c, d] })
    }

    #[inline(always)]
    fn narrow(array: &mut [f32; 16], part: usize, doubles: Self::Double) {
        let [a, b] = doubles.0;
        let singles = DoubleLanes::token(doubles).narrow_f64x4(a, b).to_array();
        // Not `copy_from_slice`, which is a call in a build without link-time optimisation.
        let (first, mut lane) = (part.wrapping_mul(8) % 16, 0);
        while lane < 8 {
            array[first + lane] = singles[lane];
            lane += 1;
        }
    }
}

joined! {
    f32x4 mask32x4 of 4, f64x2 mask64x2 of 2, 4 [0 1 2 3],

    #[inline(always)]
    fn load(token: S, array: &[f32; 16]) -> Self {
        let (low, high) = token.split_f32x16(SimdBase::load_array_ref(token, array));
        let ((a, b), (c, d)) = (token.split_f32x8(low), token.split_f32x8(high));
        Self([a, b, c, d])
    }

    #[inline(always)]
    fn store(self) -> [f32; 16] {
        let token = Lanes::token(self);
        let low = token.combine_f32x4(self.0[0], self.0[1]);
        let high = token.combine_f32x4(self.0[2], self.0[3]);
        token.combine_f32x8(low, high).to_array()
    }

    #[inline(always)]
    fn compress(self, mask: Self::Mask) -> Self {
        // SSE2 would move bytes one by one, through calls in a build without link-time
        // optimisation.
        Self::load(Lanes::token(self), &crate::lanes::compressed(self.store(), mask.bits()))
    }

    #[inline(always)]
    fn widen(self, part: usize) -> Self::Double {
        let token = Lanes::token(self);
        let (a, b) = token.widen_f32x4(self.0[0]);
        let (c, d) = token.widen_f32x4(self.0[1]);
        let (e, f) = token.widen_f32x4(self.0[2]);
        let (g, h) = token.widen_f32x4(self.0[3]);
        Joined(if part == 0 { [a, b, c, d] } else { [e, f, g, h] })
    }

    #[inline(always)]
    fn narrow(array: &mut [f32; 16], part: usize, doubles: Self::Double) {
        let [a, b, c, d] = doubles.0;
        let token = DoubleLanes::token(doubles);
        let (low, high) = (token.narrow_f64x2(a, b).to_array(), token.narrow_f64x2(c, d).to_array());
        let (first, mut lane) = (part.wrapping_mul(8) % 16, 0);
        while lane < 4 {
            array[first + lane] = low[lane];
            array[first + 4 + lane] = high[lane];
            lane += 1;
        }
    }
}
