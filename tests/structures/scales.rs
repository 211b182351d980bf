//! Nothing depends on the units. If a scene, or the directions of its rays, are multiplied by powers of two, the answers
//! are multiplied. `tests/proofs/src/scales.rs` shows that the work is the same.

use super::scenes::{EYE, camera, diffuse, uniform};
use super::{BOTH, EXACT};
use spherule_kernel::{Ray, Sphere, Tier, Vec3};
use spherule_referee::random::{Random, power_of_two};
use spherule_tests::scenes::{scaled_ray, scaled_sphere};
use spherule_tests::variants::{Layer, Structure, Variant, assert_same, bits, brute};

fn scaled(spheres: &[Sphere], exponent: i64) -> Vec<Sphere> {
    spheres.iter().map(|sphere| scaled_sphere(sphere, exponent)).collect()
}

/// Multiplies origins by one power of two, and directions by another.
fn scaled_rays(rays: &[Ray], exponent: i64, length: i64) -> Vec<Ray> {
    rays.iter().map(|ray| scaled_ray(ray, exponent, length)).collect()
}

/// The same hits, with t multiplied, for every power of two; structures answer as the list.
#[test]
fn scaled_scenes_have_scaled_answers() {
    let unscaled = uniform(150);
    let mut random = Random::new(101, 0);
    let mut rays = camera(EYE, Vec3::ZERO, 0.364, 8);
    rays.extend(diffuse(32));
    for exponent in -100..=100 {
        // Directions scaled by one, by the scene's factor, or at random.
        let random_length = random.integer(-100, 100);
        for length in [0, exponent, random_length] {
            let spheres = scaled(&unscaled, exponent);
            let rays_here = scaled_rays(&rays, exponent, length);
            let stable = (-34..=34).contains(&exponent);
            assert_same(if stable { BOTH } else { EXACT }, &rays_here, &spheres);
            // Otherwise t are subnormal, or infinite.
            let by = exponent - length;
            if by.abs() > 110 {
                continue;
            }
            for &tier in if stable { BOTH } else { EXACT } {
                let slices = Variant { tier, structure: Structure::List, layer: Layer::Slice };
                let expected = slices.closest(&unscaled, &rays);
                let found = slices.closest(&spheres, &rays_here);
                for (expected, found) in expected.iter().zip(&found) {
                    let expected = expected.map(|hit| {
                        let t = f64::from(hit.t) * power_of_two(by);
                        ((t as f32).to_bits(), hit.sphere)
                    });
                    assert_eq!(bits(*found), expected, "{tier:?}, 2^{exponent}, |d| 2^{length}");
                }
            }
        }
    }
}

/// Numbers at which scaling loses something that decides.
#[test]
fn where_powers_of_two_lose_something() {
    let size = power_of_two(100) as f32;
    let at = |x: f32, y: f32, z: f32, radius: f32| Sphere { center: Vec3::new(x, y, z), radius };

    // In the units of a scene of 2^100, 2^-60 is zero. It makes a tangent a miss, or a hit through two points.
    let mut spheres = scaled(&uniform(40), 100);
    let little = power_of_two(-60) as f32;
    for (place, y) in [-little, little, 0.0].into_iter().enumerate() {
        spheres.push(at(8.0 * place as f32 * size, y, 4.0 * size, size));
    }
    let ray = |x: f32| Ray::new(Vec3::new(8.0 * x * size, size, 0.0), Vec3::Z);
    let rays: Vec<Ray> = (0..48).map(|ray_number| ray((ray_number % 3) as f32)).collect();
    assert_same(EXACT, &rays, &spheres);
    let met = brute(Tier::Exact).closest(&spheres, &rays[..3]);
    assert_eq!([0, 1, 2].map(|ray| met[ray].is_some()), [false, true, true]);

    // A hit at t = 2^127, 2^-24 of the scene away, where no t of the rest of the scene is finite.
    let mut spheres = scaled(&uniform(40), 100);
    spheres.push(at(0.0, 0.0, size, size * (1.0 - power_of_two(-24) as f32)));
    let direction = Vec3::new(0.0, 0.0, power_of_two(-51) as f32);
    let rays = [Ray::new(Vec3::ZERO, direction); 20];
    assert_same(EXACT, &rays, &spheres);
    let hit = brute(Tier::Exact).closest(&spheres, &rays[..1])[0];
    assert_eq!(hit.map(|hit| hit.t), Some(power_of_two(127) as f32));

    // A hit at t = -2^-151, which rounds to zero, 2^-31 of the scene before the origin.
    let mut spheres = uniform(40);
    spheres.retain(|sphere| sphere.center.length() > 0.5);
    spheres.push(at(0.0, 0.0, -0.003_906_25 - power_of_two(-31) as f32, 0.003_906_25));
    let spheres = scaled(&spheres, -100);
    let rays: Vec<Ray> = camera(Vec3::ZERO, Vec3::Z, 0.1, 8);
    let rays = scaled_rays(&rays, 0, 20);
    assert_same(EXACT, &rays, &spheres);
    let hit = brute(Tier::Exact).closest(&spheres, &rays[27..28])[0];
    assert_eq!(hit.map(|hit| (hit.t, hit.sphere)), Some((0.0, spheres.len() as u32 - 1)));
}

/// At the least t: a root that rounds to zero, or to the least number, counts as rounded, before the origin too.
#[test]
fn where_t_are_the_least_numbers() {
    let mut random = Random::new(104, 0);
    for exponent in [-100, -90, -80, -60] {
        let spheres = scaled(&uniform(200), exponent);
        let mut rays = Vec::new();
        for by in 20..=60 {
            // A t of 2^-149 is 2^(by - 40) of the scene.
            let length = (by - 40 + exponent + 149).min(126);
            let mut some = scaled_rays(&diffuse(8), exponent, length);
            for ray in &mut some {
                ray.t_min =
                    random.pick(&[0.0, f32::from_bits(1), -f32::from_bits(1), f32::NEG_INFINITY]);
                ray.t_max = random.pick(&[f32::INFINITY, f32::from_bits(3), 0.0]);
            }
            rays.extend(some);
        }
        assert_same(EXACT, &rays, &spheres);
    }
}
