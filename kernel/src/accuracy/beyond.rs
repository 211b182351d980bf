//! Spheres that lie past a limit, told in single precision: where many are met one behind the
//! other, that saves most of what a tier costs.
//!
//! Both roots are at least b/a - r/|d|, so both are past the limit where b - r |d| > limit a. The
//! test has a margin of 2^-20 of its terms, which also covers the 2^-22 (|p| + r) / |d| that the t
//! of `Stable` is off where its squares do not underflow; where |p| + r might be so small, nothing
//! is told. The t of `Fast` may be off by anything, so `Fast` does not use it.

use super::RayLanes;
use crate::Lanes;
use crate::axes::{axes, dot};

/// What tells whether both roots of a sphere lie past a limit.
#[derive(Clone, Copy, Debug)]
pub struct Beyond<L> {
    /// d.d; NaN, which no comparison passes, where it might have underflowed.
    a: L,
    /// |d|, rounded up.
    length: L,
}

impl<L: Lanes> Beyond<L> {
    #[inline(always)]
    pub(super) fn new(rays: &RayLanes<L>) -> Self {
        let d = rays.direction;
        let a = dot(d, d);
        let a = L::select(a.like(LEAST_A).le(a), a, a.like(f32::NAN));
        Self { a, length: a.sqrt() * a.like(1.0 + 8.0 * f32::EPSILON) }
    }

    /// Where both roots are surely larger than `limit`.
    ///
    /// b is within 4v |d| |p|, v = 2^-24, the product limit a within 4v of itself, r |d| and the
    /// differences within 2v; together below 8v of the sum of the three magnitudes, to which 2^-120
    /// is added for what underflows. What overflows makes the bound infinite or NaN: not told.
    #[inline(always)]
    pub(super) fn limit(&self, rays: &RayLanes<L>, center: [L; 3], radius: L, limit: L) -> L::Mask {
        let [end, size, entry] = self.terms(rays, center, radius, limit);
        let margin = end.like(MARGIN) * (size + end.abs()) + end.like(LEAST_A);
        (end.like(LEAST_SIZE) * self.length).le(size) & (end + margin).lt(entry)
    }

    /// limit a; |p|_1 |d| + r |d|; b - r |d|.
    #[inline(always)]
    fn terms(&self, rays: &RayLanes<L>, center: [L; 3], radius: L, limit: L) -> [L; 3] {
        let p = axes!(i => center[i] - rays.origin[i]);
        let b = dot(rays.direction, p);
        // Among subnormals the next t may be twice the last, more than any margin: past the limit
        // by one of them is not past it yet.
        let end = (limit + b.like(f32::MIN_POSITIVE)) * self.a;
        let reach = radius * self.length;
        let size = (p[0].abs() + p[1].abs() + p[2].abs()) * self.length + reach;
        [end, size, b - reach]
    }
}

/// 2^-20.
const MARGIN: f32 = 8.0 * f32::EPSILON;
/// 2^-38: below it, the squares of |p| and r might underflow in `Stable`.
const LEAST_SIZE: f32 = 1.0 / (1u64 << 38) as f32;

/// 2^-120.
const LEAST_A: f32 = 1.0 / (1u128 << 120) as f32;

#[cfg(test)]
mod worst;
