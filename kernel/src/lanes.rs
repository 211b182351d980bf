//! The lane operations that the kernel needs, and no more.
//!
//! A kernel written against [`Lanes`] runs on one lane (`f32`: the readable reference, and the
//! form for targets without SIMD) and on 4, 8 or 16 lanes of the crate `wide`, with the same
//! bits: answers come from `+ - * /` and square root, each correctly rounded on every target.
//! The operations whose result differs between targets, [`Lanes::filter_mul_add`],
//! [`Lanes::filter_max`] and [`Lanes::filter_greatest`], are named *filter*; they may decide which work is
//! skipped, under a bound that covers them, and never what is answered.
//!
//! The trait is open: other vector types can implement it. Types whose instruction set is chosen at
//! run time need proof that the CPU has it: the [`Lanes::Token`], which everything takes that makes
//! lanes from numbers. For types fixed at build time the token is `()`. Vectors never cross a
//! run-time dispatch: packets in memory hold plain arrays.

mod array;
#[cfg(feature = "std")]
pub(crate) mod dispatched;
mod scalar;
mod wide;

pub use array::LaneArray;
pub(crate) use array::WIDTH;

use core::fmt::Debug;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// One truth value a lane.
pub trait LaneMask:
    Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// Lane `i` in bit `i`; bits past the last lane are zero.
    fn bits(self) -> u32;

    /// Whether any lane is true.
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
}

/// A vector of `COUNT` single-precision numbers.
///
/// `+ - * /` and [`sqrt`](Lanes::sqrt) must be IEEE 754 round-to-nearest-even in every lane, with
/// subnormals kept, and must not be contracted. Comparisons with NaN are false.
pub trait Lanes:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// How many lanes: 1, 4, 8 or 16, and a multiple of [`DoubleLanes::COUNT`] of [`Lanes::Double`].
    const COUNT: usize;
    /// u, half a unit in the last place of 1: margins are multiples of it. Leave it as it is: lanes hold `f32`. (The
    /// tests run the kernel over shorter floats.)
    #[doc(hidden)]
    const UNIT_ROUNDOFF: f32 = f32::EPSILON / 2.0;
    /// What must be held to make lanes: `()` where the instruction set is fixed at build time.
    type Token: Copy + Debug;
    /// `[f32; COUNT]`: what packets in memory are made of.
    type Array: LaneArray;
    /// One truth value a lane.
    type Mask: LaneMask;
    /// The double-precision partner: as many lanes, or a part of them.
    type Double: DoubleLanes<Token = Self::Token>;

    /// The token that these lanes were made with.
    fn token(self) -> Self::Token;
    /// `value` in every lane.
    fn splat(token: Self::Token, value: f32) -> Self;
    /// Lane `i` from element `i`.
    fn load(token: Self::Token, array: &Self::Array) -> Self;
    /// Lane `i` from number `part * COUNT + i` of sixteen; a part past the last wraps to the first.
    #[inline(always)]
    fn load_part(token: Self::Token, numbers: &[f32; 16], part: usize) -> Self {
        Self::load(token, &Self::Array::part(numbers, part))
    }
    /// Element `i` from lane `i`.
    fn store(self) -> Self::Array;
    /// A table of eight numbers a row, transposed: number `i` of column `k` is number `k` of row `i`.
    #[inline(always)]
    fn columns(_: Self::Token, row: impl Fn(usize) -> [f32; 8]) -> [Self::Array; 8] {
        let mut columns = [Self::Array::ZEROS; 8];
        for lane in 0..Self::COUNT {
            let row = row(lane);
            for column in 0..8 {
                if let (Some(column), Some(number)) =
                    (columns.get_mut(column), row.as_slice().get(column))
                {
                    column.set(lane, *number);
                }
            }
        }
        columns
    }
    /// The correctly rounded square root; NaN below zero.
    fn sqrt(self) -> Self;
    /// `self * factor + addend` with one rounding or two, depending on the target: for filters.
    fn filter_mul_add(self, factor: Self, addend: Self) -> Self;
    /// The larger; either of the two where one is NaN or both are zero: for filters.
    fn filter_max(self, other: Self) -> Self;
    /// `self < other`.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self <= other`.
    fn le(self, other: Self) -> Self::Mask;
    /// True in the lanes whose bit is set.
    #[inline(always)]
    fn mask(token: Self::Token, bits: u32) -> Self::Mask {
        let mut marks = Self::Array::filled(0.0);
        for lane in 0..Self::COUNT {
            marks.set(lane, if bits >> lane & 1 == 1 { 1.0 } else { 0.0 });
        }
        Self::splat(token, 0.0).lt(Self::load(token, &marks))
    }
    /// `yes` where `mask` is true, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// The lanes in which `mask` is true, in their order, from the first lane on; the lanes after
    /// them are unspecified.
    fn compress(self, mask: Self::Mask) -> Self;
    /// Bit `i` from bit `order >> 4 i & 15` of sixteen.
    #[inline(always)]
    fn bits_in_order(_: Self::Token, bits: u32, order: u64) -> u32 {
        ordered(bits, order)
    }
    /// The bits of `self <= other`, the first lane at bit `first`, modulo 32, [in the order `order`](Lanes::bits_in_order).
    #[inline(always)]
    fn le_in_order(self, other: Self, first: usize, order: u64) -> u32 {
        Self::bits_in_order(self.token(), self.le(other).bits() << (first % 32), order)
    }
    /// The largest lane; any lane where one is NaN: for filters.
    #[inline(always)]
    fn filter_greatest(self) -> f32 {
        // Combines halves in lanes: number by number, this took two thirds of a packet group's time.
        let (mut greatest, mut half) = (self, Self::COUNT / 2);
        while half > 0 {
            let (lanes, mut moved) = (greatest.store(), greatest.store());
            for lane in 0..Self::COUNT {
                moved.set(lane, lanes.get(lane + half));
            }
            greatest = greatest.filter_max(Self::load(self.token(), &moved));
            half /= 2;
        }
        greatest.store().get(0)
    }
    /// Lanes `part * DoubleLanes::COUNT ..` in double precision, exactly.
    ///
    /// `part` counts from zero to [`Lanes::PARTS`]; past it, the result is any part.
    fn widen(self, part: usize) -> Self::Double;
    /// Rounds `doubles` to single precision into those elements of `array` that
    /// [`widen`](Lanes::widen) would read lanes from.
    fn narrow(array: &mut Self::Array, part: usize, doubles: Self::Double);

    /// Calls `work` in a function of its own, compiled for the instruction set of the lanes: for rare work beside a hot
    /// loop, whose registers it would take if inlined.
    fn out_of_line<R>(token: Self::Token, work: impl FnOnce() -> R) -> R;

    /// How many double-precision partners hold all lanes.
    const PARTS: usize = Self::COUNT / Self::Double::COUNT;

    /// `value` in every lane, with the token of these lanes.
    #[inline(always)]
    fn like(self, value: f32) -> Self {
        Self::splat(self.token(), value)
    }

    /// The magnitude, +0 for -0; NaN for NaN.
    #[inline(always)]
    fn abs(self) -> Self {
        let zero = self.like(0.0);
        Self::select(self.le(zero), zero - self, self)
    }
}

