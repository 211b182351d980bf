//! The walk of a refit: leaves are made anew from where their spheres are now, and boxes from the leaves up.

use crate::bvh::build::bounds::{Corners, padded};
use crate::bvh::build::lay_down::write_columns;
use crate::bvh::leaf::{self, STEP};
use crate::bvh::node::{BvhNode, LEAF, NO_CHILD, WIDTH};
use crate::bvh::prefetch;
use crate::geometry::sphere::Spheres;
use crate::numeric::rounding::{least, most};
use crate::scale::scene::SceneScale;
use core::hint::black_box;
use wide::f32x4;

/// Lists of more spheres are read ahead: so many the second-level cache of a core holds.
const NEAR: usize = 65_536;

/// The leaves of a tree, and where their spheres are now.
pub(super) struct Leaves<'a> {
    pub(super) spheres: &'a Spheres<'a>,
    pub(super) scale: SceneScale,
    pub(super) numbers: &'a mut [f32],
    /// The index of each lane.
    pub(super) lanes: &'a [u32],
    /// The indices of spheres that no box holds, and how many there are.
    pub(super) outside: &'a mut [u32],
    pub(super) count: usize,
}

impl Leaves<'_> {
    /// Refits a node or a leaf, with all below it; returns its box. No tree is deeper than ten nodes.
    pub(super) fn refit(&mut self, nodes: &mut [BvhNode], child: u32) -> Corners {
        if child & LEAF != 0 {
            return if child == NO_CHILD { Corners::EMPTY } else { self.leaf(child & !LEAF) };
        }
        let mut held = Corners::EMPTY;
        let Some(node) = nodes.get(child as usize) else { return held };
        if self.spheres.len() > NEAR {
            self.read_ahead(node);
        }
        for slot in 0..WIDTH {
            let Some(below) = nodes.get(child as usize).map(|node| node.child[slot]) else { break };
            if below == NO_CHILD {
                continue;
            }
            let corners = self.refit(nodes, below);
            if let Some(node) = nodes.get_mut(child as usize) {
                node.set_box(slot, box_of(&corners));
            }
            held.hold(corners);
        }
        held
    }

    /// Refits a leaf; returns its box. (Not inlined: each node on the way would keep room on the stack for a leaf.)
    #[inline(never)]
    fn leaf(&mut self, number: u32) -> Corners {
        let (begin, lanes) = leaf::extent_of(number);
        let none = [0.0; WIDTH];
        let mut columns = [none, none, none, [f32::NAN; WIDTH]];
        // Spheres that are the same have the same sum, as where leaves are laid down.
        let mut sums = [f32::NAN; WIDTH];
        let (mut there, mut inside) = (0, 0);
        let infinity = f32x4::splat(f32::INFINITY);
        let (mut low, mut high) = ([infinity; 3], [-infinity; 3]);
        let own = self.lanes.get(begin..begin + lanes).unwrap_or_default();
        for (step, indices) in own.as_chunks::<STEP>().0.iter().enumerate().take(WIDTH / STEP) {
            let nowhere = [0.0; STEP];
            let mut given = [nowhere, nowhere, nowhere, [f32::NAN; STEP]];
            for lane in 0..STEP {
                let Some(sphere) = self.spheres.get(indices[lane] as usize) else { continue };
                let [x, y, z] = sphere.center();
                let row = [x, y, z, sphere.radius];
                for axis in 0..4 {
                    given[axis][lane] = row[axis];
                }
                there += 1;
            }
            let (scaled, bits) = self.scale.scale_four(given.map(f32x4::new));
            inside += bits.count_ones() as i32;
            let [x, y, z, radius] = scaled;
            let is_none = radius.is_nan();
            for (axis, center) in [x, y, z].into_iter().enumerate() {
                low[axis] = low[axis].fast_min(is_none.bitselect(infinity, center - radius));
                high[axis] = high[axis].fast_max(is_none.bitselect(-infinity, center + radius));
            }
            let sum = x + y * 3.0 + z * 5.0 + radius * 7.0;
            let numbers = scaled.map(f32x4::to_array);
            for (column, numbers) in columns.iter_mut().zip(&numbers) {
                put_step(column, step, numbers);
            }
            put_step(&mut sums, step, &sum.to_array());
        }
        if inside < there {
            self.leave_out_of_leaf(begin, lanes);
        }
        let corners = across(low, high);
        let mut alike = [0; WIDTH];
        for other in 0..lanes.min(WIDTH) {
            let sum = sums[other];
            for lane in 0..WIDTH {
                alike[lane] += i32::from(sum == sums[lane]);
            }
        }
        // Each is like itself.
        if alike.iter().sum::<i32>() > inside {
            self.keep_lowest((begin, lanes), &mut columns);
        }
        write_columns(self.numbers, (begin, lanes), &columns);
        corners
    }

    /// Leaves out spheres that are valid and not seen by bounds.
    #[cold]
    fn leave_out_of_leaf(&mut self, begin: usize, lanes: usize) {
        for lane in 0..lanes {
            let Some(&index) = self.lanes.get(begin + lane) else { continue };
            let Some(sphere) = self.spheres.get(index as usize) else { continue };
            if sphere.is_valid() && self.scale.scaled(&sphere).is_none() {
                self.leave_out(index);
            }
        }
    }

    /// Reads a node, its leaves and their spheres, one after the other: then all are on their way from memory at once, as
    /// in `bvh/prefetch.rs`. Memory that is only written is read, too: its line must be there first, and few writes can
    /// wait for lines at once. Not inlined, like a leaf. (With a million spheres, a refit takes 0.68 of the time that it takes when the spheres
    /// alone are read, and 0.96 when those and the node are.)
    #[inline(never)]
    fn read_ahead(&self, node: &BvhNode) {
        let mut bits = prefetch::node(node);
        for child in node.child {
            if child & LEAF == 0 || child == NO_CHILD {
                continue;
            }
            let (begin, lanes) = leaf::extent_of(child & !LEAF);
            bits ^= prefetch::leaf(self.numbers, child & !LEAF);
            let own = self.lanes.get(begin..begin + lanes).unwrap_or_default();
            for column in self.spheres.columns() {
                for index in own {
                    bits ^= column.get(*index as usize).map_or(0, |number| number.to_bits());
                }
            }
        }
        black_box(bits);
    }

    /// Keeps the one with the lowest index of spheres that are the same.
    #[cold]
    fn keep_lowest(&self, (begin, lanes): (usize, usize), columns: &mut [[f32; WIDTH]; 4]) {
        let own = *columns;
        let row = |lane: usize| [own[0][lane], own[1][lane], own[2][lane], own[3][lane]];
        let indices = self.lanes.get(begin..begin + lanes).unwrap_or_default();
        for (lane, index) in indices.iter().enumerate().take(WIDTH) {
            for (other, lower) in indices.iter().enumerate().take(lane) {
                if row(other) == row(lane) {
                    columns[3][if lower < index { lane } else { other }] = f32::NAN;
                }
            }
        }
    }

    pub(super) fn leave_out(&mut self, index: u32) {
        if let Some(place) = self.outside.get_mut(self.count) {
            *place = index;
        }
        self.count += 1;
    }
}

/// The box of four boxes, which are given along each axis.
#[inline(always)]
fn across(low: [f32x4; 3], high: [f32x4; 3]) -> Corners {
    let (mut lows, mut highs) = ([0.0; 4], [0.0; 4]);
    for axis in 0..3 {
        let ([a, b, c, d], [e, f, g, h]) = (low[axis].to_array(), high[axis].to_array());
        lows[axis] = least(least(a, b), least(c, d));
        highs[axis] = most(most(e, f), most(g, h));
    }
    Corners { low: f32x4::new(lows), high: f32x4::new(highs) }
}

/// Writes four of sixteen numbers.
#[inline(always)]
fn put_step(column: &mut [f32; WIDTH], step: usize, numbers: &[f32; STEP]) {
    if let Some(place) = column.as_chunks_mut::<STEP>().0.get_mut(step) {
        *place = *numbers;
    }
}

/// The box of a child, as nodes have it; if the child has no sphere, a box that no ray enters.
#[inline(always)]
fn box_of(corners: &Corners) -> [[f32; 3]; 2] {
    if corners.is_empty() {
        return [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    }
    let [low, high] = corners.outward();
    padded(low, high)
}
