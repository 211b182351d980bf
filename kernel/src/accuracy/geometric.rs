//! The lecture's geometric form, in single precision.
//!
//! With p = c - o and the unit direction v = d / |d|: the line is closest to the centre at s = v.p, its distance there
//! is l, l^2 = p.p - s^2, and half a chord, h = sqrt(r^2 - l^2), lies on either side: t = (s -+ h) / |d|. p.p - s^2
//! cancels where the sphere is far for its size, and s - h where the ray starts near the surface, as p.p - r^2 and
//! b - sqrt D do in [`Fast`](super::Fast). The unit direction is rounded besides, and |v| = 1 is taken for granted.
//! [`Stable`](super::Stable) is this form with each of these errors cured.

use super::formula::{Squares, Tier, TierFormula, Underflow};
use super::roots::{RayLanes, Roots, line_roots_of};
use crate::numeric::axes::{axes, dot};
use crate::{Lanes, Ray, Sphere};

/// The lecture's geometric form in `f32`, unimproved: wrong where `f32` is wrong.
///
/// In real arithmetic this form equals [`Fast`](crate::Fast). Where both are right they agree: from 2 to 10 radii away,
/// and not grazing, t is within 256 ulp of the t of `Fast`; the most that a search found is 138. Where the precision of
/// `f32` ends, each fails in its own way. The measured errors stand in the budget table of the tests.
///
/// A ray hits nothing if the square of its direction overflows.
#[derive(Clone, Copy, Debug)]
pub struct Geometric;

/// The rays, their directions of unit length, and 1/|d|.
#[derive(Clone, Copy, Debug)]
pub struct GeometricRays<L> {
    origin: [L; 3],
    pub(crate) unit: [L; 3],
    per_length: L,
}

impl TierFormula for Geometric {
    const THIS: Self = Self;
    const TIER: Tier = Tier::Geometric;
    /// r^2 - l^2 is off by 25 u |p|^2 + 2 u r^2 (`docs/numerics.md`); this is 2^-9, whose square is 64 u.
    const SPREAD: f32 = 1.0 / 512.0;
    /// The length is 2^-50: its square is far above what underflows in d.d, below 2^-147. The size is 2^-60, as large
    /// as the filter asks: what underflows in r^2 - l^2 is below 2^-146.
    const UNDERFLOW: Underflow =
        Underflow { length: 1.0 / (1_u64 << 50) as f32, size: 1.0 / (1_u64 << 60) as f32 };
    const SQUARES: Squares = Squares::OfPointsAndDirections;
    type Prepared<L: Lanes> = GeometricRays<L>;

    #[inline(always)]
    fn prepare<L: Lanes>(rays: &RayLanes<L>) -> GeometricRays<L> {
        let d = rays.direction;
        let length = dot(d, d).sqrt();
        // 1 / inf is no length: v would be zero, and so would every t.
        let finite = length.lt(length.like(f32::INFINITY));
        let per_length = L::select(finite, length.like(1.0) / length, length.like(f32::NAN));
        GeometricRays { origin: rays.origin, unit: axes!(i => d[i] * per_length), per_length }
    }

    #[inline(always)]
    fn first_root<L: Lanes>(
        rays: &RayLanes<L>,
        prepared: &GeometricRays<L>,
        center: [L; 3],
        radius: L,
        _active: L::Mask,
        _limit: L,
        _any: bool,
    ) -> L {
        roots(prepared, center, radius).first_accepted(rays)
    }

    fn line_roots(ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]> {
        line_roots_of(Self::prepare, roots, ray, sphere)
    }
}

#[inline(always)]
pub(crate) fn roots<L: Lanes>(rays: &GeometricRays<L>, center: [L; 3], radius: L) -> Roots<L> {
    let GeometricRays { origin: o, unit, per_length } = *rays;
    let p = axes!(i => center[i] - o[i]);
    let middle = dot(unit, p);
    let ll = dot(p, p) - middle * middle;
    let left = radius * radius - ll;
    let half = left.sqrt();
    Roots {
        meets: left.like(0.0).le(left),
        near: (middle - half) * per_length,
        far: (middle + half) * per_length,
    }
}
