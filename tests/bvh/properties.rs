//! As brute force does: whatever proptest finds.

use crate::{BOTH, EXACT, difference};
use proptest::prelude::*;
use spherule_tests::inputs::{self, Scene};

fn check(tiers: &[&str], scene: &Scene) -> Result<(), TestCaseError> {
    match difference(tiers, &scene.rays, &scene.spheres) {
        Some(difference) => Err(TestCaseError::fail(difference)),
        None => Ok(()),
    }
}

proptest! {
    #![proptest_config(inputs::config(200))]

    #[test]
    fn scenes_on_the_lattice(scene in inputs::scene(inputs::lattice)) {
        check(BOTH, &scene)?;
    }

    #[test]
    fn scenes_near_the_lattice(scene in inputs::scene(inputs::walked)) {
        check(BOTH, &scene)?;
    }

    #[test]
    fn scenes_of_every_size(scene in inputs::sized_scene()) {
        check(EXACT, &scene)?;
    }

    #[test]
    fn scenes_of_any_bits(scene in inputs::scene(inputs::wild)) {
        check(EXACT, &scene)?;
    }

    #[test]
    fn scenes_of_every_regime(scene in inputs::scene(inputs::hard)) {
        check(EXACT, &scene)?;
    }

    #[test]
    fn scenes_of_all_kinds(scene in inputs::scene(inputs::case)) {
        check(EXACT, &scene)?;
    }
}
