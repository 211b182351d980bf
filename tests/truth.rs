//! The referee's truth under rules equals that of the oracle.

use spherule_kernel::{Hit, Tier};
use spherule_referee::case::Case;
use spherule_referee::families::FAMILIES;
use spherule_referee::rules::{Inside, Interval, Rules, Tangents};
use spherule_referee::truth::{Shared, Truth, of_pair, of_pairs};
use spherule_tests::oracle;
use std::cmp::Ordering;

const CONTRACT: Rules = Rules::CONTRACT;

/// What rules make of a case, from the oracle's roots alone.
fn expected(rules: &Rules, case: &Case) -> Truth {
    let Case { ray, sphere } = case;
    let Some(roots) = oracle::roots(ray, sphere) else { return Truth::Miss };
    let (open_start, open_end) = match rules.interval {
        Interval::Closed => (false, false),
        Interval::Open => (true, true),
        Interval::OpenStart => (true, false),
        Interval::OpenEnd => (false, true),
    };
    let counts = |t: &f32| {
        let after = if open_start { ray.t_min < *t } else { ray.t_min <= *t };
        let before = if open_end { *t < ray.t_max } else { *t <= ray.t_max };
        t.is_finite() && after && before
    };
    let Some(t) = roots.into_iter().find(counts) else { return Truth::Miss };
    if rules.inside == Inside::Miss && oracle::side(ray.origin, sphere) == Ordering::Less {
        return Truth::Miss;
    }
    let is_tangent = oracle::discriminant_sign(ray, sphere) == Some(Ordering::Equal);
    match rules.tangents {
        Tangents::Miss if is_tangent => Truth::Miss,
        Tangents::Either if is_tangent => Truth::Open,
        _ => Truth::Hit(Hit { t, sphere: 0 }),
    }
}

#[test]
fn of_a_pair() {
    let (mut open, mut changed) = (0, 0);
    for rules in [
        CONTRACT,
        Rules { interval: Interval::Open, ..CONTRACT },
        Rules { interval: Interval::OpenStart, tangents: Tangents::Miss, ..CONTRACT },
        Rules { interval: Interval::OpenEnd, inside: Inside::Miss, ..CONTRACT },
        Rules { tangents: Tangents::Either, ..CONTRACT },
    ] {
        for family in FAMILIES {
            let cases: Vec<Case> = family.cases(300).collect();
            let (rays, spheres): (Vec<_>, Vec<_>) =
                cases.iter().map(|case| (case.ray, case.sphere)).unzip();
            let mut truths = Vec::new();
            of_pairs(&rules, &rays, &spheres, &mut truths);
            for (case, truth) in cases.iter().zip(truths) {
                assert_eq!(truth, expected(&rules, case), "{rules:?}, {family:?}: {case:?}");
                assert_eq!(truth, of_pair(&rules, &case.ray, &case.sphere));
                open += usize::from(truth == Truth::Open);
                changed += usize::from(truth != expected(&CONTRACT, case));
            }
        }
    }
    assert!(open > 300 && changed > 1000, "{open} open, {changed} changed");
}

/// The closest hit under rules is the closest of the hits that each sphere has under rules.
#[test]
fn of_many_spheres() {
    let rules = Rules { tangents: Tangents::Miss, inside: Inside::Miss, ..CONTRACT };
    let mut hits = 0;
    for family in FAMILIES {
        let cases: Vec<Case> = family.cases(160).collect();
        for cases in cases.chunks(8) {
            let (rays, spheres): (Vec<_>, Vec<_>) =
                cases.iter().map(|case| (case.ray, case.sphere)).unzip();
            let mut truths = Vec::new();
            Shared::new(&spheres).truths(&rules, &rays, &mut truths);
            for (ray, truth) in rays.iter().zip(truths) {
                let mut closest: Option<Hit> = None;
                for (index, sphere) in (0..).zip(&spheres) {
                    let case = Case { ray: *ray, sphere: *sphere };
                    let Truth::Hit(hit) = expected(&rules, &case) else { continue };
                    let hit = Hit { sphere: index, ..hit };
                    let closer = |known| oracle::is_closer(Tier::Exact, ray, &spheres, hit, known);
                    if closest.is_none_or(closer) {
                        closest = Some(hit);
                    }
                }
                assert_eq!(truth.hit(), closest, "{family:?}: {ray:?} {spheres:?}");
                hits += usize::from(closest.is_some());
            }
        }
    }
    assert!(hits > 500, "{hits}");
}
