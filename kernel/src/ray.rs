//! Rays, one at a time and in packets.

use crate::{LaneArray, Lanes};
use glam::Vec3;

/// The half-line (or, by its interval, any part of the line) `origin + t * direction`.
///
/// `direction` need not have unit length; `t` is counted in multiples of it. Only `t` in the
/// closed interval `[t_min, t_max]` counts; an empty one (`t_min > t_max`, or NaN at either end)
/// accepts nothing, and is how a lane of a packet is switched off. A ray with NaN or infinity in
/// `origin` or `direction`, or with `direction` zero, hits nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where `t` is zero, in the units of the scene.
    pub origin: Vec3,
    /// Where `t` grows to; any length but zero.
    pub direction: Vec3,
    /// The least accepted `t`; may be negative or `-inf`.
    pub t_min: f32,
    /// The greatest accepted `t`; may be `+inf`.
    pub t_max: f32,
}

impl Ray {
    /// A ray that hits nothing.
    pub const INACTIVE: Self = Self {
        origin: Vec3::ZERO,
        direction: Vec3::ZERO,
        t_min: f32::INFINITY,
        t_max: f32::NEG_INFINITY,
    };

    /// The half-line from `origin`: `t` in `[0, +inf]`.
    #[must_use]
    pub const fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, t_min: 0.0, t_max: f32::INFINITY }
    }

    /// Whether the ray can hit anything: rule 1, and an interval that is not empty.
    #[must_use]
    pub fn is_live(&self) -> bool {
        self.origin.is_finite()
            && self.direction.is_finite()
            && self.direction != Vec3::ZERO
            && self.t_min <= self.t_max
    }

    /// The point at `t`, each coordinate with two roundings.
    #[must_use]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + t * self.direction
    }
}

/// As many rays as `L` has lanes.
pub type RayPacket<L> = RayArrays<<L as Lanes>::Array>;

/// A packet of rays, component by component, in plain arrays.
///
/// A packet is memory, not registers: it holds no vector type, so it may be made on one side of a
/// run-time dispatch and read on the other. [`RayPacket`] names it by the lanes that read it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct RayArrays<A: LaneArray> {
    pub(crate) origin: [A; 3],
    pub(crate) direction: [A; 3],
    pub(crate) t_min: A,
    pub(crate) t_max: A,
}

impl<A: LaneArray> RayArrays<A> {
    /// A packet whose every lane is [`Ray::INACTIVE`].
    #[must_use]
    pub fn inactive() -> Self {
        let mut packet = Self {
            origin: Default::default(),
            direction: Default::default(),
            t_min: Default::default(),
            t_max: Default::default(),
        };
        packet.t_min.as_mut().fill(f32::INFINITY);
        packet.t_max.as_mut().fill(f32::NEG_INFINITY);
        packet
    }

    /// Ray `i` in lane `i`; lanes past the end of `rays` are inactive, rays past the last lane
    /// are left out.
    #[must_use]
    pub fn new(rays: &[Ray]) -> Self {
        let mut packet = Self::inactive();
        for (lane, ray) in rays.iter().take(A::COUNT).enumerate() {
            packet.set(lane, ray);
        }
        packet
    }

    /// Puts `ray` in `lane`; nothing happens where there is no such lane.
    pub fn set(&mut self, lane: usize, ray: &Ray) {
        let put = |array: &mut A, value: f32| {
            if let Some(element) = array.as_mut().get_mut(lane) {
                *element = value;
            }
        };
        for axis in 0..3 {
            put(&mut self.origin[axis], ray.origin[axis]);
            put(&mut self.direction[axis], ray.direction[axis]);
        }
        put(&mut self.t_min, ray.t_min);
        put(&mut self.t_max, ray.t_max);
    }

    /// The ray in `lane`; [`Ray::INACTIVE`] where there is no such lane.
    #[must_use]
    pub fn ray(&self, lane: usize) -> Ray {
        if lane >= A::COUNT {
            return Ray::INACTIVE;
        }
        let get = |array: &A| array.as_ref().get(lane).copied().unwrap_or(f32::NAN);
        Ray {
            origin: Vec3::from_array([0, 1, 2].map(|axis| get(&self.origin[axis]))),
            direction: Vec3::from_array([0, 1, 2].map(|axis| get(&self.direction[axis]))),
            t_min: get(&self.t_min),
            t_max: get(&self.t_max),
        }
    }
}
