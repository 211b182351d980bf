//! Sums and products of lanes with their rounding errors: nothing is lost.
//!
//! Built from `+ - *` alone: a fused multiply-add would be shorter, but it is not fused on every
//! target, and where it is not the error term is silently zero.

use crate::Lanes;

/// `high + low = a + b` exactly, with `high` the rounded sum (Knuth; Møller 1965).
///
/// Domain: no overflow; underflow does not harm sums.
#[inline(always)]
pub(crate) fn two_sum<L: Lanes>(a: L, b: L) -> (L, L) {
    let high = a + b;
    let b_part = high - a;
    let a_part = high - b_part;
    (high, (a - a_part) + (b - b_part))
}

/// `high + low = value`, each with at most 12 significant bits, so that products of such parts
/// are exact (Veltkamp, in Dekker 1971).
///
/// Domain: `|value|` below 2^115.
#[inline(always)]
pub(crate) fn split<L: Lanes>(value: L) -> (L, L) {
    let scaled = value * L::splat(value.token(), 4097.0);
    let high = scaled - (scaled - value);
    (high, value - high)
}

/// The rounding error of `product = fl(a * b)`, from the split factors (Dekker 1971).
///
/// Domain: the product neither overflows nor falls below 2^-102, or is zero.
#[inline(always)]
pub(crate) fn product_error<L: Lanes>(product: L, a: (L, L), b: (L, L)) -> L {
    (((a.0 * b.0 - product) + a.0 * b.1) + a.1 * b.0) + a.1 * b.1
}
