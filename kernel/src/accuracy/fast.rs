//! The lecture's algebraic form, in single precision.
//!
//! With p = c - o: a = d.d, b = d.p, D = b^2 - a (p.p - r^2), t = (b -+ sqrt D) / a. p.p - r^2
//! cancels where the sphere is far for its size, and b - sqrt D where the ray starts near the
//! surface: the tier trades this loss for speed, and the report counts it.

use super::formula::{Squares, Tier, TierFormula, Underflow};
use super::roots::{RayLanes, Roots, line_roots_of};
use crate::numeric::axes::{axes, dot};
use crate::{Lanes, Ray, Sphere};

/// The lecture's algebraic form, the textbook quadratic, in `f32`: wrong where `f32` is wrong.
///
/// For distance/radius up to some 10, and not grazing, t is within some hundred ulp. At
/// distance/radius 1e4 nearly half of all decisions are wrong. The measured errors stand in the
/// budget table of the tests.
#[derive(Clone, Copy, Debug)]
pub struct Fast;

/// The rays, a = d.d, and 1/a: one division a packet instead of two a sphere.
#[derive(Clone, Copy, Debug)]
pub struct FastRays<L> {
    origin: [L; 3],
    direction: [L; 3],
    a: L,
    per_a: L,
}

impl TierFormula for Fast {
    const THIS: Self = Self;
    const TIER: Tier = Tier::Fast;
    /// D/a is off by 20 u |p|^2 + 10 u r^2 (`docs/numerics.md`); this is 2^-9, whose square is 64 u.
    const SPREAD: f32 = 1.0 / 512.0;
    /// 2^-30: what underflows in D is below 2^-148.
    const UNDERFLOW: Underflow =
        Underflow { length: 1.0 / (1 << 30) as f32, size: 1.0 / (1 << 30) as f32 };
    const SQUARES: Squares = Squares::OfPointsAndDirections;
    type Prepared<L: Lanes> = FastRays<L>;

    #[inline(always)]
    fn prepare<L: Lanes>(rays: &RayLanes<L>) -> FastRays<L> {
        let d = rays.direction;
        let a = dot(d, d);
        FastRays { origin: rays.origin, direction: d, a, per_a: a.like(1.0) / a }
    }

    #[inline(always)]
    fn first_root<L: Lanes>(
        rays: &RayLanes<L>,
        prepared: &FastRays<L>,
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
pub(crate) fn roots<L: Lanes>(rays: &FastRays<L>, center: [L; 3], radius: L) -> Roots<L> {
    let FastRays { origin: o, direction: d, a, per_a } = *rays;
    let p = axes!(i => center[i] - o[i]);
    let b = dot(d, p);
    let c = dot(p, p) - radius * radius;
    let discriminant = b * b - a * c;
    let root = discriminant.sqrt();
    Roots { meets: a.like(0.0).le(discriminant), near: (b - root) * per_a, far: (b + root) * per_a }
}
