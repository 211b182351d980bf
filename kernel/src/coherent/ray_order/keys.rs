//! The keys by which rays are sorted: cells of a grid over where rays start, where they run to, or where they cross a plane.

use crate::geometry::many::ManyRays;
use crate::geometry::ray::{Ray, RayPacket};
use crate::lanes::Lanes;
use crate::numeric::z_curve::{one_in_three, one_in_two};
use glam::Vec3;

/// Bits of a key.
pub(super) const BITS: u32 = 16;
/// The most rays that are sorted together: their numbers have as many bits.
pub(crate) const MOST: usize = 1 << BITS;
/// The last of 256 cells along an axis.
const LAST_CELL: f32 = 255.0;
/// Added to a number below 2^8, it leaves the nearest whole number in the low bits.
const ROUNDING: f32 = (1 << 23) as f32;
/// Rays are nearly parallel if their directions, whose components have sizes that sum up to one, are so near their mean.
const PARALLEL: f32 = 1.0 / 16.0;

/// How the keys of some rays are made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayKeys {
    pub(super) key: Key,
    /// Unit vectors at right angles; the last is the mean direction.
    axes: [Vec3; 3],
    /// The plane goes through this point.
    middle: Vec3,
    /// Where the grid begins, and its cells per length.
    low: [f32; 3],
    per_length: [f32; 3],
}

/// What a key is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Key {
    Start,
    Direction,
    Crossing,
}

impl RayKeys {
    /// Keys by start, with axes along the mean direction of those rays.
    pub(super) fn along_mean(rays: &[Ray], most: f32) -> Self {
        let (mut direction, mut middle) = (Vec3::ZERO, Vec3::ZERO);
        for ray in rays {
            let unit = ray.direction / ray.direction.abs().element_sum();
            direction += if unit.is_finite() { unit } else { Vec3::ZERO };
            let start = ray.origin.max(Vec3::splat(-most)).min(Vec3::splat(most));
            middle += if start.is_finite() { start / rays.len() as f32 } else { Vec3::ZERO };
        }
        let unit = direction / libm::sqrtf(direction.dot(direction));
        let axis = if unit.is_finite() { unit } else { Vec3::Z };
        let (across, up) = axis.any_orthonormal_pair();
        let axes = [across, up, axis];
        Self { key: Key::Start, axes, middle, low: [0.0; 3], per_length: [0.0; 3] }
    }

    /// Lays the grid over those rays, in squares where it is flat; no place counts as farther away than `most`.
    pub(super) fn lay_grid(&mut self, rays: &[Ray], most: f32) {
        let (mut low, mut high) = ([most; 3], [-most; 3]);
        for ray in rays {
            let place = self.place(self.key, ray);
            for axis in 0..3 {
                low[axis] = if place[axis] < low[axis] { place[axis] } else { low[axis] };
                high[axis] = if place[axis] > high[axis] { place[axis] } else { high[axis] };
            }
        }
        for axis in 0..3 {
            (low[axis], high[axis]) = (low[axis].max(-most), high[axis].min(most));
        }
        let mut lengths = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
        if self.key != Key::Start {
            lengths = [lengths[0].max(lengths[1]); 3];
        }
        (self.low, self.per_length) = (low, lengths.map(|length| (LAST_CELL + 1.0) / length));
    }

    /// Returns a direction along the axes, whose sizes sum up to one: a place on an octahedron.
    #[inline(always)]
    fn direction(&self, ray: &Ray) -> [f32; 3] {
        let [across, up, axis] = self.axes;
        let along = [ray.direction.dot(across), ray.direction.dot(up), ray.direction.dot(axis)];
        let per_size = 1.0 / (along[0].abs() + along[1].abs() + along[2].abs());
        [along[0] * per_size, along[1] * per_size, along[2] * per_size]
    }

    pub(super) fn is_parallel(&self, ray: &Ray) -> bool {
        let [across, up, along] = self.direction(ray);
        along > 0.0 && across.abs() + up.abs() <= PARALLEL
    }

    /// Returns where a ray is in the grid's space.
    #[inline(always)]
    fn place(&self, key: Key, ray: &Ray) -> [f32; 3] {
        match key {
            Key::Start => ray.origin.to_array(),
            Key::Direction => self.direction(ray),
            Key::Crossing => {
                let [across, up, axis] = self.axes;
                let from = ray.origin - self.middle;
                let crossing = from - ray.direction * (from.dot(axis) / ray.direction.dot(axis));
                [crossing.dot(across), crossing.dot(up), 0.0]
            }
        }
    }

    /// Returns a key of 16 bits; keys of rays that are near each other are mostly near each other.
    #[inline(always)]
    fn key_of(&self, key: Key, ray: &Ray) -> u32 {
        let place = self.place(key, ray);
        let mut cell = [0; 3];
        for axis in 0..3 {
            let along = (place[axis] - self.low[axis]) * self.per_length[axis];
            // NaN is in the first cell.
            let along = if along > 0.0 { along } else { 0.0 };
            let along = if along < LAST_CELL { along } else { LAST_CELL };
            // Rounded, since no instruction of vectors does what a cast does.
            cell[axis] = (along + ROUNDING).to_bits() & LAST_CELL as u32;
        }
        let flat = one_in_two(cell[0]) | one_in_two(cell[1]) << 1;
        match key {
            Key::Start => {
                let [x, y, z] = cell.map(one_in_three);
                (x | y << 1 | z << 2) >> 8
            }
            // The sides of an octahedron that face away come last.
            Key::Direction => u32::from(place[2] < 0.0) << 15 | flat >> 1,
            Key::Crossing => flat,
        }
    }

    #[inline(never)]
    pub(super) fn key(&self, ray: &Ray) -> u32 {
        self.key_of(self.key, ray)
    }

    /// Writes the keys of at most [`MOST`] rays into `places`, above their numbers.
    #[inline(always)]
    pub(crate) fn write_keys<L: Lanes<Array = [f32; 16]>>(
        &self,
        token: L::Token,
        rays: &ManyRays<'_>,
        places: &mut [u32],
    ) {
        match self.key {
            Key::Start => self.write::<L>(token, Key::Start, rays, places),
            Key::Direction => self.write::<L>(token, Key::Direction, rays, places),
            Key::Crossing => self.write::<L>(token, Key::Crossing, rays, places),
        }
    }

    /// A packet at a time, so that the compiler makes vectors of its lanes. (Ray after ray took 20 ns each.)
    #[inline(always)]
    fn write<L: Lanes<Array = [f32; 16]>>(
        &self,
        token: L::Token,
        key: Key,
        rays: &ManyRays<'_>,
        places: &mut [u32],
    ) {
        let mut packet = [RayPacket::BLANK];
        for (number, places) in places.chunks_mut(RayPacket::COUNT).enumerate() {
            rays.fill::<L>(token, number, &mut packet);
            let mut keys = [0; RayPacket::COUNT];
            for lane in 0..RayPacket::COUNT {
                let number = (number * RayPacket::COUNT + lane) % MOST;
                keys[lane] = (self.key_of(key, &packet[0].ray(lane)) << BITS) | number as u32;
            }
            for (place, key) in places.iter_mut().zip(keys) {
                *place = key;
            }
        }
    }
}
