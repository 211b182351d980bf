//! The part of `spherule trace` that is timed: packets through the kernel, by all threads.

use super::batches::Batch;
use crate::error::Error;
use crate::structure::scene::SceneStructures;
use crate::structure::search::{Scratch, Search, Tracing};
use crate::threads::Threads;
use spherule_kernel::{Hit, HitPacket, Ray, RayPacket, SphereList, SpherePacket, pair_packets};
use std::ops::Range;
use std::time::{Duration, Instant};

/// What is computed for every ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Query {
    /// Its closest hit.
    Closest,
    /// Whether there is any hit.
    Any,
    /// Its hit with the sphere of its index.
    Pairs,
}

/// The work of every pass, and how often it is repeated.
pub(super) struct Passes<'a> {
    pub(super) tracing: Tracing,
    pub(super) threads: &'a Threads,
    pub(super) batches: &'a [Batch],
    pub(super) query: Query,
    pub(super) repeat: u32,
}

impl Passes<'_> {
    /// Traces, and returns the hit of every ray and the time of every pass; an any hit has sphere 0 and no t. Packets
    /// are made once; only the kernel's calls are timed, and no building.
    ///
    /// # Errors
    /// [`Error::Running`] if there is no memory for a structure.
    pub(super) fn run(
        &self,
        structures: &mut SceneStructures<'_>,
        list: &SphereList,
        rays: &[Ray],
    ) -> Result<(Vec<Option<Hit>>, Vec<Duration>), Error> {
        let packets: Vec<_> = rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect();
        let tracing = self.tracing;
        if self.query == Query::Any {
            let mut occluded = vec![0; packets.len()];
            let passes =
                self.timed(structures, &mut occluded, |search, task, scratch, occluded| {
                    search.any_hits(tracing, scratch, &packets[task], occluded);
                })?;
            let bit = |i: usize| occluded[i / RayPacket::COUNT] >> (i % RayPacket::COUNT) & 1 == 1;
            let hit = |index| bit(index).then_some(Hit { t: f32::NAN, sphere: 0 });
            return Ok(((0..rays.len()).map(hit).collect(), passes));
        }
        let mut hits = vec![HitPacket::none(); packets.len()];
        let passes = if self.query == Query::Pairs {
            let spheres: Vec<_> = list.spheres().iter().collect();
            let spheres: Vec<_> = spheres.chunks(RayPacket::COUNT).map(SpherePacket::new).collect();
            self.timed(structures, &mut hits, |_, task, _, hits| {
                let (rays, spheres) = (&packets[task.clone()], &spheres[task]);
                pair_packets(tracing.tier, tracing.level, rays, spheres, hits);
            })?
        } else {
            self.timed(structures, &mut hits, |search, task, scratch, hits| {
                search.closest_hits(tracing, scratch, &packets[task], hits);
            })?
        };
        Ok((hits.iter().flat_map(HitPacket::hits).take(rays.len()).collect(), passes))
    }

    /// Hands the tasks to the threads, as often as they are repeated, and returns how long each pass
    /// took; the structure of a batch is built once.
    fn timed<R: Send>(
        &self,
        structures: &mut SceneStructures<'_>,
        results: &mut [R],
        trace: impl Fn(&Search<'_>, Range<usize>, &mut Scratch, &mut [R]) + Sync,
    ) -> Result<Vec<Duration>, Error> {
        let mut passes = vec![Duration::ZERO; self.repeat as usize];
        let mut scratches = Vec::new();
        for batch in self.batches {
            let search = structures.search(batch.structure, batch.viewpoint)?;
            for pass in &mut passes {
                let (mut rest, mut from) = (&mut *results, 0);
                let tasks = batch.tasks.iter().map(|task| {
                    let _other_batches = rest.split_off_mut(..task.start - from);
                    from = task.end;
                    (task.clone(), rest.split_off_mut(..task.len()).unwrap_or_default())
                });
                let start = Instant::now();
                self.threads.share(&mut scratches, tasks, |scratch, (task, results)| {
                    trace(&search, task, scratch, results);
                });
                *pass += start.elapsed();
            }
        }
        Ok(passes)
    }
}
