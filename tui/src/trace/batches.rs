//! Packets cut into what is searched together, and that into the tasks of threads.

use crate::structure::{RaysKind, Structure, Workload};
use spherule_kernel::tiles::Viewpoint;
use spherule_kernel::{Lanes, Ray, Vec3};
use std::ops::Range;

/// How many packets are judged together: as many as go through a tree together.
const BUNDLE: usize = 4;
/// The fewest packets that the spheres are sorted for: 256 rays. A sphere takes about as long to be
/// sorted as to be tested against a hundred.
const FEWEST_SORTED: usize = 16;

/// Packets side by side that have something in common, or nothing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    pub(super) packets: Range<usize>,
    pub(super) shared: Option<Viewpoint>,
}

/// Packets for one thread.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Task {
    pub(super) packets: Range<usize>,
    pub(super) kind: RaysKind,
}

impl Task {
    /// In pieces of at most `longest` packets.
    fn cut(&self, longest: usize) -> impl Iterator<Item = Self> {
        let Self { packets: Range { start, end }, kind } = *self;
        let piece = move |start| Self { packets: start..end.min(start + longest), kind };
        (start..end).step_by(longest).map(piece)
    }
}

/// Tasks, in the order of their packets, that are searched in the same way.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Batch {
    /// How: a structure, for rays of a viewpoint or none.
    pub(super) structure: Structure,
    pub(super) viewpoint: Option<Viewpoint>,
    pub(super) tasks: Vec<Task>,
}

