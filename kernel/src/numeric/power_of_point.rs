//! The power of a point with respect to a sphere: below zero inside, above it outside.

use super::error_free::two_sum;
use super::rounding::DOUBLE_U as U;
use crate::lanes::DoubleLanes;

/// |x - c|^2 - r^2 of numbers of single precision, and a bound on its error besides u of itself.
///
/// All ten products are exact, and their sum is compensated: off by u of itself and 81 u^2 of their magnitudes
/// (Ogita, Rump, Oishi 2005, Accurate Sum and Dot Product, Sum2). Plain double precision does not tell the points of
/// a ground of radius 10^6 from each other.
#[inline(always)]
pub(crate) fn power_of<D: DoubleLanes>(x: [D; 3], c: [D; 3], radius: D) -> (D, D) {
    let square = radius * radius;
    let (mut sum, mut error, mut size) = (-square, radius.like(0.0), square);
    for i in 0..3 {
        for term in [x[i] * x[i], c[i] * c[i], -((x[i] + x[i]) * c[i])] {
            let (high, low) = two_sum(sum, term);
            (sum, error, size) = (high, error + low, size + term.abs());
        }
    }
    (sum + error, radius.like(256.0 * U * U) * size)
}
