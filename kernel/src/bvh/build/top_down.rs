//! From a list of spheres to a tree: top down, straight into nodes of sixteen children.
//!
//! The spheres are moved into the order of the leaves, at the end of their memory. A node is made of the parts of a
//! run (`children.rs`); parts that are no leaf become nodes in their turn, and a stack of those that wait replaces
//! recursion. At last the leaves are laid down (`lay_down.rs`), and the children of every node ordered (`child_order.rs`).
//!
//! The root's children become subtrees apart from each other, perhaps at the same time, each in as many nodes as it may
//! take (`budget.rs`). Then the nodes are moved together. So the tree does not depend on what runs at the same time.

use super::budget::{Budget, needed, nodes_needed};
use super::child_order::order_children;
use super::children::{Children, Part, children, in_equal_parts};
use super::join::Join;
use super::lay_down::{lay_down, unsettled};
use super::run::Run;
use crate::bvh::boxes_per_ray::inverse_of_body;
use crate::bvh::built::Built;
use crate::bvh::leaf::{BEFORE, BEHIND, STEP};
use crate::bvh::node::{BvhNode, DEPTH, LEAF, NO_CHILD, SMALL_TREE, WIDTH};
use crate::bvh::unplaced::Unplaced;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::scale::scene::SceneScale;

/// Bytes of a line of the cache.
const LINE: usize = 64;

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
    places: &mut [[f32; 4]],
    indices: &mut [u32],
) -> Built {
    let scale = SceneScale::of(spheres);
    // What is beyond the need is left alone, and changes no tree.
    let needed = needed(spheres.len());
    let all = needed.places.min(places.len()).min(indices.len());
    let (places, indices) =
        (places.get_mut(..all).unwrap_or_default(), indices.get_mut(..all).unwrap_or_default());
    let most = needed.nodes.min(nodes.len());
    let nodes = nodes.get_mut(..most).unwrap_or_default();
    let first = fill(places, indices, spheres, &scale);
    let inside = places.len() - first;
    let mut run = Run { spheres: places, indices };
    let mut run = run.part(first, inside);

    let root = Part::new(join, run.spheres, 0, inside);
    let (mut used, mut child) = (0, NO_CHILD);
    if inside > 0 && root.is_leaf() {
        child = settle(&mut run, &root, 0);
    } else if inside > 0 {
        let budget = Budget {
            nodes: nodes.len().saturating_sub(nodes_needed(inside)),
            // Spheres that are not inside take room behind the leaves.
            places: (first + inside).saturating_sub(spheres.len() + BEFORE + BEHIND + STEP),
        };
        used = build_tree(join, nodes, &mut run, root, budget);
        child = 0;
    }
    let nodes = nodes.get_mut(..used).unwrap_or_default();
    // Where a line of the cache begins: at least as near as numbers are to each other.
    let shift = places.as_flattened().as_ptr().align_offset(LINE) % (LINE / size_of::<f32>());
    let (used_places, dropped) = lay_down((places, shift), indices, first, nodes, &mut child);
    let inverse = inverse_of_body(spheres, &scale);
    let numbers = places.as_flattened().get(shift..).unwrap_or_default();
    let boxes_per_ray = order_children::<true>(join, nodes, numbers, inverse);
    let boxes_per_ray = boxes_per_ray.of_root(child);
    let all = places.len();
    let mut built = Built {
        nodes: used,
        shift,
        places: used_places,
        outside: 0,
        unplaced: dropped.count,
        root: child,
        scale,
        extent: 0.0,
        boxes_per_ray,
        cost_when_built: 1.0,
    };
    dropped.collect(places.as_flattened_mut(), all, shift + built.leaves());
    // The numbers behind the last leaf are loaded with it, and never used: zeros, so that trees of a list are equal.
    let behind = shift + 4 * used_places;
    if let Some(behind) = places.as_flattened_mut().get_mut(behind..behind + 4 * BEHIND) {
        behind.fill(0.0);
    }

    if inside < spheres.len() {
        leave_out(&mut built, places, indices, spheres);
    }
    if inside > 0 {
        built.extent = extent_of([root.bounds.low, root.bounds.high]);
    }
    built.cost_when_built = built.boxes_per_ray.cost(built.outside);
    built
}

/// The largest magnitude of a coordinate of a box.
pub(super) fn extent_of(corners: [[f32; 3]; 2]) -> f32 {
    corners.as_flattened().iter().fold(0.0, |extent, coordinate| coordinate.abs().max(extent))
}

/// Writes the indices of the spheres that bounds do not see behind the leaves.
fn leave_out(
    built: &mut Built,
    places: &mut [[f32; 4]],
    indices: &mut [u32],
    spheres: &Spheres<'_>,
) {
    let table = places.as_flattened_mut().get_mut(built.shift + built.leaves()..);
    let table = table.unwrap_or_default().as_chunks_mut().0;
    for (index, sphere) in spheres.iter().enumerate() {
        if built.scale.scaled(&sphere).is_some() {
            continue;
        }
        let index = index as u32;
        if let Some(place) = table.get_mut(built.unplaced) {
            *place = Unplaced { index, same: index }.bits();
            built.unplaced += 1;
        }
        if sphere.is_valid()
            && let Some(place) = indices.get_mut(built.places + built.outside)
        {
            *place = index;
            built.outside += 1;
        }
    }
}

