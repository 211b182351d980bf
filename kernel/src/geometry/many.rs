//! A caller's many rays: a slice of them, columns, or packets.

use super::columns::RayColumns;
use super::ray::Ray;
use super::ray_packet::RayPacket;
use crate::lanes::Lanes;

/// A caller's rays, from which packets are filled.
#[derive(Clone, Copy, Debug)]
pub enum ManyRays<'a> {
    /// One after the other: transposed into packets.
    Slice(&'a [Ray]),
    /// In columns, as packets have them.
    Columns(RayColumns<'a>),
    /// In packets, of which parts are whole ones.
    #[cfg(feature = "alloc")]
    Packets(&'a [RayPacket]),
}

#[cfg(feature = "alloc")]
const INACTIVE: RayPacket = RayPacket::inactive();

impl ManyRays<'_> {
    /// How many rays there are.
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::Slice(rays) => rays.len(),
            Self::Columns(rays) => rays.len(),
            #[cfg(feature = "alloc")]
            Self::Packets(packets) => packets.len() * RayPacket::COUNT,
        }
    }

    /// Rays `from` to `to`.
    pub(crate) fn part(&self, from: usize, to: usize) -> Self {
        match self {
            Self::Slice(rays) => Self::Slice(rays.get(from..to).unwrap_or_default()),
            Self::Columns(rays) => Self::Columns(rays.part(from..to)),
            #[cfg(feature = "alloc")]
            Self::Packets(packets) => {
                let part = from / RayPacket::COUNT..to / RayPacket::COUNT;
                Self::Packets(packets.get(part).unwrap_or_default())
            }
        }
    }

    /// Ray `index`, if there is one.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn ray(&self, index: usize) -> Option<Ray> {
        match self {
            Self::Slice(rays) => rays.get(index).copied(),
            Self::Columns(rays) => rays.ray(index),
            Self::Packets(packets) => {
                let packet = packets.get(index / RayPacket::COUNT)?;
                Some(packet.ray(index % RayPacket::COUNT))
            }
        }
    }

    /// Copies the rays with these numbers.
    #[cfg(feature = "alloc")]
    pub(crate) fn gather(&self, numbers: impl Iterator<Item = usize>, rays: &mut [Ray]) {
        // Matched once for all.
        match self {
            Self::Slice(_) => self.gather_each(numbers, rays),
            Self::Columns(_) => self.gather_each(numbers, rays),
            Self::Packets(_) => self.gather_each(numbers, rays),
        }
    }

    #[cfg(feature = "alloc")]
    #[inline(always)]
    fn gather_each(&self, numbers: impl Iterator<Item = usize>, rays: &mut [Ray]) {
        for (place, number) in rays.iter_mut().zip(numbers) {
            if let Some(ray) = self.ray(number) {
                *place = ray;
            }
        }
    }

    /// Fills packets with the rays from packet `first` on; lanes past the last ray are inactive.
    #[inline(always)]
    pub(crate) fn fill<L: Lanes>(
        &self,
        token: L::Token,
        first: usize,
        packets: &mut [RayPacket<L::Array>],
    ) {
        match self {
            Self::Slice(rays) => {
                let mut rest = rays.get(first * L::COUNT..).unwrap_or_default();
                for packet in packets {
                    packet.fill::<L>(token, rest);
                    rest = rest.get(L::COUNT..).unwrap_or_default();
                }
            }
            Self::Columns(rays) => {
                for number in 0..packets.len() {
                    if let Some(packet) = packets.get_mut(number) {
                        rays.fill::<L>(token, (first + number) * L::COUNT, packet);
                    }
                }
            }
            #[cfg(feature = "alloc")]
            Self::Packets(all) => {
                for (number, packet) in packets.iter_mut().enumerate() {
                    let ray = (first + number) * L::COUNT;
                    let from = all.get(ray / RayPacket::COUNT).unwrap_or(&INACTIVE);
                    RayColumns::of(from).fill::<L>(token, ray % RayPacket::COUNT, packet);
                }
            }
        }
    }
}

#[cfg(all(test, proofs))]
#[cfg(feature = "alloc")]
mod tests {
    use super::ManyRays;
    use crate::{Ray, RayPacket, Vec3};

    fn ray(number: usize) -> Ray {
        Ray::new(Vec3::splat(number as f32), Vec3::Z)
    }

    #[test]
    fn packets_are_rays_by_their_numbers() {
        let packets: [RayPacket; 3] = core::array::from_fn(|packet| {
            RayPacket::new(&core::array::from_fn::<_, 16, _>(|lane| ray(16 * packet + lane)))
        });
        let rays = ManyRays::Packets(&packets);
        assert_eq!((rays.count(), rays.ray(47), rays.ray(48)), (48, Some(ray(47)), None));
        let part = rays.part(16, 48);
        assert_eq!((part.count(), part.ray(0)), (32, Some(ray(16))));
        let mut filled = [RayPacket::<[f32; 4]>::inactive(); 9];
        part.fill::<wide::f32x4>((), 0, &mut filled);
        assert_eq!([filled[7].ray(3), filled[8].ray(0)], [ray(47), Ray::INACTIVE]);
    }
}
