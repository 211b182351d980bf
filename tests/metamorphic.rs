//! Relations between two answers that must hold, whatever the right answer is: properties of the lecture's ray and
//! sphere that every tier keeps.

use proptest::prelude::*;
use spherule_kernel::{Hit, Ray, Sphere, Tier, Vec3, roots};
use spherule_referee::random::power_of_two;
use spherule_referee::scene::Scene;
use spherule_referee::strategies;
use spherule_tests::oracle::discriminant_sign;
use spherule_tests::variants::{bits, lists};
use std::cmp::Ordering;

fn all_bits(hits: Vec<Option<Hit>>) -> Vec<Option<(u32, u32)>> {
    hits.into_iter().map(bits).collect()
}

/// A lattice scene, or one a few ulp off: nothing comes near underflow or overflow. Point spheres are left out, since
/// their discriminant is all rounding, down to its square.
fn common() -> impl Strategy<Value = Scene> {
    let case = || prop_oneof![strategies::lattice(), strategies::walked()];
    strategies::scene(case).prop_map(|mut scene| {
        for sphere in &mut scene.spheres {
            sphere.radius += if sphere.radius == 0.0 { 1.0 } else { 0.0 };
        }
        scene
    })
}

fn any_scene() -> impl Strategy<Value = Scene> {
    strategies::scene(strategies::case)
}

/// The scene with other points and directions, and radii times `by`.
fn moved(scene: &Scene, vector: impl Fn(Vec3) -> Vec3, by: f32) -> Scene {
    let ray =
        |ray: &Ray| Ray { origin: vector(ray.origin), direction: vector(ray.direction), ..*ray };
    let sphere = |s: &Sphere| Sphere { center: vector(s.center), radius: s.radius * by };
    Scene {
        rays: scene.rays.iter().map(ray).collect(),
        spheres: scene.spheres.iter().map(sphere).collect(),
    }
}

fn keeps_answers(scene: &Scene, moved: &Scene, tiers: impl Fn(Tier) -> bool) {
    for variant in lists().filter(|variant| tiers(variant.tier)) {
        let expected = all_bits(variant.closest(&scene.spheres, &scene.rays));
        let found = all_bits(variant.closest(&moved.spheres, &moved.rays));
        assert_eq!(found, expected, "{variant:?}");
    }
}

/// Whether any line touches any sphere in one point.
fn has_tangent(scene: &Scene) -> bool {
    let touches = |ray, sphere| discriminant_sign(ray, sphere) == Some(Ordering::Equal);
    scene.rays.iter().any(|ray| scene.spheres.iter().any(|sphere| touches(ray, sphere)))
}

/// A tangent that proptest found. Squares of the rest of its `Stable` discriminant underflow at one scale, but not at
/// twice that.
#[test]
fn a_tangent_is_one_at_every_scale_by_exact() {
    let ray = Ray::new(Vec3::new(3.0, 1.0, 0.0), Vec3::new(0.0, -1.000_000_2, -2.000_000_5));
    let ray = Ray { t_min: f32::NEG_INFINITY, ..ray };
    let sphere = Sphere { center: Vec3::new(1.0, 2.0, 2.0), radius: 2.0 };
    let scene = Scene { rays: vec![ray], spheres: vec![sphere] };
    assert!(has_tangent(&scene));
    let stable = |by: f32| {
        let Scene { rays, spheres } = moved(&scene, |v| v * by, by);
        roots(Tier::Stable, &rays[0], &spheres[0])
    };
    assert!(stable(1.0).is_some() && stable(2.0).is_none());
    for exponent in -10..=10 {
        let by = power_of_two(exponent) as f32;
        let moved = moved(&scene, |v| v * by, by);
        keeps_answers(&scene, &moved, |tier| tier == Tier::Exact);
    }
}

fn scaled(t: f32, exponent: i64) -> f32 {
    t * power_of_two(exponent) as f32
}

