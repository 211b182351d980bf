//! Spheres of all sizes in one scene: the answers of brute force. `tests/proofs/src/scales.rs` shows that they take no more work.

use super::EXACT;
use super::scenes::{EYE, camera, diffuse, uniform};
use proptest::prelude::*;
use spherule_kernel::{
    Coherence, HitPacket, Intersect, Ray, RayPacket, Sphere, SphereTree, Tier, Trace, Vec3,
    Viewpoint,
};
use spherule_referee::random::{Random, power_of_two};
use spherule_referee::strategies;
use spherule_tests::scenes::{scaled_ray, scaled_sphere};
use spherule_tests::variants::{assert_same, assert_same_from};

/// Scenes of many sizes.
fn mixed(random: &mut Random) -> Vec<Vec<Sphere>> {
    let ground = |exponent: i64| {
        let radius = power_of_two(exponent) as f32;
        Sphere { center: Vec3::new(0.0, -1.5 * radius, 0.0), radius }
    };
    let with = |sphere: Sphere| {
        let mut spheres = uniform(1000);
        spheres.insert(500, sphere);
        spheres
    };
    let half = |exponent: i64| {
        let mut spheres = uniform(1000);
        for sphere in spheres.iter_mut().step_by(2) {
            *sphere = scaled_sphere(sphere, exponent);
        }
        spheres
    };
    let every = uniform(1000);
    let every = every.iter().map(|sphere| scaled_sphere(sphere, random.integer(-120, 120)));
    let tiny = Sphere { center: Vec3::ZERO, radius: 1e-30 };
    vec![
        with(ground(60)),
        with(ground(100)),
        with(tiny),
        half(60),
        half(100),
        half(-100),
        every.collect(),
    ]
}

/// Rays among spheres of this size.
fn rays_there(exponent: i64) -> Vec<Ray> {
    let mut rays = camera(EYE, Vec3::ZERO, 0.364, 16);
    rays.extend(diffuse(128));
    rays.iter().map(|ray| scaled_ray(ray, exponent, 0)).collect()
}

#[test]
fn scenes_that_mix_sizes() {
    for spheres in mixed(&mut Random::new(102, 0)) {
        for exponent in [0, 60, 100, -100] {
            let rays = rays_there(exponent);
            assert_same(EXACT, &rays, &spheres);
            for direction in [Vec3::Z, Vec3::new(1.0, 2.0, 2.0)] {
                let parallel: Vec<Ray> = rays.iter().map(|ray| Ray { direction, ..*ray }).collect();
                assert_same_from(Viewpoint::Direction(direction), EXACT, &parallel, &spheres);
            }
        }
    }
}

/// An output shorter than the rays, for a scene with spheres that no bound covers.
#[test]
fn shorter_outputs() {
    let spheres = mixed(&mut Random::new(102, 0)).swap_remove(1);
    let (tree, rays) = (SphereTree::new(spheres.as_slice()), rays_there(0));
    let packets: Vec<_> = rays.chunks(16).map(RayPacket::<[f32; 16]>::new).collect();
    let ask = |coherence: Coherence, count: usize| {
        let mut trace = Trace::new().with(coherence);
        let (mut hits, mut occluded) = (vec![HitPacket::none(); count], vec![u32::MAX; count]);
        tree.closest_hit_packets(Tier::Exact, &mut trace, &packets, &mut hits);
        tree.any_hit_packets(Tier::Exact, &mut trace, &packets, &mut occluded);
        (hits, occluded)
    };
    for coherence in [Coherence::Coherent, Coherence::Incoherent] {
        let (all, occluded) = ask(coherence, packets.len());
        let (some, some_occluded) = ask(coherence, 5);
        assert_eq!((&some[..], &some_occluded[..]), (&all[..5], &occluded[..5]), "{coherence:?}");
    }
}

fn exponent() -> impl Strategy<Value = i64> {
    prop_oneof![4 => Just(0_i64), 2 => -100_i64..=100, 1 => -149_i64..=127]
}

proptest! {
    #![proptest_config(strategies::config(150))]

    /// Spheres and rays of any size, directions of any length, and intervals of any size.
    #[test]
    fn any_sizes_in_one_scene(
        seed in any::<u64>(),
        sizes in prop::collection::vec(exponent(), 1..4),
        lengths in prop::collection::vec(exponent(), 1..4),
        parallel in any::<bool>(),
    ) {
        let mut random = Random::new(103, seed);
        let mut spheres = uniform(60);
        for sphere in &mut spheres {
            *sphere = scaled_sphere(sphere, random.pick(&sizes));
        }
        let mut rays = camera(EYE, Vec3::ZERO, 0.364, 4);
        rays.extend(diffuse(16));
        for ray in &mut rays {
            *ray = scaled_ray(ray, random.pick(&sizes), random.pick(&lengths));
            if random.one_in(4) {
                ray.t_min = random.pick(&[f32::NEG_INFINITY, -1.0, 0.0, 1e-45, 1e-30, 1.0, 1e30]);
                ray.t_max = random.pick(&[f32::INFINITY, 0.0, 1.0, 1e-45, 1e-30, 1e30, f32::MAX]);
            }
        }
        let first = rays[0];
        let viewpoint = if parallel {
            rays.iter_mut().for_each(|ray| ray.direction = first.direction);
            Viewpoint::Direction(first.direction)
        } else {
            Viewpoint::Origin(first.origin)
        };
        assert_same_from(viewpoint, EXACT, &rays, &spheres);
    }
}
