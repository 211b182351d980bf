//! Rays in slices and in packets, and memory for the answers to both.

use crate::engine::{EVERY_SECOND, Query};
use spherule_kernel::{Hit, HitPacket, Ray, RayPacket};

/// What a ray hits: t in bits, and the sphere; both are zero for any hit.
pub(crate) type Answer = Option<(u32, u32)>;

/// The answer that a hit is.
pub(crate) fn answer(hit: Option<Hit>) -> Answer {
    hit.map(|hit| (hit.t.to_bits(), hit.sphere))
}

/// The rays of calls, and what the calls answer.
pub(crate) struct Forms {
    pub(crate) rays: Vec<Ray>,
    pub(crate) packets: Vec<RayPacket>,
    pub(crate) hits: Vec<Option<Hit>>,
    pub(crate) occluded: Vec<bool>,
    pub(crate) packet_hits: Vec<HitPacket>,
    pub(crate) packets_occluded: Vec<u32>,
}

impl Forms {
    pub(crate) fn new(rays: Vec<Ray>) -> Self {
        let packets: Vec<_> = rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect();
        Self {
            hits: vec![None; rays.len()],
            occluded: vec![false; rays.len()],
            packet_hits: vec![HitPacket::none(); packets.len()],
            packets_occluded: vec![0; packets.len()],
            rays,
            packets,
        }
    }

    /// Overwrites the answers with wrong ones, so that a call that writes none is seen. (Bits that are inverted are right again when they
    /// are inverted twice.)
    pub(crate) fn forget(&mut self) {
        self.hits.fill(Some(Hit { t: f32::NAN, sphere: u32::MAX }));
        self.occluded.iter_mut().enumerate().for_each(|(ray, hit)| *hit = ray % 2 == 0);
        self.packet_hits.fill(HitPacket::none());
        self.packets_occluded.fill(EVERY_SECOND);
    }

    /// What calls of slices answered.
    pub(crate) fn of_slices(&self, query: Query) -> Vec<Answer> {
        match query {
            Query::ClosestHit => self.hits.iter().copied().map(answer).collect(),
            Query::AnyHit => self.occluded.iter().map(|hit| hit.then_some((0, 0))).collect(),
        }
    }

    /// What calls of packets answered.
    pub(crate) fn of_packets(&self, query: Query) -> Vec<Answer> {
        let of_ray = |ray: usize| {
            let (packet, lane) = (ray / RayPacket::COUNT, ray % RayPacket::COUNT);
            match query {
                Query::ClosestHit => answer(self.packet_hits[packet].hit(lane)),
                Query::AnyHit => (self.packets_occluded[packet] >> lane & 1 == 1).then_some((0, 0)),
            }
        };
        (0..self.rays.len()).map(of_ray).collect()
    }
}