proptest! {
    #![proptest_config(strategies::config(600))]

    /// r(t) = o + t d: with d twice as long, every t is half as large, exactly.
    #[test]
    fn scaling_the_direction_scales_t(scene in common(), exponent in -10_i64..=10) {
        let scaled_rays: Vec<Ray> = scene.rays.iter().map(|ray| Ray {
            direction: ray.direction * power_of_two(exponent) as f32,
            t_min: scaled(ray.t_min, -exponent),
            t_max: scaled(ray.t_max, -exponent),
            ..*ray
        }).collect();
        for variant in lists() {
            let scale = |hit: Hit| Hit { t: scaled(hit.t, -exponent), ..hit };
            let expected = variant.closest(&scene.spheres, &scene.rays);
            let expected = all_bits(expected.into_iter().map(|hit| hit.map(scale)).collect());
            let found = all_bits(variant.closest(&scene.spheres, &scaled_rays));
            prop_assert_eq!(found, expected, "{:?}", variant);
        }
    }

    /// All lengths twice as large: the same t. `Stable` is exempt beside a tangent, as
    /// [`Stable`](spherule_kernel::Stable) says.
    #[test]
    fn scaling_the_world_keeps_t(scene in common(), exponent in -10_i64..=10) {
        let by = power_of_two(exponent) as f32;
        let has_tangent = has_tangent(&scene);
        let keeps = |tier| tier != Tier::Stable || !has_tangent;
        keeps_answers(&scene, &moved(&scene, |v| v * by, by), keeps);
    }

    /// A mirror turns signs of products, but changes no rounding.
    #[test]
    fn mirrors_keep_t(scene in any_scene(), mirrored in any::<[bool; 3]>()) {
        let signs = mirrored.map(|mirrored| if mirrored { -1.0 } else { 1.0 });
        keeps_answers(&scene, &moved(&scene, |v| v * Vec3::from_array(signs), 1.0), |_| true);
    }

    /// Looking back along a line swaps entry and exit, and their signs.
    #[test]
    fn looking_back_turns_the_roots(case in strategies::case()) {
        let back = Ray { direction: -case.ray.direction, ..case.ray };
        for tier in Tier::ALL {
            let forth = roots(tier, &case.ray, &case.sphere);
            let back = roots(tier, &back, &case.sphere);
            prop_assert_eq!(forth.is_some(), back.is_some(), "{:?}", tier);
            let (Some([near, far]), Some([back_near, back_far])) = (forth, back) else { continue };
            let numbers = [near, far, back_near, back_far].iter().all(|t| !t.is_nan());
            if numbers {
                // Compares numbers, not bits, since zero has no sign to turn.
                prop_assert_eq!([near, far], [-back_far, -back_near], "{:?}", tier);
            }
        }
    }

    /// The interval is closed at its end: cut at t, it still holds the hit.
    #[test]
    fn an_interval_that_ends_at_the_hit_finds_it_again(scene in any_scene()) {
        for variant in lists() {
            let hits = variant.closest(&scene.spheres, &scene.rays);
            let cut = |(ray, hit): (&Ray, &Option<Hit>)| Ray {
                t_max: hit.map_or(ray.t_max, |hit| hit.t),
                ..*ray
            };
            let rays: Vec<Ray> = scene.rays.iter().zip(&hits).map(cut).collect();
            let found = all_bits(variant.closest(&scene.spheres, &rays));
            prop_assert_eq!(found, all_bits(hits), "{:?}", variant);
        }
    }

    /// The interval is closed at its start: begun at t, it holds the hit; begun at the next number, it does not, and
    /// what is found is further.
    #[test]
    fn an_interval_that_starts_after_the_hit_finds_another(scene in any_scene()) {
        for variant in lists() {
            let hits = variant.closest(&scene.spheres, &scene.rays);
            for open in [false, true] {
                let start = |hit: &Hit| if open { hit.t.next_up() } else { hit.t };
                let begun = |(ray, hit): (&Ray, &Option<Hit>)| Ray {
                    t_min: hit.as_ref().map_or(ray.t_min, start),
                    ..*ray
                };
                let rays: Vec<Ray> = scene.rays.iter().zip(&hits).map(begun).collect();
                let found = variant.closest(&scene.spheres, &rays);
                for (hit, found) in hits.iter().zip(found) {
                    let Some(hit) = hit else {
                        prop_assert_eq!(found, None);
                        continue;
                    };
                    let as_it_should = if open {
                        found.is_none_or(|found| found.t > hit.t)
                    } else {
                        bits(found) == bits(Some(*hit))
                    };
                    prop_assert!(as_it_should, "{:?}: {:?}, then {:?}", variant, hit, found);
                }
            }
        }
    }
}
