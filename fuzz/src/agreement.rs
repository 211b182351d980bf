//! Every variant against one lane; and the rules of the contract, on the answers of the tier itself, which hold for any
//! bits, in the tier's domain or not.

use crate::{objects, pairs, promise, surfaces, tiles};
use spherule_kernel::{Hit, Ray, Sphere, Tier, Viewpoint, roots};
use spherule_referee::bytes::AimedScene;
use spherule_tests::oracle::{accepted, is_closer};
use spherule_tests::variants::{
    Answers, Memory, Structure, Structures, Variant, bits, reference, variants,
};

/// A tree of so many spheres has boxes, though a third of them are invalid. Smaller trees look into every leaf.
const MANY: usize = 100;

/// Judges everything that the kernel answers about a scene.
///
/// # Panics
/// If an answer is wrong.
pub fn check(scene: &AimedScene) {
    let AimedScene { rays, spheres, .. } = scene;
    let one_lane = Tier::ALL.map(|tier| OneLane::new(tier, scene));
    for OneLane { tier, hits, .. } in &one_lane {
        check_one_lane(*tier, scene, hits);
        pairs::check(*tier, scene);
        objects::check(*tier, scene, hits);
        surfaces::check(*tier, scene);
    }
    let Ray { origin, direction, .. } = rays[0];
    let mut memory = Memory::new(spheres);
    memory.sorted(Viewpoint::Origin(origin), |structures| {
        check_variants(variants(), structures, scene, &one_lane);
    });
    // The other structures have no viewpoint.
    let lists = variants().filter(|variant| matches!(variant.structure, Structure::DepthList(_)));
    memory.sorted(Viewpoint::Direction(direction), |structures| {
        check_variants(lists, structures, scene, &one_lane);
    });
    let many = with_copies(scene);
    Memory::new(&many.spheres).sorted(Viewpoint::Origin(origin), |structures| {
        use Structure::{Refitted, Stream, Tree};
        let is_tree =
            |asked: &Variant| matches!(asked.structure, Tree(_) | Refitted(_) | Stream(_));
        let trees = variants().filter(is_tree);
        check_variants(trees, structures, &many, &one_lane);
    });
    tiles::check(scene);
}

/// Behind the spheres that they equal, copies change no answer.
fn with_copies(scene: &AimedScene) -> AimedScene {
    let spheres = scene.spheres.iter().copied().cycle().take(MANY).collect();
    AimedScene { spheres, ..scene.clone() }
}

/// What a tier answers in one lane.
struct OneLane {
    tier: Tier,
    /// The closest hits.
    hits: Vec<Option<Hit>>,
    /// The closest hits of those spheres alone that the line really meets.
    true_hits: Vec<Option<Hit>>,
}

impl OneLane {
    fn new(tier: Tier, AimedScene { rays, spheres, .. }: &AimedScene) -> Self {
        let closest_true = |ray: &Ray| {
            // Nothing hits a sphere of negative radius.
            let only_met = |sphere: &Sphere| match roots(Tier::Exact, ray, sphere) {
                Some(_) => *sphere,
                None => Sphere { radius: -1.0, ..*sphere },
            };
            let met: Vec<Sphere> = spheres.iter().map(only_met).collect();
            reference(tier).closest(&met, &[*ray])[0]
        };
        let hits = reference(tier).closest(spheres, rays);
        // Only these tiers see hits on lines that miss.
        let true_hits = if matches!(tier, Tier::Fast | Tier::Geometric) {
            rays.iter().map(closest_true).collect()
        } else {
            hits.clone()
        };
        Self { tier, hits, true_hits }
    }
}

/// The rules on a tier's answers.
fn check_one_lane(tier: Tier, AimedScene { rays, spheres, .. }: &AimedScene, hits: &[Option<Hit>]) {
    for (ray, &hit) in rays.iter().zip(hits) {
        check_rules(tier, ray, spheres, hit);
        // Rule 3: the interval is closed, so the t that was returned finds the same hit again.
        if let Some(Hit { t, .. }) = hit {
            assert!(!(t == 0.0 && t.is_sign_negative()), "-0: {ray:?}");
            let again = reference(tier).closest(spheres, &[Ray { t_max: t, ..*ray }])[0];
            assert_eq!(bits(again), bits(hit), "{tier:?}: {ray:?}");
        }
    }
}

