//! The choice of a tier: by type at build time, or by value at run time.
//!
//! Traversals are compiled once, not once a tier: what a tier changes in them is one number, its
//! [`spread`](TierFormula::SPREAD). The tests of spheres are compiled for each tier, as a [`TierWork`],
//! and the tier chooses among them: at build time if it is a type, by one branch if it is a [`Tier`].

use super::roots::RayLanes;
use super::surface::{self, SurfaceLanes};
use super::{Exact, Fast, Geometric, Stable};
use crate::count::count;
#[cfg(feature = "std")]
use crate::geometry::ray::RayPacket;
use crate::geometry::sphere::Spheres;
use crate::geometry::surface::Surface;
use crate::numeric::rounding::U;
use crate::{Lanes, Ray, Sphere};
use core::cmp::Ordering;
use core::fmt::{Debug, Formatter};
use glam::Vec3;

/// The formula of a tier.
pub trait TierFormula: Copy + Debug {
    /// The tier as a value of its own type.
    const THIS: Self;
    /// The same as a value of all tiers' type.
    const TIER: Tier;

    /// How far off the tier may be beside the few ulp of s that are allowed to all: as if r^2
    /// were changed by up to (`SPREAD` (|p| + r))^2. Zero except for [`Fast`] and
    /// [`Geometric`].
    const SPREAD: f32 = 0.0;

    /// Whether the roots themselves are in order, where t are equal: rule 5.
    const ORDERS_ROOTS: bool = false;

    /// Below which sizes the tier may see hits that it owes to underflow.
    const UNDERFLOW: Underflow = Underflow::NONE;

    /// What the tier computes once a packet.
    type Prepared<L: Lanes>: Copy;

    /// Computes what depends on the rays alone.
    fn prepare<L: Lanes>(rays: &RayLanes<L>) -> Self::Prepared<L>;

    /// The t of rules 2 to 4 for one sphere a lane, `+inf` if there is none.
    ///
    /// Read only in the lanes `asked`, where ray and sphere are valid; may be `+inf` where t is
    /// larger than `limit`. Every bit pattern must return.
    fn first_root<L: Lanes>(
        rays: &RayLanes<L>,
        prepared: &Self::Prepared<L>,
        center: [L; 3],
        radius: L,
        asked: L::Mask,
        limit: L,
    ) -> L;

    /// [`first_root`](TierFormula::first_root) of a valid ray and a valid sphere, whatever it is.
    #[cfg(feature = "std")]
    #[inline(always)]
    fn first_root_of(ray: &Ray, sphere: &Sphere) -> f32 {
        let rays = RayLanes::<f32>::load((), &RayPacket::new(core::slice::from_ref(ray)));
        let (center, radius, limit) = (sphere.center.to_array(), sphere.radius, f32::INFINITY);
        Self::first_root(&rays, &Self::prepare(&rays), center, radius, true, limit)
    }

    /// Both roots of the line of a valid ray and a valid sphere, the smaller first, never -0.
    fn line_roots(ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]>;

    /// How two spheres compare that `ray` hits at the same `t`: `Equal` if the tier knows no more than t.
    fn compare_at(_ray: &Ray, _t: f32, _spheres: [&Sphere; 2]) -> Ordering {
        Ordering::Equal
    }

    /// The surface of a sphere of positive radius that a valid ray hits at `t`, where [`TierFormula::surfaces`] does
    /// not know it.
    fn surface_at(_ray: &Ray, _t: f32, _sphere: &Sphere) -> Surface {
        Surface { normal: Vec3::ZERO, point: Vec3::ZERO, rest: Vec3::ZERO }
    }

    /// The surfaces of spheres of positive radius that rays hit at `t`, and those of the lanes `asked` in which they
    /// are known.
    #[inline(always)]
    fn surfaces<L: Lanes>(
        rays: &RayLanes<L>,
        t: L,
        center: [L; 3],
        radius: L,
        asked: L::Mask,
    ) -> (SurfaceLanes<L>, L::Mask) {
        (surface::in_lanes(rays, t, center, radius), asked)
    }
}

