//! Where on the screen a sphere can be seen: the bounds of object order.
//!
//! The camera's rays pass through the screen, before it is cut into samples. In perspective a ray of direction d has the place (d.right,
//! d.up) / d.forward, a slope to each side. In parallel projection a ray of origin o has the place ((o - eye).right, (o - eye).up). Bounds
//! are found for each axis by itself:
//!
//! ```text
//!   perspective, from above:                 parallel:
//!
//!    slope low          slope high             x - r          x + r
//!        \     .---.     /                       |    .---.    |
//!         \   (  c  )   /                        |   (  c  )   |
//!          \   '---'   /                         |    '---'    |
//!           \         /                          |             |
//!            \       /    the planes that        |             |    the planes that all
//!             \     /     touch the sphere,      |             |    rays are parallel to
//!              \   /      through the eye        |             |
//!               eye                              rays begin here
//! ```
//!
//! # Why no hit is dropped
//!
//! A slope s divides space by a plane through the eye. Rays of greater slopes, from the eye forwards, stay on one side of the plane. A
//! sphere whose centre lies on the other side, at least a radius from the plane, meets none of them. This is *checked* for every bound, as
//! it is rounded to `f32`; how the bound was found does not matter. If the check fails, there is no bound.
//!
//! The sphere is taken to have a radius of R = r + 2^-19 (|p| + r) + 2^-100, where p goes from the eye to its centre. That covers
//!
//! - the check in double precision, which is off by less than 2^-47 (|p| + r): p is rounded once, each dot product with
//!   an axis thrice, and so are the products of the check, all of them at most some |p| times the plane's normal;
//! - the hits of the tiers: `Exact` sees the sphere as it is, and `Stable` sees no hit on a line more than R from the centre, since its D/a
//!   is off by at most 2^-40 (|p|^2 + r^2) (`docs/numerics.md`), and R^2 is above r^2 + 2^-38 (|p| + r)^2;
//! - roots just before the eye that are rounded to T = -0 = 0, which counts: t is below 2^-150, and a direction at most 2^49 long.
//!
//! `Fast` and `Geometric` see hits farther than R from a sphere: those hits are lost, as in a tree.
//!
//! A sphere may be anywhere on the screen if the eye is in it, or less than 2^-12 R away from it: so near, `Stable` may take a root for one
//! on the other side of the eye. A sphere that is behind the eye is nowhere.
//!
//! The places of rays are computed from the rays themselves, so it does not matter how a camera rounds. They are rounded outwards. In
//! perspective the margin is 2^-36 (1 + |place|); two dot products and a division are off by less for slopes up to 256, by 2^-42. In
//! parallel projection the margin is 2^-18 of |o - eye|, since the error of a tier grows with |o - eye|, too. Rays that are not the
//! camera's (another origin or direction, t_min < 0), or outside of these ranges, may meet any sphere.

use crate::view::View;
use glam::{DVec2, DVec3};
use spherule_kernel::{Ray, RayPacket, Sphere, Viewpoint};

/// What R is above r, in units of |p| + r.
const SPREAD: f64 = 1.0 / (1 << 19) as f64;
/// What R is above r at least: 2^-100.
const LEAST: f64 = 1.0 / (1_u128 << 100) as f64;
/// A sphere nearer to the eye than this, in units of its radius, may be anywhere.
const NEAR: f64 = 1.0 / (1 << 12) as f64;
/// What slopes are rounded by.
const SLOPE_ERROR: f64 = 1.0 / (1_u64 << 36) as f64;
/// What places in parallel projection are rounded by.
const PLACE_ERROR: f64 = 1.0 / (1 << 18) as f64;
/// The greatest slope of a ray that has a place.
const STEEPEST: f64 = 256.0;
/// The greatest depth of a direction that has a place: 2^40.
const LONGEST: f64 = (1_u64 << 40) as f64;

/// A rectangle of the screen, closed on all sides, rounded outwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    low: [f32; 2],
    high: [f32; 2],
}

impl Area {
    /// All of the screen, and beyond. It overlaps even [`Area::NOWHERE`]: a ray without a place may meet a sphere that is nowhere.
    pub const ANYWHERE: Self = Self { low: [f32::NEG_INFINITY; 2], high: [f32::INFINITY; 2] };
    /// Nothing on the screen.
    pub const NOWHERE: Self = Self { low: [f32::INFINITY; 2], high: [f32::NEG_INFINITY; 2] };

    /// Whether both have a place in common.
    #[must_use]
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        self.low[0] <= other.high[0]
            && other.low[0] <= self.high[0]
            && self.low[1] <= other.high[1]
            && other.low[1] <= self.high[1]
    }

    /// The least area that holds both.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        let low = [0, 1].map(|axis| self.low[axis].min(other.low[axis]));
        Self { low, high: [0, 1].map(|axis| self.high[axis].max(other.high[axis])) }
    }

    /// The places between `low` and `high`, rounded outwards.
    fn between(low: DVec2, high: DVec2) -> Self {
        Self { low: low.to_array().map(below), high: high.to_array().map(above) }
    }
}

