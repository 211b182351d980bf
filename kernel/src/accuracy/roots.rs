//! Rays in registers, and the roots that a tier finds on their lines.

use crate::geometry::ray_packet::RayPacket;
use crate::lanes::LaneArray;
use crate::numeric::axes::axes;
use crate::{Lanes, Ray, Sphere};
use glam::Vec3;

/// The rays of a packet in registers, as the tiers read them.
#[derive(Clone, Copy, Debug)]
pub struct RayLanes<L: Lanes> {
    pub(crate) origin: [L; 3],
    pub(crate) direction: [L; 3],
    pub(crate) t_min: L,
    pub(crate) t_max: L,
    /// The lanes whose ray rule 1 lets hit anything, and whose interval is not empty.
    pub(crate) live: L::Mask,
}

impl<L: Lanes> RayLanes<L> {
    #[inline(always)]
    pub(crate) fn load(token: L::Token, packet: &RayPacket<L::Array>) -> Self {
        let origin = axes!(i => L::load(token, &packet.origin[i]));
        let direction = axes!(i => L::load(token, &packet.direction[i]));
        let (t_min, t_max) = (L::load(token, &packet.t_min), L::load(token, &packet.t_max));

        let zero = L::splat(token, 0.0);
        let along = axes!(i => direction[i].lt(zero) | zero.lt(direction[i]));
        let directed = along[0] | along[1] | along[2];
        let live = all_finite(origin) & all_finite(direction) & directed & t_min.le(t_max);
        Self { origin, direction, t_min, t_max, live }
    }

    /// The ray of the first lane.
    #[inline(always)]
    pub(super) fn first(&self) -> Ray {
        let [ox, oy, oz] = axes!(i => self.origin[i].store().get(0));
        let [dx, dy, dz] = axes!(i => self.direction[i].store().get(0));
        let (origin, direction) = (Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz));
        let (t_min, t_max) = (self.t_min.store().get(0), self.t_max.store().get(0));
        Ray { origin, direction, t_min, t_max }
    }

    /// The lanes in which rule 3 accepts `t`.
    #[inline(always)]
    pub(super) fn accept(&self, t: L) -> L::Mask {
        self.t_min.le(t) & t.le(self.t_max) & t.abs().le(t.like(f32::MAX))
    }
}

/// The lanes in which no component is NaN or infinite.
#[inline(always)]
pub(crate) fn all_finite<L: Lanes>(v: [L; 3]) -> L::Mask {
    let largest = v[0].like(f32::MAX);
    v[0].abs().le(largest) & v[1].abs().le(largest) & v[2].abs().le(largest)
}

/// Where the lines of a packet meet a sphere, as a tier computed it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Roots<L: Lanes> {
    /// Whether the line meets the sphere at all; tangents do.
    pub(super) meets: L::Mask,
    /// The smaller root; unspecified if the line does not meet the sphere.
    pub(super) near: L,
    /// The larger root.
    pub(super) far: L,
}

impl<L: Lanes> Roots<L> {
    /// The accepted t of rules 2 to 4, `+inf` if there is none.
    #[inline(always)]
    pub(super) fn first_accepted(&self, rays: &RayLanes<L>) -> L {
        // Adding zero turns -0 into +0.
        let zero = self.near.like(0.0);
        let (near, far) = (self.near + zero, self.far + zero);
        let far = L::select(self.meets & rays.accept(far), far, zero.like(f32::INFINITY));
        L::select(self.meets & rays.accept(near), near, far)
    }
}

/// Both roots of one line, by the lanes of a tier that always computes both roots.
#[inline(always)]
pub(super) fn line_roots_of<P>(
    prepare: impl Fn(&RayLanes<f32>) -> P,
    roots: impl Fn(&P, [f32; 3], f32) -> Roots<f32>,
    ray: &Ray,
    sphere: &Sphere,
) -> Option<[f32; 2]> {
    let rays = RayLanes::load((), &RayPacket::<[f32; 1]>::new(&[*ray]));
    let roots = roots(&prepare(&rays), sphere.center.to_array(), sphere.radius);
    roots.meets.then_some([roots.near + 0.0, roots.far + 0.0])
}