/// Below which sizes a tier may see hits where there are none, since its squares underflow: a filter leaves such to it.
#[derive(Clone, Copy, Debug)]
pub struct Underflow {
    /// Of the largest component of a direction.
    pub length: f32,
    /// Of the root of |p|^2 + r^2.
    pub size: f32,
}

impl Underflow {
    /// The tier sees none.
    pub const NONE: Self = Self { length: 0.0, size: 0.0 };
}

/// Work that is compiled once a tier.
pub trait TierWork {
    /// What comes of it.
    type Output;
    /// Does the work by the formula of one tier.
    fn run<F: TierFormula>(self) -> Self::Output;
}

mod sealed {
    /// Calls the formula of a tier.
    pub trait Chosen: Copy {
        /// [`TierFormula::SPREAD`](super::TierFormula::SPREAD).
        fn spread(self) -> f32;
        /// How far two answers may be in another order than their roots, in units of T: zero if roots are ordered.
        fn answer_error(self) -> f32;
        /// [`TierFormula::UNDERFLOW`](super::TierFormula::UNDERFLOW).
        fn underflow(self) -> super::Underflow;
        /// Does `work` by the formula of the tier.
        fn with_formula<W: super::TierWork>(self, work: W) -> W::Output;
        /// [`TierFormula::compare_at`](super::TierFormula::compare_at).
        fn compare_at(
            self,
            ray: &super::Ray,
            t: f32,
            spheres: [&super::Sphere; 2],
        ) -> super::Ordering;
    }
}

/// A tier: [`Fast`], [`Geometric`], [`Stable`] or [`Exact`], known at build time, or a [`Tier`], known at run time.
///
/// Sealed: the scene structures prove their bounds tier by tier.
pub trait Accuracy: sealed::Chosen + Copy + Debug {
    /// The tier as a value.
    fn tier(self) -> Tier;
}

impl<F: TierFormula> sealed::Chosen for F {
    #[inline(always)]
    fn spread(self) -> f32 {
        F::SPREAD
    }

    #[inline(always)]
    fn underflow(self) -> Underflow {
        F::UNDERFLOW
    }

    #[inline(always)]
    fn answer_error(self) -> f32 {
        if F::ORDERS_ROOTS { 0.0 } else { 8.0 * U }
    }

    #[inline(always)]
    fn with_formula<W: TierWork>(self, work: W) -> W::Output {
        work.run::<F>()
    }

    #[inline(always)]
    fn compare_at(self, ray: &Ray, t: f32, spheres: [&Sphere; 2]) -> Ordering {
        F::compare_at(ray, t, spheres)
    }
}

impl<F: TierFormula> Accuracy for F {
    #[inline(always)]
    fn tier(self) -> Tier {
        F::TIER
    }
}

/// A tier that is chosen at run time.
///
/// ```
/// use spherule_kernel::{Accuracy, Exact, Tier};
///
/// assert_eq!(Tier::ALL.map(Tier::as_str), ["fast", "geometric", "stable", "exact"]);
/// assert_eq!(Exact.tier(), Tier::Exact);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Tier {
    /// [`Fast`].
    Fast,
    /// [`Geometric`].
    Geometric,
    /// [`Stable`].
    Stable,
    /// [`Exact`].
    Exact,
}

impl Tier {
    /// Every tier: the two forms of the lecture, then what is more accurate.
    pub const ALL: [Self; 4] = [Self::Fast, Self::Geometric, Self::Stable, Self::Exact];

    /// The name on the command line and in reports.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Geometric => "geometric",
            Self::Stable => "stable",
            Self::Exact => "exact",
        }
    }
}

/// Its name.
impl Debug for Tier {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> core::fmt::Result {
        formatter.write_str(self.as_str())
    }
}

impl sealed::Chosen for Tier {
    #[inline(always)]
    fn spread(self) -> f32 {
        match self {
            Self::Fast => Fast::SPREAD,
            Self::Geometric => Geometric::SPREAD,
            Self::Stable => Stable::SPREAD,
            Self::Exact => Exact::SPREAD,
        }
    }

    #[inline(always)]
    fn underflow(self) -> Underflow {
        match self {
            Self::Fast => Fast::UNDERFLOW,
            Self::Geometric => Geometric::UNDERFLOW,
            Self::Stable => Stable::UNDERFLOW,
            Self::Exact => Exact::UNDERFLOW,
        }
    }

