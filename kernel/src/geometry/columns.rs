//! A caller's rays and hits in columns: a slice for each of their numbers.

use super::hit::{Hit, HitPacket, NO_SPHERE};
use super::ray::Ray;
use super::ray_packet::RayPacket;
use crate::lanes::{LaneArray, Lanes};
use crate::numeric::axes::axes;
use core::ops::Range;
use glam::Vec3;

/// Rays in eight columns, the form in which arrays, tables and simulations have them: ray `i` consists of number `i` of each.
///
/// There are as many rays as the shortest column has numbers. No padding or alignment is needed.
///
/// ```
/// use spherule_kernel::{Ray, RayColumns, Vec3};
///
/// let (zero, one, infinity) = ([0.0; 2], [1.0; 2], [f32::INFINITY; 3]);
/// let rays = RayColumns {
///     origin: [&[0.0, 5.0], &zero, &zero],
///     direction: [&zero, &zero, &one],
///     t_min: &zero,
///     t_max: &infinity,
/// };
/// assert_eq!(rays.len(), 2);
/// assert_eq!(rays.ray(1), Some(Ray::new(Vec3::new(5.0, 0.0, 0.0), Vec3::Z)));
/// assert_eq!(rays.ray(2), None);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RayColumns<'a> {
    /// Where `t` is zero: x, y and z.
    pub origin: [&'a [f32]; 3],
    /// Towards greater `t`: x, y and z, of any length except zero.
    pub direction: [&'a [f32]; 3],
    /// The least accepted `t` of each ray.
    pub t_min: &'a [f32],
    /// The greatest accepted `t` of each ray.
    pub t_max: &'a [f32],
}

impl<'a> RayColumns<'a> {
    /// How many rays: as many as the shortest column has numbers.
    ///
    /// ```
    /// use spherule_kernel::RayColumns;
    ///
    /// let (zero, one, infinity) = ([0.0; 2], [1.0; 2], [f32::INFINITY; 2]);
    /// let rays =
    ///     RayColumns { origin: [&zero; 3], direction: [&zero, &zero, &one], t_min: &zero, t_max: &infinity };
    /// assert_eq!(rays.len(), 2);
    /// ```
    #[must_use]
    pub fn len(&self) -> usize {
        let ([ox, oy, oz], [dx, dy, dz]) = (self.origin, self.direction);
        let mut shortest = self.t_min.len();
        for column in [ox, oy, oz, dx, dy, dz, self.t_max] {
            shortest = shortest.min(column.len());
        }
        shortest
    }

    /// Whether there are no rays.
    ///
    /// ```
    /// use spherule_kernel::RayColumns;
    ///
    /// let (zero, one, infinity) = ([0.0; 2], [1.0; 2], [f32::INFINITY; 2]);
    /// let rays =
    ///     RayColumns { origin: [&zero; 3], direction: [&zero, &zero, &one], t_min: &zero, t_max: &infinity };
    /// assert!(!rays.is_empty());
    /// ```
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Ray `index`; `None` past the end.
    ///
    /// ```
    /// use spherule_kernel::{Ray, RayColumns, Vec3};
    ///
    /// let (zero, one, infinity) = ([0.0; 2], [1.0; 2], [f32::INFINITY; 2]);
    /// let rays =
    ///     RayColumns { origin: [&zero; 3], direction: [&zero, &zero, &one], t_min: &zero, t_max: &infinity };
    /// assert_eq!(rays.ray(1), Some(Ray::new(Vec3::ZERO, Vec3::Z)));
    /// assert_eq!(rays.ray(2), None);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn ray(&self, index: usize) -> Option<Ray> {
        let ([ox, oy, oz], [dx, dy, dz]) = (self.origin, self.direction);
        Some(Ray {
            origin: Vec3::new(*ox.get(index)?, *oy.get(index)?, *oz.get(index)?),
            direction: Vec3::new(*dx.get(index)?, *dy.get(index)?, *dz.get(index)?),
            t_min: *self.t_min.get(index)?,
            t_max: *self.t_max.get(index)?,
        })
    }

    /// The lanes of a packet.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn of(packet: &'a RayPacket) -> Self {
        Self {
            origin: packet.origin.each_ref().map(<[f32; 16]>::as_slice),
            direction: packet.direction.each_ref().map(<[f32; 16]>::as_slice),
            t_min: &packet.t_min,
            t_max: &packet.t_max,
        }
    }

    /// Returns the rays of a range, without those past the end: what a thread takes of all. Cost: nothing is copied.
    ///
    /// ```
    /// use spherule_kernel::{Ray, RayColumns, Vec3};
    ///
    /// let (zero, one, infinity) = ([0.0; 3], [1.0; 3], [f32::INFINITY; 3]);
    /// let origin: [&[f32]; 3] = [&[0.0, 1.0, 2.0], &zero, &zero];
    /// let rays = RayColumns { origin, direction: [&zero, &zero, &one], t_min: &zero, t_max: &infinity };
    /// assert_eq!(rays.part(1..3).ray(1), Some(Ray::new(Vec3::new(2.0, 0.0, 0.0), Vec3::Z)));
    /// assert_eq!([rays.part(2..4).len(), rays.part(3..5).len()], [1, 0]);
    /// ```
    #[must_use]
    pub fn part(&self, range: Range<usize>) -> Self {
        let Range { start, end } = range;
        let part = |column: &'a [f32]| column.get(start..end.min(column.len())).unwrap_or_default();
        Self {
            origin: self.origin.map(part),
            direction: self.direction.map(part),
            t_min: part(self.t_min),
            t_max: part(self.t_max),
        }
    }

    /// The packet of the rays from `first` on: a vector from each column.
    #[inline(always)]
    pub(crate) fn fill<L: Lanes>(
        &self,
        token: L::Token,
        first: usize,
        packet: &mut RayPacket<L::Array>,
    ) {
        if let ([Some(ox), Some(oy), Some(oz)], [Some(dx), Some(dy), Some(dz)]) = (
            axes!(i => L::Array::taken_at(self.origin[i], first)),
            axes!(i => L::Array::taken_at(self.direction[i], first)),
        ) && let (Some(t_min), Some(t_max)) =
            (L::Array::taken_at(self.t_min, first), L::Array::taken_at(self.t_max, first))
        {
            (packet.origin, packet.direction) = ([ox, oy, oz], [dx, dy, dz]);
            (packet.t_min, packet.t_max) = (t_min, t_max);
            return;
        }
        // The last packet, which is not full.
        L::out_of_line(
            token,
            #[inline(always)]
            || {
                *packet = RayPacket::inactive();
                for lane in 0..L::COUNT {
                    if let Some(ray) = self.ray(first + lane) {
                        packet.set(lane, &ray);
                    }
                }
            },
        );
    }
}

