//! The surface that a ray has hit.

use crate::lanes::LaneArray;
use glam::Vec3;

/// The surface of a sphere where a ray hits it: made by [`surface`](crate::surface()).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// The unit normal, which points out of the sphere.
    pub normal: Vec3,
    /// The point as seen from the sphere's centre, in the units of the scene.
    pub point: Vec3,
    /// What rounding takes from `point`, as double precision knows it.
    pub(crate) rest: Vec3,
}

/// A [`Surface`] for every lane of a packet, in plain arrays: sixteen lanes unless `A` says otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct SurfacePacket<A: LaneArray = [f32; 16]> {
    alignment: A::Alignment,
    pub(crate) normal: [A; 3],
    pub(crate) point: [A; 3],
    /// What rounding takes from `point`, as double precision knows it.
    pub(crate) rest: [A; 3],
}

impl<A: LaneArray> SurfacePacket<A> {
    /// Zeros in every lane, as of rays that hit nothing.
    ///
    /// ```
    /// use spherule_kernel::{SurfacePacket, Vec3};
    ///
    /// assert_eq!(SurfacePacket::<[f32; 4]>::none().normal(0), Vec3::ZERO);
    /// ```
    #[must_use]
    #[inline(always)]
    pub const fn none() -> Self {
        let zeros = [A::ZEROS; 3];
        Self { alignment: A::ALIGNMENT, normal: zeros, point: zeros, rest: zeros }
    }

    /// The unit normal of every lane, coordinate by coordinate; zeros if the ray hits nothing.
    ///
    /// ```
    /// use spherule_kernel::{
    ///     Exact, HitPacket, Intersect, Level, Ray, RayPacket, SphereTree, SurfacePacket, Trace, Vec3, surface_packets,
    /// };
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let (mut hits, mut surfaces) = ([HitPacket::none()], [SurfacePacket::none()]);
    /// tree.closest_hit_packets(Exact, &mut Trace::new(), &rays, &mut hits);
    /// surface_packets(Exact, Level::best(), tree.list().spheres(), &rays, &hits, &mut surfaces);
    /// assert_eq!(surfaces[0].normals()[2][..2], [-1.0, 0.0]);
    /// ```
    #[must_use]
    pub fn normals(&self) -> [&[f32]; 3] {
        self.normal.each_ref().map(A::as_ref)
    }

    /// The point of every lane as seen from the sphere's centre, coordinate by coordinate.
    ///
    /// ```
    /// use spherule_kernel::{
    ///     Exact, HitPacket, Intersect, Level, Ray, RayPacket, SphereTree, SurfacePacket, Trace, Vec3, surface_packets,
    /// };
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let (mut hits, mut surfaces) = ([HitPacket::none()], [SurfacePacket::none()]);
    /// tree.closest_hit_packets(Exact, &mut Trace::new(), &rays, &mut hits);
    /// surface_packets(Exact, Level::best(), tree.list().spheres(), &rays, &hits, &mut surfaces);
    /// assert_eq!(surfaces[0].points()[2][..2], [-1.0, 0.0]);
    /// ```
    #[must_use]
    pub fn points(&self) -> [&[f32]; 3] {
        self.point.each_ref().map(A::as_ref)
    }

    /// The unit normal in `lane`; zero if there is no such lane.
    ///
    /// ```
    /// use spherule_kernel::{
    ///     Exact, HitPacket, Intersect, Level, Ray, RayPacket, SphereTree, SurfacePacket, Trace, Vec3, surface_packets,
    /// };
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let (mut hits, mut surfaces) = ([HitPacket::none()], [SurfacePacket::none()]);
    /// tree.closest_hit_packets(Exact, &mut Trace::new(), &rays, &mut hits);
    /// surface_packets(Exact, Level::best(), tree.list().spheres(), &rays, &hits, &mut surfaces);
    /// assert_eq!(surfaces[0].normal(0), Vec3::NEG_Z);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn normal(&self, lane: usize) -> Vec3 {
        at(&self.normal, lane)
    }

    /// The point in `lane` as seen from the sphere's centre; zero if there is no such lane.
    ///
    /// ```
    /// use spherule_kernel::{
    ///     Exact, HitPacket, Intersect, Level, Ray, RayPacket, SphereTree, SurfacePacket, Trace, Vec3, surface_packets,
    /// };
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let (mut hits, mut surfaces) = ([HitPacket::none()], [SurfacePacket::none()]);
    /// tree.closest_hit_packets(Exact, &mut Trace::new(), &rays, &mut hits);
    /// surface_packets(Exact, Level::best(), tree.list().spheres(), &rays, &hits, &mut surfaces);
    /// assert_eq!(surfaces[0].point(0), Vec3::NEG_Z);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn point(&self, lane: usize) -> Vec3 {
        at(&self.point, lane)
    }

    /// The surface in `lane`; zeros if the ray hits nothing, or there is no such lane.
    ///
    /// ```
    /// use spherule_kernel::{
    ///     Exact, HitPacket, Intersect, Level, Ray, RayPacket, SphereTree, SurfacePacket, Trace, Vec3, surface_packets,
    /// };
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let (mut hits, mut surfaces) = ([HitPacket::none()], [SurfacePacket::none()]);
    /// tree.closest_hit_packets(Exact, &mut Trace::new(), &rays, &mut hits);
    /// surface_packets(Exact, Level::best(), tree.list().spheres(), &rays, &hits, &mut surfaces);
    /// assert_eq!(surfaces[0].surface(0).normal, Vec3::NEG_Z);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn surface(&self, lane: usize) -> Surface {
        let rest = at(&self.rest, lane);
        Surface { normal: self.normal(lane), point: self.point(lane), rest }
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, surface: &Surface) {
        for axis in 0..3 {
            self.normal[axis].set(lane, surface.normal[axis]);
            self.point[axis].set(lane, surface.point[axis]);
            self.rest[axis].set(lane, surface.rest[axis]);
        }
    }
}

#[inline(always)]
fn at<A: LaneArray>([x, y, z]: &[A; 3], lane: usize) -> Vec3 {
    if lane < A::COUNT { Vec3::new(x.get(lane), y.get(lane), z.get(lane)) } else { Vec3::ZERO }
}
