//! Rays that are spawned inside, where their origin is shallow, meet the far side.

use super::{hit, hit_of, spawn};
use spherule_kernel::{Exact, Intersect, Ray, Side, Sphere, SphereList, Tier, Vec3};
use spherule_referee::random::Random;

/// An origin may be so shallow that the far side lies before the interval, or that a tier sees no sphere at all.
#[test]
fn inside_rays_along_the_surface_meet_its_far_side() {
    let rows = [
        (
            Tier::Fast,
            [-1.382_462_9, -0.194_582_15, 1.309_370_3],
            [2.231_936_2, 0.548_219_7, -1.780_551_7],
            [1.0, 0.75, -0.25, 1.0],
            [0.474_673_78, -0.827_725_47, -0.299_258_1],
        ),
        (
            Tier::Exact,
            [-1.161_875e-6, 9.0, 1.890_108_7e-4],
            [0.0, -1.0, 0.0],
            [3.0, -4.0, 0.0, 5.0],
            [-1.598_109_7, -1.198_578_4, -0.097_122_85],
        ),
        // By cancellation, both roots are zero.
        (
            Tier::Fast,
            [0.003_000_3, 10.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, -1000.0, 0.0, 1000.0],
            [1.0, -3.000_3e-6, 0.0],
        ),
    ];
    for (tier, origin, direction, sphere, inwards) in rows {
        let (surface, sphere) = hit_of(tier, origin, direction, sphere);
        let spawned = surface.spawn_ray(tier, &sphere, Side::Inside, inwards.into());
        let spawned = spawned.expect("an origin");
        let hit = SphereList::from([sphere]).closest_hit(tier, &spawned);
        assert!(hit.is_some(), "{tier:?} {spawned:?}");
    }
}

/// Outwards, the far side is no farther than the origin is deep, which near the coordinates' zero is as little as the interval's start.
#[test]
fn inside_rays_of_any_direction_meet_the_far_side() {
    let mut random = Random::seeded(53);
    let mut shallow = 0;
    for _ in 0..4000 {
        let sphere = {
            let side = random.between(1.0, 2.0);
            let center = -side * (Vec3::ONE + random.in_cube(1e-6));
            Sphere { center, radius: center.length() }
        };
        let towards = -sphere.center;
        let Some(surface) = hit(Tier::Exact, &Ray::new(2.0 * towards, -towards), &sphere) else {
            continue;
        };
        let spawned = spawn(&surface, &sphere, Side::Inside, Vec3::ONE);
        let hit = SphereList::from([sphere]).closest_hit(Exact, &spawned);
        let hit = hit.unwrap_or_else(|| panic!("{spawned:?} {sphere:?}"));
        shallow += u32::from(hit.t < 2.0 * spawned.t_min);
    }
    assert!(shallow > 100, "{shallow}");
}
