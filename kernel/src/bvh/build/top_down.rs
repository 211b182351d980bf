//! From a list of spheres to a tree: top down, straight into nodes of sixteen children.
//!
//! A node is made of the parts of a run (`children.rs`); parts of more than one leaf become nodes in
//! their turn, and a stack of those that wait replaces recursion.
//!
//! The root's children do so apart from each other, perhaps at the same time: each in as many
//! nodes as it can need, which is 8/15 of its leaves (`Bvh::needed`). Then the nodes move together.
//! So the tree does not depend on what runs at the same time.

use super::child_order::order_children;
use super::children::{Part, children};
use super::join::Join;
use crate::bvh::built::Built;
use crate::bvh::node::{BvhLeaf, BvhNode, DEPTH, LEAF, NO_CHILD, WIDTH};
use crate::geometry::sphere::{Sphere, Spheres};
use crate::scale::scene::SceneScale;

/// A run that waits to become node `node`.
#[derive(Clone, Copy)]
struct Waiting {
    part: Part,
    node: usize,
}

/// Builds a tree in memory that is as large as `Bvh::needed` says.
pub(crate) fn build(
    join: &impl Join,
    spheres: &Spheres<'_>,
    nodes: &mut [BvhNode],
    leaves: &mut [BvhLeaf],
) -> Built {
    let scale = SceneScale::of(spheres);
    let inside = fill(leaves, spheres, |sphere| scale.scaled(sphere));
    let full = inside.div_ceil(WIDTH);
    let (leaves, rest) = leaves.split_at_mut(full.min(leaves.len()));
    let outside = fill(rest, spheres, |sphere| {
        (sphere.is_valid() && scale.scaled(sphere).is_none()).then_some(*sphere)
    });
    let outside = outside.div_ceil(WIDTH).min(rest.len());

    let root = Part::new(join, leaves, inside, 0, full);
    let used = if full > 1 { build_tree(join, nodes, leaves, inside, root) } else { 0 };
    let child = match full {
        0 => NO_CHILD,
        1 => LEAF,
        _ => 0,
    };
    for (place, leaf) in leaves.iter_mut().enumerate() {
        sort(leaf, (inside - place * WIDTH).min(WIDTH));
    }
    let mut extent = 0.0_f32;
    if full > 0 {
        for axis in 0..3 {
            extent = extent.max(root.bounds.low[axis].abs()).max(root.bounds.high[axis].abs());
        }
    }
    Built { nodes: used, leaves: leaves.len(), outside, root: child, scale, extent }
}

/// Puts the spheres that are `wanted`, as they are, into leaves, in the order of their indices, and empties the
/// rest of the last; returns their number.
fn fill(
    leaves: &mut [BvhLeaf],
    spheres: &Spheres<'_>,
    wanted: impl Fn(&Sphere) -> Option<Sphere>,
) -> usize {
    let mut count = 0;
    for (index, sphere) in spheres.iter().enumerate() {
        let Some(sphere) = wanted(&sphere) else { continue };
        if let Some(leaf) = leaves.get_mut(count / WIDTH) {
            let lane = count % WIDTH;
            if lane == 0 {
                *leaf = BvhLeaf::EMPTY;
            }
            for axis in 0..3 {
                leaf.center[axis][lane] = sphere.center[axis];
            }
            leaf.radius[lane] = sphere.radius;
            leaf.index[lane] = index as u32;
            count += 1;
        }
    }
    count
}

/// A child of the root, and the memory that becomes its nodes.
#[derive(Default)]
struct Subtree<'a> {
    leaves: &'a mut [BvhLeaf],
    /// Where its leaves begin among all.
    first: usize,
    /// How many spheres are in them.
    count: usize,
    nodes: &'a mut [BvhNode],
    /// How many nodes it took: none for a single leaf.
    used: usize,
}

