//! Packets cut into batches that are searched together, and batches cut into the tasks of threads.

use crate::structure::Structure;
use crate::structure::choose::Workload;
use spherule_kernel::{Ray, RayPacket, Vec3, Viewpoint};
use std::ops::Range;

/// How many packets are judged together: as many as go through a tree together.
const GROUP: usize = 4;
/// The fewest packets that the spheres are sorted for: 256 rays. Sorting a sphere takes about as long as testing it
/// against a hundred rays.
const FEWEST_SORTED: usize = 16;

/// Packets side by side whose rays share an origin or a direction, or nothing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    pub(super) packets: Range<usize>,
    pub(super) shared: Option<Viewpoint>,
}

/// Packets that are searched in the same way.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Batch {
    /// A structure, for rays of a viewpoint or none.
    pub(super) structure: Structure,
    pub(super) viewpoint: Option<Viewpoint>,
    /// The packets of each task, in ascending order.
    pub(super) tasks: Vec<Range<usize>>,
}

/// The runs of packets that are filled with `rays` from first to last.
///
/// All rays of [`GROUP`] packets are judged together: they share something, or nothing.
pub(super) fn runs(rays: &[Ray]) -> Vec<Run> {
    let mut runs = Vec::<Run>::new();
    for (index, rays) in rays.chunks(GROUP * RayPacket::COUNT).enumerate() {
        let (shared, start) = (shared(rays), GROUP * index);
        let end = start + rays.len().div_ceil(RayPacket::COUNT);
        match runs.last_mut() {
            Some(last) if last.shared == shared => last.packets.end = end,
            _ => runs.push(Run { packets: start..end, shared }),
        }
    }
    runs
}

fn shared(rays: &[Ray]) -> Option<Viewpoint> {
    let first = rays.first()?;
    let all = |of: fn(&Ray) -> Vec3| rays.iter().all(|ray| of(ray) == of(first));
    if all(|ray| ray.origin) {
        Some(Viewpoint::Origin(first.origin))
    } else if all(|ray| ray.direction) {
        Some(Viewpoint::Direction(first.direction))
    } else {
        None
    }
}

/// The work of tracing the runs `repeat` times; a run that shares something is a picture.
pub(super) fn workload(runs: &[Run], repeat: u32) -> Workload {
    let (coherent, other): (Vec<&Run>, Vec<&Run>) =
        runs.iter().partition(|run| run.shared.is_some());
    let packets = |runs: &[&Run]| runs.iter().map(|run| run.packets.len()).sum::<usize>();
    let all = RayPacket::COUNT * (packets(&coherent) + packets(&other));
    let (pictures, coherent) = if packets(&other) > packets(&coherent) {
        (1, false)
    } else {
        (coherent.len().max(1), true)
    };
    let pictures_in_all = pictures as f64 * f64::from(repeat);
    Workload { coherent, ..Workload::of_pictures(pictures_in_all, all / pictures, 0) }
}

