//! The rays that orders are made of, in double precision, rounded once.

use super::Extent;
use crate::point::{Point, plus, unit, within};
use spherule_kernel::{Ray, Sphere, Spheres};
use spherule_referee::aim::single;
use spherule_referee::random::{Random, cross, dot};
use std::f64::consts::TAU;

/// Pixels of a line of a large picture.
const LINE: usize = 1024;
/// From the middle to the camera, in halves of the scene.
const CAMERA: Point = [1.6, 2.0, 3.2];
/// The other of two cameras.
const OTHER_CAMERA: Point = [-3.4, 1.2, -1.8];
/// From the middle to lights.
const LIGHTS: [Point; 2] = [[1.5, 2.5, 1.0], [-2.0, 1.8, 0.7]];
/// The direction of a beam.
const ASLANT: Point = [0.36, -0.48, -0.8];

/// Makes rays for a scene.
pub(super) struct Rays<'a> {
    pub(super) extent: &'a Extent,
    pub(super) random: Random,
}

impl Rays<'_> {
    /// Uniform in the box.
    fn inside(&mut self) -> Point {
        within(&mut self.random, self.extent.low, self.extent.high)
    }

    /// So many halves of the scene from its middle.
    fn off_middle(&self, offset: Point) -> Point {
        plus(self.extent.middle(), self.extent.half(), offset)
    }

    /// Through random points, from in front of the scene; directions differ by `spread`.
    pub(super) fn beam(&mut self, count: usize, spread: f64) -> Vec<Ray> {
        let back = -4.0 * self.extent.half();
        let ray = |_| {
            let origin = plus(self.inside(), back, ASLANT);
            ray(origin, plus(ASLANT, spread, self.random.unit()))
        };
        (0..count).map(ray).collect()
    }

    /// From a random point to each of the lights.
    pub(super) fn shadow_rays(&mut self) -> [Ray; 2] {
        let point = self.inside();
        LIGHTS.map(|light| {
            let light = self.off_middle(light);
            Ray { t_max: 1.0, ..ray(point, plus(light, -1.0, point)) }
        })
    }

    /// Lines of a picture, evenly spaced, each from left to right.
    pub(super) fn camera(&mut self, count: usize, other: bool) -> Vec<Ray> {
        // A few rays also make a few lines.
        let width = (count / 16).next_power_of_two().clamp(16, LINE);
        let lines = count.div_ceil(width).max(1);
        let camera = Camera::new(self.extent, if other { OTHER_CAMERA } else { CAMERA });
        let middle = |index: usize, of: usize| 2.0 * (index as f64 + 0.5) / of as f64 - 1.0;
        let ray =
            |index: usize| camera.ray(middle(index % width, width), middle(index / width, lines));
        (0..count).map(ray).collect()
    }

    /// Rays of two cameras by turns, of each `half` or fewer.
    pub(super) fn two_cameras(&mut self, count: usize, half: usize) -> Vec<Ray> {
        in_turns([self.camera(half, false), self.camera(half, true)], 1, count)
    }

    /// The rays in no order, each as likely in any place (Fisher and Yates).
    pub(super) fn shuffled(&mut self, mut rays: Vec<Ray>) -> Vec<Ray> {
        for last in (1..rays.len()).rev() {
            rays.swap(last, self.random.integer(0, last as i64) as usize);
        }
        rays
    }

    /// Random pixels of a camera `distance` scene sizes away.
    pub(super) fn camera_shuffled(&mut self, count: usize, distance: f64) -> Vec<Ray> {
        let camera = Camera::new(self.extent, ASLANT.map(|x| -2.0 * distance * x));
        let mut pixel =
            || 2.0 * (self.random.integer(0, LINE as i64 - 1) as f64 + 0.5) / LINE as f64 - 1.0;
        (0..count).map(|_| camera.ray(pixel(), pixel())).collect()
    }

    /// Bursts from one point each, in directions that differ by 0.02.
    pub(super) fn bursts(&mut self, count: usize, alike: usize) -> Vec<Ray> {
        let mut rays = Vec::with_capacity(count);
        while rays.len() < count {
            let (origin, towards) = (self.inside(), self.random.unit());
            let next = |_| ray(origin, plus(towards, 0.02, self.random.unit()));
            rays.extend((0..alike.min(count - rays.len())).map(next));
        }
        rays
    }

    /// Fans of 64 heights from 25 degrees below to 15 above, each turned by a step.
    pub(super) fn scanner(&mut self, count: usize) -> Vec<Ray> {
        const FAN: usize = 64;
        let (origin, turns) = (self.off_middle([0.11, 0.07, -0.13]), count.div_ceil(FAN));
        let ray = |index: usize| {
            let turn = TAU * (index / FAN) as f64 / turns as f64;
            let height = (-25.0 + 40.0 * (index % FAN) as f64 / (FAN - 1) as f64).to_radians();
            let flat = height.cos();
            ray(origin, [flat * turn.cos(), height.sin(), flat * turn.sin()])
        };
        (0..count).map(ray).collect()
    }

    /// Two components of the direction are zero.
    pub(super) fn along_an_axis(&mut self, count: usize) -> Vec<Ray> {
        (0..count).map(|_| ray(self.inside(), [0.0, 0.0, 1.0])).collect()
    }

    /// A beam from 10^4 sizes away.
    pub(super) fn far_beam(&mut self, count: usize) -> Vec<Ray> {
        let back = -2e4 * self.extent.half();
        (0..count).map(|_| ray(plus(self.inside(), back, ASLANT), ASLANT)).collect()
    }

    /// From one point inside.
    pub(super) fn all_around(&mut self, count: usize) -> Vec<Ray> {
        let origin = self.off_middle([-0.17, 0.05, 0.09]);
        (0..count).map(|_| ray(origin, self.random.unit())).collect()
    }

    /// Rays from anywhere inside to anywhere.
    pub(super) fn diffuse(&mut self, count: usize) -> Vec<Ray> {
        (0..count).map(|_| ray(self.inside(), self.random.unit())).collect()
    }

    /// From a random point of a random valid sphere, the steeper the likelier (Lambert); diffuse rays if no sphere is
    /// valid.
    pub(super) fn bounces(&mut self, spheres: Spheres<'_>, count: usize) -> Vec<Ray> {
        let bounce = |_| {
            for _ in 0..64 {
                let index = self.random.integer(0, spheres.len().max(1) as i64 - 1) as usize;
                let Some(sphere) = spheres.get(index).filter(Sphere::is_valid) else {
                    continue;
                };
                let (normal, radius) = (self.random.unit(), f64::from(sphere.radius));
                let center = sphere.center.to_array().map(f64::from);
                // A little above the surface, so that the rounded point stays outside.
                let least = center.iter().fold(radius, |most, x| x.abs().max(most)) * 2.5e-7;
                let origin = plus(center, radius * (1.0 + 1e-5) + least, normal);
                let towards = plus(normal, 0.999, self.random.unit());
                return ray(origin, towards);
            }
            ray(self.inside(), self.random.unit())
        };
        (0..count).map(bounce).collect()
    }
}

