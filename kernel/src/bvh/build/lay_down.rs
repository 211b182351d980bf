//! Leaves, from the order in which the build has left their spheres to the places where they are found.
//!
//! The spheres stand at the end of their memory, in the order of the leaves, and leaves are laid down from the front,
//! in the same order. A leaf takes at most the places of its spheres and those that were spent on it, so nothing is
//! written where a sphere has yet to be read (`budget.rs`). Of spheres that are the same, the one with the lowest
//! index stays: it answers for all. The others lie in free lanes, with NaN for a radius, so that they have a place if
//! they part (`refit.rs`); those for which no lane is free are dropped.

use super::dropped::Dropped;
use crate::bvh::leaf::{STEP, leaf_at};
use crate::bvh::node::{BvhNode, LEAF, NO_CHILD, WIDTH};
use crate::bvh::unplaced::Unplaced;

/// How many bits of a leaf that is not laid down are the place of its first sphere; the four above them are the number
/// of its spheres, less one.
const BEGIN_BITS: u32 = 27;

/// A leaf that is not laid down: of up to sixteen spheres.
pub(super) const fn unsettled(first: usize, count: usize) -> u32 {
    let less_one = (count as u32).wrapping_sub(1) % WIDTH as u32;
    LEAF | (less_one << BEGIN_BITS) | first as u32
}

/// Lays down all leaves of a tree, `shift` numbers after the front; its spheres begin at `first`. Returns how many
/// places they take, and what was dropped.
pub(super) fn lay_down(
    (places, shift): (&mut [[f32; 4]], usize),
    indices: &mut [u32],
    first: usize,
    nodes: &mut [BvhNode],
    root: &mut u32,
) -> (usize, Dropped) {
    let (mut end, mut dropped) = (0, Dropped::none(first));
    *root = lay_down_leaves(nodes, *root, &mut |child: u32| {
        let begin = first + (child & ((1 << BEGIN_BITS) - 1)) as usize;
        let count = ((child & !LEAF) >> BEGIN_BITS) as usize + 1;
        dropped.leave_out(places, indices, begin);
        let leaf = Leaf::read(places, indices, begin, count);
        let settled = leaf_at(end, leaf.count);
        let copies = leaf.copies.get(..leaf.dropped).unwrap_or_default();
        dropped.read_leaf(places, (begin + count, leaf.indices[0]), copies);
        leaf.write((places, shift), indices, end);
        end += leaf.count.next_multiple_of(STEP);
        settled
    });
    let all = places.len();
    dropped.leave_out(places, indices, all);
    (end, dropped)
}

/// Replaces a leaf, or every leaf below a node, by what `settle` returns, in the order of their spheres; returns what the child is
/// then. No tree is deeper than ten nodes.
fn lay_down_leaves(nodes: &mut [BvhNode], child: u32, settle: &mut impl FnMut(u32) -> u32) -> u32 {
    if child & LEAF != 0 {
        return if child == NO_CHILD { child } else { settled(settle, child) };
    }
    // Children stand in the order of their spheres.
    for slot in 0..WIDTH {
        let Some(below) = nodes.get(child as usize).map(|node| node.child[slot]) else { break };
        let below = lay_down_leaves(nodes, below, settle);
        if let Some(node) = nodes.get_mut(child as usize) {
            node.child[slot] = below;
        }
    }
    child
}

/// Calls `settle`. (Not inlined: each node on the way would keep room on the stack for a leaf.)
#[inline(never)]
fn settled(settle: &mut impl FnMut(u32) -> u32, leaf: u32) -> u32 {
    settle(leaf)
}

/// The spheres of a leaf, column by column.
struct Leaf {
    columns: [[f32; WIDTH]; 4],
    indices: [u32; WIDTH],
    count: usize,
    /// The copies of spheres for which no lane is free, and their number.
    copies: [Unplaced; WIDTH],
    dropped: usize,
}

impl Leaf {
    /// What stands where there is no sphere.
    const EMPTY: Self = {
        let zeros = [0.0; WIDTH];
        Self {
            columns: [zeros, zeros, zeros, [f32::NAN; WIDTH]],
            indices: [u32::MAX; WIDTH],
            count: 0,
            copies: [Unplaced { index: 0, same: 0 }; WIDTH],
            dropped: 0,
        }
    };

