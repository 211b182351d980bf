//! What is true under rules where a root, a tie or an end of the interval is hard to tell.

use spherule_kernel::{Exact, Tier, roots};
use spherule_referee::answer::Answer;
use spherule_referee::families::FAMILIES;
use spherule_referee::intersector::Kernel;
use spherule_referee::judge::Judge;
use spherule_referee::rules::{Interval, Precision, Tangents, Ties};
use spherule_referee::truth::{Shared, Truth, of_pair};
use spherule_referee::verdict::Kind;
use spherule_referee::{Intersector, Ray, Rules, Sphere, Vec3};

const RAY: Ray = Ray::new(Vec3::ZERO, Vec3::Z);
const CONTRACT: Rules = Rules::CONTRACT;
const RIGHT: [Kind; 0] = [];
const DOUBLE: Rules = Rules { precision: Precision::F64, ..CONTRACT };

/// The truth about one ray.
fn truth(rules: &Rules, ray: &Ray, spheres: &[Sphere]) -> Truth {
    let mut truths = Vec::new();
    Shared::new(spheres).truths(rules, &[*ray], &mut truths);
    truths[0]
}

/// The kinds of wrong answers that a judge sees in one.
fn wrong(rules: Rules, ray: &Ray, spheres: &[Sphere], answer: Answer) -> Vec<Kind> {
    let mut judge = Judge::new(rules, false);
    judge.shared(&Shared::new(spheres), &[*ray], &[Some(answer)], &[]);
    let counts = judge.total().by_rules;
    assert_eq!(counts.judged, 1, "{counts:?}");
    Kind::ALL.into_iter().filter(|&kind| counts.of(kind) > 0).collect()
}

fn of_sphere(t: f64, sphere: u32) -> Answer {
    Answer { t, sphere: Some(sphere) }
}

/// Double precision tells a root from an end to which it is rounded, and compares it with the end that the ray has.
#[test]
fn a_root_rounded_to_an_open_end_is_left_open() {
    let small = Sphere::from([0.0, 0.0, 1.25, 0.25 - 2.0_f32.powi(-26)]);
    let large = Sphere::from([0.0, 0.0, 1.25, 0.25 + 2.0_f32.powi(-25)]);
    let behind = Sphere::from([0.0, 0.0, 9.0, 1.0]);
    for (sphere, ray, interval) in [
        (small, Ray { t_min: 1.0, ..RAY }, Interval::OpenStart),
        (large, Ray { t_max: 1.0, ..RAY }, Interval::OpenEnd),
    ] {
        assert_eq!(roots(Exact, &ray, &sphere).map(|roots| roots[0]), Some(1.0));
        let rules = Rules { interval, ..DOUBLE };
        assert_eq!(of_pair(&rules, &ray, &sphere), Truth::Open, "{interval:?}");
        for spheres in [vec![sphere], vec![behind, sphere]] {
            assert_eq!(truth(&rules, &ray, &spheres), Truth::Open, "{interval:?}");
        }
        // Single precision knows no root but the rounded one.
        let single = Rules { precision: Precision::F32, ..rules };
        assert_ne!(of_pair(&single, &ray, &sphere), Truth::Open);
    }
}

#[test]
fn a_root_that_overflows_is_left_open_beside_others() {
    let far = Sphere::from([0.0, 0.0, 1e10, 1.0]);
    let ray = Ray::new(Vec3::ZERO, Vec3::Z * 1e-30);
    assert_eq!(of_pair(&DOUBLE, &ray, &far), Truth::Open);
    for spheres in [vec![far], vec![Sphere::from([9.0, 0.0, 0.0, 1.0]), far]] {
        assert_eq!(truth(&DOUBLE, &ray, &spheres), Truth::Open);
        assert_eq!(truth(&CONTRACT, &ray, &spheres), Truth::Miss);
    }
    // Behind a hit it is not the first.
    let near = Sphere::from([0.0, 0.0, 1e-20, 1e-21]);
    assert_eq!(truth(&DOUBLE, &ray, &[near, far]), of_pair(&CONTRACT, &ray, &near));
}

#[test]
fn one_sphere_is_a_scene_of_one() {
    let mut open = 0;
    for interval in [Interval::Closed, Interval::Open, Interval::OpenStart, Interval::OpenEnd] {
        let rules = Rules { interval, ..DOUBLE };
        for family in FAMILIES {
            for case in family.cases(200) {
                let pair = of_pair(&rules, &case.ray, &case.sphere);
                let scene = truth(&rules, &case.ray, &[case.sphere]);
                assert_eq!(pair, scene, "{interval:?}, {family:?}: {case:?}");
                open += u32::from(pair == Truth::Open);
            }
        }
    }
    assert!(open > 400, "{open}");
}

/// Two spheres are met at t = 5, the second in one point.
#[test]
fn a_tangent_that_may_be_a_hit_ties() {
    let ray = Ray { origin: Vec3::X, ..RAY };
    let spheres = [[1.0, 0.0, 6.0, 1.0], [0.0, 0.0, 5.0, 1.0]].map(Sphere::from);
    let rules = Rules { tangents: Tangents::Either, ties: Ties::Rounded, ..CONTRACT };
    for sphere in [0, 1] {
        assert_eq!(wrong(rules, &ray, &spheres, of_sphere(5.0, sphere)), RIGHT);
    }
    let miss = Rules { tangents: Tangents::Miss, ..rules };
    assert_eq!(wrong(miss, &ray, &spheres, of_sphere(5.0, 1)), [Kind::OtherSphere]);
}

/// Roots of 2e-50 and 5e-51, both rounded to zero, and a tangent before both.
#[test]
fn roots_rounded_to_zero_have_their_order() {
    let ray = Ray::new(Vec3::ZERO, Vec3::Z * 1e30);
    let spheres =
        [[0.0, 0.0, 3e-20, 1e-20], [0.0, 0.0, 1.5e-20, 1e-20], [1e-20, 0.0, 1e-21, 1e-20]]
            .map(Sphere::from);
    let equal = Rules { ties: Ties::Equal, ..CONTRACT };
    let judged =
        |rules, count: usize, sphere| wrong(rules, &ray, &spheres[..count], of_sphere(0.0, sphere));
    assert_eq!(judged(equal, 2, 1), RIGHT);
    assert_eq!(judged(equal, 2, 0), [Kind::OtherSphere]);
    assert_eq!(judged(Rules { ties: Ties::Rounded, ..equal }, 2, 0), RIGHT);
    let miss = Rules { tangents: Tangents::Miss, ..equal };
    assert_eq!(judged(miss, 3, 1), RIGHT);
    assert_eq!(judged(miss, 3, 0), [Kind::OtherSphere]);
}

/// A line that misses several spheres has no place among those that nearly touch one.
#[test]
fn a_miss_that_names_no_sphere_has_no_place() {
    let spheres = [[4.0, 0.0, 5.0, 1.0], [8.0, 0.0, 5.0, 1.0]].map(Sphere::from);
    for (count, places) in [(1, 1), (2, 0)] {
        let some = &spheres[..count];
        let mut judge = Judge::new(CONTRACT, true);
        let answers = Kernel(Tier::Exact).closest_hits(some, &[RAY]);
        judge.shared(&Shared::new(some), &[RAY], &answers, &[]);
        let total = judge.total();
        assert_eq!(total.by_rules.judged, 1);
        assert_eq!(total.places.iter().map(|place| place[0]).sum::<u64>(), places);
    }
}
