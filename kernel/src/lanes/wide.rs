//! 4, 8 and 16 lanes of the crate `wide`, whose instruction set is fixed at build time.
//!
//! `wide` keeps a mask as a vector of the same type with all bits of a lane set or clear; here it
//! gets a type of its own, so that a mask cannot be added by mistake.

use super::{DoubleLanes, LaneMask, Lanes};
use core::ops::{BitAnd, BitOr, Not};
use wide::{f32x4, f32x8, f32x16, f64x4, f64x8};

/// A mask kept as `wide` keeps it: every bit of a lane set, or none.
#[derive(Clone, Copy, Debug)]
pub struct WideMask<V>(V);

impl<V: BitAnd<Output = V>> BitAnd for WideMask<V> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl<V: BitOr<Output = V>> BitOr for WideMask<V> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl<V: Not<Output = V>> Not for WideMask<V> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

/// What single and double precision share: the operations of a [`WideMask`] and of comparison.
macro_rules! shared_lane_operations {
    ($vector:ident, $element:ident) => {
        #[inline(always)]
        fn token(self) {}

        #[inline(always)]
        fn splat((): (), value: $element) -> Self {
            $vector::splat(value)
        }

        #[inline(always)]
        fn sqrt(self) -> Self {
            $vector::sqrt(self)
        }

        #[inline(always)]
        fn lt(self, other: Self) -> Self::Mask {
            WideMask(self.simd_lt(other))
        }

        #[inline(always)]
        fn le(self, other: Self) -> Self::Mask {
            WideMask(self.simd_le(other))
        }

        #[inline(always)]
        fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
            mask.0.select(yes, no)
        }

        #[inline(always)]
        fn abs(self) -> Self {
            $vector::abs(self)
        }
    };
}

macro_rules! wide_mask {
    ($vector:ident) => {
        impl LaneMask for WideMask<$vector> {
            #[inline(always)]
            fn bits(self) -> u32 {
                self.0.to_bitmask()
            }

            #[inline(always)]
            fn any(self) -> bool {
                self.0.any()
            }
        }
    };
}

macro_rules! wide_lanes {
    ($vector:ident, $count:literal, $double:ident) => {
        wide_mask!($vector);

        impl Lanes for $vector {
            const COUNT: usize = $count;
            type Token = ();
            type Array = [f32; $count];
            type Mask = WideMask<$vector>;
            type Double = $double;

            shared_lane_operations!($vector, f32);

            #[inline(always)]
            fn load((): (), array: &[f32; $count]) -> Self {
                $vector::new(*array)
            }

            #[inline(always)]
            fn store(self) -> [f32; $count] {
                self.to_array()
            }

            #[inline(always)]
            fn out_of_line<R>((): (), work: impl FnOnce() -> R) -> R {
                super::plain_call(work)
            }

            #[inline(always)]
            fn compress(self, mask: Self::Mask) -> Self {
                $vector::new(super::compressed(self.to_array(), mask.bits()))
            }

            #[inline(always)]
            fn widen(self, part: usize) -> $double {
                const WIDTH: usize = <$double as DoubleLanes>::COUNT;
                let (singles, first) = (self.to_array(), part.wrapping_mul(WIDTH) % $count);
                let mut doubles = [0.0; WIDTH];
                for lane in 0..WIDTH {
                    doubles[lane] = f64::from(singles[first + lane]);
                }
                $double::new(doubles)
            }

            #[inline(always)]
            fn narrow(array: &mut [f32; $count], part: usize, doubles: $double) {
                const WIDTH: usize = <$double as DoubleLanes>::COUNT;
                let (doubles, first) = (doubles.to_array(), part.wrapping_mul(WIDTH) % $count);
                for lane in 0..WIDTH {
                    array[first + lane] = doubles[lane] as f32;
                }
            }

            #[inline(always)]
            fn filter_mul_add(self, factor: Self, addend: Self) -> Self {
                self.mul_add(factor, addend)
            }

            #[inline(always)]
            fn filter_max(self, other: Self) -> Self {
                self.fast_max(other)
            }
        }
    };
}

macro_rules! wide_double_lanes {
    ($vector:ident, $count:literal) => {
        wide_mask!($vector);

        impl DoubleLanes for $vector {
            const COUNT: usize = $count;
            type Token = ();
            type Mask = WideMask<$vector>;

            shared_lane_operations!($vector, f64);
        }
    };
}

wide_lanes!(f32x4, 4, f64x4);
wide_lanes!(f32x8, 8, f64x8);
wide_lanes!(f32x16, 16, f64x8);
wide_double_lanes!(f64x4, 4);
wide_double_lanes!(f64x8, 8);
