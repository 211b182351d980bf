//! Shadows, in crowds of spheres, against integers; packets of shadow rays against one ray at a time.

use super::{departing, outward, spawn};
use spherule_kernel::{
    Exact, Intersect, Ray, Side, Sphere, SphereList, Tier, Towards, Vec3, side, surface,
};
use spherule_referee::random::Random;
use spherule_tests::campaign::on_all_cores;
use spherule_tests::oracle;
use spherule_tests::variants::{Layer, shadow_rays_of, surface_layers};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Spheres that touch, overlap, lie one in another and two in one place, moved by `offset`.
fn crowd(random: &mut Random, offset: Vec3) -> Vec<Sphere> {
    let mut spheres = vec![Sphere { center: offset - 100.0 * Vec3::Y, radius: 100.0 }];
    for index in 0..14 {
        let Sphere { center, radius } = random.pick(&spheres);
        let sphere = match index % 5 {
            // Touching, up to rounding.
            0 => {
                let other = random.between(0.25, 1.5);
                Sphere { center: center + (radius + other) * random.direction(), radius: other }
            }
            1 if index > 5 => Sphere { center, radius },
            2 if radius < 50.0 => Sphere { center, radius: 0.75 * radius },
            _ => Sphere {
                center: offset + random.in_cube(2.0) + Vec3::Y,
                radius: random.between(0.25, 1.0),
            },
        };
        spheres.push(sphere);
    }
    spheres
}

/// Checks shadows of such crowds against integers; returns how many there were, and how many rays.
fn shadows(seed: u64, rays_a_place: u32) -> [u32; 2] {
    let mut random = Random::seeded(seed);
    let (mut rays, mut dark) = (0, 0);
    for place in [0.0, 4096.0, 65_536.0, 262_144.0, 1_048_576.0, 1e7] {
        let offset = place * Vec3::new(1.0, -0.5, 0.75);
        // At 10^7 numbers are 1 apart, so spheres are larger. The largest are some 6.5e6, as the Earth in metres.
        let scale = random.pick(&[if place > 1e5 { 4096.0 } else { 1.0 }, 65_536.0]);
        let spheres: Vec<_> = crowd(&mut random, offset / scale)
            .into_iter()
            .map(|Sphere { center, radius }| Sphere {
                center: scale * center,
                radius: scale * radius,
            })
            .collect();
        let list = SphereList::from(&spheres[..]);
        for _ in 0..rays_a_place {
            let eye = offset + scale * 10_f32.powf(random.between(0.8, 7.0)) * random.direction();
            let ray = Ray::new(eye, offset + scale * random.in_cube(2.5) - eye);
            let Some(hit) = list.closest_hit(Exact, &ray) else { continue };
            let sphere = spheres[hit.sphere as usize];
            let surface = surface(Exact, &ray, hit.t, &sphere);
            let to = surface.incident_side(ray.direction);
            let direction = departing(&mut random, outward(&surface, to));
            let spawned = spawn(&surface, &sphere, to, direction);
            let others = spheres.iter().enumerate();
            let occluded = others
                .filter(|&(index, _)| index != hit.sphere as usize || to == Side::Inside)
                .any(|(_, sphere)| oracle::intersect(&spawned, sphere).is_some());
            assert_eq!(list.any_hit(Exact, &spawned), occluded, "{spawned:?} of {spheres:?}");
            rays += 1;
            dark += u32::from(occluded);
        }
    }
    [dark, rays]
}

#[test]
fn shadows_are_those_of_integers() {
    let [dark, rays] = shadows(23, 2000);
    assert!(rays > 4000 && dark > 800 && dark < rays - 800, "{dark} of {rays}");
}

/// Takes some ten minutes: `cargo test --test main a_million_shadows -- --ignored --nocapture`.
#[test]
#[ignore = "a million shadows"]
fn a_million_shadows_are_those_of_integers() {
    let sums = [const { AtomicU32::new(0) }; 2];
    on_all_cores(200, |seed| {
        for (sum, more) in sums.iter().zip(shadows(2000 + seed, 2000)) {
            sum.fetch_add(more, Relaxed);
        }
    });
    let [dark, rays] = sums.map(AtomicU32::into_inner);
    println!("{dark} of {rays} in shadow");
    assert!(rays > 1_000_000, "{rays}");
}

