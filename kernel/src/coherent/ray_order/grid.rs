//! A grid over where rays start, where they run to, or where they cross a plane; its cells are numbered along a Z curve.

use crate::geometry::ray::Ray;
use crate::numeric::z_curve::{one_in_three, one_in_two};
use glam::Vec3;

/// The last of 256 cells along an axis.
const LAST_CELL: f32 = 255.0;
/// Added to a number below 2^8, it leaves the nearest whole number in the low bits.
const ROUNDING: f32 = (1 << 23) as f32;
/// Rays are nearly parallel if their directions, whose components have sizes that sum up to one, are so near their mean.
const PARALLEL: f32 = 1.0 / 16.0;

/// The space that a grid lies in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Space {
    Start,
    Direction,
    Crossing,
}

/// A grid in a space of rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    /// Unit vectors at right angles; the last is the mean direction.
    axes: [Vec3; 3],
    /// The plane goes through this point.
    middle: Vec3,
    /// Where the grid begins, and its cells per length.
    low: [f32; 3],
    per_length: [f32; 3],
}

impl Grid {
    /// With axes along the mean direction of those rays, and not laid yet.
    pub(super) fn along_mean<'a>(rays: impl Iterator<Item = &'a Ray> + Clone, most: f32) -> Self {
        let (mut direction, mut middle) = (Vec3::ZERO, Vec3::ZERO);
        let count = rays.clone().count();
        for ray in rays {
            let unit = ray.direction / ray.direction.abs().element_sum();
            direction += if unit.is_finite() { unit } else { Vec3::ZERO };
            let start = ray.origin.max(Vec3::splat(-most)).min(Vec3::splat(most));
            middle += if start.is_finite() { start / count as f32 } else { Vec3::ZERO };
        }
        let unit = direction / libm::sqrtf(direction.dot(direction));
        let axis = if unit.is_finite() { unit } else { Vec3::Z };
        let (across, up) = axis.any_orthonormal_pair();
        Self { axes: [across, up, axis], middle, low: [0.0; 3], per_length: [0.0; 3] }
    }

    /// Laid over those rays, in squares where it is flat; no place counts as farther away than `most`.
    pub(super) fn laid<'a>(
        self,
        space: Space,
        rays: impl Iterator<Item = &'a Ray>,
        most: f32,
    ) -> Self {
        let (mut low, mut high) = ([most; 3], [-most; 3]);
        for ray in rays {
            let place = self.place(space, ray);
            for axis in 0..3 {
                low[axis] = if place[axis] < low[axis] { place[axis] } else { low[axis] };
                high[axis] = if place[axis] > high[axis] { place[axis] } else { high[axis] };
            }
        }
        for axis in 0..3 {
            (low[axis], high[axis]) = (low[axis].max(-most), high[axis].min(most));
        }
        let mut lengths = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
        if space != Space::Start {
            lengths = [lengths[0].max(lengths[1]); 3];
        }
        Self { low, per_length: lengths.map(|length| (LAST_CELL + 1.0) / length), ..self }
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

    /// Returns where a ray is in the space.
    #[inline(always)]
    fn place(&self, space: Space, ray: &Ray) -> [f32; 3] {
        match space {
            Space::Start => ray.origin.to_array(),
            Space::Direction => self.direction(ray),
            Space::Crossing => {
                let [across, up, axis] = self.axes;
                let from = ray.origin - self.middle;
                let crossing = from - ray.direction * (from.dot(axis) / ray.direction.dot(axis));
                [crossing.dot(across), crossing.dot(up), 0.0]
            }
        }
    }

    /// Returns the number of a ray's cell, of 16 bits; numbers of rays that are near each other are mostly near each other.
    #[inline(always)]
    pub(super) fn cell(&self, space: Space, ray: &Ray) -> u32 {
        let place = self.place(space, ray);
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
        match space {
            Space::Start => {
                let [x, y, z] = cell.map(one_in_three);
                (x | y << 1 | z << 2) >> 8
            }
            // The sides of an octahedron that face away come last.
            Space::Direction => u32::from(place[2] < 0.0) << 15 | flat >> 1,
            Space::Crossing => flat,
        }
    }
}