/// A vector of `COUNT` double-precision numbers, under the same rules as [`Lanes`].
pub trait DoubleLanes:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// How many lanes; divides [`Lanes::COUNT`] of every type that names this its partner.
    const COUNT: usize;
    /// As [`Lanes::UNIT_ROUNDOFF`], of `f64`.
    #[doc(hidden)]
    const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;
    /// What must be held to make lanes.
    type Token: Copy + Debug;
    /// One truth value a lane.
    type Mask: LaneMask;

    /// The token that these lanes were made with.
    fn token(self) -> Self::Token;
    /// `value` in every lane.
    fn splat(token: Self::Token, value: f64) -> Self;
    /// The correctly rounded square root; NaN below zero.
    fn sqrt(self) -> Self;
    /// `self < other`.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self <= other`.
    fn le(self, other: Self) -> Self::Mask;
    /// `yes` where `mask` is true, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// `value` in every lane, with the token of these lanes.
    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self::splat(self.token(), value)
    }

    /// The magnitude, +0 for -0; NaN for NaN.
    #[inline(always)]
    fn abs(self) -> Self {
        let zero = self.like(0.0);
        Self::select(self.le(zero), zero - self, self)
    }
}

/// The numbers whose bits are set, in their order, from the first on: [`Lanes::compress`] where no instruction does it.
#[inline(always)]
fn compressed<const N: usize>(numbers: [f32; N], mut bits: u32) -> [f32; N] {
    let (mut kept, mut to) = (numbers, 0);
    while bits != 0 {
        kept[to % N] = numbers[bits.trailing_zeros() as usize % N];
        to += 1;
        bits &= bits - 1;
    }
    kept
}

/// [`Lanes::bits_in_order`] where no instruction does it.
#[inline(always)]
fn ordered(bits: u32, order: u64) -> u32 {
    let mut ordered = 0;
    for place in 0..16 {
        ordered |= (bits >> (order >> (4 * place) & 15) & 1) << place;
    }
    ordered
}

/// A call that is not inlined: [`Lanes::out_of_line`] where the instruction set is fixed.
#[inline(never)]
fn plain_call<R>(work: impl FnOnce() -> R) -> R {
    work()
}
