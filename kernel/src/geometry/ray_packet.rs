//! Rays in packets.

use super::ray::Ray;
use crate::lanes::{LaneArray, Lanes};
use glam::Vec3;

/// A packet of rays, component by component, in plain arrays: sixteen rays unless `A` says otherwise.
///
/// A packet is memory, not registers: it holds no vector type, so it may be made on one side of a
/// run-time dispatch and read on the other.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct RayPacket<A: LaneArray = [f32; 16]> {
    pub(crate) alignment: A::Alignment,
    pub(crate) origin: [A; 3],
    pub(crate) direction: [A; 3],
    pub(crate) t_min: A,
    pub(crate) t_max: A,
}

impl<A: LaneArray> RayPacket<A> {
    /// Memory for a packet: zeros, which are cleared faster than inactive rays are copied.
    pub(crate) const BLANK: Self = Self {
        alignment: A::ALIGNMENT,
        origin: [A::ZEROS; 3],
        direction: [A::ZEROS; 3],
        t_min: A::ZEROS,
        t_max: A::ZEROS,
    };

    /// A packet whose every lane is [`Ray::INACTIVE`].
    ///
    /// ```
    /// use spherule_kernel::{Ray, RayPacket};
    ///
    /// let packet: RayPacket = RayPacket::inactive();
    /// assert_eq!((packet.live(), packet.ray(0)), (0, Ray::INACTIVE));
    /// ```
    #[must_use]
    #[inline(always)]
    pub const fn inactive() -> Self {
        Self {
            alignment: A::ALIGNMENT,
            origin: [A::ZEROS; 3],
            direction: [A::ZEROS; 3],
            t_min: A::INFINITIES,
            t_max: A::MINUS_INFINITIES,
        }
    }

