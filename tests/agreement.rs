//! One answer, whatever the way to it. Every variant gives the bits of one lane, whatever that lane's neighbours; a
//! list gives what its spheres give one at a time, whatever the filter skips; a tree and a depth list give what the
//! list gives.

use proptest::prelude::*;
use spherule_kernel::Tier::{Exact, Stable};
use spherule_kernel::{Hit, Ray, Sphere, Tier, Vec3, Viewpoint, roots};
use spherule_referee::case::Case;
use spherule_referee::families::FAMILIES;
use spherule_referee::scene::Scene;
use spherule_referee::strategies;
use spherule_tests::oracle;
use spherule_tests::variants::{
    Layer, Structure, assert_hits, assert_same_from, bits, lists, pair_layers, pairs_of, reference,
};

fn t_bits(t: Option<f32>) -> Option<u32> {
    t.map(f32::to_bits)
}

/// The t of a case on its own, in one lane.
fn alone(tier: Tier, case: &Case) -> Option<f32> {
    pairs_of(tier, Layer::Lanes(1), &[*case])[0]
}

/// Rule 5 in plain words: sphere by sphere, without a filter.
fn by_rule_5(tier: Tier, ray: &Ray, spheres: &[Sphere]) -> Option<Hit> {
    let cases: Vec<Case> = spheres.iter().map(|&sphere| Case { ray: *ray, sphere }).collect();
    let mut closest: Option<Hit> = None;
    for (index, t) in pairs_of(tier, Layer::Lanes(1), &cases).into_iter().enumerate() {
        let Some(t) = t else { continue };
        let hit = Hit { t, sphere: index as u32 };
        if closest.is_none_or(|known| oracle::is_closer(tier, ray, spheres, hit, known)) {
            closest = Some(hit);
        }
    }
    closest
}

/// Checks all variants of lists, and for `tiers` those of all structures.
fn check_scene(Scene { rays, spheres }: &Scene, tiers: &[Tier]) {
    for tier in Tier::ALL {
        let expected: Vec<_> = rays.iter().map(|ray| by_rule_5(tier, ray, spheres)).collect();
        assert_hits(&expected, rays, spheres, &|variant| {
            let is_promised = variant.structure == Structure::List || tiers.contains(&tier);
            variant.tier == tier && is_promised
        });
    }
}

/// Checks rules 3 and 4 on the roots that the tier computes.
fn check_pairs(cases: &[Case]) {
    for tier in Tier::ALL {
        let answer = |case: &Case| {
            let roots = roots(tier, &case.ray, &case.sphere)?;
            oracle::accepted(&case.ray, roots).map(f32::to_bits)
        };
        let expected: Vec<_> = cases.iter().map(answer).collect();
        for layer in pair_layers() {
            let found: Vec<_> = pairs_of(tier, layer, cases).into_iter().map(t_bits).collect();
            assert_eq!(found, expected, "{tier:?}, {layer:?}: {cases:?}");
        }
    }
}

const BOTH: &[Tier] = &[Exact, Stable];
const EXACT: &[Tier] = &[Exact];

proptest! {
    #![proptest_config(strategies::config(1000))]

    #[test]
    fn scenes_are_their_spheres_on_the_lattice(scene in strategies::scene(strategies::lattice)) {
        check_scene(&scene, BOTH);
    }

    #[test]
    fn scenes_are_their_spheres_near_the_lattice(scene in strategies::scene(strategies::walked)) {
        check_scene(&scene, BOTH);
    }

    #[test]
    fn scenes_are_their_spheres_in_every_size(scene in strategies::sized_scene()) {
        check_scene(&scene, EXACT);
    }

    #[test]
    fn scenes_are_their_spheres_for_any_bits(scene in strategies::scene(strategies::wild)) {
        check_scene(&scene, EXACT);
    }

    #[test]
    fn scenes_are_their_spheres_in_every_family(scene in strategies::scene(strategies::hard)) {
        check_scene(&scene, EXACT);
    }

    #[test]
    fn scenes_are_their_spheres_whatever_the_neighbours(scene in strategies::scene(strategies::case)) {
        check_scene(&scene, EXACT);
    }
}

proptest! {
    #![proptest_config(strategies::config(300))]

    /// The viewpoint is the first ray's origin or direction, which most other rays share.
    #[test]
    fn rays_that_share_a_viewpoint(scene in strategies::scene(strategies::case), alone in any::<bool>()) {
        let Scene { mut rays, spheres } = scene;
        let first = rays[0];
        for viewpoint in [Viewpoint::Origin(first.origin), Viewpoint::Direction(first.direction)] {
            for (_, ray) in rays.iter_mut().enumerate().filter(|(i, _)| !alone || i % 5 != 4) {
                match viewpoint {
                    Viewpoint::Origin(origin) => ray.origin = origin,
                    Viewpoint::Direction(direction) => ray.direction = direction,
                }
            }
            assert_same_from(viewpoint, EXACT, &rays, &spheres);
        }
    }
}

proptest! {
    #![proptest_config(strategies::config(5000))]

    #[test]
    fn pairs_are_their_roots_in_every_width(
        cases in prop::collection::vec(strategies::case(), 1..=35)
    ) {
        check_pairs(&cases);
    }

    #[test]
    fn pairs_are_their_roots_for_any_bits(
        cases in prop::collection::vec(strategies::wild(), 1..=35)
    ) {
        check_pairs(&cases);
    }
}

/// The filter on the cases that are hardest for it: 2,000 cases a family, each its own list of one.
#[test]
fn the_filter_drops_nothing_in_any_family() {
    for family in FAMILIES {
        let cases: Vec<Case> = family.cases(2000).collect();
        for tier in Tier::ALL {
            for (case, t) in cases.iter().zip(pairs_of(tier, Layer::Lanes(1), &cases)) {
                let hit = reference(tier).closest(&[case.sphere], &[case.ray])[0];
                let found = hit.map(|hit| hit.t.to_bits());
                assert_eq!(found, t_bits(t), "{tier:?}, {family:?}: {case:?}");
            }
        }
    }
}

/// Found by `scenes_are_their_spheres_in_every_size`. With d 2^-38 long, a c is half of the least number, so `Fast`
/// computes D = 0 and calls a miss a hit. The filter must leave that decision to `Fast`.
#[test]
fn the_filter_keeps_what_underflow_makes_a_hit() {
    let (d, r) = (2.0_f32.powi(-38), 2.0_f32.powi(-37));
    let numbers = [0.0, 0.0, 0.0, d, 0.0, 0.0, 0.0, f32::INFINITY, 0.0, -r, -r, r];
    let case = Case::from_numbers(numbers);
    for variant in lists() {
        let hit = variant.closest(&[case.sphere], &[case.ray])[0];
        let expected = t_bits(alone(variant.tier, &case));
        assert_eq!(hit.map(|hit| hit.t.to_bits()), expected, "{variant:?}");
    }
}

/// Found by `scenes_are_their_spheres_in_every_size`. Lengths are about 2^-75, so their squares underflow, and a sphere
/// that is nearer by an ulp is in the second group of four.
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
        for variant in lists() {
            let hit = bits(variant.closest(&spheres, &[ray])[0]);
            assert_eq!(hit, bits(by_rule_5(variant.tier, &ray, &spheres)), "{variant:?}");
        }
    }
}
