//! A structure that is ready to be searched.

use super::{RaysKind, Structure};
use spherule_kernel::dispatch::{self, Level, Packet};
use spherule_kernel::{Accuracy, Bvh, DepthOrder, HitPacket, RayPacket, Spheres};

/// Spheres, and how rays find them. Threads may share it.
#[derive(Clone, Copy, Debug)]
pub struct Search<'a> {
    spheres: Spheres<'a>,
    index: Index<'a>,
}

/// What leads to the spheres.
#[derive(Clone, Copy, Debug)]
enum Index<'a> {
    None,
    Order(DepthOrder<'a>),
    Tree(Bvh<'a>),
}

/// The lists of tiles that one thread is at work on.
#[derive(Clone, Debug, Default)]
pub struct TileLists(Vec<u32>);

impl TileLists {
    /// As long as they can become for so many spheres; shorter where there is no memory, which
    /// takes longer.
    fn of(&mut self, spheres: usize) -> &mut [u32] {
        let missing = DepthOrder::lists(spheres).saturating_sub(self.0.len());
        if self.0.try_reserve_exact(missing).is_ok() {
            self.0.resize(self.0.len() + missing, 0);
        }
        &mut self.0
    }
}

impl<'a> Search<'a> {
    /// From end to end.
    #[must_use]
    pub fn brute(spheres: Spheres<'a>) -> Self {
        Self { spheres, index: Index::None }
    }

    /// By the order of these spheres, for rays of its viewpoint.
    pub(super) fn tiles(spheres: Spheres<'a>, order: DepthOrder<'a>) -> Self {
        Self { spheres, index: Index::Order(order) }
    }

    /// By the tree that was built over these spheres.
    pub(super) fn tree(spheres: Spheres<'a>, tree: Bvh<'a>) -> Self {
        Self { spheres, index: Index::Tree(tree) }
    }

    /// What is searched.
    #[must_use]
    pub fn structure(&self) -> Structure {
        match self.index {
            Index::None => Structure::Brute,
            Index::Order(_) => Structure::Tiles,
            Index::Tree(_) => Structure::Bvh,
        }
    }

    /// The nearest hit of every ray, as [`spherule_kernel::nearest`] finds it.
    pub fn nearest<A: Accuracy>(
        &self,
        level: Level,
        kind: RaysKind,
        rays: &[RayPacket<Packet>],
        lists: &mut TileLists,
        hits: &mut [HitPacket<Packet>],
    ) {
        let Self { spheres, index } = *self;
        match (index, kind) {
            (Index::None, _) => dispatch::nearest::<A>(level, rays, spheres, hits),
            (Index::Order(order), _) => {
                let lists = lists.of(spheres.len());
                dispatch::tiles::nearest::<A>(level, rays, spheres, &order, lists, hits);
            }
            (Index::Tree(tree), RaysKind::Coherent) => {
                dispatch::bvh::nearest_coherent::<A>(level, rays, spheres, &tree, hits);
            }
            (Index::Tree(tree), RaysKind::Incoherent) => {
                dispatch::bvh::nearest::<A>(level, rays, spheres, &tree, hits);
            }
        }
    }

    /// Whether every ray meets anything, as [`spherule_kernel::any`] finds it.
    pub fn any<A: Accuracy>(
        &self,
        level: Level,
        kind: RaysKind,
        rays: &[RayPacket<Packet>],
        lists: &mut TileLists,
        met: &mut [u32],
    ) {
        let Self { spheres, index } = *self;
        match (index, kind) {
            (Index::None, _) => dispatch::any::<A>(level, rays, spheres, met),
            (Index::Order(order), _) => {
                let lists = lists.of(spheres.len());
                dispatch::tiles::any::<A>(level, rays, spheres, &order, lists, met);
            }
            (Index::Tree(tree), RaysKind::Coherent) => {
                dispatch::bvh::any_coherent::<A>(level, rays, spheres, &tree, met);
            }
            (Index::Tree(tree), RaysKind::Incoherent) => {
                dispatch::bvh::any::<A>(level, rays, spheres, &tree, met);
            }
        }
    }
}
