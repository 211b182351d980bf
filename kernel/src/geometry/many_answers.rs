//! Where the answers of many rays go: slices, columns, or packets.

use super::columns::HitColumns;
use super::hit::{Hit, HitPacket};
#[cfg(feature = "alloc")]
use super::ray_packet::RayPacket;

/// Where the answers of many rays go.
pub trait ManyAnswers {
    /// What a packet of sixteen rays is answered with.
    type Packet;
    /// What one ray is answered with.
    type One;

    /// How many answers there is room for.
    fn count(&self) -> usize;
    /// Writes the answers of packets, lane by lane, to the places `indices`.
    #[cfg(feature = "alloc")]
    fn scatter(&mut self, packets: &[Self::Packet], indices: impl Iterator<Item = usize>);
    /// Writes the answer of one ray at place `index`.
    #[cfg(feature = "alloc")]
    fn set(&mut self, index: usize, one: Self::One);
    /// Writes the answers of packets from place `from` on, before place `to`. With `std` it is compiled for each level.
    /// Else it is a call, so that it is compiled with this crate: in a user's dev build it took longer than tracing the
    /// rays.
    fn write(&mut self, packets: &[Self::Packet], from: usize, to: usize);
}

/// Where the closest hits of rays go.
#[derive(Debug)]
pub enum ManyHits<'a> {
    /// One after the other in memory.
    Slice(&'a mut [Option<Hit>]),
    /// In columns, as packets have them.
    Columns(HitColumns<'a>),
    /// In packets.
    #[cfg(feature = "alloc")]
    Packets(&'a mut [HitPacket]),
}

impl ManyAnswers for ManyHits<'_> {
    type Packet = HitPacket;
    type One = Option<Hit>;

    #[inline(always)]
    fn count(&self) -> usize {
        match self {
            Self::Slice(hits) => hits.len(),
            Self::Columns(hits) => hits.len(),
            #[cfg(feature = "alloc")]
            Self::Packets(packets) => packets.len() * RayPacket::COUNT,
        }
    }

    #[cfg(feature = "alloc")]
    fn scatter(&mut self, packets: &[HitPacket], indices: impl Iterator<Item = usize>) {
        // Matched once, not for each ray.
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

    #[cfg(feature = "alloc")]
    #[inline(always)]
    fn set(&mut self, index: usize, one: Option<Hit>) {
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

    #[cfg_attr(feature = "std", inline(always))]
    #[cfg_attr(not(feature = "std"), inline(never))]
    fn write(&mut self, packets: &[HitPacket], from: usize, to: usize) {
        match self {
            Self::Slice(hits) => write_slice(packets, hits.get_mut(from..to).unwrap_or_default()),
            Self::Columns(hits) => hits.write(packets, from, to),
            #[cfg(feature = "alloc")]
            Self::Packets(hits) => copy_packets(packets, hits, from, to),
        }
    }
}

/// (`get_mut`, since a compiler that optimises for size keeps the checks of an index. A hit takes three stores: vectors would have to be
/// shuffled by three, which the layout of `Option` does not allow.)
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

/// Where the answers of any-hit queries go.
#[derive(Debug)]
pub enum ManyOccluded<'a> {
    /// One after the other in memory.
    Slice(&'a mut [bool]),
    /// In packets, a bit a lane.
    #[cfg(feature = "alloc")]
    Packets(&'a mut [u32]),
}

impl ManyAnswers for ManyOccluded<'_> {
    type Packet = u32;
    type One = bool;

    #[inline(always)]
    fn count(&self) -> usize {
        match self {
            Self::Slice(occluded) => occluded.len(),
            #[cfg(feature = "alloc")]
            Self::Packets(packets) => packets.len() * RayPacket::COUNT,
        }
    }

    #[cfg(feature = "alloc")]
    fn scatter(&mut self, packets: &[u32], indices: impl Iterator<Item = usize>) {
        match self {
            Self::Slice(_) => each_lane(packets, indices, |bits, lane, index| {
                self.set(index, bits >> lane & 1 == 1);
            }),
            Self::Packets(_) => each_lane(packets, indices, |bits, lane, index| {
                self.set(index, bits >> lane & 1 == 1);
            }),
        }
    }

    #[cfg(feature = "alloc")]
    #[inline(always)]
    fn set(&mut self, index: usize, one: bool) {
        match self {
            Self::Slice(occluded) => {
                if let Some(occluded) = occluded.get_mut(index) {
                    *occluded = one;
                }
            }
            Self::Packets(packets) => {
                if let Some(bits) = packets.get_mut(index / RayPacket::COUNT) {
                    let lane = index % RayPacket::COUNT;
                    *bits = *bits & 0xffff & !(1 << lane) | u32::from(one) << lane;
                }
            }
        }
    }

    #[cfg_attr(feature = "std", inline(always))]
    #[cfg_attr(not(feature = "std"), inline(never))]
    fn write(&mut self, packets: &[u32], from: usize, to: usize) {
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

/// Copies the answers of packets into `answers`, from ray `from` on, before ray `to`: whole packets.
#[cfg(feature = "alloc")]
fn copy_packets<P: Copy>(packets: &[P], answers: &mut [P], from: usize, to: usize) {
    let to = to.div_ceil(RayPacket::COUNT).min(answers.len());
    let answers = answers.get_mut(from / RayPacket::COUNT..to).unwrap_or_default();
    for (answer, packet) in answers.iter_mut().zip(packets) {
        *answer = *packet;
    }
}

/// Writes each lane's bit of packets as a truth value.
#[inline(always)]
fn write_occluded(packets: &[u32], occluded: &mut [bool]) {
    let mut at = 0;
    for bits in packets {
        let rest = occluded.get_mut(at..).unwrap_or_default();
        at += 16;
        if let Some(sixteen) = rest.first_chunk_mut::<16>() {
            // A mask instead of a shift by lane, for which vectors have an instruction only from
            // AVX2 on.
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
    use super::{ManyAnswers, ManyHits, ManyOccluded};
    use crate::{Hit, HitPacket};

    /// Values from before the call do not stay.
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
