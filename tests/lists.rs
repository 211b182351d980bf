//! Lists with a name, in every variant: no spheres, any number of them, many equal ones, invalid members.

use spherule_kernel::{Hit, Ray, Sphere, Vec3};
use spherule_tests::variants::{Layer, assert_hits, lists};

/// From (0, 0, -3) upwards, and the sphere of radius 1 about zero: hit at 2.
const RAY: Ray = Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z);
const SPHERE: Sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };

/// Asserts that every variant gives these answers.
#[track_caller]
fn answers(spheres: &[Sphere], rays: &[Ray], expected: &[Option<Hit>]) {
    assert_hits(expected, rays, spheres, &|_| true);
}

/// Asserts that [`RAY`] hits this sphere.
#[track_caller]
fn hits(spheres: &[Sphere], sphere: usize) {
    answers(spheres, &[RAY], &[Some(Hit { t: 2.0, sphere: sphere as u32 })]);
}

#[test]
fn no_spheres_and_no_rays() {
    answers(&[], &[RAY], &[None]);
    answers(&[], &[RAY; 40], &[None; 40]);
    answers(&[SPHERE], &[], &[]);
    answers(&[], &[], &[]);
}

/// The sphere that is hit stands last in its list, for any length of the list: no sphere of a partial group of four,
/// and none of a second block, is lost.
#[test]
fn lists_of_any_length() {
    let far = Sphere { center: Vec3::new(0.0, 9.0, 0.0), radius: 1.0 };
    for length in (1..=20).chain([127, 128, 129, 255, 257]) {
        let mut spheres = vec![far; length];
        spheres[length - 1] = SPHERE;
        hits(&spheres, length - 1);
    }
}

/// A finished ray does not end the search for its neighbours.
#[test]
fn each_lane_meets_its_own_sphere() {
    let at = |index: u32| Vec3::new(10.0 * index as f32, 0.0, 0.0);
    let spheres: Vec<Sphere> = (0..40).map(|i| Sphere { center: at(i), ..SPHERE }).collect();
    let rays: Vec<Ray> = (0..40).map(|i| Ray { origin: RAY.origin + at(i), ..RAY }).rev().collect();
    let expected: Vec<_> = (0..40).rev().map(|sphere| Some(Hit { t: 2.0, sphere })).collect();
    answers(&spheres, &rays, &expected);
}

/// An invalid ray does not disturb its neighbours.
#[test]
fn rays_that_are_none_among_others() {
    let nan = Vec3::splat(f32::NAN);
    let none = [
        Ray { origin: nan, ..RAY },
        Ray { direction: nan, ..RAY },
        Ray { t_min: f32::NAN, ..RAY },
        Ray { t_max: f32::NAN, ..RAY },
        Ray { direction: Vec3::ZERO, ..RAY },
        Ray { origin: Vec3::splat(f32::INFINITY), ..RAY },
        Ray::INACTIVE,
    ];
    for place in [0, 1, 7, 15, 16, 39] {
        for none in none {
            let (mut rays, mut expected) = ([RAY; 40], [Some(Hit { t: 2.0, sphere: 0 }); 40]);
            (rays[place], expected[place]) = (none, None);
            answers(&[SPHERE; 3], &rays, &expected);
        }
    }
    for none in none {
        answers(&[SPHERE; 3], &[none; 40], &[None; 40]);
    }
}

#[test]
fn a_hundred_and_fifty_thousand_spheres_in_one_place() {
    let spheres = vec![SPHERE; 150_000];
    // In `Exact`, every sphere needs exact sums.
    for variant in lists().filter(|variant| matches!(variant.layer, Layer::Lanes(_))) {
        assert_eq!(variant.closest(&spheres, &[RAY]), [Some(Hit { t: 2.0, sphere: 0 })]);
    }
    hits(&spheres[..30_000], 0);
}

#[test]
fn the_lowest_index_of_equals() {
    let near = Sphere { center: Vec3::new(0.0, 0.0, -0.5), radius: 0.5 };
    let miss = Sphere { center: Vec3::new(9.0, 0.0, 0.0), radius: 1.0 };
    // Different spheres are hit at t = 2, from the third on.
    hits(&[miss, Sphere { radius: -1.0, ..near }, near, SPHERE, near], 2);
}

#[test]
fn invalid_spheres_among_others() {
    let invalid = [
        Sphere { radius: f32::NAN, ..SPHERE },
        Sphere { radius: f32::INFINITY, ..SPHERE },
        Sphere { center: Vec3::new(0.0, f32::NAN, 0.0), ..SPHERE },
        Sphere { center: Vec3::new(f32::INFINITY, 0.0, 0.0), ..SPHERE },
        SPHERE,
        Sphere { radius: -1.0, ..SPHERE },
    ];
    hits(&invalid, 4);
    answers(&invalid[..4], &[RAY], &[None]);
}