    /// Reads the spheres of a leaf, in the order of their indices, each once.
    fn read(places: &[[f32; 4]], indices: &[u32], begin: usize, count: usize) -> Self {
        let mut as_they_are = Self::EMPTY;
        // Spheres that are the same have the same sum, whatever the signs of zeros are; others seldom do.
        let mut sums = [f32::NAN; WIDTH];
        let there = places.iter().zip(indices).skip(begin).take(count.min(WIDTH));
        for (lane, (sphere, index)) in there.enumerate() {
            for axis in 0..4 {
                as_they_are.columns[axis][lane % WIDTH] = sphere[axis];
            }
            let [x, y, z, radius] = *sphere;
            sums[lane % WIDTH] = x + 3.0 * y + 5.0 * z + 7.0 * radius;
            as_they_are.indices[lane % WIDTH] = *index;
            as_they_are.count = lane + 1;
        }
        // A sphere goes to the lane whose number is how many indices are lower. No branch depends on a comparison.
        let (mut ranks, mut alike) = ([0; WIDTH], [0; WIDTH]);
        for other in 0..as_they_are.count.min(WIDTH) {
            let (sum, index) = (sums[other], as_they_are.indices[other]);
            for lane in 0..WIDTH {
                // As integers with a sign: indices are below 2^27.
                ranks[lane] += i32::from((index as i32) < as_they_are.indices[lane] as i32);
                alike[lane] += i32::from(sum == sums[lane]);
            }
        }
        let mut leaf = Self { count: as_they_are.count, ..Self::EMPTY };
        for lane in 0..as_they_are.count.min(WIDTH) {
            let to = ranks[lane] as usize % WIDTH;
            for axis in 0..4 {
                leaf.columns[axis][to] = as_they_are.columns[axis][lane];
            }
            leaf.indices[to] = as_they_are.indices[lane];
        }
        // Each is like itself.
        if alike.iter().sum::<i32>() > leaf.count as i32 {
            leaf.keep_first();
        }
        leaf
    }

    /// Keeps the first of spheres that are the same; the others come behind as long as lanes are free.
    #[cold]
    fn keep_first(&mut self) {
        let row = |Self { columns: [x, y, z, radius], .. }: &Self, lane: usize| {
            [x[lane], y[lane], z[lane], radius[lane]]
        };
        let mut kept = Self::EMPTY;
        let (mut copies, mut number) = (Self::EMPTY.copies, 0);
        for lane in 0..self.count.min(WIDTH) {
            let (sphere, index) = (row(self, lane % WIDTH), self.indices[lane]);
            if let Some(other) = (0..kept.count).find(|lane| row(&kept, lane % WIDTH) == sphere) {
                copies[number % WIDTH] = Unplaced { index, same: kept.indices[other % WIDTH] };
                number += 1;
                continue;
            }
            for axis in 0..4 {
                kept.columns[axis][kept.count % WIDTH] = sphere[axis];
            }
            kept.indices[kept.count % WIDTH] = index;
            kept.count += 1;
        }
        let (count, lanes) = (kept.count, kept.count.next_multiple_of(STEP));
        for (copy, lane) in copies.into_iter().zip(count..count + number) {
            if lane < lanes {
                kept.indices[lane % WIDTH] = copy.index;
            } else {
                kept.copies[(lane - lanes) % WIDTH] = copy;
                kept.dropped += 1;
            }
        }
        *self = kept;
    }

    fn write(&self, (places, shift): (&mut [[f32; 4]], usize), indices: &mut [u32], begin: usize) {
        let lanes = self.count.next_multiple_of(STEP);
        let numbers = places.as_flattened_mut().get_mut(shift..).unwrap_or_default();
        write_columns(numbers, (begin, lanes), &self.columns);
        in_steps(indices.get_mut(begin..begin + lanes).unwrap_or_default(), &self.indices);
    }
}

/// Writes the spheres of a leaf that begins at a place and has so many lanes.
#[inline(always)]
pub(super) fn write_columns(
    numbers: &mut [f32],
    (begin, lanes): (usize, usize),
    columns: &[[f32; WIDTH]; 4],
) {
    let numbers = numbers.get_mut(4 * begin..).unwrap_or_default();
    for (to, column) in numbers.chunks_exact_mut(lanes.max(1)).zip(columns) {
        in_steps(to, column);
    }
}

/// Copies as many as there is room for, a multiple of [`STEP`].
fn in_steps<T: Copy>(to: &mut [T], from: &[T; WIDTH]) {
    for (to, from) in to.as_chunks_mut::<STEP>().0.iter_mut().zip(from.as_chunks::<STEP>().0) {
        *to = *from;
    }
}
