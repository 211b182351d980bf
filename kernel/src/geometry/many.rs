//! Many rays of a caller's, and where their answers go: a slice of them, columns, or packets.

use super::columns::{HitColumns, RayColumns};
use super::hit::{Hit, HitPacket};
use super::ray::{Ray, RayPacket};
use crate::lanes::Lanes;

/// Rays of a caller's, from which packets are filled.
#[derive(Clone, Copy, Debug)]
pub enum ManyRays<'a> {
    /// One behind the other: transposed.
    Slice(&'a [Ray]),
    /// As packets have them.
    Columns(RayColumns<'a>),
    /// In packets, of which parts are whole ones.
    #[cfg(feature = "alloc")]
    Packets(&'a [RayPacket]),
}

#[cfg(feature = "alloc")]
const INACTIVE: RayPacket = RayPacket::inactive();

impl ManyRays<'_> {
    /// How many there are.
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
            Self::Columns(rays) => Self::Columns(rays.part(from, to)),
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

    /// Copies the rays of those numbers.
    #[cfg(feature = "alloc")]
    pub(crate) fn gather(&self, numbers: impl Iterator<Item = usize>, rays: &mut [Ray]) {
        // What they are is asked once.
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

/// Where the closest hits of rays go.
#[derive(Debug)]
pub enum ManyHits<'a> {
    /// One behind the other.
    Slice(&'a mut [Option<Hit>]),
    /// As packets have them.
    Columns(HitColumns<'a>),
    /// In packets.
    #[cfg(feature = "alloc")]
    Packets(&'a mut [HitPacket]),
}

impl ManyHits<'_> {
    /// How many there is room for.
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::Slice(hits) => hits.len(),
            Self::Columns(hits) => hits.len(),
            #[cfg(feature = "alloc")]
            Self::Packets(packets) => packets.len() * RayPacket::COUNT,
        }
    }

    /// Writes what rays hit, those of packets at the places `indices`.
    #[cfg(feature = "alloc")]
    pub(crate) fn scatter(&mut self, packets: &[HitPacket], indices: impl Iterator<Item = usize>) {
        // Where they go is asked once.
        match self {
            Self::Slice(_) => each_lane(packets, indices, |packet, lane, index| {
                self.set(index, packet.hit(lane));
            }),
            Self::Columns(_) => each_lane(packets, indices, |packet, lane, index| {
                self.set(index, packet.hit(lane));
            }),
            Self::Packets(_) => each_lane(packets, indices, |packet, lane, index| {
                self.set(index, packet.hit(lane));
            }),
        }
    }

    /// Writes what one ray hits at place `index`.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn set(&mut self, index: usize, one: Option<Hit>) {
        match self {
            Self::Slice(hits) => {
                if let Some(hit) = hits.get_mut(index) {
                    *hit = one;
                }
            }
            Self::Columns(hits) => hits.set(index, one),
            Self::Packets(packets) => {
                if let Some(HitPacket { t, sphere, .. }) = packets.get_mut(index / RayPacket::COUNT)
                {
                    HitColumns { t, sphere }.set(index % RayPacket::COUNT, one);
                }
            }
        }
    }

    /// Writes the hits of packets from place `from` on, before place `to`.
    #[inline(always)]
    pub(crate) fn write(&mut self, packets: &[HitPacket], from: usize, to: usize) {
        match self {
            Self::Slice(hits) => write_slice(packets, hits.get_mut(from..to).unwrap_or_default()),
            Self::Columns(hits) => hits.write(packets, from, to),
            #[cfg(feature = "alloc")]
            Self::Packets(hits) => copy_packets(packets, hits, from, to),
        }
    }
}

/// (`get_mut`, since for size the compiler keeps the checks of an index. Three stores a hit: in vectors they would have to be shuffled by three, which the layout of `Option` does not allow.)
#[inline(always)]
fn write_slice(packets: &[HitPacket], hits: &mut [Option<Hit>]) {
    let mut at = 0;
    for packet in packets {
        let rest = hits.get_mut(at..).unwrap_or_default();
        at += 16;
        if let Some(sixteen) = rest.first_chunk_mut::<16>() {
            for lane in 0..16 {
                if let Some(hit) = sixteen.get_mut(lane) {
                    *hit = packet.hit(lane);
                }
            }
            continue;
        }
        for lane in 0..16 {
            if let Some(hit) = rest.get_mut(lane) {
                *hit = packet.hit(lane);
            }
        }
    }
}

/// Whether rays hit anything: where that goes.
#[derive(Debug)]
pub enum ManyOccluded<'a> {
    /// One behind the other.
    Slice(&'a mut [bool]),
    /// A lane's bit of packets.
    #[cfg(feature = "alloc")]
    Packets(&'a mut [u32]),
}

impl ManyOccluded<'_> {
    /// How many there is room for.
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::Slice(occluded) => occluded.len(),
            #[cfg(feature = "alloc")]
            Self::Packets(packets) => packets.len() * RayPacket::COUNT,
        }
    }

    /// Writes whether rays hit anything, those of packets at the places `indices`.
    #[cfg(feature = "alloc")]
    pub(crate) fn scatter(&mut self, packets: &[u32], indices: impl Iterator<Item = usize>) {
        match self {
            Self::Slice(_) => each_lane(packets, indices, |bits, lane, index| {
                self.set(index, bits >> lane & 1 == 1);
            }),
            Self::Packets(_) => each_lane(packets, indices, |bits, lane, index| {
                self.set(index, bits >> lane & 1 == 1);
            }),
        }
    }

    /// Writes whether one ray hits anything at place `index`.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn set(&mut self, index: usize, one: bool) {
        match self {
            Self::Slice(occluded) => {
                if let Some(occluded) = occluded.get_mut(index) {
                    *occluded = one;
                }
            }
            Self::Packets(packets) => {
                if let Some(bits) = packets.get_mut(index / RayPacket::COUNT) {
                    let lane = index % RayPacket::COUNT;
                    *bits = *bits & !(1 << lane) | u32::from(one) << lane;
                }
            }
        }
    }

    /// Writes the answers of packets from place `from` on, before place `to`.
    #[inline(always)]
    pub(crate) fn write(&mut self, packets: &[u32], from: usize, to: usize) {
        match self {
            Self::Slice(occluded) => {
                write_occluded(packets, occluded.get_mut(from..to).unwrap_or_default());
            }
            #[cfg(feature = "alloc")]
            Self::Packets(occluded) => copy_packets(packets, occluded, from, to),
        }
    }
}

