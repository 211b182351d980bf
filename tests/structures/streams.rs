//! Answers as brute force gives them, for rays that could trip a stream, and so every other way.

use super::scenes::{diffuse, point, uniform, unit};
use super::{BOTH, EXACT};
use spherule_kernel::{Ray, Sphere, Vec3};
use spherule_referee::random::Random;
use spherule_tests::variants::assert_same;

/// No ray, one ray, and packets that are not full.
#[test]
fn few_rays() {
    for count in [0, 1, 15, 16, 17, 33] {
        assert_same(BOTH, &diffuse(count), &uniform(300));
    }
}

/// No interval, no direction, NaN: such rays enter no node, alone or beside rays that do.
#[test]
fn dead_rays() {
    let mut rays = diffuse(300);
    for (number, ray) in rays.iter_mut().enumerate() {
        match number % 4 {
            0 => (ray.t_min, ray.t_max) = (1.0, 0.5),
            1 => ray.direction = Vec3::ZERO,
            2 => ray.origin.y = f32::NAN,
            _ => ray.t_max = f32::NAN,
        }
    }
    assert_same(BOTH, &rays, &uniform(300));
    for (number, ray) in diffuse(rays.len()).into_iter().enumerate().step_by(41) {
        rays[number] = ray;
    }
    assert_same(BOTH, &rays, &uniform(300));
}

/// All rays wait in the same queues, which some variants' memory cannot hold.
#[test]
fn equal_rays() {
    let spheres = uniform(300);
    for ray in diffuse(4) {
        assert_same(BOTH, &[ray; 1500], &spheres);
    }
}

/// Nothing is ruled out: every ray enters every node and tests every sphere.
#[test]
fn every_ray_through_every_sphere() {
    let mut random = Random::new(131, 0);
    let mut sphere = |_| {
        let center = point(&mut random, 0.2);
        Sphere { center, radius: random.uniform(0.5, 1.0) as f32 }
    };
    let spheres: Vec<Sphere> = (0..1200).map(&mut sphere).collect();
    for from in [3.0, 0.0] {
        let mut ray = |_| {
            let origin = from * unit(&mut random) + point(&mut random, 0.05);
            let target = point(&mut random, 0.05);
            Ray::new(origin, target - origin)
        };
        let rays: Vec<Ray> = (0..300).map(&mut ray).collect();
        assert_same(BOTH, &rays, &spheres);
    }
}

/// Zeros of both signs beside components of every sign, from points in the faces of boxes.
#[test]
fn zeros_in_every_octant() {
    let spheres = uniform(200);
    let mut rays = Vec::new();
    for number in 0..216 {
        let component =
            |place: u32| [1.0, -1.0, 0.0, -0.0, 0.5, -2.0][number / 6_usize.pow(place) % 6];
        let direction = Vec3::new(component(0), component(1), component(2));
        for sphere in spheres.iter().step_by(41) {
            let corner = sphere.center - Vec3::splat(sphere.radius);
            rays.extend([sphere.center, corner].map(|at| Ray::new(at - direction, direction)));
            rays.push(Ray::new(corner - 3.0 * direction, direction));
        }
    }
    assert_same(EXACT, &rays, &spheres);
}