/// The runs of packets of `L` lanes that are filled with `rays` from first to last.
///
/// Rays share what they share where all of [`BUNDLE`] packets do.
pub(super) fn runs<L: Lanes>(rays: &[Ray]) -> Vec<Run> {
    let mut runs = Vec::<Run>::new();
    for (index, rays) in rays.chunks(BUNDLE * L::COUNT).enumerate() {
        let (shared, start) = (shared(rays), BUNDLE * index);
        let end = start + rays.len().div_ceil(L::COUNT);
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

/// What the runs ask of a structure, traced so often: a run that shares something is a picture.
pub(super) fn workload<L: Lanes>(runs: &[Run], repeat: u32) -> Workload {
    let (coherent, other): (Vec<&Run>, Vec<&Run>) =
        runs.iter().partition(|run| run.shared.is_some());
    let packets = |runs: &[&Run]| runs.iter().map(|run| run.packets.len()).sum::<usize>();
    let all = L::COUNT * (packets(&coherent) + packets(&other));
    let (pictures, kind) = if packets(&other) > packets(&coherent) {
        (1, RaysKind::Incoherent)
    } else {
        (coherent.len().max(1), RaysKind::Coherent)
    };
    Workload { rays: all / pictures, pictures: pictures as f64 * f64::from(repeat), kind }
}

/// The batches in which `structure` searches the runs, in tasks of at most `longest` packets.
///
/// Tiles are for runs that share something and are not too short: a batch each. What is left is
/// searched by brute force.
pub(super) fn batches(runs: &[Run], structure: Structure, longest: usize) -> Vec<Batch> {
    let mut batches = Vec::new();
    let mut common = Vec::<Task>::new();
    let common_structure = match structure {
        Structure::Tiles => Structure::Brute,
        Structure::Brute | Structure::Bvh => structure,
    };
    for Run { packets, shared } in runs {
        if structure == Structure::Tiles && shared.is_some() && packets.len() >= FEWEST_SORTED {
            let all = Task { packets: packets.clone(), kind: RaysKind::Coherent };
            batches.push(Batch {
                structure,
                viewpoint: *shared,
                tasks: all.cut(longest).collect(),
            });
            continue;
        }
        let kind = match shared {
            // Brute force has no use for what rays share.
            Some(_) if common_structure == Structure::Bvh => RaysKind::Coherent,
            _ => RaysKind::Incoherent,
        };
        match common.last_mut() {
            Some(last) if last.packets.end == packets.start && last.kind == kind => {
                last.packets.end = packets.end;
            }
            _ => common.push(Task { packets: packets.clone(), kind }),
        }
    }
    if !common.is_empty() || batches.is_empty() {
        let tasks = common.iter().flat_map(|task| task.cut(longest)).collect();
        batches.push(Batch { structure: common_structure, viewpoint: None, tasks });
    }
    batches
}

#[cfg(test)]
mod tests {
    use super::*;
    use RaysKind::{Coherent, Incoherent};
    use spherule_kernel::f32x16;

    /// Rays from one point, but for those in `scattered`, which have nothing in common.
    fn rays(count: usize, scattered: Range<usize>) -> Vec<Ray> {
        let ray = |index| {
            let place = index as f32;
            let origin = if scattered.contains(&index) { place } else { 0.5 };
            Ray::new(Vec3::splat(origin), Vec3::new(1.0, place, 0.0))
        };
        (0..count).map(ray).collect()
    }

    #[test]
    fn what_rays_share_is_told_by_the_bundle() {
        let runs = runs::<f32x16>(&rays(1000, 130..300));
        let origin = Some(Viewpoint::Origin(Vec3::splat(0.5)));
        let found: Vec<_> = runs.iter().map(|run| (run.packets.clone(), run.shared)).collect();
        assert_eq!(found, [(0..8, origin), (8..20, None), (20..63, origin)]);
        let Workload { rays, pictures, kind } = workload::<f32x16>(&runs, 3);
        assert_eq!((rays, pictures, kind), (504, 6.0, Coherent));
        let parallel: Vec<_> =
            (0..9_u8).map(|index| Ray::new(Vec3::splat(index.into()), Vec3::Z)).collect();
        let shared = Some(Viewpoint::Direction(Vec3::Z));
        assert_eq!(super::runs::<f32x16>(&parallel), [Run { packets: 0..1, shared }]);
        assert_eq!(super::runs::<f32x16>(&[]), []);
    }

    #[test]
    fn every_packet_is_in_one_task() {
        let runs = runs::<f32x16>(&rays(100_001, 5000..6000));
        for structure in Structure::ALL {
            for longest in [16, 48, 256] {
                let batches = batches(&runs, structure, longest);
                let mut tasks: Vec<_> = batches.into_iter().flat_map(|batch| batch.tasks).collect();
                assert!(tasks.iter().all(|task| task.packets.len() <= longest));
                assert!(tasks.len() <= 6251 / longest + 4);
                tasks.sort_by_key(|task| task.packets.start);
                let packets = tasks.into_iter().flat_map(|task| task.packets);
                assert!(packets.eq(0..6251), "{structure:?} {longest}");
            }
        }
    }

    #[test]
    fn short_runs_of_a_kind_go_together() {
        // Each 64 rays have an origin of their own.
        let ray =
            |index: u16| Ray::new(Vec3::splat((index / 64).into()), Vec3::splat(index.into()));
        let rays: Vec<_> = (0..6400).map(ray).collect();
        let runs = runs::<f32x16>(&rays);
        assert_eq!(runs.len(), 100);
        for (structure, kind) in [
            (Structure::Brute, Incoherent),
            (Structure::Tiles, Incoherent),
            (Structure::Bvh, Coherent),
        ] {
            let batches = batches(&runs, structure, 1000);
            let tasks: Vec<_> = batches.into_iter().flat_map(|batch| batch.tasks).collect();
            assert_eq!(tasks, [Task { packets: 0..400, kind }]);
        }
    }

    #[test]
    fn tiles_are_for_long_runs() {
        let ran = |rays: &[Ray]| {
            let batches = batches(&runs::<f32x16>(rays), Structure::Tiles, 64);
            batches.into_iter().map(|batch| batch.structure).collect::<Vec<_>>()
        };
        assert_eq!(ran(&[]), [Structure::Brute]);
        assert_eq!(ran(&rays(240, 0..0)), [Structure::Brute]);
        assert_eq!(ran(&rays(2000, 0..0)), [Structure::Tiles]);
        assert_eq!(ran(&rays(2000, 0..100)), [Structure::Tiles, Structure::Brute]);
        assert_eq!(ran(&rays(2000, 0..2000)), [Structure::Brute]);
    }
}