/// Asks variants, and judges each answer; `one_lane` has the answers of every tier.
fn check_variants(
    asked: impl Iterator<Item = Variant>,
    structures: Structures<'_>,
    AimedScene { rays, spheres, .. }: &AimedScene,
    one_lane: &[OneLane],
) {
    let is_promised =
        |ray: &Ray| spheres.iter().all(|sphere| promise::is_stable_in_structures(ray, sphere));
    let stable: Vec<bool> = rays.iter().map(is_promised).collect();
    let lane_of = |tier: Tier| one_lane.iter().find(|lane| lane.tier == tier).expect("every tier");
    for variant in asked {
        let Answers { hits, occluded } = variant.ask(structures, rays);
        let (own, exact) = (lane_of(variant.tier), lane_of(Tier::Exact));
        for (index, ray) in rays.iter().enumerate() {
            let answer = (hits[index], occluded[index]);
            let expected = [own.hits[index], own.true_hits[index], exact.hits[index]];
            let judged = judge(&variant, (ray, spheres), answer, (expected, stable[index]));
            if let Err(wrong) = judged {
                panic!(
                    "{wrong}: {variant:?}, ray {index}: {answer:?} for {expected:?}: {rays:?} {spheres:?}"
                );
            }
        }
    }
}

/// Judges a closest hit and any hit of a variant, with the answers in one lane: of its tier, also to those spheres alone that the line
/// meets, and of `Exact`; and whether structures promise those of `Stable`.
fn judge(
    variant: &Variant,
    (ray, spheres): (&Ray, &[Sphere]),
    (hit, occluded): (Option<Hit>, bool),
    ([list, true_hit, exact], stable): ([Option<Hit>; 3], bool),
) -> Result<(), &'static str> {
    let Variant { tier, structure, .. } = *variant;
    if structure == Structure::List || tier == Tier::Exact || tier == Tier::Stable && stable {
        return if bits(hit) != bits(list) {
            Err("closest")
        } else if occluded != list.is_some() {
            Err("any")
        } else {
            Ok(())
        };
    }
    // The other answers lack false hits alone: the closest hit is the closest true one, or a false one before that.
    let is_lost = |known: Hit| {
        !occluded || hit.is_none_or(|hit| (known.t, known.sphere) < (hit.t, hit.sphere))
    };
    // Where squares underflow, bounds see what the ray meets: any hit is true, and what lies behind is lost.
    let is_own = |Hit { t, sphere }: Hit| {
        let roots = roots(tier, ray, &spheres[sphere as usize]);
        roots.and_then(|roots| accepted(ray, roots)).map(f32::to_bits) == Some(t.to_bits())
    };
    // In a depth list, and by `Stable` outside its domain, the rays that go together decide which false hits are lost.
    let is_depth_list = matches!(structure, Structure::DepthList(_));
    let same_by_every_call = !is_depth_list && tier != Tier::Stable;
    match hit {
        Some(hit) if !is_own(hit) => Err("a t that is not the tier's"),
        _ if stable && true_hit.is_some_and(is_lost) => Err("a true hit is lost"),
        Some(_) if same_by_every_call && !occluded => Err("a closest hit without any hit"),
        None if same_by_every_call && occluded && exact.is_none() => {
            Err("any hit without a closest hit")
        }
        _ if occluded && list.is_none() && exact.is_none() => Err("any hit of nothing"),
        _ => Ok(()),
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

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::Vec3;
    use spherule_referee::random::Random;
    use spherule_tests::oracle;

    fn random_scene(seed: u64) -> AimedScene {
        let mut random = Random::new(seed, 0);
        let bytes: Vec<u8> = (0..700).map(|_| random.bits() as u8).collect();
        AimedScene::from_bytes(&bytes)
    }

    #[test]
    fn random_scenes_pass() {
        for seed in 0..500 {
            check(&random_scene(seed));
        }
    }

    #[test]
    fn random_bytes_make_geometry_worth_judging() {
        let (mut judged, mut met, mut kept, mut all) = (0, 0, 0, 0);
        for seed in 0..200 {
            let scene = random_scene(seed);
            let one_lane = OneLane::new(Tier::Fast, &scene);
            for (ray, hit) in scene.rays.iter().zip(one_lane.true_hits) {
                let is_promised = |sphere| promise::is_stable_in_structures(ray, sphere);
                let is_kept = hit.is_some() && scene.spheres.iter().all(is_promised);
                kept += i32::from(is_kept && scene.spheres.len() > 4);
            }
            for (ray, &aim) in scene.rays.iter().zip(&scene.aims) {
                let sphere = &scene.spheres[aim];
                all += 1;
                judged += i32::from(promise::in_domain(ray, sphere));
                met += i32::from(oracle::meets(ray, sphere));
            }
        }
        println!("{judged} judged, {met} met, {kept} that a tree must not lose of {all}");
        assert!(judged * 3 > all, "{judged} of {all} in the domain");
        assert!(met * 4 > all, "{met} of {all} meet");
        assert!(kept * 20 > all, "{kept} of {all} must not be lost");
    }

    #[test]
    fn copies_make_more_spheres_than_a_small_tree_has() {
        let scene = AimedScene::from_bytes(&[7]);
        let many = with_copies(&scene).spheres;
        assert!(many.len() > 64 && many.starts_with(&scene.spheres), "{many:?}");
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

    /// In every structure but the list.
    #[test]
    fn a_wrong_answer_of_a_structure_is_seen() {
        let ray = Ray::new(Vec3::ZERO, Vec3::Z);
        let spheres = [[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]].map(Sphere::from);
        let [near, behind, nearer] =
            [(4.0, 0), (8.0, 1), (3.0, 0)].map(|(t, sphere)| Some(Hit { t, sphere }));
        let mut asked = 0;
        for variant in variants().filter(|variant| variant.structure != Structure::List) {
            let judge = |answer, [list, true_hit]: [Option<Hit>; 2], stable| {
                judge(&variant, (&ray, &spheres), answer, ([list, true_hit, list], stable))
            };
            for stable in [false, true] {
                assert_eq!(judge((near, true), [near; 2], stable), Ok(()), "{variant:?}");
                assert_eq!(judge((None, false), [None; 2], stable), Ok(()), "{variant:?}");
                assert!(judge((nearer, true), [near; 2], stable).is_err(), "{variant:?}");
                assert!(judge((None, true), [None; 2], stable).is_err(), "{variant:?}");
            }
            // No true hit is lost, not even behind a false one.
            for lost in [(None, false), (behind, true), (near, false)] {
                assert!(judge(lost, [near; 2], true).is_err(), "{variant:?}: {lost:?}");
            }
            assert!(judge((None, false), [near, behind], true).is_err(), "{variant:?}");
            // A false hit is, by some tiers.
            let is_exact = matches!(variant.tier, Tier::Stable | Tier::Exact);
            for (lost, true_hit) in [((None, false), None), ((behind, true), behind)] {
                let judged = judge(lost, [near, true_hit], true);
                assert_eq!(judged.is_err(), is_exact, "{variant:?}: {lost:?}");
            }
            let is_depth_list = matches!(variant.structure, Structure::DepthList(_));
            let is_seen = is_exact || !is_depth_list;
            assert_eq!(judge((near, false), [near, None], true).is_err(), is_seen, "{variant:?}");
            asked += 1;
        }
        assert!(asked > 100, "{asked} variants");
    }

    #[test]
    #[should_panic(expected = "rules")]
    fn a_hit_that_breaks_the_rules_is_seen() {
        let scene = AimedScene::from_bytes(&[]);
        let hit = Some(Hit { t: 1.0, sphere: 0 });
        check_rules(Tier::Stable, &scene.rays[0], &scene.spheres, hit);
    }
}
