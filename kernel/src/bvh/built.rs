//! What a build leaves in the memory of a tree.

use crate::scale::scene::SceneScale;

/// How much of the memory is the tree, and where it begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Built {
    pub(crate) nodes: usize,
    /// How many numbers there are before the leaves.
    pub(crate) shift: usize,
    /// Of the leaves.
    pub(crate) places: usize,
    /// Spheres of no leaf, whose indices are behind those of the leaves.
    pub(crate) outside: usize,
    /// A node, a leaf with [`LEAF`](super::node::LEAF) set, or [`NO_CHILD`](super::node::NO_CHILD).
    pub(crate) root: u32,
    /// How bounds see lengths.
    pub(crate) scale: SceneScale,
    /// No coordinate of a box is larger, as bounds see it.
    pub(crate) extent: f32,
}
