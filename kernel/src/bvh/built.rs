//! What a build leaves in the memory of a tree.

/// How much of the memory is the tree, and where it begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Built {
    pub(crate) nodes: usize,
    pub(crate) leaves: usize,
    /// Leaves of no node, behind the others.
    pub(crate) outside: usize,
    /// A node, a leaf with [`LEAF`](super::node::LEAF) set, or [`NO_CHILD`](super::node::NO_CHILD).
    pub(crate) root: u32,
    /// No coordinate of a box is larger.
    pub(crate) extent: f32,
}
