//! The spheres of the scenes.

use super::{Point, cross, plus, rounded, unit};
use crate::random::Random;
use spherule_kernel::{Sphere, Vec3};
use std::f64::consts::{FRAC_PI_3, FRAC_PI_6};

/// The unit sphere.
pub(super) fn one() -> Vec<Sphere> {
    vec![Sphere { center: Vec3::ZERO, radius: 1.0 }]
}

/// Uniform in the cube from -1 to 1; a quarter to three quarters of the side of a cell large.
pub(super) fn uniform(count: usize, seed: u64) -> Vec<Sphere> {
    in_cube(count, 0.5, seed)
}

/// The same, twice as large: half of the cube is in some sphere.
pub(super) fn dense(count: usize) -> Vec<Sphere> {
    in_cube(count, 1.0, 6)
}

fn in_cube(count: usize, radius: f64, seed: u64) -> Vec<Sphere> {
    let mut random = Random::new(seed);
    let scale = radius * (count as f64).powf(-1.0 / 3.0);
    let sphere = |_| {
        let center = [(); 3].map(|()| 2.0 * random.unit() - 1.0);
        Sphere { center: rounded(center), radius: (scale * (0.5 + random.unit())) as f32 }
    };
    (0..count).map(sphere).collect()
}

/// Where the spheres on the ground have their centres.
pub(super) const LAYER: [Point; 2] = [[-10.0, 0.0, -10.0], [10.0, 1.0, 10.0]];

/// `count - 1` spheres of log-normal radii (the median a fortieth, sigma 0.7; one in a million is
/// thirty times that) in a layer on a sphere of radius 1000, which is in the middle of the list.
pub(super) fn over_ground(count: usize) -> Vec<Sphere> {
    let mut random = Random::new(9);
    let [low, high] = LAYER;
    let volume: f64 = (0..3).map(|axis| high[axis] - low[axis]).product();
    let median = 0.2 * (volume / count as f64).cbrt();
    let small = |_| {
        let center = [0, 1, 2].map(|axis| low[axis] + (high[axis] - low[axis]) * random.unit());
        let radius = median * (0.7 * random.normal()).exp();
        Sphere { center: rounded(center), radius: radius as f32 }
    };
    let mut list: Vec<_> = (1..count).map(small).collect();
    let ground = Sphere { center: Vec3::new(0.0, -1000.0, 0.0), radius: 1000.0 };
    list.insert(count / 2, ground);
    list
}

/// Eric Haines' `balls` of the Standard Procedural Databases: every sphere has nine children of a
/// third of its radius, six around its equator and three towards its pole.
pub(super) fn flake(generations: u32) -> Vec<Sphere> {
    let around = |turn: f64, height: f64| {
        let flat = (1.0 - height * height).sqrt();
        [flat * turn.cos(), flat * turn.sin(), height]
    };
    let equator = (0..6).map(|k| around(f64::from(k) * FRAC_PI_3, 0.0));
    let pole = (0..3).map(|k| {
        around(FRAC_PI_6 + f64::from(k) * 2.0 * FRAC_PI_3, 54.7356_f64.to_radians().sin())
    });
    let places: Vec<Point> = equator.chain(pole).collect();
    let mut list = Vec::new();
    grow(&mut list, &places, [0.0; 3], 0.5, [0.0, 0.0, 1.0], generations);
    list
}

/// A sphere, and its children in the order of `places` around its axis, each before its own.
fn grow(
    list: &mut Vec<Sphere>,
    places: &[Point],
    center: Point,
    radius: f64,
    axis: Point,
    generations: u32,
) {
    list.push(Sphere { center: rounded(center), radius: radius as f32 });
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
        grow(list, places, child, radius / 3.0, out, generations - 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flake_touches_its_children() {
        let list = flake(4);
        assert_eq!(list.len(), 7381);
        let (parent, child) = (list[0], list[1]);
        let gap = parent.center.distance(child.center) - parent.radius - child.radius;
        assert!(gap.abs() < 1e-6);
    }

    #[test]
    fn the_ground_is_one_and_the_rest_is_small() {
        let list = over_ground(10_000);
        let mut radii: Vec<_> = list.iter().map(|sphere| sphere.radius).collect();
        radii.sort_by(f32::total_cmp);
        assert_eq!(list[5_000].radius, 1000.0);
        assert_eq!(radii.len(), 10_000);
        let spread = (radii[8_413] / radii[5_000]).ln();
        assert!((0.65..0.75).contains(&spread), "{spread}");
        assert!(radii[9_998] < 3.0);
    }
}
