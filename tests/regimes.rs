//! The generators hit what they claim to hit, by the oracle's word.

use spherule_tests::aim::double;
use spherule_tests::case::Case;
use spherule_tests::oracle;
use spherule_tests::random::dot;
use spherule_tests::regimes::REGIMES;
use std::cmp::Ordering;

const COUNT: u64 = 400;

/// In how many of the first [`COUNT`] cases of a regime `claim` holds.
fn count(regime: usize, claim: impl Fn(&Case) -> bool) -> u64 {
    REGIMES[regime].cases(COUNT).filter(claim).count() as u64
}

fn hits(case: &Case) -> bool {
    oracle::intersect(&case.ray, &case.sphere).is_some()
}

fn any_root(case: &Case, claim: impl Fn(f32) -> bool) -> bool {
    oracle::roots(&case.ray, &case.sphere).is_some_and(|roots| roots.into_iter().any(claim))
}

fn discriminant_is(case: &Case, sign: Ordering) -> bool {
    oracle::discriminant_sign(&case.ray, &case.sphere) == Some(sign)
}

/// Distance / radius of the centre, in double precision.
fn distance_in_radii(case: &Case) -> f64 {
    let (c, o) = (double(case.sphere.center), double(case.ray.origin));
    let p = [c[0] - o[0], c[1] - o[1], c[2] - o[2]];
    dot(p, p).sqrt() / f64::from(case.sphere.radius)
}

#[test]
fn each_is_at_its_number() {
    for (index, regime) in REGIMES.iter().enumerate() {
        assert_eq!(usize::from(regime.number), index);
    }
}

#[test]
fn both_answers_occur() {
    for regime in REGIMES {
        let hits = count(usize::from(regime.number), hits);
        println!("{regime:?}: {hits} hits of {COUNT}");
        let least = match regime.number {
            // Always from inside, or always a tangent in front of the ray or behind it.
            5 | 7 | 17 => 0,
            19 => 1,
            _ => COUNT / 20,
        };
        assert!(hits >= COUNT / 20 || regime.number == 19 && hits > 0, "{regime:?}: {hits} hits");
        assert!(COUNT - hits >= least, "{regime:?}: {hits} hits of {COUNT}");
    }
}
