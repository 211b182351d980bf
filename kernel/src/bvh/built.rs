//! What a build leaves in the memory of a tree.

use super::boxes_per_ray::BoxesPerRay;
use super::leaf::BEHIND;
use crate::scale::scene::SceneScale;

/// How much of the memory is the tree, and where it begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Built {
    pub(crate) nodes: usize,
    /// How many numbers there are before the leaves.
    pub(crate) shift: usize,
    /// How many places the leaves have.
    pub(crate) places: usize,
    /// Valid spheres of no leaf, whose indices are behind those of the leaves.
    pub(crate) outside: usize,
    /// Spheres that have no lane in a leaf: `unplaced.rs`.
    pub(crate) unplaced: usize,
    /// A node, a leaf with [`LEAF`](super::node::LEAF) set, or [`NO_CHILD`](super::node::NO_CHILD).
    pub(crate) root: u32,
    /// How bounds see lengths.
    pub(crate) scale: SceneScale,
    /// No coordinate of a box is larger than this, as bounds see it.
    pub(crate) extent: f32,
    /// How many boxes a ray is expected to enter.
    pub(crate) boxes_per_ray: BoxesPerRay,
    /// What a ray was expected to cost when the tree was built.
    pub(crate) cost_when_built: f32,
}

impl Built {
    /// How many numbers, from the first leaf on, are leaves and what is loaded behind the last; the table of
    /// `unplaced.rs` comes after them.
    pub(crate) const fn leaves(&self) -> usize {
        4 * (self.places + BEHIND)
    }
}
