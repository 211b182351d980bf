//! A tree of boxes over many spheres, sixteen children a node, in memory that the caller provides.
//!
//! # Method
//!
//! Sphere i is in the box c -+ r, rounded outward. A node holds the boxes of up to sixteen
//! children, coordinate by coordinate, so that one ray is tested against all of them at once; a leaf
//! holds up to sixteen spheres in the same way. The [build](Bvh::build) goes from the root down by
//! the surface area heuristic (Wald 2007: sixteen bins an axis), and cuts at multiples of sixteen
//! spheres only: then every leaf but the last is full, and the memory needed is known before.
//! [`nearest`] and [`any`] walk the tree ray by ray, which is the way for rays that have nothing in
//! common (and look at every leaf, where there are four at most); [`nearest_coherent`] and
//! [`any_coherent`] let packets that look the same way go down together, which is the way for the
//! rays of a camera and of shadows.
//!
//! # What is guaranteed
//!
//! Bit for bit what the functions of the same names outside this module return: by
//! [`Exact`](crate::Exact) for every input, by [`Stable`](crate::Stable) in its domain, by
//! [`Fast`](crate::Fast) but for hits that the textbook form finds on lines that pass a sphere's
//! box by. Boxes and filters only decide what is skipped, under bounds proven in `bvh/approach.rs`,
//! `bvh/slabs.rs`, `bvh/bracket.rs` and `bvh/frustum.rs`; every t is a tier's. What the bounds do
//! not cover is not skipped: spheres with a coordinate or radius above 2^40 are kept apart and tested
//! by every ray; rays that start beyond 2^40, or whose squared length lies outside [2^-100,
//! 2^100], are tested against all spheres.
//!
//! # Depth
//!
//! A node over m leaves gives none of its children more than m/8 of them, rounded up, or 16, whatever
//! the heuristic prefers (`bvh/parts.rs`). There are at most 2^28 leaves, and a node over at most
//! sixteen has only leaves for children: nodes stand nine deep at most, for 2^28, 2^25, ..
//! 2^4 leaves.

mod answers;
mod approach;
mod bins;
mod bounds;
mod bracket;
mod build;
mod bundle;
mod candidates;
mod course;
mod few;
mod frustum;
mod join;
mod member;
mod octants;
mod order;
mod parts;
mod ray_walk;
pub(crate) mod resolve;
mod round;
pub(crate) mod slabs;
mod split;
mod stack;
mod touch;
mod under_way;
mod walk;

pub use bundle::{any_coherent, nearest_coherent};
pub use join::{InTurn, Join};
pub use walk::{any, nearest};

use crate::Spheres;
use core::fmt;

/// Children a node, spheres a leaf.
pub(crate) const WIDTH: usize = 16;
/// How many nodes lie one below the other at most.
pub(crate) const DEPTH: usize = 9;
/// A child that is not there. No leaf has that number: there are fewer than 2^29.
pub(crate) const NO_CHILD: u32 = u32::MAX;
/// Set where a child is a leaf; the other bits are its place among nodes or leaves.
pub(crate) const LEAF: u32 = 1 << 31;
/// 2^40: spheres with a coordinate or radius above are kept outside of the tree.
pub(crate) const LARGEST: f32 = 1_099_511_627_776.0;

/// The boxes of up to sixteen children, where they are, and in which order rays meet them. 512 bytes.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct BvhNode {
    /// The lower corners, an array an axis; `+inf` where there is no child.
    pub(crate) low: [[f32; WIDTH]; 3],
    /// The upper corners; `-inf` where there is no child.
    pub(crate) high: [[f32; WIDTH]; 3],
    /// A node, or a leaf with [`LEAF`] set, or [`NO_CHILD`].
    pub(crate) child: [u32; WIDTH],
    /// For each octant of directions the slots from the farthest child to the nearest, four bits
    /// each; bit i of an octant's number is set where directions run down along axis i.
    pub(crate) order: [u64; 8],
}

impl BvhNode {
    /// A node without children: what memory for a tree is filled with.
    pub const EMPTY: Self = Self {
        low: [[f32::INFINITY; WIDTH]; 3],
        high: [[f32::NEG_INFINITY; WIDTH]; 3],
        child: [NO_CHILD; WIDTH],
        order: [0; 8],
    };
}

/// Up to sixteen spheres, in the order of their indices. 320 bytes.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct BvhLeaf {
    pub(crate) center: [[f32; WIDTH]; 3],
    /// NaN where there is no sphere: no comparison with it is true.
    pub(crate) radius: [f32; WIDTH],
    /// The index in the list of spheres.
    pub(crate) index: [u32; WIDTH],
}

impl BvhLeaf {
    /// A leaf without spheres: what memory for a tree is filled with.
    pub const EMPTY: Self =
        Self { center: [[0.0; WIDTH]; 3], radius: [f32::NAN; WIDTH], index: [u32::MAX; WIDTH] };
}

/// How much memory a tree takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BvhSize {
    /// Nodes, of 512 bytes.
    pub nodes: usize,
    /// Leaves, of 320 bytes.
    pub leaves: usize,
}

/// The memory for a tree was too small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooSmall {
    /// What [`Bvh::needed`] says.
    pub needed: BvhSize,
}

