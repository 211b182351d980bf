//! The part of `spherule trace` that is timed: packets through the kernel, by all threads.

use super::pieces::Piece;
use crate::structure::Search;
use crate::threads::Threads;
use spherule_kernel::dispatch::{Level, Packet, pairs};
use spherule_kernel::{Accuracy, HitPacket, Lanes, Ray, RayPacket, Sphere, SpherePacket, Spheres};
use std::time::{Duration, Instant};

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Question {
    /// What every ray meets first.
    Nearest,
    /// Whether every ray meets anything.
    Any,
    /// Where ray i meets sphere i.
    Pairs,
}

/// What the rays met.
pub(super) struct Met {
    /// A t a ray, `+inf` where nothing was hit; none where only any hit was asked for.
    pub(super) t: Vec<f32>,
    /// A sphere a ray (of pairs, its lane), or [`Met::NOTHING`]; where any hit was asked for, 1
    /// or that.
    pub(super) sphere: Vec<u32>,
    /// How long the kernel took, a pass.
    pub(super) passes: Vec<Duration>,
}

impl Met {
    /// No sphere has that index.
    pub(super) const NOTHING: u32 = u32::MAX;
}

/// What is done, as often as it is repeated.
pub(super) struct Passes<'a> {
    pub(super) level: Level,
    pub(super) threads: &'a Threads,
    pub(super) search: Search<'a>,
    pub(super) pieces: &'a [Piece],
    pub(super) question: Question,
    pub(super) repeat: u32,
}

impl Passes<'_> {
    /// Traces with one tier. Packets are made once; only the kernel's calls are timed.
    pub(super) fn run<A: Accuracy>(&self, spheres: Spheres<'_>, rays: &[Ray]) -> Met {
        let packets: Vec<RayPacket<Packet>> =
            rays.chunks(Packet::COUNT).map(RayPacket::<Packet>::new).collect();
        let (level, search) = (self.level, &self.search);
        if self.question == Question::Any {
            let mut met = vec![0; packets.len()];
            let passes = self.timed(&packets, &mut met, |piece, rays, met| {
                search.any::<A>(level, piece.kind, rays, met);
            });
            let bit = |index: usize| met[index / Packet::COUNT] >> (index % Packet::COUNT) & 1;
            let sphere = |index| if bit(index) == 1 { 1 } else { Met::NOTHING };
            return Met { t: Vec::new(), sphere: (0..rays.len()).map(sphere).collect(), passes };
        }
        let mut hits = vec![HitPacket::<Packet>::none(); packets.len()];
        let passes = if self.question == Question::Pairs {
            let spheres: Vec<Sphere> = spheres.iter().collect();
            let spheres: Vec<SpherePacket<Packet>> =
                spheres.chunks(Packet::COUNT).map(SpherePacket::<Packet>::new).collect();
            self.timed(&packets, &mut hits, |piece, rays, hits| {
                pairs::<A>(level, rays, &spheres[piece.packets.clone()], hits);
            })
        } else {
            self.timed(&packets, &mut hits, |piece, rays, hits| {
                search.nearest::<A>(level, piece.kind, rays, hits);
            })
        };
        let hit = |index: usize| hits[index / Packet::COUNT].hit(index % Packet::COUNT);
        Met {
            t: (0..rays.len()).map(|ray| hit(ray).map_or(f32::INFINITY, |hit| hit.t)).collect(),
            sphere: (0..rays.len())
                .map(|ray| hit(ray).map_or(Met::NOTHING, |hit| hit.sphere))
                .collect(),
            passes,
        }
    }

    /// Hands the pieces to the threads, as often as asked, and says how long each time took.
    fn timed<R: Send>(
        &self,
        packets: &[RayPacket<Packet>],
        results: &mut [R],
        trace: impl Fn(&Piece, &[RayPacket<Packet>], &mut [R]) + Sync,
    ) -> Vec<Duration> {
        let pass = |_| {
            let start = Instant::now();
            let mut rest = &mut *results;
            let pieces = self.pieces.iter().map(|piece| {
                let own = rest.split_off_mut(..piece.packets.len()).unwrap_or_default();
                (piece, own)
            });
            self.threads.share(&mut Vec::new(), pieces, |(), (piece, results)| {
                trace(piece, &packets[piece.packets.clone()], results);
            });
            start.elapsed()
        };
        (0..self.repeat).map(pass).collect()
    }
}