    /// Ray `i` in lane `i`; lanes past the end of `rays` are inactive, rays past the last lane
    /// are left out.
    ///
    /// ```
    /// use spherule_kernel::{Ray, RayPacket, Vec3};
    ///
    /// let packet = RayPacket::<[f32; 4]>::new(&[Ray::new(Vec3::ZERO, Vec3::Z)]);
    /// assert_eq!(packet.live(), 0b0001);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn new(rays: &[Ray]) -> Self {
        let mut packet = Self::inactive();
        for (lane, ray) in rays.iter().take(A::COUNT).enumerate() {
            packet.set(lane, ray);
        }
        packet
    }

    /// Fills the packet as [`new`](Self::new) does from `rays`, in lanes: a whole packet of rays is transposed in
    /// registers.
    #[inline(always)]
    pub(crate) fn fill<L: Lanes<Array = A>>(&mut self, token: L::Token, rays: &[Ray]) {
        let Some(rays) = rays.get(..A::COUNT) else {
            return L::out_of_line(
                token,
                #[inline(always)]
                || *self = Self::new(rays),
            );
        };
        let [ox, oy, oz, dx, dy, dz, t_min, t_max] = L::columns(
            token,
            #[inline(always)]
            |lane| match rays.get(lane) {
                Some(ray) => ray.row(),
                None => [0.0; 8],
            },
        );
        (self.origin, self.direction) = ([ox, oy, oz], [dx, dy, dz]);
        (self.t_min, self.t_max) = (t_min, t_max);
    }

    /// Puts `ray` in `lane`; does nothing if there is no such lane.
    ///
    /// ```
    /// use spherule_kernel::{Ray, RayPacket, Vec3};
    ///
    /// let mut packet = RayPacket::<[f32; 4]>::inactive();
    /// packet.set(2, &Ray::new(Vec3::ZERO, Vec3::Z));
    /// assert_eq!(packet.live(), 0b0100);
    /// ```
    #[inline(always)]
    pub fn set(&mut self, lane: usize, ray: &Ray) {
        if lane >= A::COUNT {
            return;
        }
        let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
        for axis in 0..3 {
            self.origin[axis].set(lane, origin[axis]);
            self.direction[axis].set(lane, direction[axis]);
        }
        self.t_min.set(lane, ray.t_min);
        self.t_max.set(lane, ray.t_max);
    }

    /// The ray in `lane`; [`Ray::INACTIVE`] if there is no such lane.
    ///
    /// ```
    /// use spherule_kernel::{Ray, RayPacket, Vec3};
    ///
    /// let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    /// let packet = RayPacket::<[f32; 4]>::new(&[ray]);
    /// assert_eq!([packet.ray(0), packet.ray(9)], [ray, Ray::INACTIVE]);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn ray(&self, lane: usize) -> Ray {
        if lane >= A::COUNT {
            return Ray::INACTIVE;
        }
        let ([ox, oy, oz], [dx, dy, dz]) = (&self.origin, &self.direction);
        Ray {
            origin: Vec3::new(ox.get(lane), oy.get(lane), oz.get(lane)),
            direction: Vec3::new(dx.get(lane), dy.get(lane), dz.get(lane)),
            t_min: self.t_min.get(lane),
            t_max: self.t_max.get(lane),
        }
    }

    /// The direction of every lane, coordinate by coordinate.
    ///
    /// ```
    /// use spherule_kernel::{Ray, RayPacket, Vec3};
    ///
    /// let packet = RayPacket::<[f32; 4]>::new(&[Ray::new(Vec3::ZERO, Vec3::Z)]);
    /// assert_eq!(packet.directions()[2], [1.0, 0.0, 0.0, 0.0]);
    /// ```
    #[must_use]
    pub fn directions(&self) -> [&[f32]; 3] {
        self.direction.each_ref().map(A::as_ref)
    }

    /// Which lanes hold a [live](Ray::is_live) ray, a bit a lane.
    ///
    /// ```
    /// use spherule_kernel::{Ray, RayPacket, Vec3};
    ///
    /// let rays = [Ray::new(Vec3::ZERO, Vec3::X), Ray::INACTIVE, Ray::new(Vec3::ZERO, Vec3::Y)];
    /// let packet = RayPacket::<[f32; 8]>::new(&rays);
    /// assert_eq!((packet.live(), packet.directions()[1]), (0b101, &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0][..]));
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn live(&self) -> u32 {
        let ([ox, oy, oz], [dx, dy, dz]) = (&self.origin, &self.direction);
        let mut live = 0;
        for lane in 0..A::COUNT {
            // No branches, so that the compiler takes several lanes at a time: x - x is zero unless x is NaN or infinite.
            let mut not_finite = 0.0;
            for axis in [ox, oy, oz, dx, dy, dz] {
                not_finite += axis.get(lane) - axis.get(lane);
            }
            let is_finite = not_finite == 0.0;
            let goes = (dx.get(lane) != 0.0) | (dy.get(lane) != 0.0) | (dz.get(lane) != 0.0);
            let is_open = self.t_min.get(lane) <= self.t_max.get(lane);
            live |= u32::from(is_finite & goes & is_open) << lane;
        }
        live
    }
}

/// Cuts rays into packets on the stack, for [`RayPacket`]s of sixteen.
impl RayPacket {
    /// How many rays a packet holds: sixteen.
    pub const COUNT: usize = 16;

    /// Packs `rays` into `packets`, and returns the packets that were filled. The last is filled up
    /// with inactive lanes. Rays that find no room are left out.
    ///
    /// ```
    /// use spherule_kernel::{Ray, RayPacket, Vec3};
    ///
    /// let rays = [Ray::new(Vec3::ZERO, Vec3::Z); 20];
    /// let mut packets = [RayPacket::inactive(); 4];
    /// let filled = RayPacket::pack(&rays, &mut packets);
    /// assert_eq!((filled.len(), filled[1].live()), (2, 0b1111));
    /// ```
    pub fn pack<'a>(rays: &[Ray], packets: &'a mut [Self]) -> &'a [Self] {
        let mut filled = 0;
        let mut rest = rays;
        for packet in packets.iter_mut() {
            if rest.is_empty() {
                break;
            }
            *packet = Self::new(rest);
            rest = rest.get(Self::COUNT..).unwrap_or_default();
            filled += 1;
        }
        packets.get(..filled).unwrap_or_default()
    }
}
