//! The rays of the scenes: two cameras, and two kinds of rays that have nothing in common.

use super::{Point, cross, plus, rounded, unit};
use crate::random::Random;
use spherule_kernel::Ray;

/// Pixels to a side of a tile: sixteen rays.
const TILE: usize = 4;

/// A pinhole camera with a square picture; `angle` is from its lower to its upper edge, in degrees.
pub(super) fn perspective(eye: Point, target: Point, angle: f64, pixels: usize) -> Vec<Ray> {
    let [u, v, w] = axes(eye, target);
    let half = (angle.to_radians() / 2.0).tan();
    let towards = |[x, y]: [f64; 2]| plus(plus(w, half * x, u), half * y, v);
    tiles(pixels).map(|point| Ray::new(rounded(eye), rounded(towards(point)))).collect()
}

/// A camera whose rays are parallel, with a square picture of side `height`.
pub(super) fn parallel(eye: Point, target: Point, height: f64, pixels: usize) -> Vec<Ray> {
    let [u, v, w] = axes(eye, target);
    let half = height / 2.0;
    let origin = |[x, y]: [f64; 2]| plus(plus(eye, half * x, u), half * y, v);
    tiles(pixels).map(|point| Ray::new(rounded(origin(point)), rounded(w))).collect()
}

/// Right, up and forwards; up is towards y.
fn axes(eye: Point, target: Point) -> [Point; 3] {
    let w = unit(plus(target, -1.0, eye));
    let u = unit(cross(w, [0.0, 1.0, 0.0]));
    [u, cross(u, w), w]
}

/// The middles of the pixels, from -1 to 1 to the right and up, tile by tile.
fn tiles(pixels: usize) -> impl Iterator<Item = [f64; 2]> {
    let tiles = pixels / TILE;
    (0..tiles * tiles * TILE * TILE).map(move |index| {
        let (tile, within) = (index / (TILE * TILE), index % (TILE * TILE));
        let x = tile % tiles * TILE + within % TILE;
        let y = tile / tiles * TILE + within / TILE;
        let middle = |pixel: usize| 2.0 * (pixel as f64 + 0.5) / pixels as f64 - 1.0;
        [middle(x), -middle(y)]
    })
}

/// Origins uniform in a box, directions uniform.
pub(super) fn scattered(low: Point, high: Point, count: usize) -> Vec<Ray> {
    let mut random = Random::new(7);
    let ray = |_| {
        let origin = [0, 1, 2].map(|axis| low[axis] + (high[axis] - low[axis]) * random.unit());
        Ray::new(rounded(origin), rounded(direction(&mut random)))
    };
    (0..count).map(ray).collect()
}

/// Origins uniform on a sphere around the scene, towards points uniform in the cube.
pub(super) fn from_afar(distance: f64, count: usize) -> Vec<Ray> {
    let mut random = Random::new(8);
    let ray = |_| {
        let origin = direction(&mut random).map(|x| x * distance);
        let target = [(); 3].map(|()| 2.0 * random.unit() - 1.0);
        Ray::new(rounded(origin), rounded(unit(plus(target, -1.0, origin))))
    };
    (0..count).map(ray).collect()
}

fn direction(random: &mut Random) -> Point {
    unit([(); 3].map(|()| random.normal()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_rays_are_a_tile() {
        let middles: Vec<_> = tiles(8).collect();
        assert_eq!(middles.len(), 64);
        assert_eq!(middles[0], [-0.875, 0.875]);
        assert_eq!(middles[5], [-0.625, 0.625]);
        assert_eq!(middles[16], [0.125, 0.875]);
        assert_eq!(middles[63], [0.875, -0.875]);
    }

    #[test]
    fn the_camera_looks_at_its_target_and_up_is_up() {
        let rays = perspective([0.0, 0.0, 4.0], [0.0; 3], 40.0, 4);
        let sum = rays
            .iter()
            .fold([0.0_f32; 3], |sum, ray| [0, 1, 2].map(|axis| sum[axis] + ray.direction[axis]));
        assert!(sum[0].abs() < 1e-6 && sum[1].abs() < 1e-6 && (sum[2] + 16.0).abs() < 1e-6);
        assert!(rays[0].direction.x < 0.0 && rays[0].direction.y > 0.0);
    }

    #[test]
    fn far_rays_meet_the_scene() {
        for ray in from_afar(2.0e4, 100) {
            let closest = ray.at(-ray.origin.dot(ray.direction) / ray.direction.length_squared());
            assert!(closest.length() < 1.8, "{closest}");
        }
    }
}
