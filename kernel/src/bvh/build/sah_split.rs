//! Cutting a run of spheres in two, by the surface area heuristic where that can tell.
//!
//! The spheres lie in the leaves that the tree will have, so that they are moved, not pointed at:
//! every pass reads memory in order, and no other memory is needed. Cuts fall on multiples of
//! sixteen, so a run is a run of leaves.

use super::bounds::Bounds;
use super::join::Join;
use super::sah_bins::{BINS, Bin, bin_of, bins_of, scales};
use crate::bvh::node::{BvhLeaf, WIDTH};

/// Up to how many leaves all cuts are compared.
const EVERY_CUT: usize = 32;

/// A run of leaves, and how many spheres are in them: all leaves are full but the last of all.
pub(super) struct Run<'a> {
    pub(super) leaves: &'a mut [BvhLeaf],
    pub(super) count: usize,
}

/// Where to cut: before sphere `at`, in the order along `axis`.
struct Cut {
    axis: usize,
    at: usize,
    /// The slice that the cut is in, and what lies in the slices before.
    bin: usize,
    before: usize,
    inside: usize,
}

impl Run<'_> {
    /// Cuts the run where the heuristic says; returns the leaves of the first part, at least
    /// one and fewer than all. The run has two leaves or more.
    pub(super) fn split(&mut self, join: &impl Join, bounds: &Bounds) -> usize {
        let scales = scales(bounds);
        match self.best_cut(join, bounds, scales) {
            Some(cut) => {
                // Of three, as a mask that the compiler sees.
                let axis = cut.axis % 3;
                let (least, scale) = (bounds.least[axis], scales[axis]);
                let before = self.gather(0, self.count, |leaf, lane| {
                    bin_of(leaf.center[axis][lane], least, scale) < cut.bin
                });
                debug_assert_eq!(before, cut.before, "counted and gathered alike");
                if before < cut.at && cut.at < before + cut.inside {
                    let end = self.gather(before, self.count, |leaf, lane| {
                        bin_of(leaf.center[axis][lane], least, scale) == cut.bin
                    });
                    self.order_about(cut.at, before, end, axis);
                }
                cut.at / WIDTH
            }
            None => self.split_at(self.leaves.len() / 2, bounds),
        }
    }

    /// Cuts the run behind `leaves` leaves, by the centres along the longest axis, or by the radii
    /// where the centres coincide.
    pub(super) fn split_at(&mut self, leaves: usize, bounds: &Bounds) -> usize {
        self.order_about(leaves * WIDTH, 0, self.count, bounds.longest_axis());
        leaves
    }

    /// The cheapest cut between slices, moved to a multiple of sixteen; `None` if all centres
    /// coincide, or nearly.
    fn best_cut(&self, join: &impl Join, bounds: &Bounds, scales: [f32; 3]) -> Option<Cut> {
        let bins = bins_of(join, self.leaves, self.count, bounds, scales);
        let mut best = None;
        let mut least_cost = f32::INFINITY;
        for ((axis, bins), scale) in bins.iter().enumerate().zip(scales) {
            if scale == 0.0 {
                continue;
            }
            // Surfaces of the first so many slices, and of the others.
            let mut left = [0.0; BINS + 1];
            let mut right = [0.0; BINS + 1];
            let mut all = Bin::EMPTY;
            for (area, bin) in left.iter_mut().skip(1).zip(bins) {
                all.grow(bin.low, bin.high, bin.count);
                *area = all.half_area();
            }
            let mut all = Bin::EMPTY;
            for (area, bin) in right.iter_mut().zip(bins).rev().skip(1) {
                all.grow(bin.low, bin.high, bin.count);
                *area = all.half_area();
            }
            let mut before = 0;
            // Pairs, so that the compiler sees that no index is out of bounds.
            let areas = left.windows(2).zip(right.windows(2));
            for (Bin { count: inside, .. }, areas) in bins.iter().zip(areas) {
                let (&[left, left_with], &[right_with, right]) = areas else { continue };
                if *inside == 0 {
                    continue;
                }
                // Of a short run every cut, of a long one that nearest to the end of the slice.
                let end = before + inside;
                let nearest = (end + WIDTH / 2) / WIDTH * WIDTH;
                let (mut at, last) = if self.leaves.len() <= EVERY_CUT {
                    (before / WIDTH * WIDTH + WIDTH, end / WIDTH * WIDTH)
                } else {
                    (nearest, nearest)
                };
                while at <= last {
                    if at > 0 && at < self.count {
                        let share = (at - before.min(at)) as f32 / *inside as f32;
                        let first = left + share * (left_with - left);
                        let second = right_with + share * (right - right_with);
                        let cost = first * at as f32 + second * (self.count - at) as f32;
                        if cost < least_cost {
                            least_cost = cost;
                            best = Some((axis, at));
                        }
                    }
                    at += WIDTH;
                }
                before = end;
            }
        }
        let (axis, at) = best?;
        let mut before = 0;
        for (bin, Bin { count, .. }) in bins[axis % 3].iter().enumerate() {
            if at <= before + count {
                return Some(Cut { axis, at, bin, before, inside: *count });
            }
            before += count;
        }
        None
    }
}
