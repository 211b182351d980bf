//! The rays of the large scenes: two cameras, and two kinds of rays that have nothing in common.

use crate::point::{Point, direction, plus, unit, within};
use spherule_kernel::Ray;
use spherule_referee::aim::single;
use spherule_referee::random::{Random, cross};

/// Pixels to a side of a tile, which holds sixteen rays.
const TILE: usize = 4;

/// A pinhole camera with a square picture; `angle` is from its lower to its upper edge, in degrees.
pub(super) fn perspective(eye: Point, target: Point, angle: f64, pixels: usize) -> Vec<Ray> {
    let [u, v, w] = axes(eye, target);
    let half = (angle.to_radians() / 2.0).tan();
    let towards = |[x, y]: [f64; 2]| plus(plus(w, half * x, u), half * y, v);
    tiles(pixels).map(|point| Ray::new(single(eye), single(towards(point)))).collect()
}

/// A camera whose rays are parallel, with a square picture of side `height`.
pub(super) fn parallel(eye: Point, target: Point, height: f64, pixels: usize) -> Vec<Ray> {
    let [u, v, w] = axes(eye, target);
    let half = height / 2.0;
    let origin = |[x, y]: [f64; 2]| plus(plus(eye, half * x, u), half * y, v);
    tiles(pixels).map(|point| Ray::new(single(origin(point)), single(w))).collect()
}

/// Right, up and forwards; up is towards y.
fn axes(eye: Point, target: Point) -> [Point; 3] {
    let w = unit(plus(target, -1.0, eye));
    let u = unit(cross(w, [0.0, 1.0, 0.0]));
    [u, cross(u, w), w]
}

/// The middles of the pixels, from -1 to 1 to the right and up, tile by tile.
pub(super) fn tiles(pixels: usize) -> impl Iterator<Item = [f64; 2]> {
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
    let mut random = Random::seeded(7);
    let ray = |_| {
        let origin = within(&mut random, low, high);
        Ray::new(single(origin), single(direction(&mut random)))
    };
    (0..count).map(ray).collect()
}

/// Origins are uniform on a sphere around the scene, and rays go towards points uniform in the
/// cube.
pub(super) fn from_afar(distance: f64, count: usize) -> Vec<Ray> {
    let mut random = Random::seeded(8);
    let ray = |_| {
        let origin = direction(&mut random).map(|x| x * distance);
        let target = within(&mut random, [-1.0; 3], [1.0; 3]);
        Ray::new(single(origin), single(unit(plus(target, -1.0, origin))))
    };
    (0..count).map(ray).collect()
}