/// Where the hits of rays go, in two columns: the hit of ray `i` becomes number `i` of each.
///
/// A query writes as many hits as there are rays, but no more than the shorter column has numbers; it leaves later
/// numbers as they are.
#[derive(Debug)]
pub struct HitColumns<'a> {
    /// Where, in multiples of the ray's direction; `+inf` if the ray hits nothing.
    pub t: &'a mut [f32],
    /// The index of the sphere in its list; [`HitColumns::NO_SPHERE`] if the ray hits nothing.
    pub sphere: &'a mut [u32],
}

impl HitColumns<'_> {
    /// The index that stands for "no sphere".
    pub const NO_SPHERE: u32 = NO_SPHERE;

    /// How many hits there is room for: the shorter of the two columns.
    ///
    /// ```
    /// use spherule_kernel::HitColumns;
    ///
    /// let (mut t, mut sphere) = ([4.0, f32::INFINITY, 0.0], [7, HitColumns::NO_SPHERE]);
    /// let hits = HitColumns { t: &mut t, sphere: &mut sphere };
    /// assert_eq!(hits.len(), 2);
    /// ```
    #[must_use]
    pub fn len(&self) -> usize {
        self.t.len().min(self.sphere.len())
    }

    /// Whether there is room for none.
    ///
    /// ```
    /// use spherule_kernel::HitColumns;
    ///
    /// let (mut t, mut sphere) = ([4.0, f32::INFINITY, 0.0], [7, HitColumns::NO_SPHERE]);
    /// let hits = HitColumns { t: &mut t, sphere: &mut sphere };
    /// assert!(!hits.is_empty());
    /// ```
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Hit `index`; `None` if there is none, or past the end.
    ///
    /// ```
    /// use spherule_kernel::{Hit, HitColumns};
    ///
    /// let (mut t, mut sphere) = ([4.0, f32::INFINITY, 0.0], [7, HitColumns::NO_SPHERE]);
    /// let hits = HitColumns { t: &mut t, sphere: &mut sphere };
    /// assert_eq!([hits.hit(0), hits.hit(1)], [Some(Hit { t: 4.0, sphere: 7 }), None]);
    /// ```
    #[must_use]
    pub fn hit(&self, index: usize) -> Option<Hit> {
        let hit = Hit { t: *self.t.get(index)?, sphere: *self.sphere.get(index)? };
        (hit.sphere != Self::NO_SPHERE).then_some(hit)
    }

    /// Writes what one ray hits at place `index`.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn set(&mut self, index: usize, one: Option<Hit>) {
        let none = Hit { t: f32::INFINITY, sphere: Self::NO_SPHERE };
        let hit = one.unwrap_or(none);
        if let (Some(t), Some(sphere)) = (self.t.get_mut(index), self.sphere.get_mut(index)) {
            (*t, *sphere) = (hit.t, hit.sphere);
        }
    }

    /// Writes the hits of packets from place `from` on, before place `to`.
    #[inline(always)]
    pub(crate) fn write(&mut self, packets: &[HitPacket], from: usize, to: usize) {
        let (Some(t), Some(spheres)) = (self.t.get_mut(from..to), self.sphere.get_mut(from..to))
        else {
            return;
        };
        let mut at = 0;
        for packet in packets {
            let (t, spheres) =
                (t.get_mut(at..).unwrap_or_default(), spheres.get_mut(at..).unwrap_or_default());
            at += 16;
            if let (Some(t), Some(spheres)) =
                (t.first_chunk_mut::<16>(), spheres.first_chunk_mut::<16>())
            {
                (*t, *spheres) = (packet.t, packet.sphere);
                continue;
            }
            for lane in 0..16 {
                if let (Some(t), Some(sphere)) = (t.get_mut(lane), spheres.get_mut(lane))
                    && let (Some(at), Some(hit)) =
                        (packet.t.as_slice().get(lane), packet.sphere.as_slice().get(lane))
                {
                    (*t, *sphere) = (*at, *hit);
                }
            }
        }
    }
}
