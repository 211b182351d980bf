//! How much memory a tree may take, and what is left of it.
//!
//! A tree that is cut in equal parts, sixteen a node and sixteen spheres a leaf, takes a small and known number of
//! nodes: what a run *needs*. Cuts where the heuristic chooses take more. The memory beyond the need of all runs that
//! wait is there for the first that asks. A cut that cannot be afforded is not made; the node is cut in equal parts
//! then. So the memory is known before, whatever the spheres are.

use crate::bvh::leaf::{BEFORE, BEHIND, MOST_PLACES, STEP};
use crate::bvh::node::WIDTH;

/// How many nodes a run of `count` spheres needs: those of equal parts; none for a leaf.
pub(crate) const fn nodes_needed(count: usize) -> usize {
    let (mut wide, mut nodes) = (count.div_ceil(WIDTH), 0);
    while wide > 1 {
        wide = wide.div_ceil(WIDTH);
        nodes += wide;
    }
    nodes
}

/// How many places a run of `count` spheres needs: those of full leaves.
pub(crate) const fn places_needed(count: usize) -> usize {
    count.next_multiple_of(STEP)
}

/// How many nodes there are beyond the need, to be spent on cuts.
pub(crate) const fn spare_nodes(count: usize) -> usize {
    count / 41
}

/// How many places there are beyond the need, to be spent on leaves that are not full.
pub(crate) const fn spare_places(count: usize) -> usize {
    count / 4
}

/// Nodes and places that are there beyond what is needed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Budget {
    pub(super) nodes: usize,
    pub(super) places: usize,
}

impl Budget {
    /// Pays for a cut of `count` spheres behind the first `first`; `None` if it cannot be paid.
    pub(super) fn cut(self, count: usize, first: usize) -> Option<Self> {
        let rest = count.saturating_sub(first);
        Some(Self {
            nodes: (self.nodes + nodes_needed(count))
                .checked_sub(nodes_needed(first) + nodes_needed(rest))?,
            places: (self.places + places_needed(count))
                .checked_sub(places_needed(first) + places_needed(rest))?,
        })
    }

    /// The share of `count` spheres among `all`.
    pub(super) fn share(self, count: usize, all: usize) -> Self {
        let share = |whole: usize| (whole as u64 * count as u64 / all.max(1) as u64) as usize;
        Self { nodes: share(self.nodes), places: share(self.places) }
    }
}

/// How much memory a tree takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BvhSize {
    /// How many nodes, of 512 bytes each.
    pub nodes: usize,
    /// How many places of spheres, of 16 bytes each, and as many indices, of 4 bytes each.
    pub places: usize,
}

/// The memory that any list of `count` spheres needs.
pub(crate) const fn needed(count: usize) -> BvhSize {
    let places = places_needed(if count < MOST_PLACES { count } else { MOST_PLACES });
    let places = places + spare_places(places) + BEFORE + BEHIND + 1;
    if count > MOST_PLACES / 2 {
        return BvhSize { nodes: usize::MAX, places: usize::MAX };
    }
    BvhSize { nodes: nodes_needed(count) + spare_nodes(count), places }
}
