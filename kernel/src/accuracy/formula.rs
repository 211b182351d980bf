//! What a tier is: its formula, and its name as a value.

use super::roots::RayLanes;
use super::surface::{self, SurfaceLanes};
#[cfg(feature = "std")]
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::surface::Surface;
use crate::unknown_name::UnknownName;
use crate::{Lanes, Ray, Sphere};
use core::cmp::Ordering;
use core::fmt::{self, Debug, Formatter};
use core::str::FromStr;
use glam::Vec3;

/// A tier that is chosen at run time.
///
/// ```
/// use spherule_kernel::{Accuracy, Exact, Tier};
///
/// assert_eq!(Tier::ALL.map(Tier::as_str), ["fast", "geometric", "stable", "exact"]);
/// assert_eq!(Exact.tier(), Tier::Exact);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Tier {
    /// [`Fast`](super::Fast).
    Fast,
    /// [`Geometric`](super::Geometric).
    Geometric,
    /// [`Stable`](super::Stable).
    Stable,
    /// [`Exact`](super::Exact).
    Exact,
}

impl Tier {
    /// Every tier: the two forms of the lecture, then the more accurate tiers.
    pub const ALL: [Self; 4] = [Self::Fast, Self::Geometric, Self::Stable, Self::Exact];

    /// The name on the command line and in reports.
    ///
    /// ```
    /// use spherule_kernel::Tier;
    ///
    /// assert_eq!(Tier::Exact.as_str(), "exact");
    /// ```
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
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.as_str())
    }
}

/// Its name, padded as a string is.
impl fmt::Display for Tier {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        formatter.pad(self.as_str())
    }
}

/// ```
/// use spherule_kernel::Tier;
///
/// assert_eq!("exact".parse(), Ok(Tier::Exact));
/// assert!("Exact".parse::<Tier>().is_err());
/// ```
impl FromStr for Tier {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        const NAMES: [&str; 4] = [
            Tier::Fast.as_str(),
            Tier::Geometric.as_str(),
            Tier::Stable.as_str(),
            Tier::Exact.as_str(),
        ];
        let error = UnknownName { kind: "tier", names: &NAMES };
        Self::ALL.into_iter().find(|tier| tier.as_str() == name).ok_or(error)
    }
}

/// The formula of a tier.
pub trait TierFormula: Copy + Debug {
    /// The tier as a value of its own type.
    const THIS: Self;
    /// The tier as a value of the type of all tiers.
    const TIER: Tier;

    /// The error of the tier beyond the few ulp of s that every tier may have: as if r^2 were
    /// changed by up to (`SPREAD` (|p| + r))^2. Zero except for [`Fast`](super::Fast) and
    /// [`Geometric`](super::Geometric).
    const SPREAD: f32 = 0.0;

    /// Whether the tier orders the roots themselves where their t are equal: rule 5.
    const ORDERS_ROOTS: bool = false;

    /// The sizes below which underflow may make the tier see hits.
    const UNDERFLOW: Underflow = Underflow::NONE;

    /// What the tier squares in single precision.
    const SQUARES: Squares = Squares::None;

    /// What the tier computes once a packet.
    type Prepared<L: Lanes>: Copy;

    /// Computes what depends on the rays alone.
    fn prepare<L: Lanes>(rays: &RayLanes<L>) -> Self::Prepared<L>;

    /// The t of rules 2 to 4 for one sphere a lane, `+inf` if there is none.
    ///
    /// The result is read only in the lanes `active`, where ray and sphere are valid; it may be
    /// `+inf` where t is larger than `limit`. If `any` hit will do, it may be another number where there is a t. The function must
    /// return for every bit pattern.
    fn first_root<L: Lanes>(
        rays: &RayLanes<L>,
        prepared: &Self::Prepared<L>,
        center: [L; 3],
        radius: L,
        active: L::Mask,
        limit: L,
        any: bool,
    ) -> L;

    /// [`first_root`](TierFormula::first_root) of a valid ray and a valid sphere, without a limit.
    #[cfg(feature = "std")]
    #[inline(always)]
    fn first_root_of(ray: &Ray, sphere: &Sphere) -> f32 {
        let rays = RayLanes::<f32>::load((), &RayPacket::new(core::slice::from_ref(ray)));
        let (center, radius, limit) = (sphere.center.to_array(), sphere.radius, f32::INFINITY);
        Self::first_root(&rays, &Self::prepare(&rays), center, radius, true, limit, false)
    }

    /// Both roots of the line of a valid ray and a valid sphere, the smaller first, never -0.
    fn line_roots(ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]>;

    /// Compares two spheres that `ray` hits at the same `t`: returns `Equal` if the tier knows no more than t.
    fn compare_at(_ray: &Ray, _t: f32, _spheres: [&Sphere; 2]) -> Ordering {
        Ordering::Equal
    }

    /// The surface of a sphere of positive radius that a valid ray hits at `t`, where [`TierFormula::surfaces`] does
    /// not know it.
    fn surface_at(_ray: &Ray, _t: f32, _sphere: &Sphere) -> Surface {
        Surface { normal: Vec3::ZERO, point: Vec3::ZERO, rest: Vec3::ZERO }
    }

    /// The surfaces of spheres of positive radius that rays hit at `t`, and those of the lanes `active` in which they
    /// are known.
    #[inline(always)]
    fn surfaces<L: Lanes>(
        rays: &RayLanes<L>,
        t: L,
        center: [L; 3],
        radius: L,
        active: L::Mask,
    ) -> (SurfaceLanes<L>, L::Mask) {
        (surface::in_lanes(rays, t, center, radius), active)
    }
}

/// What a tier squares in single precision, so that it sees no hit where the squares overflow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Squares {
    /// Nothing: it sees each hit.
    None,
    /// Points.
    OfPoints,
    /// Points, and directions as given.
    OfPointsAndDirections,
}

/// The sizes below which a tier may see hits where there are none, since its squares underflow: a filter lets such
/// spheres pass to the tier.
#[derive(Clone, Copy, Debug)]
pub struct Underflow {
    /// For the largest component of a direction.
    pub length: f32,
    /// For the root of |p|^2 + r^2.
    pub size: f32,
}

impl Underflow {
    /// The tier sees no such hits.
    pub const NONE: Self = Self { length: 0.0, size: 0.0 };
}

/// Work that is compiled once for each tier.
pub trait TierWork {
    /// The result of the work.
    type Output;
    /// Does the work by the formula of one tier.
    fn run<F: TierFormula>(self) -> Self::Output;
}
