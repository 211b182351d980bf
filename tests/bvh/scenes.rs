//! Spheres and rays for the tests of the tree.

use spherule_kernel::{Ray, Sphere, Vec3};
use spherule_tests::random::Random;

pub(crate) fn point(random: &mut Random, size: f64) -> Vec3 {
    let mut coordinate = || random.uniform(-size, size) as f32;
    Vec3::new(coordinate(), coordinate(), coordinate())
}

/// Centres in [-1, 1]^3, some eight radii apart.
pub(crate) fn uniform(count: usize) -> Vec<Sphere> {
    let mut random = Random::new(70, count as u64);
    let size = 0.5 * (count as f64).powf(-1.0 / 3.0);
    (0..count)
        .map(|_| Sphere {
            center: point(&mut random, 1.0),
            radius: (size * random.uniform(0.5, 1.5)) as f32,
        })
        .collect()
}

pub(crate) fn unit(random: &mut Random) -> Vec3 {
    Vec3::from_array(random.unit().map(|x| x as f32))
}

pub(crate) fn diffuse(count: usize) -> Vec<Ray> {
    let mut random = Random::new(71, 0);
    (0..count).map(|_| Ray::new(point(&mut random, 1.0), unit(&mut random))).collect()
}

/// A picture of `size` x `size` pixels from (0, 0, 4).
pub(crate) fn camera(size: usize) -> Vec<Ray> {
    let at = |i: usize| 0.364 * (2.0 * (i as f32 + 0.5) / size as f32 - 1.0);
    let ray = |i| Ray::new(Vec3::new(0.0, 0.0, 4.0), Vec3::new(at(i % size), at(i / size), -1.0));
    (0..size * size).map(ray).collect()
}
