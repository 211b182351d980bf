//! A scene structure that is chosen at run time.

use super::object_order::{ObjectOrder, Raster};
pub use super::tracing::Tracing;
use spherule_kernel::{
    Bvh, CameraTiles, DepthList, HitPacket, Intersect, RayPacket, Spheres, Trace, tile_rays,
};

/// Spheres, and how rays find them. Threads may share it.
#[derive(Clone, Copy, Debug)]
pub enum Search<'a> {
    /// From end to end.
    Brute(Spheres<'a>),
    /// By their depth, for rays of one viewpoint.
    DepthList(DepthList<'a>),
    /// By a tree.
    Bvh(Bvh<'a>),
    /// Not at all: every sphere finds its rays.
    Objects(ObjectOrder<'a>),
}

/// The memory that one thread lends to depth lists and to object order.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    lists: Vec<f32>,
    raster: Raster,
}

impl Scratch {
    /// Lends as much memory as `search` can use. If there is less, tracing takes longer.
    fn of(
        &mut self,
        search: &Search<'_>,
        Tracing { level, coherence, .. }: Tracing,
    ) -> (Trace<'_>, &mut Raster) {
        let Self { lists, raster } = self;
        if let Search::DepthList(list) = search {
            let missing = DepthList::scratch(list.spheres().len()).saturating_sub(lists.len());
            if lists.try_reserve_exact(missing).is_ok() {
                lists.resize(lists.len() + missing, 0.0);
            }
        }
        (Trace::new().at(level).with(coherence).with_scratch(lists), raster)
    }
}

impl Search<'_> {
    /// Writes the closest hit of every ray to `hits`.
    pub fn closest_hits(
        &self,
        tracing: Tracing,
        scratch: &mut Scratch,
        rays: &[RayPacket],
        hits: &mut [HitPacket],
    ) {
        let tier = tracing.tier;
        let (mut trace, raster) = scratch.of(self, tracing);
        let trace = &mut trace;
        match self {
            Self::Brute(spheres) => spheres.closest_hit_packets(tier, trace, rays, hits),
            Self::DepthList(list) => list.closest_hit_packets(tier, trace, rays, hits),
            Self::Bvh(tree) => tree.closest_hit_packets(tier, trace, rays, hits),
            Self::Objects(objects) => {
                objects.closest_hits(tracing, raster, rays, hits);
            }
        }
    }

    /// Writes to `hits` the closest hit of every ray of a camera's tiles. The rays are made in `rays`, one packet a
    /// tile.
    pub fn tile_hits(
        &self,
        tracing: Tracing,
        scratch: &mut Scratch,
        tiles: CameraTiles<'_>,
        rays: &mut [RayPacket],
        hits: &mut [HitPacket],
    ) {
        let tier = tracing.tier;
        let (mut trace, raster) = scratch.of(self, tracing);
        let trace = &mut trace;
        match self {
            Self::Brute(spheres) => spheres.closest_hit_tiles(tier, trace, tiles, rays, hits),
            Self::DepthList(list) => list.closest_hit_tiles(tier, trace, tiles, rays, hits),
            Self::Bvh(tree) => tree.closest_hit_tiles(tier, trace, tiles, rays, hits),
            Self::Objects(objects) => {
                tile_rays(tracing.level, tiles, rays);
                objects.closest_hits(tracing, raster, rays, hits);
            }
        }
    }

    /// Writes whether each ray meets anything: lane i in bit i. The rays are not a camera's, so object order searches
    /// all spheres for them.
    pub fn any_hits(
        &self,
        tracing: Tracing,
        scratch: &mut Scratch,
        rays: &[RayPacket],
        occluded: &mut [u32],
    ) {
        let tier = tracing.tier;
        let trace = &mut scratch.of(self, tracing).0;
        match self {
            Self::Brute(spheres) => spheres.any_hit_packets(tier, trace, rays, occluded),
            Self::DepthList(list) => list.any_hit_packets(tier, trace, rays, occluded),
            Self::Bvh(tree) => tree.any_hit_packets(tier, trace, rays, occluded),
            Self::Objects(objects) => {
                objects.spheres().any_hit_packets(tier, trace, rays, occluded);
            }
        }
    }
}
