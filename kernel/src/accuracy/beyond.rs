//! Spheres that lie past a limit, told in single precision: where many are met one behind the
//! other, that saves most of what a tier costs.
//!
//! Both roots are at least (b - sqrt D) / a, so both are past the limit where b - sqrt D > limit a,
//! with D = a r^2 - |d x p|^2 raised by the most that it can be off. (With r |d| in place of sqrt D,
//! a third of the operations, `Exact` was 3.3 times `Fast` where incoherent rays meet 64 large
//! spheres, one through the other.) The test has a margin of 2^-20 of its terms, which also covers the 2^-22 (|p| + r) / |d| that the t
//! of `Stable` is off where its squares do not underflow; where |p| + r might be so small, nothing
//! is told. The t of `Fast` may be off by anything, so `Fast` does not use it.

use super::roots::RayLanes;
use crate::numeric::axes::{axes, dot};
use crate::{LaneMask, Lanes};

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
    /// The margin is proven in `docs/numerics.md`. What overflows is not told.
    #[inline(always)]
    pub(super) fn limit(&self, rays: &RayLanes<L>, center: [L; 3], radius: L, limit: L) -> L::Mask {
        let bounded = limit.lt(limit.like(f32::INFINITY));
        if !bounded.any() {
            return bounded;
        }
        let [end, size, b, discriminant] = self.terms(rays, center, radius, limit);
        let raise = end.like(RAISE) * (size * size) + end.like(LEAST_A);
        let entry = b - (discriminant.filter_max(end.like(0.0)) + raise).sqrt();
        let margin = end.like(MARGIN) * (size + end.abs()) + end.like(LEAST_A);
        (end.like(LEAST_SIZE) * self.length).le(size) & (end + margin).lt(entry)
    }

    /// limit a; size; b; D.
    #[inline(always)]
    fn terms(&self, rays: &RayLanes<L>, center: [L; 3], radius: L, limit: L) -> [L; 4] {
        let d = rays.direction;
        let p = axes!(i => center[i] - rays.origin[i]);
        // Among subnormals the next t may be twice the last, more than any margin: past the limit
        // by one of them is not past it yet.
        let end = (limit + limit.like(f32::MIN_POSITIVE)) * self.a;
        let size = (p[0].abs() + p[1].abs() + p[2].abs() + radius) * self.length;

        let x = [d[1] * p[2] - d[2] * p[1], d[2] * p[0] - d[0] * p[2], d[0] * p[1] - d[1] * p[0]];
        [end, size, dot(d, p), self.a * (radius * radius) - dot(x, x)]
    }
}

/// 64v.
const RAISE: f32 = 32.0 * f32::EPSILON;
/// 2^-20.
const MARGIN: f32 = 8.0 * f32::EPSILON;
/// 2^-38: below it, the squares of |p| and r might underflow in `Stable`.
const LEAST_SIZE: f32 = 1.0 / (1u64 << 38) as f32;

/// 2^-120.
const LEAST_A: f32 = 1.0 / (1u128 << 120) as f32;

#[cfg(test)]
mod derived;
#[cfg(test)]
mod worst;