/// The batches in which `structure` searches the runs, in tasks of at most `longest` packets.
///
/// A depth list searches each run that shares something and is not too short, as a batch of its own. Brute force
/// searches the others.
pub(super) fn batches(runs: &[Run], structure: Structure, longest: usize) -> Vec<Batch> {
    let sorted = |run: &&Run| {
        let long = run.packets.len() >= FEWEST_SORTED;
        structure == Structure::DepthList && run.shared.is_some() && long
    };
    let (sorted, others): (Vec<&Run>, Vec<&Run>) = runs.iter().partition(sorted);
    let cut = |Range { start, end }: Range<usize>| {
        (start..end).step_by(longest).map(move |start| start..end.min(start + longest))
    };
    let of_run = |run: &Run| {
        let tasks = cut(run.packets.clone()).collect();
        Batch { structure, viewpoint: run.shared, tasks }
    };
    let mut batches: Vec<_> = sorted.into_iter().map(of_run).collect();
    let mut joined = Vec::<Range<usize>>::new();
    for Run { packets, .. } in others {
        match joined.last_mut() {
            Some(last) if last.end == packets.start => last.end = packets.end,
            _ => joined.push(packets.clone()),
        }
    }
    if !joined.is_empty() || batches.is_empty() {
        let structure = match structure {
            Structure::DepthList => Structure::Brute,
            Structure::Brute | Structure::Bvh => structure,
        };
        let tasks = joined.into_iter().flat_map(cut).collect();
        batches.push(Batch { structure, viewpoint: None, tasks });
    }
    batches
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::ValueEnum;

    /// Rays from one point, except those in `scattered`, which share nothing.
    fn rays(count: usize, scattered: Range<usize>) -> Vec<Ray> {
        let ray = |index| {
            let place = index as f32;
            let origin = if scattered.contains(&index) { place } else { 0.5 };
            Ray::new(Vec3::splat(origin), Vec3::new(1.0, place, 0.0))
        };
        (0..count).map(ray).collect()
    }

    #[test]
    fn what_rays_share_is_told_by_the_group() {
        let runs = runs(&rays(1000, 130..300));
        let origin = Some(Viewpoint::Origin(Vec3::splat(0.5)));
        let found: Vec<_> = runs.iter().map(|run| (run.packets.clone(), run.shared)).collect();
        assert_eq!(found, [(0..8, origin), (8..20, None), (20..63, origin)]);
        let Workload { rays, pictures, coherent, .. } = workload(&runs, 3);
        assert_eq!((rays, pictures, coherent), (504, 6.0, true));
        let parallel: Vec<_> =
            (0..9_u8).map(|index| Ray::new(Vec3::splat(index.into()), Vec3::Z)).collect();
        let shared = Some(Viewpoint::Direction(Vec3::Z));
        assert_eq!(super::runs(&parallel), [Run { packets: 0..1, shared }]);
        assert_eq!(super::runs(&[]), []);
    }

    #[test]
    fn every_packet_is_in_one_task() {
        let runs = runs(&rays(100_001, 5000..6000));
        for &structure in Structure::value_variants() {
            for longest in [16, 48, 256] {
                let batches = batches(&runs, structure, longest);
                let mut tasks: Vec<_> = batches.into_iter().flat_map(|batch| batch.tasks).collect();
                assert!(tasks.iter().all(|task| task.len() <= longest));
                assert!(tasks.len() <= 6251 / longest + 4);
                tasks.sort_by_key(|task| task.start);
                assert!(tasks.into_iter().flatten().eq(0..6251), "{structure:?} {longest}");
            }
        }
    }

    #[test]
    fn short_runs_go_together() {
        // Each 64 rays have an origin of their own.
        let ray =
            |index: u16| Ray::new(Vec3::splat((index / 64).into()), Vec3::splat(index.into()));
        let rays: Vec<_> = (0..6400).map(ray).collect();
        let runs = runs(&rays);
        assert_eq!(runs.len(), 100);
        for &structure in Structure::value_variants() {
            let batches = batches(&runs, structure, 1000);
            let tasks: Vec<_> = batches.into_iter().flat_map(|batch| batch.tasks).collect();
            assert!(tasks.len() == 1 && tasks[0] == (0..400), "{tasks:?}");
        }
    }

    #[test]
    fn depth_lists_are_for_long_runs() {
        use Structure::{Brute, DepthList};
        let ran = |rays: &[Ray]| {
            let batches = batches(&runs(rays), DepthList, 64);
            batches.into_iter().map(|batch| batch.structure).collect::<Vec<_>>()
        };
        assert_eq!(ran(&[]), [Brute]);
        assert_eq!(ran(&rays(240, 0..0)), [Brute]);
        // 256 rays share an origin, but only four groups do, the last in part.
        assert_eq!(ran(&rays(326, 0..70)), [Brute]);
        assert_eq!(ran(&rays(2000, 0..0)), [DepthList]);
        assert_eq!(ran(&rays(2000, 0..100)), [DepthList, Brute]);
        assert_eq!(ran(&rays(2000, 0..2000)), [Brute]);
    }
}
