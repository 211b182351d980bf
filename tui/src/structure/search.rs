//! A scene structure that is chosen at run time.

use super::object_order::{ObjectOrder, Raster};
pub use super::tracing::Tracing;
use crate::threads::Threads;
use spherule_kernel::{
    Bvh, CameraTiles, DepthList, HitPacket, Intersect, RayPacket, Spheres, Trace, tile_rays,
};
use std::ops::Range;

/// The tests of brute force between two questions whether anyone still waits: 16 to 90 ms, by the CPU's level.
const TESTS: usize = 1 << 27;
/// The fewest packets of a part: the spheres are prepared for each part, which takes as long as a packet.
const FEWEST: usize = 8;

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
    /// Parts of so many packets, to be traced one after the other, until `threads` are stopped. Only brute force over many
    /// spheres takes so long that it has more than one; its answers do not depend on what is traced together.
    pub fn parts<'t>(
        &self,
        packets: usize,
        threads: &'t Threads,
    ) -> impl Iterator<Item = Range<usize>> + use<'t> {
        let at_once = match self {
            Self::Brute(spheres) => (TESTS / RayPacket::COUNT / spheres.len().max(1)).max(FEWEST),
            Self::DepthList(_) | Self::Bvh(_) | Self::Objects(_) => packets.max(1),
        };
        (0..packets)
            .step_by(at_once)
            .map(move |from| from..packets.min(from + at_once))
            .take_while(move |_| !threads.are_stopped())
    }

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

    /// Writes to `hits` the closest hit of every ray of a camera's tiles, [part](Self::parts) after part. The rays are made
    /// in `rays`, one packet a tile.
    pub fn tile_hits(
        &self,
        tracing: Tracing,
        (scratch, threads): (&mut Scratch, &Threads),
        tiles: CameraTiles<'_>,
        rays: &mut [RayPacket],
        hits: &mut [HitPacket],
    ) {
        let tier = tracing.tier;
        let count = rays.len().min(hits.len()).min(tiles.corners.len());
        for part in self.parts(count, threads) {
            let tiles = CameraTiles { corners: &tiles.corners[part.clone()], ..tiles };
            let (rays, hits) = (&mut rays[part.clone()], &mut hits[part]);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::View;
    use spherule_kernel::{Camera, Coherence, Level, SphereList, SphereTree, Tier};

    #[test]
    fn brute_force_over_many_spheres_has_parts_until_it_is_stopped() {
        let threads = Threads::default();
        let parts = |search: &Search<'_>| search.parts(150, &threads).collect::<Vec<_>>();
        let list = SphereList::from(vec![[0.0_f32, 0.0, 0.0, 1.0]; 1 << 17]);
        let many = Search::Brute(list.spheres());
        assert_eq!(parts(&many), [0..64, 64..128, 128..150]);
        let tree = SphereTree::new([[0.0, 0.0, 0.0, 1.0]]);
        for search in [Search::Brute(tree.list().spheres()), Search::Bvh(tree.bvh())] {
            assert!(search.parts(150, &threads).eq(std::iter::once(0..150)));
            assert_eq!(search.parts(0, &threads).count(), 0);
        }
        let mut halves = many.parts(150, &threads);
        assert_eq!(halves.next(), Some(0..64));
        threads.stop();
        assert_eq!(halves.next(), None);
        assert!(parts(&many).is_empty());
    }

    /// Parts as small as there are, against all packets at once.
    #[test]
    fn what_is_traced_together_changes_no_answer_of_brute_force() {
        let spheres = (0..300_u16).map(|index| {
            let [x, y] = [index % 20, index / 20].map(|at| f32::from(at) * 0.25 - 2.0);
            [x, y, x * y, 0.2]
        });
        let list = SphereList::from(spheres.collect::<Vec<_>>());
        let (size, search) = ((64, 48), Search::Brute(list.spheres()));
        let camera = View::FRONT.camera(size.0, size.1, 4.0 / 3.0);
        let corners: Vec<_> = Camera::tile_corners::<[f32; 16]>(size.0, size.1).collect();
        let threads = Threads::default();
        for tier in Tier::ALL {
            let traced = |at_once: usize| {
                let (level, coherence) = (Level::best(), Coherence::Coherent);
                let (tracing, mut scratch) =
                    (Tracing { tier, level, coherence }, Scratch::default());
                let mut rays = vec![RayPacket::inactive(); corners.len()];
                let mut hits = vec![HitPacket::none(); corners.len()];
                let parts = rays.chunks_mut(at_once).zip(hits.chunks_mut(at_once));
                for (corners, (rays, hits)) in corners.chunks(at_once).zip(parts) {
                    let tiles = CameraTiles { camera, size, corners };
                    search.tile_hits(tracing, (&mut scratch, &threads), tiles, rays, hits);
                }
                hits.iter().flat_map(HitPacket::hits).collect::<Vec<_>>()
            };
            let whole = traced(corners.len());
            assert!(whole.iter().flatten().count() > 500, "{tier:?}");
            assert!(traced(FEWEST) == whole, "{tier:?}");
        }
    }

    #[test]
    fn tiles_for_which_there_are_no_hits_are_left_alone() {
        let list = SphereList::from([[0.0, 0.0, 0.0, 1.0]]);
        let (size, search) = ((16, 16), Search::Brute(list.spheres()));
        let camera = View::FRONT.camera(size.0, size.1, 1.0);
        let corners: Vec<_> = Camera::tile_corners::<[f32; 16]>(size.0, size.1).collect();
        let tiles = CameraTiles { camera, size, corners: &corners };
        let (level, coherence) = (Level::best(), Coherence::Coherent);
        let tracing = Tracing { tier: Tier::Exact, level, coherence };
        let mut rays = vec![RayPacket::inactive(); corners.len() + 3];
        let mut hits = vec![HitPacket::none(); corners.len() - 1];
        let scratch = (&mut Scratch::default(), &Threads::default());
        search.tile_hits(tracing, scratch, tiles, &mut rays, &mut hits);
        assert!(hits.iter().flat_map(HitPacket::hits).flatten().count() > 20);
        let last = rays.get(hits.len()).expect("one without hits");
        assert_eq!(*last, RayPacket::inactive());
    }
}