/// A number below.
fn below(number: f64) -> f32 {
    (number as f32).next_down()
}

/// A number above.
fn above(number: f64) -> f32 {
    (number as f32).next_up()
}

/// The screen of a view: what its rays share, and the axes.
#[derive(Clone, Copy, Debug)]
pub struct Screen {
    viewpoint: Viewpoint,
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
}

impl Screen {
    /// The screen of [`View::camera`], however many samples there are.
    #[must_use]
    pub fn new(view: &View) -> Self {
        let [mut forward, mut right, mut up] = view.axes();
        let viewpoint = view.viewpoint();
        if let Viewpoint::Direction(direction) = viewpoint {
            // The axis as it was rounded: far away, no other would do.
            forward = direction.as_dvec3().normalize();
            right = (right - right.dot(forward) * forward).normalize();
            up = right.cross(forward);
        }
        Self { viewpoint, eye: view.eye.as_dvec3(), right, up, forward }
    }

    /// Where `sphere` can be seen.
    #[must_use]
    pub fn of_sphere(&self, sphere: &Sphere) -> Area {
        if !sphere.is_valid() {
            return Area::NOWHERE;
        }
        let p = sphere.center.as_dvec3() - self.eye;
        let place = DVec2::new(p.dot(self.right), p.dot(self.up));
        let (distance, radius) = (p.length(), f64::from(sphere.radius));
        let radius = radius + SPREAD * (distance + radius) + LEAST;
        if matches!(self.viewpoint, Viewpoint::Direction(_)) {
            return if self.eye.is_finite() {
                Area::between(place - radius, place + radius)
            } else {
                Area::ANYWHERE
            };
        }
        let depth = p.dot(self.forward);
        // A distance that is NaN says nothing.
        if distance.is_nan() || distance <= radius * (1.0 + NEAR) {
            return Area::ANYWHERE;
        }
        if depth < -radius {
            return Area::NOWHERE;
        }
        Area {
            low: place.to_array().map(|across| -slope_above(-across, depth, radius)),
            high: place.to_array().map(|across| slope_above(across, depth, radius)),
        }
    }

    /// The places of the live rays of a packet, and how many they are.
    #[must_use]
    pub fn of_packet(&self, packet: &RayPacket) -> (Area, u32) {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (mut live, mut anywhere) = (0, false);
        for ray in (0..RayPacket::COUNT).map(|lane| packet.ray(lane)) {
            if !ray.is_live() {
                continue;
            }
            live += 1;
            match self.of_ray(&ray) {
                Some((place, error)) => {
                    low = low.min(place - error);
                    high = high.max(place + error);
                }
                None => anywhere = true,
            }
        }
        (if anywhere { Area::ANYWHERE } else { Area::between(low, high) }, live)
    }

    /// The place of a ray, and its greatest error; `None` if the ray has no place.
    #[inline]
    fn of_ray(&self, ray: &Ray) -> Option<(DVec2, DVec2)> {
        let on_axes = |v: DVec3| DVec2::new(v.dot(self.right), v.dot(self.up));
        match self.viewpoint {
            Viewpoint::Origin(eye) => {
                let direction = ray.direction.as_dvec3();
                let (across, depth) = (on_axes(direction), direction.dot(self.forward));
                let is_forward = across.abs().max_element() <= STEEPEST * depth && depth <= LONGEST;
                let is_ours = ray.origin == eye && ray.t_min >= 0.0;
                let place = across / depth;
                let error = SLOPE_ERROR * (1.0 + place.abs());
                (is_ours && is_forward && depth > 0.0).then_some((place, error))
            }
            Viewpoint::Direction(direction) => {
                let from_eye = ray.origin.as_dvec3() - self.eye;
                let error = DVec2::splat(PLACE_ERROR * from_eye.length());
                (ray.direction == direction).then(|| (on_axes(from_eye), error))
            }
        }
    }
}

/// Returns a slope above the slopes of all rays that meet a circle around (`across`, `depth`), which does not contain the origin. Returns
/// infinity if there is no such slope, or none is found.
fn slope_above(across: f64, depth: f64, radius: f64) -> f32 {
    // The direction of the centre, turned until it touches the circle, which is made a little larger.
    let wide = radius * (1.0 + SPREAD);
    let along = (across * across + depth * depth - wide * wide).sqrt();
    let (side, ahead) = (across * along + depth * wide, depth * along - across * wide);
    let slope = above(side / ahead);
    let s = f64::from(slope);
    let is_on_the_other_side = s * depth - across >= radius * (1.0 + s * s).sqrt();
    if ahead > 0.0 && is_on_the_other_side { slope } else { f32::INFINITY }
}

#[cfg(test)]
mod tests;
