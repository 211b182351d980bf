//! Every tier and mark by brute force on the small scenes, in every lane width and at every level.

use crate::engine::Query;
use crate::engine::kernel::Kernel;
use crate::engine::marks::marks;
use crate::engine::probes::probes;
use crate::measure::{Effort, Measured, Plan};
use spherule_tests::scenes::{Kind, Scene, small};
use std::time::Duration;

/// Both kinds of rays of every small scene.
pub(crate) fn measure(effort: Effort) -> Vec<Measured> {
    let (rounds, sample) = match effort {
        Effort::Test => (1, 1),
        Effort::Quick => (5, 400),
        Effort::Full => (101, 400),
    };
    eprintln!("lists: {rounds} rounds");
    let plan = Plan {
        queries: &[Query::ClosestHit],
        time: Duration::ZERO,
        rounds: rounds..=rounds,
        rays: usize::MAX,
        sample: Duration::from_micros(sample),
    };
    small::scenes().iter().flat_map(|scene| of_scene(scene, &plan)).collect()
}

fn of_scene(scene: &Scene, plan: &Plan<'_>) -> [Measured; 2] {
    let kernel = Kernel::new(scene, &scene.tree());
    let (tiers, marks, probes) = (kernel.brute_force(), marks(scene), probes(scene.spheres.len()));
    let engines: Vec<_> = tiers.iter().chain(&marks).chain(&probes).collect();
    Kind::ALL.map(|kind| Measured::take((scene, kind), &engines, &kernel.truth(), plan))
}
