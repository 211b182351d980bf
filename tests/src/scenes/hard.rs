//! The spheres of scenes that are hard for trees: their boxes tell little of them.

use super::spheres::{CUBE, in_cube, scattered, uniform};
use crate::point::{direction, plus, within};
use spherule_kernel::{Sphere, Vec3};
use spherule_referee::aim::single;
use spherule_referee::random::Random;
use std::f64::consts::PI;

/// How often each of the [`duplicates`] stands in the list.
pub(super) const ALIKE: usize = 10;
/// How many spheres a chain has.
pub(super) const LINKS: usize = 1000;

/// Uniform on the unit sphere. If each sphere has a square of the surface to itself, its radius is a quarter to three quarters of the side.
pub(super) fn shell(count: usize) -> Vec<Sphere> {
    let mut random = Random::seeded(10);
    let side = (4.0 * PI / count as f64).sqrt();
    let sphere = |_| {
        let center = single(direction(&mut random));
        Sphere { center, radius: (side * random.uniform(0.25, 0.75)) as f32 }
    };
    (0..count).map(sphere).collect()
}

/// Spheres around one point, one within the other, in random order.
pub(super) fn nested(count: usize) -> Vec<Sphere> {
    let mut random = Random::seeded(11);
    let sphere = |number: usize| {
        let radius = (number as f64 / count as f64) as f32;
        Sphere { center: Vec3::ZERO, radius }
    };
    let mut list: Vec<_> = (1..=count).map(sphere).collect();
    for last in (1..count).rev() {
        list.swap(last, random.integer(0, last as i64) as usize);
    }
    list
}

/// Uniform spheres; the whole list is repeated.
pub(super) fn duplicates(count: usize) -> Vec<Sphere> {
    uniform(count / ALIKE, 12).repeat(ALIKE)
}

/// Uniform in the cube from -1 to 1. Of 10,000 spheres so large, a point of the cube lies in more than forty.
pub(super) fn overlapping(count: usize) -> Vec<Sphere> {
    scattered(count, CUBE, 13, |random| random.uniform(0.1, 0.3))
}

/// Uniform in the cube from -1 to 1, a tenth as large as there is room. In the middle of the list stands a sphere in the middle of the
/// cube, which reaches to a tenth from the cube's sides.
pub(super) fn huge_and_tiny(count: usize) -> Vec<Sphere> {
    let mut list = in_cube(count - 1, 0.1, 14);
    list.insert(count / 2, Sphere { center: Vec3::ZERO, radius: 0.9 });
    list
}

/// Straight rows of [`LINKS`] spheres that touch, in any direction, 3 long, with their middles uniform in the cube from -1 to 1.
pub(super) fn chains(count: usize) -> Vec<Sphere> {
    const RADIUS: f64 = 1.5 / LINKS as f64;
    let mut random = Random::seeded(15);
    let mut chain = || {
        let [low, high] = CUBE;
        let (middle, along) = (within(&mut random, low, high), direction(&mut random));
        let link = move |number| {
            let from_middle = (2 * number) as f64 - (LINKS - 1) as f64;
            let center = single(plus(middle, from_middle * RADIUS, along));
            Sphere { center, radius: RADIUS as f32 }
        };
        (0..LINKS).map(link)
    };
    (0..count / LINKS).flat_map(|_| chain()).collect()
}

/// Uniform in the cube from -1 to 1. Radii are 2^-20 to 1 of the largest, and every power of two between is as frequent. 20,000 spheres
/// fill a third of the cube, and fewer fill as much.
pub(super) fn spread(count: usize) -> Vec<Sphere> {
    let largest = 0.1 * (20_000.0 / count as f64).cbrt();
    scattered(count, CUBE, 16, |random| largest * random.log_uniform(-20, -1))
}
