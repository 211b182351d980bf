//! Nodes, as they lie in memory.

pub(crate) use crate::lanes::WIDTH;

/// How many nodes lie one below the other at most.
pub(crate) const DEPTH: usize = 10;
/// How many frames there are for the nodes on a ray's way: so many that a mask can stand for a bounds check.
pub(crate) const FRAMES: usize = 16;
const _: () = assert!(FRAMES > DEPTH);
/// A child that is not there. No leaf has that number, since a leaf's number has three zero bits.
pub(crate) const NO_CHILD: u32 = u32::MAX;
/// Set where a child is a leaf; the other bits are its place among nodes, or what [`leaf_at`](super::leaf::leaf_at)
/// says.
pub(crate) const LEAF: u32 = 1 << 31;

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

    /// Sets the lower and the upper corner of a child's box.
    #[inline(always)]
    pub(super) fn set_box(&mut self, slot: usize, [low, high]: [[f32; 3]; 2]) {
        for axis in 0..3 {
            self.low[axis][slot % WIDTH] = low[axis];
            self.high[axis][slot % WIDTH] = high[axis];
        }
    }
}

/// The number of an octant: bit i is set where directions run down along axis i.
#[inline(always)]
pub(crate) fn octant_of(down: [bool; 3]) -> u32 {
    u32::from(down[0]) | u32::from(down[1]) << 1 | u32::from(down[2]) << 2
}

/// A tree of at most so many spheres has full leaves: a small tree, traversed without boxes
/// (`traverse/small_tree.rs`).
pub(crate) const SMALL_TREE: usize = 64;
