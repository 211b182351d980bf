//! `Exact` against the oracle on what proptest draws: what fails is shrunk to a case that can be
//! read, printed in hexadecimal floats.

use proptest::prelude::*;
use proptest::test_runner::Config;
use spherule_kernel::{Exact, roots};
use spherule_tests::{inputs, oracle, widths::WIDTHS};

proptest! {
    // PROPTEST_CASES asks for more.
    #![proptest_config(Config { failure_persistence: None, ..Config::default() })]

    #[test]
    fn a_pair_is_the_oracles(
        case in prop_oneof![inputs::lattice(), inputs::walked(), inputs::wild(), inputs::hard()]
    ) {
        let expected = oracle::intersect(&case.ray, &case.sphere).map(f32::to_bits);
        for width in WIDTHS {
            prop_assert_eq!((width.pairs)(&[case])[0].map(f32::to_bits), expected);
            let hit = (width.nearest)(&[case.ray], &[case.sphere])[0];
            prop_assert_eq!(hit.map(|hit| hit.t.to_bits()), expected);
        }
    }

    #[test]
    fn both_roots_are_the_oracles(
        case in prop_oneof![inputs::lattice(), inputs::walked(), inputs::wild(), inputs::hard()]
    ) {
        let bits = |roots: Option<[f32; 2]>| roots.map(|roots| roots.map(f32::to_bits));
        let found = roots::<Exact>(&case.ray, &case.sphere);
        prop_assert_eq!(bits(found), bits(oracle::roots(&case.ray, &case.sphere)));
    }

    #[test]
    fn the_nearest_of_a_scene_is_the_oracles(scene in inputs::scene(inputs::case)) {
        for width in WIDTHS {
            let found = (width.nearest)(&scene.rays, &scene.spheres);
            for (ray, found) in scene.rays.iter().zip(found) {
                let bits = |hit: spherule_kernel::Hit| (hit.t.to_bits(), hit.sphere);
                let expected = oracle::nearest(ray, &scene.spheres).map(bits);
                prop_assert_eq!(found.map(bits), expected, "{} lanes", width.lanes);
            }
        }
    }
}
