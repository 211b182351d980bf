//! The tree that owns its memory.

use super::build::join::{InTurn, Join};
use super::build::top_down;
use super::built::Built;
use super::node::{BvhLeaf, BvhNode};
use super::tree::Bvh;
use crate::geometry::sphere_list::SphereList;
use alloc::collections::TryReserveError;
use alloc::vec::Vec;

/// A tree over spheres that owns both: the owned form of [`Bvh`]. 54 bytes a sphere at most, of which 16
/// are the list.
///
/// ```
/// use spherule_kernel::{Exact, Intersect, Ray, SphereTree, Vec3};
///
/// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
/// let hit = tree.closest_hit(Exact, &Ray::new(Vec3::ZERO, Vec3::Z));
/// assert_eq!(hit.map(|hit| (hit.t, hit.sphere)), Some((4.0, 0)));
/// ```
#[derive(Clone, Debug)]
pub struct SphereTree {
    spheres: SphereList,
    nodes: Vec<BvhNode>,
    leaves: Vec<BvhLeaf>,
    built: Built,
}

impl SphereTree {
    /// Builds a tree over anything that becomes a [`SphereList`], on this thread.
    ///
    /// Cost: as [`Bvh::build`]. Aborts, as `Vec` does, if there is no memory.
    #[must_use]
    pub fn new(spheres: impl Into<SphereList>) -> Self {
        let spheres = spheres.into();
        let (nodes, leaves) = memory(&spheres);
        Self::in_memory(&InTurn, spheres, nodes, leaves)
    }

    /// Builds a tree with several pieces of work at once, on threads of the caller's: the same tree.
    ///
    /// # Errors
    /// `TryReserveError` if there is no memory.
    pub fn build_with(join: &impl Join, spheres: SphereList) -> Result<Self, TryReserveError> {
        let needed = Bvh::needed(spheres.spheres().len());
        let (mut nodes, mut leaves) = (Vec::new(), Vec::new());
        nodes.try_reserve_exact(needed.nodes)?;
        leaves.try_reserve_exact(needed.leaves)?;
        nodes.resize(needed.nodes, BvhNode::EMPTY);
        leaves.resize(needed.leaves, BvhLeaf::EMPTY);
        Ok(Self::in_memory(join, spheres, nodes, leaves))
    }

    /// The memory is as large as needed.
    fn in_memory(
        join: &impl Join,
        spheres: SphereList,
        mut nodes: Vec<BvhNode>,
        mut leaves: Vec<BvhLeaf>,
    ) -> Self {
        let built = top_down::build(join, &spheres.spheres(), &mut nodes, &mut leaves);
        Self { spheres, nodes, leaves, built }
    }

    /// The tree, borrowed: a few words.
    #[must_use]
    pub fn bvh(&self) -> Bvh<'_> {
        Bvh::of(self.built, self.spheres.spheres(), &self.nodes, &self.leaves)
    }

    /// The list that the tree was built from.
    #[must_use]
    pub const fn list(&self) -> &SphereList {
        &self.spheres
    }
}

fn memory(spheres: &SphereList) -> (Vec<BvhNode>, Vec<BvhLeaf>) {
    let needed = Bvh::needed(spheres.spheres().len());
    let nodes = core::iter::repeat_n(BvhNode::EMPTY, needed.nodes).collect();
    let leaves = core::iter::repeat_n(BvhLeaf::EMPTY, needed.leaves).collect();
    (nodes, leaves)
}
