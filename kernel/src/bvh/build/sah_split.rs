//! Cutting a run of spheres in two, by the surface area heuristic where that can tell.
//!
//! Spheres are moved, not pointed at: every pass reads memory in order, and no other memory is needed. A part costs
//! its surface times the leaves that its spheres fill at least.

use super::bounds::{Bounds, Corners};
use super::join::Join;
use super::run::Run;
use super::sah_bins::{BINS, Bins, scales};
use crate::bvh::node::WIDTH;
use wide::{f32x4, i32x4};

/// Where to cut: before slice `bin` along `axis`.
#[derive(Clone, Copy)]
pub(super) struct Cut {
    pub(super) axis: usize,
    pub(super) bin: usize,
    pub(super) scale: f32,
    /// How many spheres lie before.
    pub(super) first: usize,
    /// Surface times leaves of both parts.
    pub(super) cost: f32,
    /// The boxes of both parts.
    pub(super) boxes: [Corners; 2],
}

impl Run<'_> {
    /// The cheapest cut between slices whose parts fill at most `most` leaves; `None` if there is none, as where all
    /// centres coincide, or nearly.
    pub(super) fn best_cut(&self, join: &impl Join, bounds: &Bounds, most: usize) -> Option<Cut> {
        let scales = scales(bounds);
        let mut bins = Bins::EMPTY;
        bins.add(join, self.spheres, bounds.centers.low, scales);
        let (axis, bin, cost) = bins.cheapest(self.spheres.len(), most)?;
        let axis = axis % 3;
        let mut first = 0;
        let mut boxes = [Corners::EMPTY; 2];
        for slice in 0..BINS {
            boxes[usize::from(slice >= bin)].hold(bins.boxes[slice][axis]);
            first += if slice < bin { bins.counts[slice][axis] } else { 0 };
        }
        Some(Cut { axis, bin, scale: scales[axis], first: first as usize, cost, boxes })
    }
}

impl Bins {
    /// Axis, slice and cost of the cheapest cut of `count` spheres whose parts fill at most `most` leaves; the axes go
    /// side by side, one a lane.
    fn cheapest(&self, count: usize, most: usize) -> Option<(usize, usize, f32)> {
        let zero = f32x4::splat(0.0);
        // The surface of the slices from each on.
        let mut right = [zero; BINS];
        let mut held = [Corners::EMPTY; 3];
        for bin in (1..BINS).rev() {
            for axis in 0..3 {
                held[axis].hold(self.boxes[bin][axis]);
            }
            right[bin] = half_areas(&held);
        }
        // Leaves are counted in single precision: there are 2^23 at most.
        let most = f32x4::splat(most.min(count) as f32);
        let count = i32x4::splat(count as i32);
        let (mut least, mut best) = (f32x4::splat(f32::INFINITY), zero);
        let mut before = i32x4::splat(0);
        held = [Corners::EMPTY; 3];
        for bin in 1..BINS {
            for axis in 0..3 {
                held[axis].hold(self.boxes[bin - 1][axis]);
            }
            before += i32x4::new(self.counts[bin - 1]);
            let (first, other) = (leaves(before), leaves(count - before));
            let cost = half_areas(&held) * first + right[bin] * other;
            let is_best = cost.simd_lt(least)
                & first.simd_gt(zero)
                & f32x4::from_i32x4(i32x4::new(self.counts[bin])).simd_gt(zero)
                & (first + other).simd_le(most);
            least = is_best.select(cost, least);
            best = is_best.select(f32x4::splat(bin as f32), best);
        }
        let ([x, y, z, _], [bin_x, bin_y, bin_z, _]) = (least.to_array(), best.to_array());
        let (mut axis, mut bin, mut cost) = (0, bin_x, x);
        for (other, other_bin, other_cost) in [(1, bin_y, y), (2, bin_z, z)] {
            if other_cost < cost {
                (axis, bin, cost) = (other, other_bin, other_cost);
            }
        }
        let bin = bin as usize % BINS;
        (bin > 0).then_some((axis, bin, cost))
    }
}

/// How many leaves so many spheres fill at least.
#[inline(always)]
fn leaves(count: i32x4) -> f32x4 {
    f32x4::from_i32x4((count + i32x4::splat(WIDTH as i32 - 1)) >> WIDTH.ilog2() as i32)
}

/// Half the surfaces of three boxes, one a lane.
#[inline(always)]
fn half_areas([x, y, z]: &[Corners; 3]) -> f32x4 {
    let (x, y, z) = (x.high - x.low, y.high - y.low, z.high - z.low);
    let [x, y, z, _] = f32x4::transpose([x, y, z, f32x4::splat(0.0)]);
    x * y + y * z + z * x
}

#[cfg(all(test, proofs))]
mod tests;
