//! Spheres that lie past a limit, told in single precision: where many are met one behind the
//! other, that saves most of what a tier costs.
//!
//! Both roots are at least (b - sqrt D) / a, so both are past the limit where b - sqrt D > limit a, with D = a r^2 -
//! |d x p|^2 raised by the most that it can be off. (With r |d| in place of sqrt D, a third of the operations,
//! `Exact` was 3.3 times `Fast` where incoherent rays meet 64 large spheres, one through the other.) The test has a
//! margin of 2^-20 of its terms, which also covers the 2^-22 (|p| + r) / |d| that the t of `Stable` is off where its
//! squares do not underflow; where |p| + r might be so small, nothing is told. The t of `Fast` and `Geometric` may be
//! off by anything, so they do not use it.
//!
//! Directions have any length; lengths as small as 2^-38, or so large that squares overflow, are not told of.
//! (Divided by |p| + r they would be: a list of 100 spheres lost 5 % by it.)

use super::roots::RayLanes;
use crate::numeric::axes::{axes, dot};
use crate::numeric::power_of_two::inverse_powers_of_two;
use crate::{LaneMask, Lanes};

/// What tells whether both roots of a sphere lie past a limit.
#[derive(Clone, Copy, Debug)]
pub struct RangeLimits<L> {
    /// d; scaled where its square might over- or underflow.
    direction: [L; 3],
    /// d.d.
    pub(crate) a: L,
    /// d.d times how many multiples of d a t of 1 is; NaN, which no comparison passes, where d is subnormal.
    pub(crate) per_limit: L,
    /// |d|, rounded up.
    length: L,
}

impl<L: Lanes> RangeLimits<L> {
    #[inline(always)]
    pub(crate) fn new(rays: &RayLanes<L>) -> Self {
        let (mut direction, mut a) = (rays.direction, dot(rays.direction, rays.direction));
        let mut per_limit = a;
        let usual = a.like(SHORTEST).le(a) & a.le(a.like(1.0 / SHORTEST));
        if (rays.live & !usual).any() {
            let scale = inverse_powers_of_two(longest(direction));
            direction = axes!(i => direction[i] * scale);
            a = dot(direction, direction);
            per_limit = Self::per_limit(a, scale);
        }
        Self { direction, a, per_limit, length: a.sqrt() * a.like(1.0 + 8.0 * f32::EPSILON) }
    }

    /// For a direction, and its square, that were scaled by a power of two.
    #[inline(always)]
    pub(crate) fn of_scaled(direction: [L; 3], a: L, scale: L) -> Self {
        let length = a.sqrt() * a.like(1.0 + 8.0 * f32::EPSILON);
        Self { direction, a, per_limit: Self::per_limit(a, scale), length }
    }

    #[inline(always)]
    fn per_limit(a: L, scale: L) -> L {
        // A power that brings subnormal numbers to some 1 is larger.
        let normal = scale.lt(a.like(2.0 / f32::MIN_POSITIVE));
        L::select(normal, a / scale, a.like(f32::NAN))
    }

    /// Where both roots are surely larger than `limit`; in one lane, which has no filter, also where there are none.
    ///
    /// The margin is proven in `docs/numerics.md`. What overflows is not told.
    #[inline(always)]
    pub(crate) fn limit(&self, rays: &RayLanes<L>, center: [L; 3], radius: L, limit: L) -> L::Mask {
        let bounded = limit.lt(limit.like(f32::INFINITY));
        if L::COUNT > 1 && !bounded.any() {
            return bounded;
        }
        // Where nothing will be told, squares would be subnormal: twice the time of a list on some CPUs.
        let (p, size) = self.size(rays, center, radius);
        let known = (size.like(LEAST_SIZE) * self.length).le(size);
        let told = if L::COUNT > 1 { bounded & known } else { known };
        if !told.any() {
            return told;
        }
        let [end, b, discriminant] = self.terms(p, radius, limit);
        let raise = end.like(RAISE) * (size * size) + end.like(LEAST_A);
        if L::COUNT == 1 {
            // The limit's NaN also tells of a direction that is subnormal.
            let misses = told & self.per_limit.le(self.per_limit);
            let misses = misses & (discriminant + raise).lt(end.like(0.0));
            if misses.any() {
                return misses;
            }
        }
        let entry = b - (discriminant.filter_max(end.like(0.0)) + raise).sqrt();
        let margin = end.like(MARGIN) * (size + end.abs()) + end.like(LEAST_A);
        told & (end + margin).lt(entry)
    }

    /// p, and |d| (|p| + r).
    #[inline(always)]
    pub(crate) fn size(&self, rays: &RayLanes<L>, center: [L; 3], radius: L) -> ([L; 3], L) {
        let p = axes!(i => center[i] - rays.origin[i]);
        (p, (p[0].abs() + p[1].abs() + p[2].abs() + radius) * self.length)
    }

    /// limit a; b; D.
    #[inline(always)]
    pub(crate) fn terms(&self, p: [L; 3], radius: L, limit: L) -> [L; 3] {
        let d = self.direction;
        // Among subnormals the next t may be twice the last, more than any margin: past the limit
        // by one of them is not past it yet.
        let end = (limit + limit.like(f32::MIN_POSITIVE)) * self.per_limit;
        let x = [d[1] * p[2] - d[2] * p[1], d[2] * p[0] - d[0] * p[2], d[0] * p[1] - d[1] * p[0]];
        [end, dot(d, p), self.a * (radius * radius) - dot(x, x)]
    }
}

/// The largest component.
#[inline(always)]
pub(super) fn longest<L: Lanes>(d: [L; 3]) -> L {
    d[0].abs().filter_max(d[1].abs()).filter_max(d[2].abs())
}

/// 64v.
pub(crate) const RAISE: f32 = 32.0 * f32::EPSILON;
/// 2^-20.
pub(crate) const MARGIN: f32 = 8.0 * f32::EPSILON;
/// 2^-38: below it, the squares of |p| and r might underflow in `Stable`.
const LEAST_SIZE: f32 = 1.0 / (1u64 << 38) as f32;

/// 2^-60: a squared direction below, or above the inverse, is not used.
const SHORTEST: f32 = 1.0 / (1_u64 << 60) as f32;
/// 2^-120.
pub(crate) const LEAST_A: f32 = 1.0 / (1u128 << 120) as f32;
