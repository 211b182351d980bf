//! The closest hit by brute force: rays x spheres x tier or crate x lanes.

use crate::engine::kernel::Kernel;
use crate::engine::{Query, peers};
use crate::measure::checked;
use criterion::{Criterion, Throughput};
use spherule_tests::scenes::{Kind, small};
use std::time::Duration;

/// Runs the groups: short, without plots, and quiet about changes that neighbours on the machine can cause. The
/// throughput is ray-sphere tests. `cargo bench --bench closest_hit -- primary/64` runs a part.
///
/// # Panics
/// If an answer is wrong.
pub fn closest_hit() {
    let mut criterion = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .nresamples(10_000)
        .noise_threshold(0.10)
        .significance_level(0.01)
        .without_plots()
        .configure_from_args();
    for scene in
        [("1", 1), ("8", 8), ("64", 64), ("1024", 1024)].map(|(name, n)| small::cube(name, n))
    {
        let kernel = Kernel::new(&scene, &scene.tree());
        let others = peers::LOOPS.iter().map(|make| make(scene.spheres.spheres()));
        let others: Vec<_> = others.collect();
        let tiers = kernel.brute_force();
        let engines: Vec<_> = tiers.iter().chain(&others).collect();
        for kind in Kind::ALL {
            let mut group = criterion.benchmark_group(format!("{}/{}", kind.as_str(), scene.name));
            group.throughput(Throughput::Elements((1024 * scene.spheres.len()) as u64));
            let all = checked((&scene, kind), &engines, &kernel.truth(), usize::MAX);
            for mut checked in all {
                let name = format!("{}/{}", checked.label.name, checked.label.lanes);
                group.bench_function(name, |bencher| {
                    bencher.iter(|| checked.run.run(Query::ClosestHit));
                });
            }
            group.finish();
        }
    }
    criterion.final_summary();
}
