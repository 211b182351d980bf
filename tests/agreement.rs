//! One answer, whatever the way to it: every lane width gives the bits of one lane, whatever its
//! neighbours; a list gives what its spheres give one at a time, whatever the filter skips.

use proptest::prelude::*;
use proptest::test_runner::TestCaseError;
use spherule_kernel::{Hit, Ray, Sphere, Vec3};
use spherule_tests::case::Case;
use spherule_tests::doors::{DOORS, Door};
use spherule_tests::inputs::{self, Scene};
use spherule_tests::regimes::REGIMES;

/// Bits, since -0 is not 0 here and NaN would be itself.
fn hit_bits(hit: Option<Hit>) -> Option<(u32, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.sphere))
}

fn t_bits(t: Option<f32>) -> Option<u32> {
    t.map(f32::to_bits)
}

/// Rules 3 and 4 in plain words, on the roots that the tier computes.
fn by_rules_3_and_4(door: &Door, ray: &Ray, sphere: &Sphere) -> Option<f32> {
    let [near, far] = (door.roots)(ray, sphere)?;
    let accepted = |t: f32| t.is_finite() && ray.t_min <= t && t <= ray.t_max;
    if accepted(near) {
        Some(near)
    } else if accepted(far) {
        Some(far)
    } else {
        None
    }
}

/// Rule 5 in plain words, sphere by sphere, no filter between.
fn by_rule_5(door: &Door, ray: &Ray, spheres: &[Sphere]) -> Option<Hit> {
    let mut nearest: Option<Hit> = None;
    for (index, &sphere) in spheres.iter().enumerate() {
        let Some(t) = (door.pairs)(&[Case { ray: *ray, sphere }])[0] else { continue };
        if nearest.is_none_or(|hit| t < hit.t) {
            nearest = Some(Hit { t, sphere: index as u32 });
        }
    }
    nearest
}

fn check_scene(scene: &Scene) -> Result<(), TestCaseError> {
    let Scene { rays, spheres } = scene;
    for reference in Door::references() {
        let expected: Vec<_> =
            rays.iter().map(|ray| hit_bits(by_rule_5(&reference, ray, spheres))).collect();
        for door in DOORS.iter().filter(|door| door.tier == reference.tier) {
            let (tier, lanes) = (door.tier, door.lanes);
            let hits: Vec<_> = (door.nearest)(rays, spheres).into_iter().map(hit_bits).collect();
            prop_assert_eq!(&hits, &expected, "nearest, {} in {} lanes", tier, lanes);
            let met: Vec<_> = expected.iter().map(Option::is_some).collect();
            prop_assert_eq!((door.any)(rays, spheres), met, "any, {} in {} lanes", tier, lanes);
        }
    }
    Ok(())
}

