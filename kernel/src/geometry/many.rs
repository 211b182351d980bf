//! Many rays of a caller's, and where their hits go: a slice of them, or columns.

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
}

impl ManyRays<'_> {
    /// How many there are.
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::Slice(rays) => rays.len(),
            Self::Columns(rays) => rays.len(),
        }
    }

    /// Rays `from` to `to`.
    pub(crate) fn part(&self, from: usize, to: usize) -> Self {
        match self {
            Self::Slice(rays) => Self::Slice(rays.get(from..to).unwrap_or_default()),
            Self::Columns(rays) => Self::Columns(rays.part(from, to)),
        }
    }

    /// Ray `index`, if there is one.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn ray(&self, index: usize) -> Option<Ray> {
        match self {
            Self::Slice(rays) => rays.get(index).copied(),
            Self::Columns(rays) => rays.ray(index),
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
}

impl ManyHits<'_> {
    /// How many there is room for.
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::Slice(hits) => hits.len(),
            Self::Columns(hits) => hits.len(),
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
        }
    }

    /// Writes the hits of packets from place `from` on, before place `to`.
    #[inline(always)]
    pub(crate) fn write(&mut self, packets: &[HitPacket], from: usize, to: usize) {
        match self {
            Self::Slice(hits) => write_slice(packets, hits.get_mut(from..to).unwrap_or_default()),
            Self::Columns(hits) => hits.write(packets, from, to),
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

/// Writes a lane's bit of packets as a truth value each.
#[inline(always)]
pub(crate) fn write_occluded(packets: &[u32], occluded: &mut [bool]) {
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
