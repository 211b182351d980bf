//! The part of `spherule trace` that is timed: packets through the kernel, by all threads.

use super::batches::{Batch, Task};
use crate::failure::Failure;
use crate::structure::{SceneStructures, Search, TileLists};
use crate::threads::Threads;
use spherule_kernel::dispatch::{Level, Packet, pairs};
use spherule_kernel::{Accuracy, HitPacket, Lanes, Ray, RayPacket, Sphere, SpherePacket, Spheres};
use std::ops::Range;
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
    pub(super) batches: &'a [Batch],
    pub(super) question: Question,
    pub(super) repeat: u32,
}

impl Passes<'_> {
    /// Traces with one tier. Packets are made once; only the kernel's calls are timed, and what
    /// `structures` build for them is not.
    ///
    /// # Errors
    /// [`Failure::Running`] where there is no memory for a structure.
    pub(super) fn run<A: Accuracy>(
        &self,
        structures: &mut SceneStructures<'_>,
        spheres: Spheres<'_>,
        rays: &[Ray],
    ) -> Result<Met, Failure> {
        let packets: Vec<RayPacket<Packet>> =
            rays.chunks(Packet::COUNT).map(RayPacket::<Packet>::new).collect();
        let level = self.level;
        if self.question == Question::Any {
            let mut met = vec![0; packets.len()];
            let any = |search: &Search<'_>, task: &Task, lists: &mut TileLists, met: &mut [u32]| {
                let rays = &packets[task.packets.clone()];
                search.any::<A>(level, task.kind, rays, lists, met);
            };
            let passes = self.timed(structures, &mut met, any)?;
            let bit = |index: usize| met[index / Packet::COUNT] >> (index % Packet::COUNT) & 1;
            let sphere = |index| if bit(index) == 1 { 1 } else { Met::NOTHING };
            let sphere = (0..rays.len()).map(sphere).collect();
            return Ok(Met { t: Vec::new(), sphere, passes });
        }
        let mut hits = vec![HitPacket::<Packet>::none(); packets.len()];
        let passes = if self.question == Question::Pairs {
            let spheres: Vec<Sphere> = spheres.iter().collect();
            let spheres: Vec<SpherePacket<Packet>> =
                spheres.chunks(Packet::COUNT).map(SpherePacket::<Packet>::new).collect();
            self.timed(structures, &mut hits, |_, task, _, hits| {
                let (rays, spheres) =
                    (&packets[task.packets.clone()], &spheres[task.packets.clone()]);
                pairs::<A>(level, rays, spheres, hits);
            })?
        } else {
            self.timed(structures, &mut hits, |search, task, lists, hits| {
                let rays = &packets[task.packets.clone()];
                search.nearest::<A>(level, task.kind, rays, lists, hits);
            })?
        };
        let hit = |index: usize| hits[index / Packet::COUNT].hit(index % Packet::COUNT);
        let t = |ray| hit(ray).map_or(f32::INFINITY, |hit| hit.t);
        let sphere = |ray| hit(ray).map_or(Met::NOTHING, |hit| hit.sphere);
        Ok(Met {
            t: (0..rays.len()).map(t).collect(),
            sphere: (0..rays.len()).map(sphere).collect(),
            passes,
        })
    }

    /// Hands the tasks to the threads, as often as asked, and says how long each time took; a
    /// structure for a batch is built once.
    fn timed<R: Send>(
        &self,
        structures: &mut SceneStructures<'_>,
        results: &mut [R],
        trace: impl Fn(&Search<'_>, &Task, &mut TileLists, &mut [R]) + Sync,
    ) -> Result<Vec<Duration>, Failure> {
        let mut passes = vec![Duration::ZERO; self.repeat as usize];
        let mut lists = Vec::new();
        for batch in self.batches {
            let search = structures.search(batch.structure, batch.viewpoint)?;
            for pass in &mut passes {
                let (mut rest, mut from) = (&mut *results, 0);
                let tasks = batch.tasks.iter().map(|task| {
                    let Range { start, end } = task.packets;
                    let _other_batches = rest.split_off_mut(..start - from);
                    from = end;
                    (task, rest.split_off_mut(..end - start).unwrap_or_default())
                });
                let start = Instant::now();
                self.threads.share(&mut lists, tasks, |lists, (task, results)| {
                    trace(&search, task, lists, results);
                });
                *pass += start.elapsed();
            }
        }
        Ok(passes)
    }
}
