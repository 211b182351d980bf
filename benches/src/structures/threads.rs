//! What a second thread is worth: the same packets, handed out in pieces to one thread and to two.
//!
//! By the wall's clock, so that it needs a machine with two free cores.

use crate::rounds::{self, Median, Subject};
use crate::scenes::{Kind, Scene};
use crate::structures::ours::{Answers, Rays, TreeMemory};
use spherule_kernel::Stable;
use spherule_kernel::dispatch::Level;
use spherule_kernel::dispatch::bvh::nearest_coherent;
use std::sync::Mutex;
use std::time::Instant;

/// Packets that a thread takes at a time.
const PIECE: usize = 256;

/// How many times as fast two threads find the primary rays' nearest hits as one, with `Stable`.
#[must_use]
pub fn two_by_one(scene: &Scene, level: Level, rounds: usize) -> Median {
    let spheres = scene.spheres.spheres();
    let mut memory = TreeMemory::new(spheres.len());
    let bvh = memory.build(spheres);
    let bvh = &bvh;
    let rays = Rays::new(scene.rays(Kind::Primary));
    let mut subjects = [("one", 1), ("two", 2)].map(|(name, threads)| {
        let (mut answers, rays) = (Answers::new(rays.count()), &rays);
        Subject::timing_itself(name, move || {
            let start = Instant::now();
            let pieces = Mutex::new(rays.pieces(&mut answers, PIECE));
            std::thread::scope(|scope| {
                for _ in 0..threads {
                    scope.spawn(|| {
                        // The lock is free again before a piece is worked on.
                        let next = || pieces.lock().ok()?.next();
                        while let Some((rays, hits)) = next() {
                            nearest_coherent::<Stable>(level, rays, spheres, bvh, hits);
                        }
                    });
                }
            });
            start.elapsed().as_nanos() as f64
        })
    });
    rounds::take(&mut subjects, rounds).ratio("one", "two")
}
