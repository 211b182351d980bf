//! Double precision with a proven bound, and exact sums for what it cannot prove.
//!
//! # Method
//!
//! Spheres that pass the miss filter are computed in double-precision lanes, by the cross product:
//! D = a r^2 - |d x p|^2, t = (b -+ sqrt D) / a, each with a bound on its error. Where D is larger
//! than its bound, its sign is known. Where t minus its bound and t plus its bound round to the
//! same `f32`, that number is the correctly rounded t. The other lanes - exact tangents, ties, some
//! rays that start on the surface - go one by one through [`Quadratic`], which is always right. So
//! every lane is right: the bound decides the cost, never the answer.
//!
//! `docs/numerics.md` proves the bound; `tests/proofs` searches for the largest errors under it.

mod brackets;
pub(crate) mod estimate;
mod from_start;
mod one_ray;
mod order;
mod surface;

pub(crate) use self::brackets::Brackets;
use self::one_ray::Bracketed;
use super::formula::{Tier, TierFormula};
use super::range_limits::RangeLimits;
use super::roots::RayLanes;
use super::surface::SurfaceLanes;
use crate::geometry::surface::Surface;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::{Ray, Sphere};
use core::cmp::Ordering;
use glam::Vec3;

/// Hits decided as in real arithmetic, t correctly rounded, for every `f32` input.
///
/// The tier decides as in real arithmetic whether a line meets a sphere (a tangent is a hit), and which of many spheres
/// is the closest, even where their t are equal. t is the correctly rounded root, subnormals kept; the interval is
/// tested on that t. So the answer is the same on every target, in every lane width and in every order of traversal.
///
/// Requires the default floating-point environment: round to nearest even, subnormals neither flushed nor taken for
/// zero; [`float_environment_is_sound`](crate::float_environment_is_sound) tests for it. Exactness is per ray and
/// sphere as given in `f32`: a hit *point* computed from t is rounded, and lies inside the sphere half of the time.
///
/// Cost: as [`Fast`](super::Fast) for spheres that the filter rules out. A candidate takes some 100 double-precision
/// operations, and two hits at one t take as many. Where these cannot decide, a lane takes some 2 microseconds and two
/// hits take 25, in 1 KiB of stack (on 32 bits, a whole call for a ray takes 1.6 KiB: `docs/targets.md`).
#[derive(Clone, Copy, Debug)]
pub struct Exact;

impl TierFormula for Exact {
    const THIS: Self = Self;
    const TIER: Tier = Tier::Exact;
    const ORDERS_ROOTS: bool = true;
    type Prepared<L: Lanes> = RangeLimits<L>;

    #[inline(always)]
    fn prepare<L: Lanes>(rays: &RayLanes<L>) -> RangeLimits<L> {
        RangeLimits::new(rays)
    }

    #[inline(always)]
    fn first_root<L: Lanes>(
        rays: &RayLanes<L>,
        range_limits: &RangeLimits<L>,
        center: [L; 3],
        radius: L,
        active: L::Mask,
        limit: L,
        any: bool,
    ) -> L {
        let infinity = radius.like(f32::INFINITY);
        let active = active & !range_limits.limit(rays, center, radius, limit);
        if !active.any() {
            return infinity;
        }
        if L::COUNT == 1 {
            let (ray, sphere) = (rays.first(), first(center, radius));
            let t = match one_ray::decided(&ray, &sphere, lane(limit)) {
                Some(t) => t,
                None => one_ray::settled(&ray, &sphere),
            };
            return infinity.like(t);
        }
        let brackets = Brackets::new(rays, center, radius, active);
        let (t, decided) = brackets.decide(rays, limit);
        let undecided = (active & !decided).bits();
        // Adding zero turns -0 into +0.
        let t = L::select(active, t + t.like(0.0), infinity);
        if undecided == 0 {
            return t;
        }

        // Undecided lanes leave the registers as arrays: the code for them is scalar, and runs
        // rarely.
        let mut settled = t.store();
        Unsettled::<L> {
            origin: axes!(i => rays.origin[i].store()),
            direction: axes!(i => rays.direction[i].store()),
            t_min: rays.t_min.store(),
            t_max: rays.t_max.store(),
            center: axes!(i => center[i].store()),
            radius: radius.store(),
            brackets: any.then_some(brackets),
        }
        .settle(undecided, &mut settled);
        L::load(t.token(), &settled)
    }