/// Asserts that every tier spawns the same rays at every layer; returns how many.
fn assert_as_one_ray(list: &SphereList, rays: &[Ray], towards: Towards) -> usize {
    let mut left = 0;
    for tier in Tier::ALL {
        let of = |layer| {
            let spawned = shadow_rays_of(tier, layer, list, rays, towards);
            let bits = |v: Vec3| v.to_array().map(f32::to_bits);
            let all = |ray: Ray| {
                let interval = [ray.t_min, ray.t_max].map(f32::to_bits);
                ray.is_live().then(|| (bits(ray.origin), bits(ray.direction), interval))
            };
            spawned.into_iter().take(rays.len()).map(all).collect::<Vec<_>>()
        };
        let expected = of(Layer::Ray);
        left += expected.iter().flatten().count();
        for layer in surface_layers() {
            let found = of(layer);
            for (index, ray) in rays.iter().enumerate() {
                let say = (tier, layer, ray);
                assert_eq!(found[index], expected[index], "{say:?} {towards:?}");
            }
        }
    }
    left
}

/// In one direction and to one point, from crowds near, far and moved; some rays came from inside.
#[test]
fn shadow_rays_of_packets_are_those_of_one_ray() {
    let mut random = Random::seeded(24);
    let mut left = 0;
    for (place, far) in [(0.0, 1.0), (0.0, 4.0), (0.0, 1e6), (65_536.0, 5.0), (0.0, 1e7)] {
        let offset = place * Vec3::new(1.0, -0.5, 0.75);
        let list = SphereList::from(&crowd(&mut random, offset)[..]);
        let rays: Vec<_> = (0..600)
            .map(|_| {
                let eye = offset + far * random.direction() + Vec3::Y;
                Ray::new(eye, offset + random.in_cube(2.5) - eye)
            })
            .collect();
        let light = offset + 9.0 * random.direction() + 9.0 * Vec3::Y;
        for towards in [Towards::Direction(random.direction()), Towards::Point(light)] {
            left += assert_as_one_ray(&list, &rays, towards);
        }
    }
    assert!(left > 3000, "{left}");
}

/// Seen from the surface, a light that is as near turns when the origin moves out by a step.
#[test]
fn so_they_are_to_a_light_beside_the_surface() {
    let mut random = Random::seeded(25);
    let list = SphereList::from([[0.0, 0.0, 0.0, 1.0]]);
    let mut left = 0;
    for _ in 0..60 {
        let normal = random.direction();
        let lift = 1.0 + 10_f32.powf(random.between(-8.5, -5.0)) * random.sign() as f32;
        let beside = 10_f32.powf(random.between(-4.0, -2.0)) * normal.any_orthonormal_vector();
        let eye = 5.0 * normal;
        let rays: Vec<_> = (0..64)
            .map(|_| Ray::new(eye, normal + 0.5 * beside.length() * random.in_cube(1.0) - eye))
            .collect();
        left += assert_as_one_ray(&list, &rays, Towards::Point(lift * normal + beside));
    }
    assert!(left > 1000, "{left}");
}

/// Without more depth, the far side would lie before the interval.
#[test]
fn so_they_are_from_inside_where_the_far_side_is_before_the_interval() {
    // To a light that is nearer than the origin is deep: the way turns out through the surface.
    let within_a_step = [0.5, 1.0, 2.0, 64.0].map(|aside| {
        let light = 2_f32.powi(-47) * Vec3::new(aside, 0.0, 0.125);
        ([0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0], Towards::Point(light))
    });
    // Along the surface from an origin that is shallow: near the coordinates' zero, with a light towards which the normal faces by
    // its rounding alone.
    let along_the_surface = [
        (
            [-1.279_946_9, -1.279_946_2, -1.279_945_4, 2.216_931_8],
            [-0.639_973_46, -0.639_973_1, -0.639_972_7],
            [1.279_946_9, 1.279_946_2, 1.279_945_4],
            Towards::Direction(Vec3::new(-0.359_929_35, 0.321_000_93, 0.038_928_665)),
        ),
        (
            [-1.967_390_4, -1.967_388_2, -1.967_389_3, 3.407_618_3],
            [-0.983_695_2, -0.983_694_1, -0.983_694_7],
            [1.967_390_4, 1.967_388_2, 1.967_389_3],
            Towards::Direction(Vec3::new(-0.020_913_446, -0.293_196_56, 0.314_109_86)),
        ),
    ];
    for (sphere, origin, direction, towards) in within_a_step.into_iter().chain(along_the_surface) {
        let rays = [Ray::from([origin, direction])];
        assert!(assert_as_one_ray(&SphereList::from([sphere]), &rays, towards) > 0, "{towards:?}");
    }
}