/// Puts the spheres that bounds see to the end of the memory, in the order of their indices; returns where they
/// begin.
fn fill(
    places: &mut [[f32; 4]],
    indices: &mut [u32],
    spheres: &Spheres<'_>,
    scale: &SceneScale,
) -> usize {
    let mut first = places.len();
    for index in (0..spheres.len()).rev() {
        let Some(sphere) = spheres.get(index) else { continue };
        if let Some(Sphere { center, radius }) = scale.scaled(&sphere)
            && let (Some(place), Some(number)) =
                (places.get_mut(first.wrapping_sub(1)), indices.get_mut(first.wrapping_sub(1)))
        {
            (*place, *number) = ([center.x, center.y, center.z, radius], index as u32);
            first -= 1;
        }
    }
    first
}

/// A leaf before it is laid down: where its spheres are, and how many. Of more than sixteen, which are all the same, it
/// has sixteen, among them the one with the lowest index.
fn settle(run: &mut Run<'_>, part: &Part, first: usize) -> u32 {
    let mut count = part.count;
    if count > WIDTH {
        let own = run.part(part.first, part.count);
        if let Some((least, rest)) = own.indices.split_first_mut() {
            for index in rest {
                if *index < *least {
                    core::mem::swap(index, least);
                }
            }
        }
        count = WIDTH;
    }
    unsettled(first + part.first, count)
}

/// A child of the root, and the memory that becomes its nodes.
#[derive(Default)]
struct Subtree<'a> {
    run: Run<'a>,
    /// Where its spheres begin among all.
    first: usize,
    is_leaf: bool,
    nodes: &'a mut [BvhNode],
    budget: Budget,
    /// How many nodes it took: none for a leaf.
    used: usize,
}

/// Builds the nodes over a run that is no leaf; returns their number.
fn build_tree(
    join: &impl Join,
    nodes: &mut [BvhNode],
    run: &mut Run<'_>,
    root: Part,
    budget: Budget,
) -> usize {
    let count = root.count;
    let made = if count <= SMALL_TREE {
        in_equal_parts(join, run, root, budget)
    } else {
        children(join, run, root, budget)
    };
    let parts = made.parts.get(..made.number).unwrap_or_default();
    let mut node = node_over(run, parts, 0);

    let mut subtrees: [Subtree<'_>; WIDTH] = Default::default();
    let mut free = nodes.get_mut(1..).unwrap_or_default();
    let mut rest = Run { spheres: &mut *run.spheres, indices: &mut *run.indices };
    let mut rooms = [0; WIDTH];
    for ((part, subtree), room) in parts.iter().zip(&mut subtrees).zip(&mut rooms) {
        let (own, others) = rest.split_off(part.count);
        let budget = made.left.share(part.count, count);
        *room = if part.is_leaf() { 0 } else { nodes_needed(part.count) + budget.nodes };
        let (room, others_nodes) = free.split_at_mut((*room).min(free.len()));
        let (first, is_leaf) = (part.first, part.is_leaf());
        *subtree = Subtree { run: own, first, is_leaf, nodes: room, budget, used: 0 };
        (rest, free) = (others, others_nodes);
    }
    build_subtrees(join, subtrees.get_mut(..made.number).unwrap_or_default());
    let used = subtrees.map(|subtree| subtree.used);

    let (mut from, mut to) = (1, 1);
    for (((child, part), used), room) in node.child.iter_mut().zip(parts).zip(used).zip(rooms) {
        if part.is_leaf() {
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
        (from, to) = (from + room, to + used);
    }
    if let Some(place) = nodes.first_mut() {
        *place = node;
    }
    to
}

/// Builds subtrees, which are apart.
fn build_subtrees(join: &impl Join, subtrees: &mut [Subtree<'_>]) {
    if let [subtree] = subtrees {
        if !subtree.is_leaf {
            subtree.used = build_nodes(join, subtree);
        }
    } else if !subtrees.is_empty() {
        let (some, others) = subtrees.split_at_mut(subtrees.len() / 2);
        join.join(|| build_subtrees(join, some), || build_subtrees(join, others));
    }
}

/// Builds the nodes of a subtree, numbered from zero; returns their number. Not inlined: halves of halves of subtrees
/// would each keep room on the stack for what waits here.
#[inline(never)]
fn build_nodes(join: &impl Join, subtree: &mut Subtree<'_>) -> usize {
    let Subtree { run, first, nodes, budget, .. } = subtree;
    let root = Part::new(join, run.spheres, 0, run.spheres.len());
    // Each node on the way leaves at most fifteen children waiting while one goes on.
    let mut waiting = [Waiting { part: root, node: 0 }; (WIDTH - 1) * DEPTH + WIDTH];
    let (mut top, mut used) = (1, 1);
    while top > 0 {
        top -= 1;
        let Some(&Waiting { part, node }) = waiting.get(top) else { break };
        let Children { parts, number, left } = children(join, run, part, *budget);
        *budget = left;
        let parts = parts.get(..number).unwrap_or_default();
        let mut built = node_over(run, parts, *first);
        for (slot, child) in built.child.iter_mut().zip(parts) {
            if !child.is_leaf()
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

/// A node with the boxes of its children, in the order of their spheres; leaves are settled, with `first` added.
fn node_over(run: &mut Run<'_>, parts: &[Part], first: usize) -> BvhNode {
    let mut node = BvhNode::EMPTY;
    for (slot, part) in parts.iter().enumerate().take(WIDTH) {
        node.set_box(slot, part.bounds.padded());
        if part.is_leaf() {
            node.child[slot] = settle(run, part, first);
        }
    }
    node
}

#[cfg(all(test, proofs))]
mod tests;
