//! Nearest hit by brute force: tier x lane width x how many spheres x kind of rays.
//!
//! The throughput is ray-sphere tests. `cargo bench -p spherule-benches --bench nearest --
//! camera/64` runs a part.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use spherule_benches::check::{self, Tolerance};
use spherule_benches::settings::settings;
use spherule_benches::workload::{Cloud, Kind, RAYS, SPHERES, packets};
use spherule_kernel::{
    Accuracy, Exact, Fast, HitPacket, Lanes, Ray, Stable, f32x4, f32x8, f32x16, nearest,
};
use std::hint::black_box;

/// The rays and spheres of a group of benchmarks, and what is true of them.
struct Workload {
    rays: Vec<Ray>,
    cloud: Cloud,
    truth: Vec<Option<(f64, u32)>>,
}

fn groups(criterion: &mut Criterion) {
    for kind in Kind::ALL {
        for count in SPHERES {
            let (rays, cloud) = (kind.rays(), Cloud::new(count));
            let truth = check::reference(&rays, &cloud.list());
            let workload = Workload { rays, cloud, truth };

            let mut group = criterion.benchmark_group(format!("{}/{count}", kind.name()));
            group.throughput(Throughput::Elements((RAYS * count) as u64));
            tier::<Fast>(&mut group, &workload, Tolerance::TEXTBOOK);
            tier::<Stable>(&mut group, &workload, Tolerance::CLOSEST_POINT);
            tier::<Exact>(&mut group, &workload, Tolerance::EXACT);
            group.finish();
        }
    }
}

fn tier<A: Accuracy>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    workload: &Workload,
    tolerance: Tolerance,
) {
    let answers = check::kernel_hits::<A, f32>(&workload.rays, workload.cloud.spheres());
    check::near_reference(A::NAME, &answers, &workload.truth, tolerance);
    width::<A, f32>(group, workload);
    width::<A, f32x4>(group, workload);
    width::<A, f32x8>(group, workload);
    width::<A, f32x16>(group, workload);
}

fn width<A: Accuracy, L: Lanes<Token = ()>>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    Workload { rays, cloud, .. }: &Workload,
) {
    let spheres = cloud.spheres();
    check::same_bits::<A, L>(rays, spheres);

    let packets = packets::<L>(rays);
    let mut hits = vec![HitPacket::<L>::none(); packets.len()];
    group.bench_function(format!("{}/x{}", A::NAME, L::COUNT), |bencher| {
        bencher.iter(|| {
            nearest::<A, L>((), black_box(&packets), black_box(spheres), &mut hits);
            black_box(&hits);
        });
    });
}

criterion_group! {
    name = benches;
    config = settings();
    targets = groups
}
criterion_main!(benches);