/// From inside along the least number, where the normal's coordinate is below a half: their product in single precision is zero.
#[test]
fn rays_along_the_least_number_have_sides() {
    let radius = 2_f32.powi(-30);
    let list = SphereList::from([[0.0, 0.0, 0.0, radius]]);
    let least = f32::from_bits(1) * Vec3::Z;
    let starts = [0.9, 0.92, 0.94, 0.96, 0.98];
    let rays = starts.map(|x| Ray::new(x * radius * Vec3::X, least));
    let spawned = shadow_rays_of(Tier::Exact, Layer::Ray, &list, &rays, Towards::Direction(-least));
    for (ray, spawned) in rays.iter().zip(&spawned) {
        // Back to where the ray came from, and to the far side.
        let sphere = Sphere::from([0.0, 0.0, 0.0, radius]);
        assert_eq!(side(spawned.origin, &sphere), Some(Side::Inside), "{ray:?}");
        assert!(list.any_hit(Exact, spawned), "{ray:?}");
    }
    let left = assert_as_one_ray(&list, &rays, Towards::Direction(-least));
    assert!(left >= rays.len(), "{left}");
}

/// Tangents at points that single precision has: n.d is zero except for the normal's rounding, which is of either sign.
#[test]
fn tangents_came_from_outside() {
    let triples = [[3.0, 4.0, 5.0], [7.0, 24.0, 25.0], [8.0, 15.0, 17.0], [20.0, 21.0, 29.0]];
    for [x, y, radius] in triples {
        let list = SphereList::from([[0.0, 0.0, 0.0, radius]]);
        for [first, second] in [[0, 1], [1, 2], [2, 0]] {
            let vector = |a: f32, b: f32| {
                let mut v = Vec3::ZERO;
                (v[first], v[second]) = (a, b);
                v
            };
            let point = vector(x, y);
            for direction in [vector(-y, x), vector(y, -x)] {
                let rays = [Ray::new(point - direction, direction)];
                let outwards = assert_as_one_ray(&list, &rays, Towards::Direction(point));
                let inwards = assert_as_one_ray(&list, &rays, Towards::Direction(-point));
                assert!(outwards > 0 && inwards == 0, "{rays:?}: {outwards} {inwards}");
            }
        }
    }
}

/// An ulp of the least coordinates is the least number; the largest number has no next.
#[test]
fn rays_are_spawned_at_both_ends_of_the_numbers() {
    let (tiny, large) = (2_f32.powi(-127), 2_f32.powi(120));
    let from = |x, y, z, direction| Ray::new(Vec3::new(x, y, z), direction);
    let (along, to) = (Towards::Direction, Towards::Point);
    let (far, radius) = (2_f32.powi(104), 2_f32.powi(103));
    for (sphere, ray, towards) in [
        ([0.0; 4], from(0.0, 0.0, -3.0, Vec3::Z), along(Vec3::NEG_Z)),
        ([0.0, 0.0, 0.0, tiny], from(0.0, 0.0, -1.0, Vec3::Z), along(Vec3::NEG_Z)),
        ([0.0, 0.0, 0.0, tiny], from(0.0, 0.0, 0.0, Vec3::Z), along(Vec3::NEG_Z)),
        ([0.0, 0.0, 0.0, f32::MAX], from(0.0, 0.0, 0.0, Vec3::X), along(Vec3::NEG_X)),
        (
            [f32::MAX, 0.0, 0.0, large],
            from(f32::MAX, 2.0 * large, 0.0, Vec3::NEG_Y),
            along(Vec3::Y),
        ),
        // From the surface the way to the target overflows; from half a step out it does not.
        ([-far, 0.0, 0.0, radius], from(0.0, 0.0, 0.0, Vec3::NEG_X), to(f32::MAX * Vec3::X)),
    ] {
        let list = SphereList::from([sphere]);
        let spawned = shadow_rays_of(Tier::Exact, Layer::Ray, &list, &[ray], towards);
        assert!(spawned[0].is_live(), "{sphere:?} {ray:?}");
        assert!(assert_as_one_ray(&list, &[ray], towards) > 0);
    }
}

/// A way that is longer than numbers is no shadow ray: nothing would be in its way.
#[test]
fn a_way_that_leaves_the_numbers_is_none() {
    let list = SphereList::from([[-3e38, 0.0, 0.0, 1e37]]);
    let ray = Ray::new(Vec3::ZERO, Vec3::NEG_X);
    let (sphere, hit) = (Sphere::from([-3e38, 0.0, 0.0, 1e37]), list.closest_hit(Exact, &ray));
    let surface = surface(Exact, &ray, hit.expect("a hit").t, &sphere);
    let far = Vec3::new(3e38, 0.0, 0.0);
    for tier in [Tier::Exact, Tier::Fast] {
        assert_eq!(surface.spawn_ray_to(tier, &sphere, Side::Outside, far), None);
    }
    assert!(surface.spawn_ray_to(Exact, &sphere, Side::Outside, Vec3::ZERO).is_some());
    for layer in surface_layers() {
        let spawned = shadow_rays_of(Tier::Exact, layer, &list, &[ray], Towards::Point(far));
        assert!(!spawned[0].is_live(), "{layer:?}");
    }
}
