//! Rays that end before a sphere.

use super::hit;
use spherule_kernel::{Exact, Intersect, Ray, Side, Sphere, SphereList, Tier, Vec3, roots};
use spherule_referee::random::{Random, power_of_two};

#[test]
fn a_shadow_ray_until_its_light_is_not_shadowed_by_it() {
    let (ground, light) =
        (Sphere::from([0.0, -1000.0, 0.0, 1000.0]), Sphere::from([0.0, 5.0, 0.0, 1.0]));
    let mut random = Random::seeded(41);
    let mut shadowed = 0;
    for tier in [Tier::Exact, Tier::Stable, Tier::Fast, Tier::Geometric] {
        let scene = SphereList::from([ground, light]);
        for _ in 0..2000 {
            let at = 3.0 * random.in_cube(1.0);
            let down = Ray::new(Vec3::new(at.x, 3.0, at.z), Vec3::NEG_Y);
            let Some(surface) = hit(tier, &down, &ground) else { continue };
            let target = light.center + random.direction();
            let ray =
                surface.spawn_ray_to(tier, &ground, Side::Outside, target).expect("an origin");
            shadowed += u32::from(scene.any_hit(tier, &ray));
            assert!(!scene.any_hit(tier, &ray.until(tier, &light)), "{tier:?} {ray:?}");
            // Another sphere before it is still met.
            let between = Sphere { center: ray.at(0.5), radius: 0.1 };
            let until = ray.until(tier, &light);
            assert!(SphereList::from([ground, light, between]).any_hit(tier, &until));
        }
    }
    assert!(shadowed > 4000, "{shadowed}");
}

/// Where squares underflow, `Stable` may have its far root before the near one.
#[test]
fn roots_in_the_wrong_order_end_a_ray_before_both() {
    let sphere = Sphere {
        center: Vec3::new(6.498_219_4e-21, 2.398_493_6e-21, 1.060_833_8e-19),
        radius: 3.150_952e-21,
    };
    let ray = Ray::new(
        Vec3::new(6.537_744e-21, 5.254_173_7e-21, 1.047_522_1e-19),
        Vec3::new(0.562_677, 0.063_356_61, 0.165_813_61),
    );
    let [near, far] = roots(Tier::Stable, &ray, &sphere).expect("a hit");
    assert!(far < near, "{near:e} {far:e}");
    let until = ray.until(Tier::Stable, &sphere);
    assert!(!SphereList::from([sphere]).any_hit(Tier::Stable, &until), "{until:?}");
}

#[test]
fn a_root_that_is_infinite_ends_no_ray() {
    let ray = Ray {
        t_min: f32::NEG_INFINITY,
        ..Ray::new(Vec3::ZERO, Vec3::new(0.0, 0.0, power_of_two(-126) as f32))
    };
    let around = Sphere::from([0.0, 0.0, -9.0, 10.0]);
    assert_eq!(roots(Exact, &ray, &around).map(|[near, _]| near), Some(f32::NEG_INFINITY));
    let until = ray.until(Exact, &around);
    assert_eq!(until.t_min, f32::NEG_INFINITY);
    assert_eq!(until.t_max, (power_of_two(126) as f32).next_down());
    let endless = Sphere::from([0.0, 0.0, 0.0, 10.0]);
    assert_eq!(ray.until(Exact, &endless), ray);
}
