//! Prefetching, for trees that no cache near the core holds.
//!
//! Rays in flight look into nodes and leaves all over the tree, one after the other, and each node or leaf has
//! several lines of memory. Before they do, one number of every line is read, for all rays: then all lines are on
//! their way at once, and the latency is paid once a round, not once a ray. (Among a million spheres, incoherent rays
//! are 1.2 times as fast for the closest hit, and 1.3 times for any. A prefetch instruction would do the same and
//! need `unsafe`.)
//!
//! A group looks into one node after the other, nearest first. So those of a node's children that it is inside of are
//! prefetched together, before it looks into the first of them.

use super::leaf::extent_of;
use super::node::{BvhNode, LEAF, WIDTH};

/// Trees of more bytes are far from the core, and prefetched: so many its second-level cache holds where that was measured.
/// (With 10,000 spheres, all of which it holds, prefetching took a tenth more time.)
pub(super) const NEAR_BYTES: usize = 1 << 20;

/// A bit pattern that depends on every line of a node.
#[inline(always)]
pub(crate) fn node(node: &BvhNode) -> u32 {
    let mut bits = node.child[0] ^ node.order[0] as u32;
    for axis in 0..3 {
        bits ^= node.low[axis][0].to_bits() ^ node.high[axis][0].to_bits();
    }
    bits
}

/// The same of a leaf, except the indices, which few rays need.
#[inline(always)]
pub(crate) fn leaf(numbers: &[f32], number: u32) -> u32 {
    let (begin, lanes) = extent_of(number);
    let mut bits = 0;
    for line in 0..=lanes / 4 {
        if let Some(number) = numbers.get(4 * begin + 16 * line) {
            bits ^= number.to_bits();
        }
    }
    bits
}

/// The same of the children of a node, those whose bits are set, in a tree of those nodes and leaves.
#[inline(always)]
pub(crate) fn children(
    (nodes, numbers): (&[BvhNode], &[f32]),
    of: &BvhNode,
    mut slots: u32,
) -> u32 {
    let mut bits = 0;
    while slots != 0 {
        let child = of.child[slots.trailing_zeros() as usize % WIDTH];
        slots &= slots - 1;
        if child & LEAF != 0 {
            bits ^= leaf(numbers, child & !LEAF);
        } else if let Some(child) = nodes.get(child as usize) {
            bits ^= node(child);
        }
    }
    bits
}
