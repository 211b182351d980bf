//! Vectors of three lanes, as arrays by axis.
//!
//! Closures are not used: a closure that is not inlined runs without the instruction set that its
//! surroundings were dispatched to (measured: right, but up to 40 times slower), and only a nested
//! function or a macro is sure to be inlined.

use crate::lanes::{DoubleLanes, Lanes};
use core::ops::{Add, Mul, Sub};

/// `[value of axis 0, of axis 1, of axis 2]`, written out three times.
macro_rules! axes {
    ($axis:ident => $value:expr) => {
        [
            {
                let $axis = 0;
                $value
            },
            {
                let $axis = 1;
                $value
            },
            {
                let $axis = 2;
                $value
            },
        ]
    };
}

pub(crate) use axes;

/// u.v, summed in the order of the axes.
#[inline(always)]
pub(crate) fn dot<T: Copy + Add<Output = T> + Mul<Output = T>>(u: [T; 3], v: [T; 3]) -> T {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

/// u x v.
#[inline(always)]
pub(crate) fn cross<T: Copy + Sub<Output = T> + Mul<Output = T>>(u: [T; 3], v: [T; 3]) -> [T; 3] {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// The largest magnitude of a coordinate; any of the three where one is NaN.
#[inline(always)]
pub(crate) fn largest<L: Lanes>(v: [L; 3]) -> L {
    v[0].abs().filter_max(v[1].abs()).filter_max(v[2].abs())
}

/// |v|_1, summed in the order of the axes.
#[inline(always)]
pub(crate) fn sum_of_magnitudes<D: DoubleLanes>(v: [D; 3]) -> D {
    v[0].abs() + v[1].abs() + v[2].abs()
}
