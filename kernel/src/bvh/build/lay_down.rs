//! Leaves, from the order in which the build has left their spheres to the places where they are found.
//!
//! The spheres stand at the end of their memory, in the order of the leaves, and leaves are laid down from the front,
//! in the same order. A leaf takes at most what its spheres and what was spent on it take, so nothing is written
//! where a sphere has yet to be read (`budget.rs`). Of spheres that are the same the lowest index stays: it answers
//! for all.

use crate::bvh::leaf::{STEP, leaf_at};
use crate::bvh::node::{BvhNode, DEPTH, LEAF, NO_CHILD, WIDTH};

/// Bits of a leaf that is not laid down that say where its spheres begin; the four above are their number, less one.
const BEGIN_BITS: u32 = 27;

/// A leaf that is not laid down: of up to sixteen spheres.
pub(super) const fn unsettled(first: usize, count: usize) -> u32 {
    let less_one = (count as u32).wrapping_sub(1) % WIDTH as u32;
    LEAF | (less_one << BEGIN_BITS) | first as u32
}

/// Lays down all leaves of a tree, `shift` numbers after the front; its spheres begin at `first`. Returns how many
/// places they take.
pub(super) fn lay_down(
    (places, shift): (&mut [[f32; 4]], usize),
    indices: &mut [u32],
    first: usize,
    nodes: &mut [BvhNode],
    root: &mut u32,
) -> usize {
    let mut end = 0;
    let mut settle = |child: u32| {
        let begin = first + (child & ((1 << BEGIN_BITS) - 1)) as usize;
        let count = ((child & !LEAF) >> BEGIN_BITS) as usize + 1;
        let mut leaf = Leaf::read(places, indices, begin, count);
        leaf.sort();
        let settled = leaf_at(end, leaf.count);
        leaf.write((places, shift), indices, end);
        end += leaf.count.next_multiple_of(STEP);
        settled
    };
    if *root & LEAF != 0 {
        if *root != NO_CHILD {
            *root = settle(*root);
        }
        return end;
    }
    // Children stand in the order of their spheres.
    let mut way = [(0_usize, 0_usize); DEPTH + 1];
    let mut depth = 0;
    way[0] = (*root as usize, 0);
    while let Some((number, slot)) = way.get_mut(depth) {
        let (node, at) = (nodes.get_mut(*number), *slot);
        *slot += 1;
        let child =
            node.and_then(|node| node.child.get_mut(at)).filter(|child| **child != NO_CHILD);
        match child {
            Some(child) if *child & LEAF != 0 => *child = settle(*child),
            Some(child) => {
                let below = *child as usize;
                depth += 1;
                if let Some(place) = way.get_mut(depth) {
                    *place = (below, 0);
                }
            }
            None if depth == 0 => break,
            None => depth -= 1,
        }
    }
    end
}

/// The spheres of a leaf.
struct Leaf {
    spheres: [([f32; 4], u32); WIDTH],
    count: usize,
}

impl Leaf {
    fn read(places: &[[f32; 4]], indices: &[u32], begin: usize, count: usize) -> Self {
        let mut spheres = [([0.0, 0.0, 0.0, f32::NAN], u32::MAX); WIDTH];
        let there = places.iter().zip(indices).skip(begin).take(count);
        for (to, (sphere, index)) in spheres.iter_mut().zip(there) {
            *to = (*sphere, *index);
        }
        Self { spheres, count: count.min(WIDTH) }
    }

    /// Into the order of their indices, each once.
    fn sort(&mut self) {
        let spheres = self.spheres.get_mut(..self.count).unwrap_or_default();
        spheres.sort_unstable_by_key(|(_, index)| *index);
        let mut kept = 0;
        for at in 0..self.count.min(WIDTH) {
            let sphere = self.spheres[at];
            let is_new = self.spheres.iter().take(kept).all(|(other, _)| *other != sphere.0);
            self.spheres[kept % WIDTH] = sphere;
            kept += usize::from(is_new);
        }
        for place in self.spheres.iter_mut().skip(kept) {
            *place = ([0.0, 0.0, 0.0, f32::NAN], u32::MAX);
        }
        self.count = kept;
    }

    /// Column by column.
    fn write(&self, (places, shift): (&mut [[f32; 4]], usize), indices: &mut [u32], begin: usize) {
        let lanes = self.count.next_multiple_of(STEP);
        let numbers = places.as_flattened_mut().get_mut(shift + 4 * begin..);
        let Some(indices) = indices.get_mut(begin..begin + lanes) else { return };
        let columns = numbers.unwrap_or_default().chunks_exact_mut(lanes.max(1)).take(4);
        for (axis, column) in columns.enumerate() {
            for (to, (sphere, _)) in column.iter_mut().zip(&self.spheres) {
                *to = sphere[axis % 4];
            }
        }
        for (to, (_, index)) in indices.iter_mut().zip(&self.spheres) {
            *to = *index;
        }
    }
}