    #[cfg(feature = "std")]
    #[inline(always)]
    fn first_root_of(ray: &Ray, sphere: &Sphere) -> f32 {
        match one_ray::decided_inline(ray, sphere) {
            Some(t) => t,
            None => one_ray::settled(ray, sphere),
        }
    }

    fn line_roots(ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]> {
        one_ray::line_roots(ray, sphere)
    }

    fn compare_at(ray: &Ray, t: f32, spheres: [&Sphere; 2]) -> Ordering {
        order::compare(ray, t, spheres)
    }

    fn surface_at(ray: &Ray, t: f32, sphere: &Sphere) -> Surface {
        surface::at(ray, t, sphere)
    }

    #[inline(always)]
    fn surfaces<L: Lanes>(
        rays: &RayLanes<L>,
        t: L,
        center: [L; 3],
        radius: L,
        active: L::Mask,
    ) -> (SurfaceLanes<L>, L::Mask) {
        surface::in_lanes(rays, t, center, radius, active)
    }
}

impl Exact {
    /// D of a valid ray and a valid sphere, and the bound on its error.
    pub(crate) fn discriminant(ray: &Ray, sphere: &Sphere) -> (f64, f64) {
        let Bracketed { discriminant, error, .. } = one_ray::estimate(ray, sphere);
        (discriminant, error)
    }

    /// The lanes of `active` that [`TierFormula::first_root`] takes to double precision, and those of them that it
    /// takes to exact sums.
    #[cfg(feature = "stages")]
    #[inline(always)]
    pub(crate) fn reached<L: Lanes>(
        rays: &RayLanes<L>,
        center: [L; 3],
        radius: L,
        active: L::Mask,
        limit: L,
    ) -> [L::Mask; 2] {
        let double = active & !RangeLimits::new(rays).limit(rays, center, radius, limit);
        let (_, decided) = Brackets::new(rays, center, radius, double).decide(rays, limit);
        [double, double & !decided]
    }

    /// `limit`, or the t of [`TierFormula::first_root`] where that is smaller.
    #[cfg(feature = "stages")]
    #[inline(always)]
    pub(crate) fn nearer<L: Lanes>(
        rays: &RayLanes<L>,
        center: [L; 3],
        radius: L,
        active: L::Mask,
        limit: L,
    ) -> L {
        let t =
            Self::first_root(rays, &RangeLimits::new(rays), center, radius, active, limit, false);
        L::select(active & t.lt(limit), t, limit)
    }
}

/// Rays and spheres that double precision could not decide, in memory.
struct Unsettled<L: Lanes> {
    origin: [L::Array; 3],
    direction: [L::Array; 3],
    t_min: L::Array,
    t_max: L::Array,
    center: [L::Array; 3],
    radius: L::Array,
    /// The brackets of the roots, if any hit will do.
    brackets: Option<Brackets<L>>,
}

impl<L: Lanes> Unsettled<L> {
    /// Puts the t of rules 2 to 4 into the elements of `t` whose bit is set in `lanes`.
    #[cold]
    #[inline(never)]
    fn settle(&self, lanes: u32, t: &mut L::Array) {
        for (lane, t) in t.as_mut().iter_mut().enumerate() {
            if lanes >> lane & 1 == 1 {
                *t = self.first_root(lane);
            }
        }
    }

    fn first_root(&self, lane: usize) -> f32 {
        let at = |array: &L::Array| array.as_ref().get(lane).copied().unwrap_or(f32::NAN);
        let [origin, direction, center] = [&self.origin, &self.direction, &self.center]
            .map(|[x, y, z]| Vec3::new(at(x), at(y), at(z)));
        let ray = Ray { origin, direction, t_min: at(&self.t_min), t_max: at(&self.t_max) };
        // (Without this, rays along an axis through the centres of few spheres ran at a fourteenth of the speed of ray by ray.)
        if let Some(t) =
            self.brackets.as_ref().and_then(|brackets| brackets.surely_accepted(lane, &ray))
        {
            return t;
        }
        one_ray::settled(&ray, &Sphere { center, radius: at(&self.radius) })
    }
}

/// The sphere of the first lane.
#[inline(always)]
fn first<L: Lanes>([x, y, z]: [L; 3], radius: L) -> Sphere {
    Sphere::from([lane(x), lane(y), lane(z), lane(radius)])
}

/// The number of the first lane.
#[inline(always)]
fn lane<L: Lanes>(numbers: L) -> f32 {
    numbers.store().get(0)
}

#[cfg(all(test, proofs))]
#[cfg(feature = "std")]
mod tests;