fn check_pairs(cases: &[Case]) -> Result<(), TestCaseError> {
    for door in DOORS {
        let reference = door.reference();
        let (tier, lanes) = (door.tier, door.lanes);
        for (case, t) in cases.iter().zip((door.pairs)(cases)) {
            let expected = by_rules_3_and_4(&reference, &case.ray, &case.sphere);
            prop_assert_eq!(t_bits(t), t_bits(expected), "{} in {} lanes, {:?}", tier, lanes, case);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(inputs::config(1000))]

    #[test]
    fn lists_are_their_spheres_on_the_lattice(scene in inputs::scene(inputs::lattice)) {
        check_scene(&scene)?;
    }

    #[test]
    fn lists_are_their_spheres_near_the_lattice(scene in inputs::scene(inputs::walked)) {
        check_scene(&scene)?;
    }

    #[test]
    fn lists_are_their_spheres_in_every_size(scene in inputs::sized_scene()) {
        check_scene(&scene)?;
    }

    #[test]
    fn lists_are_their_spheres_for_any_bits(scene in inputs::scene(inputs::wild)) {
        check_scene(&scene)?;
    }

    #[test]
    fn lists_are_their_spheres_in_every_regime(scene in inputs::scene(inputs::hard)) {
        check_scene(&scene)?;
    }

    #[test]
    fn lists_are_their_spheres_whatever_the_neighbours(scene in inputs::scene(inputs::case)) {
        check_scene(&scene)?;
    }
}

proptest! {
    #![proptest_config(inputs::config(5000))]

    #[test]
    fn pairs_are_their_roots_in_every_width(
        cases in prop::collection::vec(inputs::case(), 1..=35)
    ) {
        check_pairs(&cases)?;
    }

    #[test]
    fn pairs_are_their_roots_for_any_bits(
        cases in prop::collection::vec(inputs::wild(), 1..=35)
    ) {
        check_pairs(&cases)?;
    }
}

/// The filter on what it is hardest for: 2,000 cases a regime, each its own list of one.
#[test]
fn the_filter_drops_nothing_in_any_regime() {
    for regime in REGIMES {
        let cases: Vec<Case> = regime.cases(2000).collect();
        for door in Door::references() {
            for (case, t) in cases.iter().zip((door.pairs)(&cases)) {
                let hit = door.nearest_one(&case.ray, &[case.sphere]);
                assert_eq!(
                    t_bits(hit.map(|hit| hit.t)),
                    t_bits(t),
                    "{}, {regime:?}: {case:?}",
                    door.tier
                );
            }
        }
    }
}

/// A lane's bits do not change with its neighbours, nor with its place.
#[test]
fn neighbours_change_nothing() {
    for regime in REGIMES {
        let cases: Vec<Case> = regime.cases(64).collect();
        let strangers: Vec<Case> = REGIMES[19].cases(16).collect();
        for door in DOORS {
            let alone = door.reference();
            for (case, shift) in cases.iter().zip((0..16).cycle()) {
                let expected = t_bits((alone.pairs)(&[*case])[0]);
                let mut packet = strangers.clone();
                packet[shift] = *case;
                let found = t_bits((door.pairs)(&packet)[shift]);
                assert_eq!(found, expected, "{} in {} lanes: {case:?}", door.tier, door.lanes);

                let rays: Vec<Ray> = packet.iter().map(|case| case.ray).collect();
                let found = (door.nearest)(&rays, &[case.sphere])[shift];
                assert_eq!(
                    t_bits(found.map(|hit| hit.t)),
                    expected,
                    "{} in {} lanes: {case:?}",
                    door.tier,
                    door.lanes
                );
            }
        }
    }
}

/// Found by `lists_are_their_spheres_in_every_size`: with d 2^-38 long, a c is half of the least
/// number, `Fast` computes D = 0 and calls a miss a hit; the filter must leave that to it.
#[test]
fn the_filter_keeps_what_underflow_makes_a_hit() {
    let (d, r) = (2.0_f32.powi(-38), 2.0_f32.powi(-37));
    let numbers = [0.0, 0.0, 0.0, d, 0.0, 0.0, 0.0, f32::INFINITY, 0.0, -r, -r, r];
    let case = Case::from_numbers(numbers);
    for door in DOORS {
        let hit = door.nearest_one(&case.ray, &[case.sphere]);
        let expected = t_bits((door.pairs)(&[case])[0]);
        assert_eq!(t_bits(hit.map(|hit| hit.t)), expected, "{} in {}", door.tier, door.lanes);
    }
}

/// Found by `lists_are_their_spheres_in_every_size`: lengths about 2^-75, whose squares underflow,
/// and a nearer sphere, by an ulp, in the second group of four.
#[test]
fn a_nearer_sphere_of_a_later_group_is_kept_where_squares_underflow() {
    let size = 2.0_f32.powi(-76);
    let at = |z: f32, radius: f32| Sphere { center: Vec3::new(0.0, 0.0, z), radius };
    let ray = Ray { t_min: f32::NEG_INFINITY, ..Ray::new(Vec3::ZERO, Vec3::new(0.0, 0.0, 2.0)) };
    let mut spheres = [at(0.0, 0.0); 6];
    spheres[4] = at((-1.5 * size).next_up(), (2.0 * size).next_up());
    spheres[5] = at(-1.5 * size, 2.5 * size);
    let reordered = [4, 0, 1, 2, 3, 5].map(|index| spheres[index]);
    for spheres in [spheres, reordered] {
        for door in DOORS {
            let hit = hit_bits(door.nearest_one(&ray, &spheres));
            let expected = hit_bits(by_rule_5(&door, &ray, &spheres));
            assert_eq!(hit, expected, "{} in {} lanes", door.tier, door.lanes);
        }
    }
}
