//! Criterion's clock, started only after the answers have been judged.

use crate::intersector::Intersector;
use crate::judge::Judge;
use crate::truth::Shared;
use criterion::measurement::Measurement;
use criterion::{BenchmarkGroup, Throughput};
use spherule_kernel::{Ray, Sphere};
use std::hint::black_box;

/// Judges the closest hits that the intersector finds, under its own rules, then times them.
///
/// `most_wrong` is the share of rays whose decisions may be wrong.
///
/// # Panics
/// If more are wrong, with their number and one of them; or if not every ray has an answer.
pub fn bench<M: Measurement>(
    group: &mut BenchmarkGroup<'_, M>,
    intersector: &mut impl Intersector,
    (spheres, rays): (&[Sphere], &[Ray]),
    most_wrong: f64,
) {
    check(intersector, (spheres, rays), most_wrong);
    let name = intersector.name().to_owned();
    group.throughput(Throughput::Elements(rays.len() as u64));
    group.bench_function(name, |bencher| {
        bencher.iter(|| black_box(intersector.closest_hits(black_box(spheres), black_box(rays))));
    });
}

/// Judges the answers that [`bench()`] times.
///
/// # Panics
/// As [`bench()`] does.
pub fn check(
    intersector: &mut impl Intersector,
    (spheres, rays): (&[Sphere], &[Ray]),
    most_wrong: f64,
) {
    let answers = intersector.closest_hits(spheres, rays);
    let name = intersector.name();
    assert_eq!(answers.len(), rays.len(), "{name}: not as many answers as rays");
    let mut judge = Judge::new(intersector.rules(), false);
    judge.shared(&Shared::new(spheres), rays, &answers, &[]);
    let counts = judge.total().by_rules;
    let wrong = counts.decided_wrong();
    let example = crate::verdict::Kind::ALL.into_iter().find_map(|kind| judge.worst(kind));
    assert!(
        wrong as f64 <= most_wrong * counts.judged as f64,
        "{name}: {wrong} of {} rays are decided wrong, such as {example:?}",
        counts.judged
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intersector::{Kernel, Pair};
    use spherule_kernel::{Tier, Vec3};

    #[test]
    fn what_is_right_passes() {
        let (spheres, rays) =
            (vec![[0.0, 0.0, 5.0, 1.0].into()], vec![Ray::new(Vec3::ZERO, Vec3::Z)]);
        check(&mut Kernel(Tier::Exact), (&spheres, &rays), 0.0);
    }

    #[test]
    #[should_panic(expected = "blind: 1 of 1 rays are decided wrong")]
    fn what_is_wrong_is_not_timed() {
        let (spheres, rays) =
            (vec![[0.0, 0.0, 5.0, 1.0].into()], vec![Ray::new(Vec3::ZERO, Vec3::Z)]);
        check(&mut Pair::new("blind", |_: &Ray, _: &Sphere| None::<f32>), (&spheres, &rays), 0.5);
    }
}