/// Calls `write` with each lane of packets, and the next of `indices`.
#[cfg(feature = "alloc")]
#[inline(always)]
fn each_lane<P>(
    packets: &[P],
    mut indices: impl Iterator<Item = usize>,
    mut write: impl FnMut(&P, usize, usize),
) {
    for packet in packets {
        for lane in 0..RayPacket::COUNT {
            let Some(index) = indices.next() else { return };
            write(packet, lane, index);
        }
    }
}

/// Copies the answers of packets to those of the rays from `from` on, before `to`, which are whole packets.
#[cfg(feature = "alloc")]
fn copy_packets<P: Copy>(packets: &[P], answers: &mut [P], from: usize, to: usize) {
    let to = to.div_ceil(RayPacket::COUNT).min(answers.len());
    let answers = answers.get_mut(from / RayPacket::COUNT..to).unwrap_or_default();
    for (answer, packet) in answers.iter_mut().zip(packets) {
        *answer = *packet;
    }
}

/// Writes a lane's bit of packets as a truth value each.
#[inline(always)]
fn write_occluded(packets: &[u32], occluded: &mut [bool]) {
    let mut at = 0;
    for bits in packets {
        let rest = occluded.get_mut(at..).unwrap_or_default();
        at += 16;
        if let Some(sixteen) = rest.first_chunk_mut::<16>() {
            // Not shifted: that has a vector instruction from AVX2 on.
            for lane in 0..16 {
                if let Some(occluded) = sixteen.get_mut(lane) {
                    *occluded = bits & 1 << lane != 0;
                }
            }
            continue;
        }
        for lane in 0..16 {
            if let Some(occluded) = rest.get_mut(lane) {
                *occluded = bits & 1 << lane != 0;
            }
        }
    }
}

#[cfg(all(test, proofs))]
#[cfg(feature = "alloc")]
mod tests {
    use super::{ManyHits, ManyOccluded, ManyRays};
    use crate::{Hit, HitPacket, Ray, RayPacket, Vec3};

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

    /// What was there before is no answer.
    #[test]
    fn answers_are_written_over_those_before() {
        let mut before = HitPacket::none();
        (before.t, before.sphere) = ([1.0; 16], [7; 16]);
        let mut hits = [before; 3];
        let mut many = ManyHits::Packets(&mut hits);
        assert_eq!(many.count(), 48);
        let hit = Some(Hit { t: 4.0, sphere: 9 });
        many.set(17, hit);
        many.set(18, None);
        many.write(&[HitPacket::none(); 5], 32, 48);
        let at = |number: usize| hits[number / 16].hit(number % 16);
        let untouched = Some(Hit { t: 1.0, sphere: 7 });
        assert_eq!([at(16), at(17), at(18), at(31)], [untouched, hit, None, untouched]);
        assert_eq!(hits[2], HitPacket::none());

        let mut bits = [0xffff, 0, 5];
        let mut many = ManyOccluded::Packets(&mut bits);
        many.set(3, false);
        many.set(20, true);
        many.write(&[9; 5], 32, 48);
        assert_eq!((many.count(), bits), (48, [0xfff7, 16, 9]));
    }
}
