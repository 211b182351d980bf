//! Tells in single precision which spheres lie past a limit. Where a ray meets many spheres one behind the other, that
//! saves most of what a tier costs.
//!
//! Both roots are at least (b - sqrt D) / a, so both are past the limit where b - sqrt D > limit a, with D = a
//! r^2 - |d x p|^2 raised by the most that it can be off. (r |d| instead of sqrt D takes a third of the operations, but
//! `Exact` took 3.3 times as long as `Fast` where incoherent rays meet 64 large spheres that overlap.) The test has a
//! margin of 2^-20 of its terms. Margin and raise also cover the error of the t of `Stable`, (24u r + 4u |p|) / |d| where
//! its squares do not underflow; where |p| + r is so small that they might, nothing is told. The t of `Fast` and
//! `Geometric` may be off by anything, so these tiers do not use the test.
//!
//! Directions may have any length. Where |p| + r is as small as 2^-38, or so large that squares overflow, nothing is
//! told. (Dividing by |p| + r would cover such lengths: a list of 100 spheres lost 5 % by it.)

use super::roots::RayLanes;
use crate::numeric::axes::{axes, cross, dot, largest};
use crate::numeric::power_of_two::inverse_powers_of_two;
use crate::numeric::rounding::SHORTEST;
use crate::{LaneMask, Lanes};

/// Tells whether both roots of a sphere lie past a limit.
#[derive(Clone, Copy, Debug)]
pub struct RangeLimits<L> {
    /// d; scaled where its square might over- or underflow.
    direction: [L; 3],
    /// d.d.
    pub(crate) a: L,
    /// d.d times the number of multiples of d in a t of 1; NaN, which no comparison passes, where d is subnormal.
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
            let scale = inverse_powers_of_two(largest(direction));
            direction = axes!(i => direction[i] * scale);
            a = dot(direction, direction);
            per_limit = Self::per_limit(a, scale);
        }
        Self { direction, a, per_limit, length: a.sqrt() * a.like(1.0 + 8.0 * f32::EPSILON) }
    }

    /// Takes a direction, and its square, that were scaled by the power of two `scale`.
    #[inline(always)]
    pub(crate) fn of_scaled(direction: [L; 3], a: L, scale: L) -> Self {
        let length = a.sqrt() * a.like(1.0 + 8.0 * f32::EPSILON);
        Self { direction, a, per_limit: Self::per_limit(a, scale), length }
    }

    #[inline(always)]
    fn per_limit(a: L, scale: L) -> L {
        // A power that brings subnormal numbers to about 1 fails this test.
        let normal = scale.lt(a.like(2.0 / f32::MIN_POSITIVE));
        L::select(normal, a / scale, a.like(f32::NAN))
    }

    /// The lanes in which both roots are surely larger than `limit`. One lane has no filter: there, also where there
    /// are no roots.
    ///
    /// `docs/numerics.md` proves the margin. Where a term overflows, nothing is told.
    #[inline(always)]
    pub(crate) fn limit(&self, rays: &RayLanes<L>, center: [L; 3], radius: L, limit: L) -> L::Mask {
        let bounded = limit.lt(limit.like(f32::INFINITY));
        if L::COUNT > 1 && !bounded.any() {
            return bounded;
        }
        // Returns early where nothing will be told: squares would be subnormal, which doubles the time of a list on
        // some CPUs.
        let (p, size) = self.size(rays, center, radius);
        let known = (size.like(LEAST_SIZE) * self.length).le(size);
        let told = if L::COUNT > 1 { bounded & known } else { known };
        if !told.any() {
            return told;
        }
        let [end, b, discriminant] = self.terms(p, radius, limit);
        let raise = end.like(RAISE) * (size * size) + end.like(LEAST_A);
        if L::COUNT == 1 {
            // `per_limit` is NaN for a subnormal direction, of which nothing is told.
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
        // Among subnormals the next t may be twice the last, which is more than any margin: a t
        // past the limit by one of them does not count as past it yet.
        let end = (limit + limit.like(f32::MIN_POSITIVE)) * self.per_limit;
        let x = cross(d, p);
        [end, dot(d, p), self.a * (radius * radius) - dot(x, x)]
    }
}

/// 64 u of the square of |d| (|p| + r): D is raised by it, which covers its error.
pub(crate) const RAISE: f32 = 32.0 * f32::EPSILON;
/// 16 u = 2^-20, of |d| (|p| + r) and of limit a: the margin of the comparison.
pub(crate) const MARGIN: f32 = 8.0 * f32::EPSILON;
/// 2^-38: below it, the squares of |p| and r might underflow in `Stable`.
const LEAST_SIZE: f32 = 1.0 / (1u64 << 38) as f32;
/// 2^-120: added to raise and margin, it covers what underflows.
pub(crate) const LEAST_A: f32 = 1.0 / (1u128 << 120) as f32;