/// A pinhole camera that looks at the middle of a scene, which fills its square picture.
struct Camera {
    eye: Point,
    /// Forwards, then right and up as far as an edge of the picture.
    axes: [Point; 3],
}

impl Camera {
    /// `offset` from the middle, in halves of the scene.
    fn new(extent: &Extent, offset: Point) -> Self {
        let distance = dot(offset, offset).sqrt();
        let forwards = offset.map(|x| -x / distance);
        let right = unit(cross(forwards, [0.0, 1.0, 0.0]));
        let up = cross(right, forwards);
        // The picture holds a sphere of radius 1.3 around the middle.
        let edge = 1.3 / distance;
        let eye = plus(extent.middle(), extent.half(), offset);
        Self { eye, axes: [forwards, right.map(|x| edge * x), up.map(|x| edge * x)] }
    }

    /// Through a point of the picture, from -1 to 1 to the right and down.
    fn ray(&self, x: f64, y: f64) -> Ray {
        let [forwards, right, up] = self.axes;
        ray(self.eye, plus(plus(forwards, x, right), -y, up))
    }
}

/// Octant by octant, and within along a curve through the cells of the two lesser components.
pub(super) fn sorted_by_direction(mut rays: Vec<Ray>) -> Vec<Ray> {
    let key = |ray: &Ray| {
        let direction = ray.direction.to_array();
        let octant =
            (0..3).filter(|&axis| direction[axis] < 0.0).map(|axis| 1_u64 << axis).sum::<u64>();
        let cell = direction.map(|x| (x.abs() * 1023.0) as u64);
        let bit = |place: u64| (0..3).fold(0, |bits, axis| bits << 1 | cell[axis] >> place & 1);
        (0..10).rev().fold(octant, |key, place| key << 3 | bit(place))
    };
    rays.sort_by_cached_key(key);
    rays
}

fn ray(origin: Point, direction: Point) -> Ray {
    Ray::new(single(origin), single(direction))
}

/// Takes `run` rays of the first, `run` of the second, and so on, each time from where it stopped.
pub(super) fn in_turns(both: [Vec<Ray>; 2], run: usize, count: usize) -> Vec<Ray> {
    let [mut one, mut other] = both.map(Vec::into_iter);
    let turn =
        |place: usize| if (place / run).is_multiple_of(2) { one.next() } else { other.next() };
    (0..count).map_while(turn).collect()
}
