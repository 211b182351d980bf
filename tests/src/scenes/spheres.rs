//! The spheres of the large scenes.

use crate::point::{Point, plus, unit, within};
use spherule_kernel::{Sphere, Vec3};
use spherule_referee::aim::single;
use spherule_referee::random::{Random, cross};
use std::f64::consts::{FRAC_PI_3, FRAC_PI_6};

/// The unit sphere.
pub(super) fn one() -> Vec<Sphere> {
    vec![Sphere { center: Vec3::ZERO, radius: 1.0 }]
}

/// Uniform in the cube from -1 to 1; diameters are a quarter to three quarters of the side of a sphere's cell.
pub(super) fn uniform(count: usize, seed: u64) -> Vec<Sphere> {
    in_cube(count, 0.5, seed)
}

/// The same, twice as large: half of the cube lies in some sphere.
pub(super) fn dense(count: usize) -> Vec<Sphere> {
    in_cube(count, 1.0, 6)
}

/// Uniform in the cube from -1 to 1; half to one and a half of `radius` times the side of a cell with half the cube's.
pub(super) fn in_cube(count: usize, radius: f64, seed: u64) -> Vec<Sphere> {
    let scale = radius * (count as f64).powf(-1.0 / 3.0);
    scattered(count, CUBE, seed, |random| scale * random.uniform(0.5, 1.5))
}

/// Centres uniform in a box.
pub(super) fn scattered(
    count: usize,
    [low, high]: [Point; 2],
    seed: u64,
    radius: impl Fn(&mut Random) -> f64,
) -> Vec<Sphere> {
    let mut random = Random::seeded(seed);
    let sphere = |_| {
        let center = single(within(&mut random, low, high));
        Sphere { center, radius: radius(&mut random) as f32 }
    };
    (0..count).map(sphere).collect()
}

/// Where most spheres have their centres.
pub(super) const CUBE: [Point; 2] = [[-1.0; 3], [1.0; 3]];

/// Where the spheres on the ground have their centres.
pub(super) const LAYER: [Point; 2] = [[-10.0, 0.0, -10.0], [10.0, 1.0, 10.0]];

/// `count - 1` spheres in a layer on a sphere of radius 1000, which is in the middle of the list. Their radii are
/// log-normal (the median is a fortieth, sigma 0.7; one in a million is thirty times the median).
pub(super) fn over_ground(count: usize) -> Vec<Sphere> {
    let [low, high] = LAYER;
    let volume: f64 = (0..3).map(|axis| high[axis] - low[axis]).product();
    let median = 0.2 * (volume / count as f64).cbrt();
    let log_normal = |random: &mut Random| median * (0.7 * random.normal()).exp();
    let mut list = scattered(count - 1, LAYER, 9, log_normal);
    let ground = Sphere { center: Vec3::new(0.0, -1000.0, 0.0), radius: 1000.0 };
    list.insert(count / 2, ground);
    list
}

/// Eric Haines' `balls` of the Standard Procedural Databases: every sphere has nine children of a third of its radius,
/// six around its equator and three towards its pole.
pub(super) fn flake(generations: u32) -> Vec<Sphere> {
    let around = |turn: f64, height: f64| {
        let flat = (1.0 - height * height).sqrt();
        [flat * turn.cos(), flat * turn.sin(), height]
    };
    let equator = (0..6).map(|k| around(f64::from(k) * FRAC_PI_3, 0.0));
    let height = 54.7356_f64.to_radians().sin();
    let pole = (0..3).map(|k| around(FRAC_PI_6 + f64::from(k) * 2.0 * FRAC_PI_3, height));
    let places: Vec<Point> = equator.chain(pole).collect();
    let mut list = Vec::new();
    grow(&mut list, &places, ([0.0; 3], 0.5, [0.0, 0.0, 1.0]), generations);
    list
}

/// A sphere (centre, radius, axis), and its children in the order of `places` around its axis, each before its own.
fn grow(
    list: &mut Vec<Sphere>,
    places: &[Point],
    (center, radius, axis): (Point, f64, Point),
    generations: u32,
) {
    list.push(Sphere { center: single(center), radius: radius as f32 });
    if generations == 0 {
        return;
    }
    let z = unit(axis);
    let helper = if z[0].abs() < 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let x = unit(cross(helper, z));
    let y = cross(z, x);
    for place in places {
        let out = plus(plus(plus([0.0; 3], place[0], x), place[1], y), place[2], z);
        let child = plus(center, radius + radius / 3.0, out);
        grow(list, places, (child, radius / 3.0, out), generations - 1);
    }
}
