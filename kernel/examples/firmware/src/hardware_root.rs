//! Lanes of one's own: one lane, whose square root is the processor's instruction.
//!
//! The kernel's own lane takes its root from the crate `libm`, by integers; both are correctly rounded, so the bits are
//! the same. Everything else is `f32`'s.

use core::ops::{Add, Div, Mul, Neg, Sub};
use spherule_kernel::Lanes;

/// One lane.
#[derive(Clone, Copy, Debug)]
pub struct HardwareRoot(f32);

// Unsafe code: an instruction that Rust has no name for without its standard library. (As inline assembly it was
// refused: the compiler does not know that this target's registers hold numbers.)
#[allow(unsafe_code)]
mod instruction {
    core::arch::global_asm!(
        ".syntax unified",
        ".fpu fpv4-sp-d16",
        ".section .text.spherule_square_root",
        ".global spherule_square_root",
        ".type spherule_square_root, %function",
        ".thumb_func",
        "spherule_square_root:",
        "vsqrt.f32 s0, s0",
        "bx lr",
    );

    unsafe extern "C" {
        safe fn spherule_square_root(number: f32) -> f32;
    }

    pub(super) fn square_root(number: f32) -> f32 {
        spherule_square_root(number)
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident),*) => {$(
        impl $operator for HardwareRoot {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl Neg for HardwareRoot {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Lanes for HardwareRoot {
    const COUNT: usize = 1;
    type Token = ();
    type Array = [f32; 1];
    type Mask = bool;
    type Double = f64;

    #[inline(always)]
    fn splat((): (), value: f32) -> Self {
        Self(value)
    }

    #[inline(always)]
    fn load((): (), array: &[f32; 1]) -> Self {
        Self(array[0])
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn narrow(array: &mut [f32; 1], _: usize, double: f64) {
        array[0] = double as f32;
    }

    #[inline(always)]
    fn token(self) {}

    #[inline(always)]
    fn store(self) -> [f32; 1] {
        [self.0]
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(instruction::square_root(self.0))
    }

    #[inline(always)]
    fn filter_mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    #[inline(always)]
    fn filter_max(self, other: Self) -> Self {
        if self.0 > other.0 { self } else { other }
    }

    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self.0 < other.0
    }

    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self.0 <= other.0
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }

    #[inline(always)]
    fn compress(self, _: bool) -> Self {
        self
    }

    #[inline(always)]
    fn widen(self, _: usize) -> f64 {
        f64::from(self.0)
    }

    #[inline(never)]
    fn out_of_line<R>((): (), work: impl FnOnce() -> R) -> R {
        work()
    }
}
