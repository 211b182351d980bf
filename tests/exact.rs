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
use proptest::test_runner::TestCaseError;
use spherule_kernel::{Hit, Ray, Sphere, Tier, roots};
use spherule_referee::case::Case;
use spherule_referee::families::FAMILIES;
use spherule_referee::scene::Scene;
use spherule_referee::strategies;
use spherule_tests::variants::{
    Memory, Variant, bits as hit_bits, lists, pair_layers, pairs_of, variants, viewpoint_of,
};
use spherule_tests::{oracle, vectors};

/// The variants of lists in the tier.
fn exact_lists() -> impl Iterator<Item = Variant> {
    lists().filter(|variant| variant.tier == Tier::Exact)
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

/// Checks 16 cases with their answers, as pairs, and each sphere as a list of its own for all 16
/// rays.
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
        for variant in exact_lists() {
            let found = variant.closest(&[case.sphere], &rays)[index].map(|hit| hit.t);
            assert_eq!(bits(found), bits(expected[index]), "{variant:?}: {case:?}");
        }
    }
}

#[test]
fn the_vectors_are_answered_bit_for_bit() {
    let vectors = vectors::read().unwrap_or_else(|| {
        let own = FAMILIES.iter().flat_map(|family| {
            family.cases(1000).map(|case| vectors::Vector {
                regime: family.number,
                case,
                expected: oracle::intersect(&case.ray, &case.sphere),
            })
        });
        own.collect()
    });
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
                let found = roots(Tier::Exact, &case.ray, &case.sphere);
                let root_bits =
                    |roots: Option<[f32; 2]>| roots.map(|roots| roots.map(f32::to_bits));
                // Roots are those of the line: an empty interval changes nothing.
                assert_eq!(root_bits(found), root_bits(rounded), "roots: {case:?}");
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
    let (mut hits, mut equal) = (0, 0);
    for family in FAMILIES {
        for scene in 0..scenes {
            let cases: Vec<Case> =
                (0..9).map(|index| family.case(first() + scene * 9 + index)).collect();
            let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
            // Every sphere stands twice, groups of four apart: of equal t the first must win.
            let spheres: Vec<Sphere> = (0..18).map(|i| cases[i * 7 % 9].sphere).collect();
            let expected: Vec<_> = rays.iter().map(|ray| oracle::closest(ray, &spheres)).collect();
            hits += expected.iter().flatten().count();
            equal += expected.iter().flatten().filter(|hit| hit.sphere < 9).count();
            if let Err(difference) = check_scene(&Scene { rays, spheres }, &expected) {
                panic!("{family:?}: {difference}");
            }
        }
    }
    println!("{} rays against 18 spheres, {hits} hits, 0 mismatches", scenes * 9 * 22);
    assert_eq!(hits, equal, "the lower index of twins wins");
}

/// Asserts that every variant of the tier gives the expected hits.
fn check_scene(scene: &Scene, expected: &[Option<Hit>]) -> Result<(), TestCaseError> {
    let Scene { rays, spheres } = scene;
    let expected: Vec<_> = expected.iter().copied().map(hit_bits).collect();
    Memory::new(spheres).sorted(viewpoint_of(rays), |structures| {
        for variant in variants().filter(|variant| variant.tier == Tier::Exact) {
            let found: Vec<_> =
                variant.ask(structures, rays).hits.into_iter().map(hit_bits).collect();
            prop_assert_eq!(&found, &expected, "{:?}: {:?}", variant, scene);
        }
        Ok(())
    })
}

proptest! {
    #![proptest_config(strategies::config(256))]

    /// A failure is shrunk to a readable case.
    #[test]
    fn a_drawn_pair_is_the_oracles(case in strategies::case()) {
        let t = oracle::intersect(&case.ray, &case.sphere);
        for layer in pair_layers() {
            let found = pairs_of(Tier::Exact, layer, &[case])[0];
            prop_assert_eq!(bits(found), bits(t), "{:?}", layer);
        }
        let hit = t.map(|t| Hit { t, sphere: 0 });
        check_scene(&Scene { rays: vec![case.ray], spheres: vec![case.sphere] }, &[hit])?;
        let bits = |roots: Option<[f32; 2]>| roots.map(|roots| roots.map(f32::to_bits));
        let found = roots(Tier::Exact, &case.ray, &case.sphere);
        prop_assert_eq!(bits(found), bits(oracle::roots(&case.ray, &case.sphere)));
    }

    #[test]
    fn the_closest_of_a_drawn_scene_is_the_oracles(scene in strategies::scene(strategies::case)) {
        let expected: Vec<_> =
            scene.rays.iter().map(|ray| oracle::closest(ray, &scene.spheres)).collect();
        check_scene(&scene, &expected)?;
    }
}
