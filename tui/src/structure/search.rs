//! A structure that is ready to be searched.

use super::{RaysKind, Structure};
use spherule_kernel::dispatch::{self, Level, Packet};
use spherule_kernel::{Accuracy, Bvh, HitPacket, RayPacket, Spheres};

/// Spheres, and how rays find them. Threads may share it.
#[derive(Clone, Copy, Debug)]
pub struct Search<'a> {
    spheres: Spheres<'a>,
    tree: Option<Bvh<'a>>,
}

impl<'a> Search<'a> {
    /// From end to end.
    #[must_use]
    pub fn brute(spheres: Spheres<'a>) -> Self {
        Self { spheres, tree: None }
    }

    /// By the tree that was built over these spheres.
    pub(super) fn tree(spheres: Spheres<'a>, tree: Bvh<'a>) -> Self {
        Self { spheres, tree: Some(tree) }
    }

    /// What is searched.
    #[must_use]
    pub fn structure(&self) -> Structure {
        if self.tree.is_some() { Structure::Bvh } else { Structure::Brute }
    }

    /// The nearest hit of every ray, as [`spherule_kernel::nearest`] finds it.
    pub fn nearest<A: Accuracy>(
        &self,
        level: Level,
        kind: RaysKind,
        rays: &[RayPacket<Packet>],
        hits: &mut [HitPacket<Packet>],
    ) {
        let Self { spheres, tree } = *self;
        match (tree, kind) {
            (None, _) => dispatch::nearest::<A>(level, rays, spheres, hits),
            (Some(tree), RaysKind::Coherent) => {
                dispatch::bvh::nearest_coherent::<A>(level, rays, spheres, &tree, hits);
            }
            (Some(tree), RaysKind::Incoherent) => {
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
        met: &mut [u32],
    ) {
        let Self { spheres, tree } = *self;
        match (tree, kind) {
            (None, _) => dispatch::any::<A>(level, rays, spheres, met),
            (Some(tree), RaysKind::Coherent) => {
                dispatch::bvh::any_coherent::<A>(level, rays, spheres, &tree, met);
            }
            (Some(tree), RaysKind::Incoherent) => {
                dispatch::bvh::any::<A>(level, rays, spheres, &tree, met);
            }
        }
    }
}
