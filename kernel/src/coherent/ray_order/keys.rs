//! The keys by which rays are sorted: cells of a grid, or of two grids for rays of two viewpoints.

use super::grid::{Grid, Space};
use crate::geometry::many::ManyRays;
use crate::geometry::ray::Ray;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::Lanes;
use glam::Vec3;

/// Bits of a key.
pub(super) const BITS: u32 = 16;
/// The most rays that are sorted together: their numbers have as many bits.
pub(crate) const MOST: usize = 1 << BITS;

/// How the keys of some rays are made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayKeys {
    pub(super) space: Space,
    pub(super) grid: Grid,
    /// A grid for rays that start nearer to the second viewpoint.
    pub(crate) second: Option<SecondGrid>,
    /// Whether each ray has a neighbour a few rays after it.
    pub(crate) are_by_turns: bool,
}

/// Two viewpoints, and the grid of the rays from the second.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SecondGrid {
    pub(super) viewpoints: [Vec3; 2],
    pub(super) grid: Grid,
}

/// Whether a ray starts nearer to the second viewpoint, by sums of sizes: squares would overflow sooner.
#[inline(always)]
pub(super) fn is_of_second(viewpoints: [Vec3; 2], ray: &Ray) -> bool {
    let [first, second] = viewpoints.map(|point| (ray.origin - point).abs().element_sum());
    second < first
}

impl RayKeys {
    #[inline(always)]
    fn key_of(&self, space: Space, second: Option<&SecondGrid>, ray: &Ray) -> u32 {
        let own = self.grid.cell(space, ray);
        let Some(second) = second else { return own };
        // Both, so that the compiler makes vectors of it.
        let other = second.grid.cell(space, ray);
        let is_second = is_of_second(second.viewpoints, ray);
        u32::from(is_second) << (BITS - 1) | if is_second { other } else { own } >> 1
    }

    #[inline(never)]
    pub(super) fn key(&self, ray: &Ray) -> u32 {
        self.key_of(self.space, self.second.as_ref(), ray)
    }

    /// Writes the keys of at most [`MOST`] rays into `places`, above their numbers.
    #[inline(always)]
    pub(crate) fn write_keys<L: Lanes<Array = [f32; 16]>>(
        &self,
        token: L::Token,
        rays: &ManyRays<'_>,
        places: &mut [u32],
    ) {
        if self.second.is_some() {
            let by = (Space::Direction, self.second.as_ref());
            return self.write::<L>(token, by, rays, places);
        }
        match self.space {
            Space::Start => self.write::<L>(token, (Space::Start, None), rays, places),
            Space::Direction => self.write::<L>(token, (Space::Direction, None), rays, places),
            Space::Crossing => self.write::<L>(token, (Space::Crossing, None), rays, places),
        }
    }

    /// A packet at a time, so that the compiler makes vectors of its lanes. (Ray after ray took 20 ns each.)
    #[inline(always)]
    fn write<L: Lanes<Array = [f32; 16]>>(
        &self,
        token: L::Token,
        (space, second): (Space, Option<&SecondGrid>),
        rays: &ManyRays<'_>,
        places: &mut [u32],
    ) {
        let mut packet = [RayPacket::BLANK];
        for (number, places) in places.chunks_mut(RayPacket::COUNT).enumerate() {
            rays.fill::<L>(token, number, &mut packet);
            let mut keys = [0; RayPacket::COUNT];
            for lane in 0..RayPacket::COUNT {
                let number = (number * RayPacket::COUNT + lane) % MOST;
                let key = self.key_of(space, second, &packet[0].ray(lane));
                keys[lane] = (key << BITS) | number as u32;
            }
            for (place, key) in places.iter_mut().zip(keys) {
                *place = key;
            }
        }
    }
}