impl fmt::Display for TooSmall {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let BvhSize { nodes, leaves } = self.needed;
        write!(formatter, "the tree needs memory for {nodes} nodes and {leaves} leaves")
    }
}

impl core::error::Error for TooSmall {}

/// A tree over a list of spheres, for [`nearest`] and its companions.
///
/// It holds copies of the spheres. Walked with another list than it was built from, it is memory
/// safe and does not panic: with one of another length it is not used at all (every ray is tested
/// against all spheres given); with one of the same length the answers are those of the list that
/// it was built from, but for rays that the bounds do not cover, which meet the list given.
#[derive(Clone, Copy, Debug)]
pub struct Bvh<'a> {
    pub(crate) nodes: &'a [BvhNode],
    /// Those of the tree, in its order.
    pub(crate) leaves: &'a [BvhLeaf],
    /// Leaves of no node: spheres above 2^40, which every ray must be tested against.
    pub(crate) outside: &'a [BvhLeaf],
    /// A node, a leaf with [`LEAF`] set, or [`NO_CHILD`].
    pub(crate) root: u32,
    /// No coordinate of a box is larger.
    pub(crate) extent: f32,
    /// The length of the list.
    pub(crate) count: usize,
}

impl<'a> Bvh<'a> {
    /// The memory that any list of `count` spheres needs.
    ///
    /// All leaves but one are full, and one more keeps the spheres above 2^40: count/16, rounded
    /// up, and one. Of the nodes over m leaves let J have sixteen children, and K have leaves for all
    /// of their children, at least two. Each node but the root and each leaf is a child: 16 J +
    /// (leaves below the K) = J + K - 1 + m, so 15 J + 2 K <= K - 1 + m, and 2 K <= m: J + K is at most
    /// m/2 + m/30 = 8 m/15. Other nodes (`bvh/parts.rs`) need less: with c < 16 children, k of them nodes
    /// over leaves only, such a node has no room for the leaves of any, so each has 18 - c at least:
    /// 1 + k nodes over c - k + k (18 - c) leaves are at most 16/45 a leaf. Together 38 bytes a sphere
    /// at most, and 832 bytes.
    #[must_use]
    pub const fn needed(count: usize) -> BvhSize {
        let full = count.div_ceil(WIDTH);
        // In the order that cannot overflow.
        BvhSize { nodes: full / 15 * 8 + full % 15 * 8 / 15 + 1, leaves: full + 1 }
    }

    /// Builds a tree over `spheres` in the memory given, whose contents do not matter.
    ///
    /// Spheres that are not valid are left out. The same list gives the same tree on every target.
    ///
    /// Cost: a cut looks at each of its spheres a bounded number of times, and a node makes fifteen
    /// cuts at most of runs that its children are eight times shorter than; so time grows by the
    /// number of spheres times its logarithm, whatever the spheres. Stack: some 20 KiB. No other
    /// memory.
    ///
    /// # Errors
    /// [`TooSmall`], with what is needed, where either slice is shorter than [`Bvh::needed`] says;
    /// longer is no error, and the rest is left alone.
    pub fn build(
        spheres: Spheres<'_>,
        nodes: &'a mut [BvhNode],
        leaves: &'a mut [BvhLeaf],
    ) -> Result<Self, TooSmall> {
        Self::build_with(&InTurn, spheres, nodes, leaves)
    }

    /// [`Bvh::build`] with several pieces of work at once, on threads of the caller's: the same tree.
    ///
    /// Cost: with two threads some 0.7 of the time for a million spheres.
    ///
    /// # Errors
    /// As [`Bvh::build`].
    pub fn build_with(
        join: &impl Join,
        spheres: Spheres<'_>,
        nodes: &'a mut [BvhNode],
        leaves: &'a mut [BvhLeaf],
    ) -> Result<Self, TooSmall> {
        let needed = Self::needed(spheres.len());
        if nodes.len() < needed.nodes || leaves.len() < needed.leaves {
            return Err(TooSmall { needed });
        }
        Ok(build::build(join, spheres, nodes, leaves))
    }

    /// The memory that the tree takes: at most what was needed.
    #[must_use]
    pub const fn size(&self) -> BvhSize {
        BvhSize { nodes: self.nodes.len(), leaves: self.leaves.len() + self.outside.len() }
    }

    /// How many nodes lie one below the other: 0 for up to sixteen spheres, at most 9.
    #[must_use]
    pub fn depth(&self) -> usize {
        // Children come after their parents, so one pass from the back would need memory;
        // a stack of the nodes on the way needs little.
        let mut pending = [(NO_CHILD, 0); WIDTH * (DEPTH + 1)];
        let (mut top, mut depth) = (1, 0);
        pending[0] = (self.root, 1);
        while top > 0 {
            top -= 1;
            let Some(&(child, level)) = pending.get(top) else { break };
            let Some(node) = self.nodes.get(child as usize) else { continue };
            depth = depth.max(level);
            for &child in node.child.iter().filter(|&&child| child & LEAF == 0) {
                if let Some(place) = pending.get_mut(top) {
                    *place = (child, level + 1);
                    top += 1;
                }
            }
        }
        depth
    }
}
