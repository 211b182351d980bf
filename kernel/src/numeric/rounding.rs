//! Rounding outward, and the sizes within which the bounds of the scene structures hold.

use crate::Lanes;

/// u = 2^-24, the unit roundoff of `f32`.
pub(crate) const U: f32 = f32::EPSILON / 2.0;
/// 2^40: spheres with a coordinate or radius above, and rays that start beyond, are tested without bounds.
pub(crate) const LARGEST: f32 = 1_099_511_627_776.0;
/// 2^100: so are rays whose squared direction is above, or below the inverse.
pub(crate) const LONGEST: f32 = LARGEST * LARGEST * 1_048_576.0;
/// 2^-60.
pub(crate) const LEAST_COMPONENT: f32 = 1.0 / (1_073_741_824.0 * 1_073_741_824.0);
/// 2^-80: what is added for underflow.
const LEAST_PAD: f32 = LEAST_COMPONENT / 1_048_576.0;

/// At most s, as [`raised`].
#[inline(always)]
pub(crate) fn lowered<L: Lanes>(s: L) -> L {
    -raised(-s)
}

/// At least s, where `s` was computed from a t with an error of up to 8 u.
#[inline(always)]
pub(crate) fn raised<L: Lanes>(s: L) -> L {
    let (more, less) =
        (s * s.like(1.0 + 8.0 * L::UNIT_ROUNDOFF), s * s.like(1.0 - 8.0 * L::UNIT_ROUNDOFF));
    more.filter_max(less) + s.like(LEAST_PAD)
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
