//! Criterion's clock, started only after the answers have been judged.

use crate::case::{HexRay, HexSphere};
use crate::intersector::Intersector;
use crate::judge::Judge;
use crate::rules::Rules;
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
/// If more are wrong, with their number and one of them; if not every ray has an answer; if no answer can be judged, since the rules
/// promise nothing of these rays and spheres or leave all of them open; or as [`Judge::shared`] does.
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
    let (name, rules) = (intersector.name(), intersector.rules());
    assert_eq!(answers.len(), rays.len(), "{name}: not as many answers as rays");
    let mut judge = Judge::new(rules, false);
    judge.shared(&Shared::new(spheres), rays, &answers, &[]);
    let counts = judge.total().by_rules;
    assert!(
        counts.judged > 0 || rays.is_empty(),
        "{name}: no answer can be judged: its rules leave {} rays open, and promise nothing of {}{}",
        counts.open,
        counts.unpromised,
        not_covered(&rules, (spheres, rays))
    );
    let wrong = counts.decided_wrong();
    let example = crate::verdict::Kind::ALL.into_iter().find_map(|kind| judge.worst(kind));
    assert!(
        wrong as f64 <= most_wrong * counts.judged as f64,
        "{name}: {wrong} of {} rays are decided wrong, such as {example:?}",
        counts.judged
    );
}

/// A sphere of which rules promise nothing, and so nothing of the scene; else such a ray.
fn not_covered(rules: &Rules, (spheres, rays): (&[Sphere], &[Ray])) -> String {
    if let Some(sphere) = spheres.iter().find(|sphere| !rules.cover_sphere(sphere)) {
        return format!(", since there is a {}", HexSphere(sphere));
    }
    let ray = rays.iter().find(|ray| !rules.cover_ray(ray));
    ray.map_or_else(String::new, |ray| format!(", such as the {}", HexRay(ray)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intersector::{Kernel, Pair};
    use crate::rules::{Directions, Promise};
    use spherule_kernel::{Tier, Vec3};

    const RAY: Ray = Ray::new(Vec3::ZERO, Vec3::Z);
    const SPHERE: Sphere = Sphere { center: Vec3::new(0.0, 0.0, 5.0), radius: 1.0 };

    #[test]
    fn what_is_right_passes() {
        check(&mut Kernel(Tier::Exact), (&[SPHERE], &[RAY]), 0.0);
    }

    /// The check of an intersector that sees nothing, under these rules.
    fn check_blind(rules: Rules, (spheres, rays): (&[Sphere], &[Ray])) {
        let blind = Pair::new("blind", |_: &Ray, _: &Sphere| None::<f32>);
        check(&mut blind.with_rules(rules), (spheres, rays), 0.5);
    }

    #[test]
    #[should_panic(expected = "blind: 1 of 1 rays are decided wrong")]
    fn what_is_wrong_is_not_timed() {
        check_blind(Rules::CONTRACT, (&[SPHERE], &[RAY]));
    }

    #[test]
    #[should_panic(expected = "promise nothing of 1, since there is a sphere at (")]
    fn a_scene_of_which_nothing_is_promised_is_not_timed() {
        let rules = Rules { invalid: Promise::None, ..Rules::CONTRACT };
        check_blind(rules, (&[SPHERE, Sphere { radius: -1.0, ..SPHERE }], &[RAY]));
    }

    #[test]
    #[should_panic(expected = "promise nothing of 1, such as the ray from (")]
    fn rays_of_which_nothing_is_promised_are_not_timed() {
        let rules = Rules { directions: Directions::Unit, ..Rules::CONTRACT };
        check_blind(rules, (&[SPHERE], &[Ray::new(Vec3::ZERO, 2.0 * Vec3::Z)]));
    }

    #[test]
    fn no_rays_have_no_answers_to_judge() {
        check_blind(Rules::CONTRACT, (&[], &[]));
    }
}
