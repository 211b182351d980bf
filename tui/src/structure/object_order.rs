//! Object order: for each sphere, the rays that may meet it.
//!
//! ```text
//!   image order: for each ray               object order: for each sphere
//!                  for each sphere                          where on the screen can it be?
//!                    intersect                              for each ray there
//!                  keep the nearest                           intersect, keep the nearer
//!
//!   +---+---+---+---+---+---+               +---+---+---+---+---+---+
//!   |   |   |   |   |   |   |               |   |   |   |   |   |   |
//!   +---+---+---+---+---+---+               +---+###########+---+---+
//!   |   | * |   |   |   |   |  one packet   |   #   |.-.|   #   |   |  the packets in
//!   +---+---+---+---+---+---+  of rays,     +---#--(-+-+-)--#---+---+  one sphere's
//!   |   |   |   |   |   |   |  all spheres  |   #   |'-'|   #   |   |  bounds
//!   +---+---+---+---+---+---+               +---+###########+---+---+
//! ```
//!
//! The contract's rule 5 decides which hit is nearer, and bounds drop no hit (`screen.rs`). So both orders have the
//! same picture, except for false hits of `Fast` and `Geometric` beside a sphere's bounds.
//!
//! Bounds are found once a picture. A picture is traced strip by strip, so the loop over spheres runs once a strip. The
//! bounds of the strip as a whole, and of its blocks of packets, rule out most spheres at once. Neither blocks nor
//! strips change a count: which packets a sphere is tested against depends on their rays alone.
//!
//! Shadow rays have no screen in common: they go through a structure.

use super::screen::{Area, Screen};
use super::tracing::Tracing;
use spherule_kernel::{HitPacket, RayPacket, Spheres, Writes, object_packets};
use std::ops::AddAssign;

/// How many packets are looked at together: as many as are a square in the order of a picture.
const BLOCK: usize = 16;

/// The spheres of a picture, and where on its screen they can be.
#[derive(Clone, Copy, Debug)]
pub struct ObjectOrder<'a> {
    spheres: Spheres<'a>,
    screen: Screen,
    areas: &'a [Area],
}

/// The work that an order of loops takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Tests of a ray against a sphere.
    pub tests: u64,
    /// How many hits were stored, and how many replaced an earlier one.
    pub writes: Writes,
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.tests += other.tests;
        self.writes += other.writes;
    }
}

/// The packets of a strip on the screen: the memory of one thread.
#[derive(Clone, Debug, Default)]
pub struct Raster {
    /// The area of every packet, and how many live rays it has.
    packets: Vec<(Area, u32)>,
    /// The area of every [`BLOCK`] packets.
    blocks: Vec<Area>,
    /// The numbers of the packets that a sphere is tested against.
    inside: Vec<u32>,
}

impl<'a> ObjectOrder<'a> {
    /// Finds the bounds of all spheres, in the memory given.
    #[must_use]
    pub fn new(spheres: Spheres<'a>, screen: Screen, areas: &'a mut Vec<Area>) -> Self {
        areas.clear();
        areas.extend(spheres.iter().map(|sphere| screen.of_sphere(&sphere)));
        Self { spheres, screen, areas }
    }

    /// All spheres.
    #[must_use]
    pub fn spheres(&self) -> Spheres<'a> {
        self.spheres
    }

    /// Writes the closest hit of every ray to `hits`, and returns the work that took.
    pub fn closest_hits(
        &self,
        Tracing { tier, level, .. }: Tracing,
        raster: &mut Raster,
        rays: &[RayPacket],
        hits: &mut [HitPacket],
    ) -> Counts {
        for hits in hits.iter_mut().take(rays.len()) {
            *hits = HitPacket::none();
        }
        let all = raster.place(&self.screen, rays);
        let mut counts = Counts::default();
        for (area, index) in self.areas.iter().zip(0..) {
            if !area.overlaps(&all) {
                continue;
            }
            counts.tests += raster.find(area);
            if !raster.inside.is_empty() {
                let numbers = &raster.inside;
                counts.writes +=
                    object_packets(tier, level, self.spheres, index, numbers, rays, hits);
            }
        }
        counts
    }
}

impl Raster {
    /// Places the packets of a strip; returns the area of all of them.
    fn place(&mut self, screen: &Screen, rays: &[RayPacket]) -> Area {
        self.packets.clear();
        self.packets.extend(rays.iter().map(|packet| screen.of_packet(packet)));
        self.blocks.clear();
        let both = |all: Area, &(area, _): &(Area, u32)| all.and(&area);
        let blocks = self.packets.chunks(BLOCK);
        self.blocks.extend(blocks.map(|block| block.iter().fold(Area::NOWHERE, both)));
        self.blocks.iter().fold(Area::NOWHERE, |all, area| all.and(area))
    }

    /// Finds the packets that overlap `area`; returns how many rays they have.
    fn find(&mut self, area: &Area) -> u64 {
        self.inside.clear();
        let mut rays = 0;
        let blocks = self.blocks.iter().zip(self.packets.chunks(BLOCK)).zip((0..).step_by(BLOCK));
        for ((block, packets), first) in blocks {
            if !area.overlaps(block) {
                continue;
            }
            for ((place, live), number) in packets.iter().zip(first..) {
                if area.overlaps(place) {
                    self.inside.push(number);
                    rays += u64::from(*live);
                }
            }
        }
        rays
    }
}

#[cfg(test)]
mod tests;