    #[inline(always)]
    fn answer_error(self) -> f32 {
        if self == Self::Exact { 0.0 } else { 8.0 * U }
    }

    #[inline(always)]
    fn with_formula<W: TierWork>(self, work: W) -> W::Output {
        match self {
            Self::Fast => work.run::<Fast>(),
            Self::Geometric => work.run::<Geometric>(),
            Self::Stable => work.run::<Stable>(),
            Self::Exact => work.run::<Exact>(),
        }
    }

    #[inline(always)]
    fn compare_at(self, ray: &Ray, t: f32, spheres: [&Sphere; 2]) -> Ordering {
        match self {
            Self::Fast | Self::Geometric | Self::Stable => Ordering::Equal,
            Self::Exact => <Exact as TierFormula>::compare_at(ray, t, spheres),
        }
    }
}

impl Accuracy for Tier {
    #[inline(always)]
    fn tier(self) -> Tier {
        self
    }
}

/// Rule 5 for two spheres of a list that `ray` hits at the same `t`: whether `new` is the closer one, as real numbers
/// if the tier tells them apart, else by its index.
#[cold]
#[inline(never)]
pub(crate) fn is_closer(
    tier: impl Accuracy,
    spheres: &Spheres<'_>,
    ray: &Ray,
    t: f32,
    [new, old]: [u32; 2],
) -> bool {
    // A sphere that is met once more, by a ray that went on by itself.
    if new == old {
        return false;
    }
    let compared = match (sphere(spheres, new), sphere(spheres, old)) {
        (Some(new), Some(old)) => tier.compare_at(ray, t, [&new, &old]),
        _ => Ordering::Equal,
    };
    compared.then(new.cmp(&old)).is_lt()
}

/// A sphere of a list, called where code is dear.
#[cfg_attr(target_pointer_width = "32", inline(never))]
fn sphere(spheres: &Spheres<'_>, index: u32) -> Option<Sphere> {
    spheres.get(index as usize)
}

/// Tests one sphere a lane: t if there is a hit in a lane that is `asked`, else `+inf`.
///
/// The one place where scene structures do so, and a function of its own for each tier: a tier is long,
/// and would be compiled into every traversal several times.
#[inline(always)]
pub(crate) fn test_lanes<L: Lanes>(
    tier: impl Accuracy,
    rays: &RayLanes<L>,
    center: [L; 3],
    radius: L,
    asked: L::Mask,
    limit: L,
) -> L {
    tier.with_formula(LaneTest { rays, center, radius, asked, limit })
}

/// Tests a live ray against a valid sphere: t if there is a hit, else `+inf`.
#[cfg(feature = "std")]
#[inline(always)]
pub(crate) fn test_one(tier: impl Accuracy, ray: &Ray, sphere: &Sphere) -> f32 {
    tier.with_formula(OneTest { ray, sphere })
}

/// The arguments of [`test_one`].
#[cfg(feature = "std")]
struct OneTest<'a> {
    ray: &'a Ray,
    sphere: &'a Sphere,
}

#[cfg(feature = "std")]
impl TierWork for OneTest<'_> {
    type Output = f32;

    #[inline(always)]
    fn run<F: TierFormula>(self) -> f32 {
        F::first_root_of(self.ray, self.sphere)
    }
}

/// The arguments of [`test_lanes`].
struct LaneTest<'a, L: Lanes> {
    rays: &'a RayLanes<L>,
    center: [L; 3],
    radius: L,
    asked: L::Mask,
    limit: L,
}

impl<L: Lanes> TierWork for LaneTest<'_, L> {
    type Output = L;

    #[inline(always)]
    fn run<F: TierFormula>(self) -> L {
        count!(TierLanes);
        let Self { rays, center, radius, asked, limit } = self;
        L::out_of_line(
            limit.token(),
            #[inline(always)]
            || {
                let t = F::first_root(rays, &F::prepare(rays), center, radius, asked, limit);
                L::select(asked, t, limit.like(f32::INFINITY))
            },
        )
    }
}