/// Builds the nodes over all leaves, which are two or more; returns their number.
fn build_tree(
    join: &impl Join,
    nodes: &mut [BvhNode],
    leaves: &mut [BvhLeaf],
    count: usize,
    root: Part,
) -> usize {
    let (mut parts, number) = children(join, leaves, count, root);
    let parts = parts.get_mut(..number).unwrap_or(&mut []);
    // In the order of their leaves, so that memory is handed out from the front.
    for end in 1..parts.len() {
        for at in (1..=end).rev() {
            if let Some([before, part]) = parts.get_mut(at - 1..=at)
                && part.first < before.first
            {
                core::mem::swap(before, part);
            }
        }
    }

    let mut subtrees: [Subtree<'_>; WIDTH] = Default::default();
    let mut free = nodes.get_mut(1..).unwrap_or(&mut []);
    let mut left = leaves;
    for (part, subtree) in parts.iter().zip(&mut subtrees) {
        let (own, others) = left.split_at_mut(part.leaves.min(left.len()));
        let (room, rest) = free.split_at_mut(room_for(part).min(free.len()));
        let count = (count - part.first * WIDTH).min(part.leaves * WIDTH);
        *subtree = Subtree { leaves: own, first: part.first, count, nodes: room, used: 0 };
        (left, free) = (others, rest);
    }
    build_subtrees(join, subtrees.get_mut(..number).unwrap_or(&mut []));
    let used = subtrees.map(|subtree| subtree.used);

    let mut node = node_over(parts, 0);
    let (mut from, mut to) = (1, 1);
    for ((child, part), used) in node.child.iter_mut().zip(&*parts).zip(used) {
        if part.leaves == 1 {
            continue;
        }
        *child = to as u32;
        for place in 0..used {
            let Some(mut moved) = nodes.get(from + place).copied() else { continue };
            for child in moved.child.iter_mut().filter(|child| **child & LEAF == 0) {
                *child += to as u32;
            }
            if let Some(node) = nodes.get_mut(to + place) {
                *node = moved;
            }
        }
        from += room_for(part);
        to += used;
    }
    if let Some(place) = nodes.first_mut() {
        *place = node;
    }
    to
}

/// How many nodes are enough for a child of the root.
fn room_for(part: &Part) -> usize {
    if part.leaves > 1 { part.leaves / 15 * 8 + part.leaves % 15 * 8 / 15 } else { 0 }
}

/// Builds subtrees, which are apart.
fn build_subtrees(join: &impl Join, subtrees: &mut [Subtree<'_>]) {
    if let [subtree] = subtrees {
        if subtree.leaves.len() > 1 {
            subtree.used = build_nodes(join, subtree);
        }
    } else if !subtrees.is_empty() {
        let (some, others) = subtrees.split_at_mut(subtrees.len() / 2);
        join.join(|| build_subtrees(join, some), || build_subtrees(join, others));
    }
}

/// Builds the nodes of a subtree, numbered from zero; returns their number.
fn build_nodes(join: &impl Join, subtree: &mut Subtree<'_>) -> usize {
    let Subtree { leaves, first, count, nodes, .. } = subtree;
    let root = Part::new(join, leaves, *count, 0, leaves.len());
    // Each level leaves at most fifteen waiting for the one that goes on.
    let mut waiting = [Waiting { part: root, node: 0 }; (WIDTH - 1) * DEPTH + WIDTH];
    let (mut top, mut used) = (1, 1);
    while top > 0 {
        top -= 1;
        let Some(&Waiting { part, node }) = waiting.get(top) else { break };
        let (children, number) = children(join, leaves, *count, part);
        let children = children.get(..number).unwrap_or(&[]);
        let mut built = node_over(children, *first);
        for (slot, child) in built.child.iter_mut().zip(children) {
            if child.leaves > 1
                && let Some(place) = waiting.get_mut(top)
            {
                *slot = used as u32;
                *place = Waiting { part: *child, node: used };
                (top, used) = (top + 1, used + 1);
            }
        }
        if let Some(place) = nodes.get_mut(node) {
            *place = built;
        }
    }
    used
}

/// A node with the boxes of its children; leaves get their names, with `first` added.
fn node_over(children: &[Part], first: usize) -> BvhNode {
    let mut node = BvhNode::EMPTY;
    for (slot, child) in children.iter().enumerate().take(WIDTH) {
        let [low, high] = child.bounds.padded();
        for axis in 0..3 {
            node.low[axis][slot] = low[axis];
            node.high[axis][slot] = high[axis];
        }
        if child.leaves == 1 {
            node.child[slot] = (first + child.first) as u32 | LEAF;
        }
    }
    order_children(&mut node);
    node
}

/// Puts the first `count` spheres of a leaf into the order of their indices.
fn sort(leaf: &mut BvhLeaf, count: usize) {
    let mut order = [u64::MAX; WIDTH];
    for (lane, key) in order.iter_mut().enumerate().take(count) {
        *key = u64::from(leaf.index[lane]) << 32 | lane as u64;
    }
    order.sort_unstable();
    let unsorted = *leaf;
    for (lane, key) in order.iter().enumerate().take(count) {
        let from = *key as usize % WIDTH;
        for axis in 0..3 {
            leaf.center[axis][lane] = unsorted.center[axis][from];
        }
        leaf.radius[lane] = unsorted.radius[from];
        leaf.index[lane] = unsorted.index[from];
    }
}
