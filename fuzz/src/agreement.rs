//! Every variant against one lane, bit for bit; and the rules of the contract, on the answers of the tier itself. Both
//! hold for any bits, in the tier's domain or not.

use crate::{promise, surfaces, tiles};
use spherule_kernel::{Hit, Ray, Sphere, Tier, Viewpoint, roots};
use spherule_referee::bytes::AimedScene;
use spherule_referee::case::Case;
#[cfg(test)]
use spherule_tests::oracle;
use spherule_tests::oracle::{accepted, is_closer};
use spherule_tests::variants::{
    Answers, Memory, Structure, Structures, Variant, bits, pair_layers, pairs_of, reference,
    variants,
};

/// Judges everything that the kernel answers about a scene.
///
/// # Panics
/// If an answer is wrong.
pub fn check(scene: &AimedScene) {
    let Ray { origin, direction, .. } = scene.rays[0];
    let mut memory = Memory::new(&scene.spheres);
    for viewpoint in [Viewpoint::Origin(origin), Viewpoint::Direction(direction)] {
        memory.sorted(viewpoint, |structures| {
            for tier in Tier::ALL {
                check_tier(tier, scene, structures);
            }
        });
    }
    for tier in Tier::ALL {
        surfaces::check(tier, scene);
    }
    tiles::check(scene);
}

fn check_tier(tier: Tier, scene: &AimedScene, structures: Structures<'_>) {
    let AimedScene { rays, aims, spheres } = scene;
    let single = reference(tier).closest(spheres, rays);
    for (ray, &hit) in rays.iter().zip(&single) {
        check_rules(tier, ray, spheres, hit);
        // Rule 3: the interval is closed, so the t that was returned finds the same hit again.
        if let Some(Hit { t, .. }) = hit {
            assert!(!(t == 0.0 && t.is_sign_negative()), "-0: {ray:?}");
            let again = reference(tier).closest(spheres, &[Ray { t_max: t, ..*ray }])[0];
            assert_eq!(bits(again), bits(hit), "{tier:?}: {ray:?}");
        }
    }
    // In structures, `Fast`, `Geometric`, and `Stable` outside its domain answer as the bounds say, not as their
    // formula says: only lists answer as the reference does.
    let same = |variant: &Variant| tier == Tier::Exact || variant.structure == Structure::List;
    for variant in variants().filter(|variant| variant.tier == tier).filter(same) {
        let Answers { hits, occluded } = variant.ask(structures, rays);
        for (index, expected) in single.iter().enumerate() {
            let (hit, occluded) = (hits[index], occluded[index]);
            let say = || format!("{variant:?}, ray {index} of {scene:?}");
            assert_eq!(bits(hit), bits(*expected), "closest: {}", say());
            assert_eq!(occluded, expected.is_some(), "any: {}", say());
        }
    }

    // Ray i and the sphere that it was aimed at.
    let case = |(&ray, &aim): (&Ray, &usize)| Case { ray, sphere: spheres[aim] };
    let cases: Vec<Case> = rays.iter().zip(aims).map(case).collect();
    let answer = |case: &Case| {
        let roots = roots(tier, &case.ray, &case.sphere);
        promise::judge(tier, &case.ray, &case.sphere, roots);
        roots.and_then(|roots| accepted(&case.ray, roots)).map(f32::to_bits)
    };
    let expected: Vec<_> = cases.iter().map(answer).collect();
    for layer in pair_layers() {
        let found: Vec<_> =
            pairs_of(tier, layer, &cases).into_iter().map(|t| t.map(f32::to_bits)).collect();
        assert_eq!(found, expected, "pairs: {tier:?}, {layer:?}: {cases:?}");
    }
}

/// Rules 1 and 3 to 5, on a one-lane answer.
fn check_rules(tier: Tier, ray: &Ray, spheres: &[Sphere], hit: Option<Hit>) {
    let mut expected: Option<Hit> = None;
    for (index, sphere) in spheres.iter().enumerate() {
        let both = roots(tier, ray, sphere);
        // Rule 1: an invalid sphere is never hit, and an invalid ray never hits.
        let ray_is_valid = ray.origin.is_finite()
            && ray.direction.is_finite()
            && ray.direction.to_array() != [0.0; 3];
        assert!(both.is_none() || (ray_is_valid && sphere.is_valid()), "{ray:?} {sphere:?}");
        // Rules 3 and 4: the first accepted root. Rule 5: the smallest root, the lowest index.
        let Some(t) = both.and_then(|both| accepted(ray, both)) else { continue };
        let hit = Hit { t, sphere: index as u32 };
        if expected.is_none_or(|known| is_closer(tier, ray, spheres, hit, known)) {
            expected = Some(hit);
        }
    }
    assert_eq!(bits(hit), bits(expected), "{tier:?}: {hit:?}, rules {expected:?}: {ray:?}");
}

/// Bytes for the tests.
#[cfg(test)]
pub(crate) fn random_bytes(seed: u64) -> Vec<u8> {
    let mut random = spherule_referee::random::Random::new(seed, 0);
    (0..700).map(|_| random.bits() as u8).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn random_scenes_pass() {
        for seed in 0..500 {
            check(&AimedScene::from_bytes(&random_bytes(seed)));
        }
    }

    #[test]
    fn random_bytes_make_geometry_worth_judging() {
        let (mut judged, mut met, mut all) = (0, 0, 0);
        for seed in 0..200 {
            let scene = AimedScene::from_bytes(&random_bytes(seed));
            for (ray, &aim) in scene.rays.iter().zip(&scene.aims) {
                let sphere = &scene.spheres[aim];
                all += 1;
                judged += i32::from(promise::in_domain(ray, sphere));
                met += i32::from(oracle::meets(ray, sphere));
            }
        }
        println!("{judged} judged, {met} met of {all}");
        assert!(judged * 3 > all, "{judged} of {all} in the domain");
        assert!(met * 4 > all, "{met} of {all} meet");
    }

    #[test]
    fn the_corpus_passes() {
        let corpus = concat!(env!("CARGO_MANIFEST_DIR"), "/../fuzz/corpus/packet_against_oracle");
        let mut files = 0;
        for entry in std::fs::read_dir(corpus).expect("the corpus is there") {
            let path = entry.expect("an entry").path();
            let bytes = std::fs::read(&path).expect("a file");
            println!("{}", path.display());
            check(&AimedScene::from_bytes(&bytes));
            files += 1;
        }
        assert!(files >= 20, "{files} files");
    }

    #[test]
    #[should_panic(expected = "rules")]
    fn a_hit_that_breaks_the_rules_is_seen() {
        let scene = AimedScene::from_bytes(&[]);
        let hit = Some(Hit { t: 1.0, sphere: 0 });
        check_rules(Tier::Stable, &scene.rays[0], &scene.spheres, hit);
    }
}
