//! From a list of spheres to a tree: top down, straight into nodes of sixteen children.
//!
//! A node begins with one run of leaves and cuts one run after another in two, always the one
//! that costs most (surface times leaves), until there are sixteen or every run is one leaf. Runs
//! of more than one leaf become nodes in their turn; a stack of those that wait replaces
//! recursion.
//!
//! # Depth
//!
//! Of a node's m leaves let q = m/8, rounded up, and let a run of s leaves *want* s/q, rounded up,
//! less one, cuts: seven at most at the beginning, zero once no run is longer than q. A cut never
//! adds to the sum of what is wanted, since the parts' s/q, rounded up, exceed their sum's by one
//! at most, and one is paid. So as long as more cuts are left than wanted the heuristic chooses;
//! from then on a run longer than q is cut behind q leaves, which takes one off each time. After
//! fifteen cuts no child is longer than q.

use super::split::{Bounds, Run};
use super::{Bvh, BvhLeaf, BvhNode, DEPTH, LARGEST, LEAF, NO_CHILD, WIDTH};
use crate::{Sphere, Spheres};

/// A run of leaves that will be a child.
#[derive(Clone, Copy)]
struct Part {
    first: usize,
    leaves: usize,
    bounds: Bounds,
    /// What a ray pays here, but for a constant; nothing for a leaf.
    cost: f32,
}

/// A run that waits to become node `node`.
#[derive(Clone, Copy)]
struct Waiting {
    part: Part,
    node: usize,
}

/// The memory is as large as [`Bvh::needed`] says.
pub(super) fn build<'a>(
    spheres: Spheres<'_>,
    nodes: &'a mut [BvhNode],
    leaves: &'a mut [BvhLeaf],
) -> Bvh<'a> {
    let inside = fill(leaves, &spheres, is_inside);
    let full = inside.div_ceil(WIDTH);
    let (leaves, rest) = leaves.split_at_mut(full.min(leaves.len()));
    let outside = fill(rest, &spheres, |sphere| sphere.is_valid() && !is_inside(sphere));
    let outside = outside.div_ceil(WIDTH).min(rest.len());

    let root = Part::new(leaves, inside, 0, full);
    let used = if full > 1 { build_nodes(nodes, leaves, inside, root) } else { 0 };
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
    Bvh {
        nodes: nodes.get(..used).unwrap_or(&[]),
        leaves,
        outside: rest.get(..outside).unwrap_or(&[]),
        root: child,
        extent,
        count: spheres.len(),
    }
}

fn is_inside(sphere: &Sphere) -> bool {
    sphere.is_valid() && sphere.center.abs().max_element().max(sphere.radius) <= LARGEST
}

/// Puts the spheres that are `wanted` into leaves, in the order of their indices, and empties the
/// rest of the last; answers with their number.
fn fill(leaves: &mut [BvhLeaf], spheres: &Spheres<'_>, wanted: impl Fn(&Sphere) -> bool) -> usize {
    let mut count = 0;
    for (index, sphere) in spheres.iter().enumerate() {
        if !wanted(&sphere) {
            continue;
        }
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

impl Part {
    /// Leaves `first..first + leaves` of all, which hold `count` spheres.
    fn new(all: &[BvhLeaf], count: usize, first: usize, leaves: usize) -> Self {
        let run = all.get(first..first + leaves).unwrap_or(&[]);
        let bounds = Bounds::of(run, (count - first * WIDTH).min(leaves * WIDTH));
        let cost = if leaves > 1 { bounds.half_area() * leaves as f32 } else { -1.0 };
        Self { first, leaves, bounds, cost }
    }
}

/// Builds the nodes over all leaves, which are two or more; answers with their number.
fn build_nodes(nodes: &mut [BvhNode], leaves: &mut [BvhLeaf], count: usize, root: Part) -> usize {
    // Each level leaves at most fifteen waiting for the one that goes on.
    let mut waiting = [Waiting { part: root, node: 0 }; (WIDTH - 1) * DEPTH + WIDTH];
    let (mut top, mut used) = (1, 1);
    while top > 0 {
        top -= 1;
        let Some(&Waiting { part, node }) = waiting.get(top) else { break };
        let (children, number) = children(leaves, count, part);
        let mut built = BvhNode::EMPTY;
        for (slot, child) in children.iter().enumerate().take(number) {
            for axis in 0..3 {
                built.low[axis][slot] = child.bounds.low[axis];
                built.high[axis][slot] = child.bounds.high[axis];
            }
            if child.leaves == 1 {
                built.child[slot] = child.first as u32 | LEAF;
            } else if let Some(place) = waiting.get_mut(top) {
                built.child[slot] = used as u32;
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

/// Cuts a run of two leaves or more into up to sixteen.
fn children(leaves: &mut [BvhLeaf], count: usize, whole: Part) -> ([Part; WIDTH], usize) {
    let mut parts = [whole; WIDTH];
    let longest = whole.leaves.div_ceil(8);
    let wanted = |part: &Part| part.leaves.div_ceil(longest) - 1;
    for number in 1..WIDTH {
        let (made, rest) = parts.split_at_mut(number);
        let forced = made.iter().map(wanted).sum::<usize>() >= WIDTH - number;
        let candidates = made.iter_mut().filter(|part| !forced || part.leaves > longest);
        let Some(part) = candidates.max_by(|a, b| a.cost.total_cmp(&b.cost)) else {
            return (parts, number);
        };
        if part.leaves == 1 {
            return (parts, number);
        }
        let Part { first, leaves: length, bounds, .. } = *part;
        let mut run = Run {
            leaves: leaves.get_mut(first..first + length).unwrap_or(&mut []),
            count: (count - first * WIDTH).min(length * WIDTH),
        };
        let cut = if forced { run.split_at(longest, &bounds) } else { run.split(&bounds) };
        *part = Part::new(leaves, count, first, cut);
        if let Some(place) = rest.first_mut() {
            *place = Part::new(leaves, count, first + cut, length - cut);
        }
    }
    (parts, WIDTH)
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
