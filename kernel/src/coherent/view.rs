//! What the rays of a depth list have in common, an origin or a direction, and the frame that follows from
//! it.
//!
//! From a common origin, spheres and rays are seen relative to it: then the errors of all bounds are in
//! proportion to the distance from it, however far it is from the coordinates' origin. Rays of a common
//! direction are seen where they are. Depth is the distance from the common origin, or how far a point
//! lies along the common direction.

use crate::accuracy::RayLanes;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::Sphere;
use crate::lanes::{LaneMask, Lanes};
use crate::numeric::axes::{axes, dot};
use crate::numeric::power_of_two::inverse_power_of_two;
use crate::numeric::rounding::{LARGEST, LEAST_COMPONENT, U};
use crate::scale::rays::ScaledRays;
use glam::Vec3;

/// By which part of |x| + r depths are lowered.
pub(crate) const DEPTH_MARGIN: f32 = 64.0 * U;

/// What the rays of a run have in common. Rays that do not have it are tested against all spheres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viewpoint {
    /// All start here, at exactly these three numbers: a perspective camera's eye, a point light.
    Origin(Vec3),
    /// All have exactly these three numbers as their direction: a parallel projection, a directional light. They have its
    /// length, too, which need not be 1: the same direction of another length is another.
    Direction(Vec3),
}

/// A viewpoint that the bounds cover.
#[derive(Clone, Copy, Debug)]
pub(super) enum View {
    /// All rays start at `eye`; `scaled` is the eye as bounds see it.
    Perspective { eye: [f32; 3], scaled: [f32; 3] },
    /// All rays have this `direction`; `unit` is the same of unit length.
    Parallel { direction: [f32; 3], unit: [f32; 3] },
}

impl View {
    /// For spheres that are scaled by `factor`; returns `None` if the bounds do not cover the viewpoint.
    pub(super) fn new(viewpoint: Viewpoint, factor: f32) -> Option<Self> {
        match viewpoint {
            Viewpoint::Origin(eye) => {
                let scaled = (eye * factor).to_array();
                let [x, y, z] = axes!(i => scaled[i].abs() <= LARGEST);
                (x && y && z).then_some(Self::Perspective { eye: eye.to_array(), scaled })
            }
            Viewpoint::Direction(direction) => {
                let covered = direction.is_finite() && direction != Vec3::ZERO;
                let scaled = direction * inverse_power_of_two(direction.abs().max_element());
                let (direction, scaled) = (direction.to_array(), scaled.to_array());
                let per_length = 1.0 / libm::sqrtf(dot(scaled, scaled));
                let unit = axes!(i => scaled[i] * per_length);
                covered.then_some(Self::Parallel { direction, unit })
            }
        }
    }

    /// Returns the centre of a scaled sphere in the frame, and a depth before which no ray hits it.
    ///
    /// The distance is 4u off, |x| - r one more, x.n 5u; an answer lies at |s| >= |p| - r, |s| >= r - |p|
    /// and s >= p.n - r, except for 32 u (|p| + r) (`docs/traversal-margins.md`).
    pub(super) fn see(&self, sphere: &Sphere) -> ([f32; 3], f32) {
        let margin = |away: f32| DEPTH_MARGIN * (away + sphere.radius) + LEAST_COMPONENT;
        match self {
            Self::Perspective { scaled, .. } => {
                let center = axes!(i => sphere.center[i] - scaled[i]);
                let away = libm::sqrtf(dot(center, center));
                (center, (away - sphere.radius).abs() - margin(away))
            }
            Self::Parallel { unit, .. } => {
                let center = sphere.center.to_array();
                let away = libm::sqrtf(dot(center, center));
                (center, dot(center, *unit) - sphere.radius - margin(away))
            }
        }
    }

    /// Returns which rays have the origin, or the direction, that is common.
    #[inline(always)]
    pub(super) fn shares<L: Lanes>(&self, rays: &RayLanes<L>) -> L::Mask {
        let (has, common) = match self {
            Self::Perspective { eye, .. } => (rays.origin, eye),
            Self::Parallel { direction, .. } => (rays.direction, direction),
        };
        let [x, y, z] = axes!(i => {
            let common = has[i].like(common[i]);
            has[i].le(common) & common.le(has[i])
        });
        x & y & z
    }

    /// Returns whether all live rays of a packet have it.
    #[inline(always)]
    pub(super) fn is_shared_by<L: Lanes>(
        &self,
        token: L::Token,
        packet: &RayPacket<L::Array>,
    ) -> bool {
        let rays = RayLanes::<L>::load(token, packet);
        !(rays.live & !self.shares(&rays)).any()
    }

    /// Returns the rays in the frame.
    #[inline(always)]
    pub(super) fn in_frame<L: Lanes>(&self, rays: &RayLanes<L>) -> RayLanes<L> {
        match self {
            Self::Perspective { .. } => RayLanes { origin: [rays.t_min.like(0.0); 3], ..*rays },
            Self::Parallel { .. } => *rays,
        }
    }

    /// Returns the rays in the frame, of usual lengths, scaled by `factor`.
    #[inline(always)]
    pub(super) fn scaled_in_frame<L: Lanes>(
        &self,
        rays: &RayLanes<L>,
        factor: f32,
    ) -> ScaledRays<L> {
        match self {
            Self::Perspective { .. } => ScaledRays::from_zero(rays, factor),
            Self::Parallel { .. } => ScaledRays::new(rays, factor),
        }
    }

    /// Returns the depth at which rays of that origin in the frame start.
    #[inline(always)]
    pub(super) fn start_depth<L: Lanes>(&self, origin: [L; 3]) -> L {
        match self {
            Self::Perspective { .. } => origin[0].like(0.0),
            Self::Parallel { unit, .. } => dot(origin, axes!(i => origin[0].like(unit[i]))),
        }
    }
}
