//! What a ray hits.

use crate::lanes::LaneArray;

/// The closest accepted intersection of one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Where, in multiples of the ray's direction; finite, in the ray's interval, never `-0`.
    pub t: f32,
    /// The index of the sphere in its list.
    pub sphere: u32,
}

/// The index that stands for "no sphere".
pub(super) const NO_SPHERE: u32 = u32::MAX;

/// A [`Hit`] or none for every lane of a packet, in plain arrays: sixteen lanes unless `A` says
/// otherwise.
///
/// Only the kernel writes into it. To merge answers of your own, keep `Hit`s: [`compare_hits`](crate::compare_hits) says which of two comes
/// first.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct HitPacket<A: LaneArray = [f32; 16]> {
    alignment: A::Alignment,
    pub(crate) t: A,
    pub(crate) sphere: A::Ids,
}

impl<A: LaneArray> HitPacket<A> {
    /// The index that stands for "no sphere".
    pub const NO_SPHERE: u32 = NO_SPHERE;

    /// No hit in any lane: `t` is `+inf`, the sphere [`Self::NO_SPHERE`].
    ///
    /// ```
    /// use spherule_kernel::HitPacket;
    ///
    /// assert_eq!(HitPacket::<[f32; 4]>::none().t(), [f32::INFINITY; 4]);
    /// ```
    #[must_use]
    #[inline(always)]
    pub const fn none() -> Self {
        Self { alignment: A::ALIGNMENT, t: A::INFINITIES, sphere: A::NO_IDS }
    }

    /// Takes `hit` in `lane` if it is closer than the known hit; if both have the same t, `is_closer` decides, by the
    /// index of the known one.
    #[inline(always)]
    pub(crate) fn take(&mut self, lane: usize, hit: Hit, is_closer: impl FnOnce(u32) -> bool) {
        if let (Some(t), Some(sphere)) =
            (self.t.as_mut().get_mut(lane), self.sphere.as_mut().get_mut(lane))
            && (hit.t < *t || (hit.t == *t && is_closer(*sphere)))
        {
            *t = hit.t;
            *sphere = hit.sphere;
        }
    }

    /// The `t` of every lane; `+inf` if the ray hits nothing.
    ///
    /// ```
    /// use spherule_kernel::{
    ///     Exact, HitPacket, Intersect, Ray, RayPacket, SphereList, Trace, Vec3,
    /// };
    ///
    /// let list = SphereList::from([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let mut hits = [HitPacket::none()];
    /// list.closest_hit_packets(Exact, &mut Trace::new(), &rays, &mut hits);
    /// assert_eq!(hits[0].t()[..2], [4.0, f32::INFINITY]);
    /// ```
    #[must_use]
    pub fn t(&self) -> &[f32] {
        self.t.as_ref()
    }

    /// The sphere index of every lane; [`Self::NO_SPHERE`] if the ray hits nothing.
    ///
    /// ```
    /// use spherule_kernel::{
    ///     Exact, HitPacket, Intersect, Ray, RayPacket, SphereList, Trace, Vec3,
    /// };
    ///
    /// let list = SphereList::from([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let mut hits = [HitPacket::none()];
    /// list.closest_hit_packets(Exact, &mut Trace::new(), &rays, &mut hits);
    /// assert_eq!(hits[0].spheres()[..2], [0, u32::MAX]);
    /// ```
    #[must_use]
    pub fn spheres(&self) -> &[u32] {
        self.sphere.as_ref()
    }

    /// The hit in `lane`; `None` if there is none, or no such lane.
    ///
    /// ```
    /// use spherule_kernel::{
    ///     Exact, HitPacket, Intersect, Ray, RayPacket, SphereList, Trace, Vec3,
    /// };
    ///
    /// let list = SphereList::from([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let mut hits = [HitPacket::none()];
    /// list.closest_hit_packets(Exact, &mut Trace::new(), &rays, &mut hits);
    /// assert_eq!(hits[0].hit(0).map(|hit| hit.t), Some(4.0));
    /// assert_eq!(hits[0].hit(16), None);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn hit(&self, lane: usize) -> Option<Hit> {
        let hit = Hit { t: *self.t().get(lane)?, sphere: *self.spheres().get(lane)? };
        // Made before it is needed. (With `then_some`, t was loaded behind a branch, which the CPU cannot predict where hits and misses
        // alternate: 1.9 ns a ray of slices.)
        let some = Some(hit);
        if hit.sphere != Self::NO_SPHERE { some } else { None }
    }

    /// The hit of every lane, in order.
    ///
    /// ```
    /// use spherule_kernel::{
    ///     Exact, HitPacket, Intersect, Ray, RayPacket, SphereList, Trace, Vec3,
    /// };
    ///
    /// let list = SphereList::from([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let mut hits = [HitPacket::none()];
    /// list.closest_hit_packets(Exact, &mut Trace::new(), &rays, &mut hits);
    /// assert_eq!(hits[0].hits().flatten().count(), 1);
    /// ```
    pub fn hits(&self) -> impl ExactSizeIterator<Item = Option<Hit>> {
        (0..A::COUNT).map(|lane| self.hit(lane))
    }
}
