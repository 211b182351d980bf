//! `Exact` against the truth: in every variant, alone and through the filter, t bit for bit.
//!
//! `cargo test` takes a fixed number of cases. The nightly run takes 10^6 a family and 10^7 of the
//! lattice, some ten minutes on a core:
//!
//! ```text
//! SPHERULE_CASES=1000000 cargo test -p spherule-tests exact -- --nocapture
//! ```
//!
//! `SPHERULE_SEED=N` draws other cases. Whether neighbours change anything is asked by `tests/agreement.rs`, as often as
//! `PROPTEST_CASES` says.

mod discriminant;
mod lattice;

use proptest::prelude::*;
use spherule_kernel::{Hit, Ray, Sphere, Tier, roots};
use spherule_referee::case::Case;
use spherule_referee::families::FAMILIES;
use spherule_referee::scene::Scene;
use spherule_referee::strategies;
use spherule_tests::oracle::{self, root_bits};
use spherule_tests::variants::{Variant, assert_hits, lists, pair_layers, pairs_of};
use spherule_tests::vectors;

fn is_exact(variant: &Variant) -> bool {
    variant.tier == Tier::Exact
}

/// Cases a family.
fn count() -> u64 {
    variable("SPHERULE_CASES").unwrap_or(1500)
}

/// The first index in the families' streams, past the kept cases and those of other tests.
fn first() -> u64 {
    (1 + variable("SPHERULE_SEED").unwrap_or(0)) << 40
}

fn variable(name: &str) -> Option<u64> {
    let value = std::env::var(name).ok()?;
    Some(value.parse().unwrap_or_else(|_| panic!("{name}={value}: no count")))
}

/// Bits, so that -0 differs from 0 and a NaN is seen.
fn bits(t: Option<f32>) -> Option<u32> {
    t.map(f32::to_bits)
}

/// Checks cases with their answers, as pairs, and each sphere as a list of its own for all rays.
fn check(cases: &[Case], expected: &[Option<f32>]) {
    let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
    for layer in pair_layers() {
        let found = pairs_of(Tier::Exact, layer, cases);
        for index in 0..cases.len() {
            let case = cases[index];
            assert_eq!(bits(found[index]), bits(expected[index]), "{layer:?}: {case:?}");
        }
    }
    for (index, case) in cases.iter().enumerate() {
        for variant in lists().filter(is_exact) {
            let found = variant.closest(&[case.sphere], &rays)[index].map(|hit| hit.t);
            assert_eq!(bits(found), bits(expected[index]), "{variant:?}: {case:?}");
        }
    }
}

/// Roots are those of the line: an empty interval changes nothing.
fn check_roots(case: &Case, expected: Option<[f32; 2]>) {
    let found = roots(Tier::Exact, &case.ray, &case.sphere);
    assert_eq!(root_bits(found), root_bits(expected), "roots: {case:?}");
}

#[test]
fn the_vectors_are_answered_bit_for_bit() {
    let Some(vectors) = vectors::read() else { return };
    for vectors in vectors.chunks(16) {
        let cases: Vec<Case> = vectors.iter().map(|vector| vector.case).collect();
        let expected: Vec<Option<f32>> = vectors.iter().map(|vector| vector.expected).collect();
        check(&cases, &expected);
    }
    println!("{} cases, 0 mismatches", vectors.len());
}

#[test]
fn fresh_cases_of_every_family_are_answered_as_the_oracle_does() {
    for family in FAMILIES {
        let (mut hits, mut ties, mut done) = (0_u64, 0_u64, 0_u64);
        while done < count() {
            let cases: Vec<Case> =
                (done..done + 16).map(|index| family.case(first() + index)).collect();
            let mut expected = Vec::new();
            for case in &cases {
                let truth = oracle::roots_and_ties(&case.ray, &case.sphere);
                let rounded = truth.map(|roots| roots.map(|(root, _)| root));
                check_roots(case, rounded);
                let t = rounded.and_then(|roots| oracle::accepted(&case.ray, roots));
                hits += u64::from(t.is_some());
                ties += u64::from(truth.is_some_and(|roots| roots.iter().any(|root| root.1)));
                expected.push(t);
            }
            check(&cases, &expected);
            done += 16;
        }
        println!("{family:?}: {done} cases, {hits} hits, {ties} ties, 0 mismatches");
    }
}

#[test]
fn the_closest_of_many_hard_spheres_is_the_oracles() {
    let scenes = count() / 30;
    let mut hits = 0;
    for family in FAMILIES {
        println!("{family:?}");
        for scene in 0..scenes {
            let cases: Vec<Case> =
                (0..9).map(|index| family.case(first() + scene * 9 + index)).collect();
            let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
            // Every sphere stands twice, groups of four apart: of equal t the first must win.
            let spheres: Vec<Sphere> = (0..18).map(|i| cases[i * 7 % 9].sphere).collect();
            let expected: Vec<_> = rays.iter().map(|ray| oracle::closest(ray, &spheres)).collect();
            hits += expected.iter().flatten().count();
            assert_hits(&expected, &rays, &spheres, &is_exact);
        }
    }
    let rays = scenes * 9 * FAMILIES.len() as u64;
    println!("{rays} rays against 18 spheres, {hits} hits, 0 mismatches");
    // A thousand, for the fixed number of cases.
    assert!(hits as u64 >= 20 * scenes, "{hits} hits of {scenes} scenes");
}

proptest! {
    #![proptest_config(strategies::config(256))]

    /// A failure is shrunk to a readable case.
    #[test]
    fn a_drawn_pair_is_the_oracles(case in strategies::case()) {
        let t = oracle::intersect(&case.ray, &case.sphere);
        check(&[case], &[t]);
        assert_hits(&[t.map(|t| Hit { t, sphere: 0 })], &[case.ray], &[case.sphere], &is_exact);
        check_roots(&case, oracle::roots(&case.ray, &case.sphere));
    }

    #[test]
    fn the_closest_of_a_drawn_scene_is_the_oracles(scene in strategies::scene(strategies::case)) {
        let Scene { rays, spheres } = scene;
        let expected: Vec<_> = rays.iter().map(|ray| oracle::closest(ray, &spheres)).collect();
        assert_hits(&expected, &rays, &spheres, &is_exact);
    }
}
