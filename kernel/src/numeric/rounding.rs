//! Rounding outward, and the sizes within which the bounds of the scene structures hold.

use crate::Lanes;

/// u = 2^-24, the unit roundoff of `f32`.
pub(crate) const U: f32 = f32::EPSILON / 2.0;
/// u = 2^-53, the unit roundoff of `f64`.
pub(crate) const DOUBLE_U: f64 = f64::EPSILON / 2.0;
/// 2^56, in the units in which bounds see a scene: rays that start beyond it are tested without bounds.
pub(crate) const LARGEST: f32 = 72_057_594_037_927_936.0;
/// 2^100: a squared direction above this, or below its inverse, is not used; the direction is scaled before.
pub(crate) const LONGEST: f32 = LARGEST * 17_592_186_044_416.0;
/// 2^-60: a direction whose square is below this is scaled before.
pub(crate) const SHORTEST: f32 = 1.0 / (1_u64 << 60) as f32;
/// 2^-60: no component of a unit direction counts as smaller where it divides; elsewhere it covers what underflows.
pub(crate) const LEAST_COMPONENT: f32 = 1.0 / (1_073_741_824.0 * 1_073_741_824.0);

/// At most the true s, as [`raised`].
#[inline(always)]
pub(crate) fn lowered<L: Lanes>(s: L, error: L) -> L {
    -raised(-s, error)
}

/// At least the true s: `s` was computed from a t with an error of up to 8 u of itself, and of
/// `error` besides.
#[inline(always)]
pub(crate) fn raised<L: Lanes>(s: L, error: L) -> L {
    let (more, less) =
        (s * s.like(1.0 + 8.0 * L::UNIT_ROUNDOFF), s * s.like(1.0 - 8.0 * L::UNIT_ROUNDOFF));
    more.filter_max(less) + error
}

/// The smaller of two numbers; the second if either is NaN.
#[inline(always)]
pub(crate) fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The larger of two numbers; the second if either is NaN.
#[inline(always)]
pub(crate) fn most(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
