//! Where the answers of a walk go: the nearest hit of every ray, or whether there is any.

use crate::{Hit, HitPacket, Lanes};

/// Takes what the tier says about rays, packet by packet.
pub(super) trait Answers<L: Lanes> {
    /// Whether any hit will do.
    const ANY: bool;

    /// Forgets what was there before for a packet.
    fn clear(&mut self, packet: usize);
    /// Takes a hit that a ray has, if it is nearer than what is known, or as near and of a lower index.
    fn take(&mut self, packet: usize, lane: usize, hit: Hit);
    /// Beyond which t nothing matters any more: `-inf` where nothing does.
    fn limit(&self, packet: usize, lane: usize) -> f32;
}

/// The nearest hits.
pub(super) struct Nearest<'a, L: Lanes>(pub(super) &'a mut [HitPacket<L>]);

/// Whether there is any, a bit a lane.
pub(super) struct Any<'a>(pub(super) &'a mut [u32]);

impl<L: Lanes> Answers<L> for Nearest<'_, L> {
    const ANY: bool = false;

    #[inline(always)]
    fn clear(&mut self, packet: usize) {
        if let Some(hits) = self.0.get_mut(packet) {
            *hits = HitPacket::<L>::none();
        }
    }

    #[inline(always)]
    fn take(&mut self, packet: usize, lane: usize, hit: Hit) {
        if let Some(hits) = self.0.get_mut(packet) {
            hits.take(lane, hit);
        }
    }

    #[inline(always)]
    fn limit(&self, packet: usize, lane: usize) -> f32 {
        match self.0.get(packet) {
            Some(hits) => hits.t().get(lane).copied().unwrap_or(f32::INFINITY),
            None => f32::INFINITY,
        }
    }
}

impl<L: Lanes> Answers<L> for Any<'_> {
    const ANY: bool = true;

    #[inline(always)]
    fn clear(&mut self, packet: usize) {
        if let Some(met) = self.0.get_mut(packet) {
            *met = 0;
        }
    }

    #[inline(always)]
    fn take(&mut self, packet: usize, lane: usize, _: Hit) {
        if let Some(met) = self.0.get_mut(packet) {
            *met |= 1 << (lane % 32);
        }
    }

    #[inline(always)]
    fn limit(&self, packet: usize, lane: usize) -> f32 {
        match self.0.get(packet) {
            Some(met) if met >> (lane % 32) & 1 == 1 => f32::NEG_INFINITY,
            _ => f32::INFINITY,
        }
    }
}
