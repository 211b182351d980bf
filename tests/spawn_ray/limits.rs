//! Spawned rays where the number that decides is just at its limit.

use super::{hit, hit_of, spawn, true_side};
use spherule_kernel::{Exact, Intersect, Ray, Side, Sphere, SphereList, Tier, Vec3, roots, side};

/// Numbers end before the far side: its t is zero, from every origin.
#[test]
fn a_far_side_that_is_rounded_to_zero_is_no_reason_to_go_deeper() {
    let radius = 2_f32.powi(-30);
    let (surface, sphere) =
        hit_of(Tier::Exact, [2.0 * radius, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0, radius]);
    let inwards = Vec3::new(-3e38, 0.0, 0.0);
    let spawned = spawn(&surface, &sphere, Side::Inside, inwards);
    assert_eq!(roots(Exact, &spawned, &sphere).map(|[_, far]| far), Some(0.0));
}

#[test]
fn an_interval_begins_at_the_least_number_or_later() {
    let (surface, sphere) =
        hit_of(Tier::Exact, [3.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]);
    let outwards = Vec3::new(3e38, 0.0, 0.0);
    let spawned = spawn(&surface, &sphere, Side::Outside, outwards);
    assert_eq!(spawned.t_min.to_bits(), 1);
}

/// n.d is 2^-22 times the sum of the direction's coordinates, then an ulp more.
#[test]
fn a_ray_that_grazes_came_from_outside() {
    let (surface, _) = hit_of(Tier::Exact, [0.0, 0.0, 3.0], [0.0, 0.0, -1.0], [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(surface.normal, Vec3::Z);
    let side = |rise| surface.incident_side(Vec3::new(4_194_303.0, 0.0, rise));
    assert_eq!([1.0, 1.0_f32.next_up()].map(side), [Side::Outside, Side::Inside]);
}

#[test]
fn what_has_no_such_origin_is_none() {
    // Smaller than the spacing of numbers at its place: only its centre is inside.
    let sphere = Sphere { center: Vec3::splat(1e7), radius: 0.25 };
    let ray = Ray::new(Vec3::new(1e7, 1e7, 0.0), Vec3::Z);
    let surface = hit(Tier::Exact, &ray, &sphere).expect("a hit");
    let left = spawn(&surface, &sphere, Side::Inside, Vec3::Z);
    assert_eq!(left.origin, sphere.center);
    let left = spawn(&surface, &sphere, Side::Outside, -Vec3::Z);
    assert_eq!(true_side(left.origin, &sphere), Some(Side::Outside));

    // Past the end of numbers.
    let sphere = Sphere { center: Vec3::new(0.0, 0.0, f32::MAX), radius: f32::MAX };
    let surface = spherule_kernel::surface(Exact, &Ray::new(Vec3::ZERO, Vec3::Z), 0.0, &sphere);
    assert!(surface.spawn_ray(Exact, &sphere, Side::Outside, -Vec3::Z).is_some());

    // A point sphere: nothing is inside, and a ray starts beside it.
    let sphere = Sphere { center: Vec3::Z, radius: 0.0 };
    let surface = hit(Tier::Exact, &Ray::new(Vec3::ZERO, Vec3::Z), &sphere).expect("a hit");
    assert_eq!(surface.spawn_ray(Exact, &sphere, Side::Inside, Vec3::Z), None);
    let left = spawn(&surface, &sphere, Side::Outside, -Vec3::Z);
    assert!(!SphereList::from([sphere]).any_hit(Exact, &left));

    // Invalid input returns, with any result.
    for bits in [0x7fc0_0000, 0x7f80_0000, 0xff80_0000, 0x7f7f_ffff, 1, 0x8000_0001] {
        let bad = f32::from_bits(bits);
        let sphere = Sphere { center: Vec3::splat(bad), radius: bad };
        let ray = Ray::new(Vec3::splat(bad), Vec3::splat(bad));
        let surface = spherule_kernel::surface(Exact, &ray, bad, &sphere);
        for to in [Side::Outside, Side::Inside] {
            if let Some(left) = surface.spawn_ray(Exact, &sphere, to, Vec3::splat(bad)) {
                assert_eq!(side(left.origin, &sphere), Some(to));
            }
        }
    }
}
