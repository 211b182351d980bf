//! Cutting a run of spheres in two, by the surface area heuristic where that can tell.
//!
//! Spheres are moved, not pointed at: every pass reads memory in order, and no other memory is needed. A part costs
//! its surface times the leaves that its spheres fill at least.

use super::bounds::Bounds;
use super::children::leaves;
use super::join::Join;
use super::run::Run;
use super::sah_bins::{BINS, Bin, bin_of, bins_of, scales};

/// Where to cut: before slice `bin` along `axis`.
#[derive(Clone, Copy)]
pub(super) struct Cut {
    axis: usize,
    bin: usize,
    scale: f32,
    /// How many spheres lie before.
    pub(super) first: usize,
    /// Surface times leaves of both parts.
    pub(super) cost: f32,
}

impl Run<'_> {
    /// The cheapest cut between slices whose parts fill at most `most` leaves; `None` if there is none, as where all
    /// centres coincide, or nearly.
    pub(super) fn best_cut(&self, join: &impl Join, bounds: &Bounds, most: usize) -> Option<Cut> {
        let scales = scales(bounds);
        let bins = bins_of(join, self.spheres, bounds, scales);
        let mut best = None;
        let mut least_cost = f32::INFINITY;
        for ((axis, bins), scale) in bins.iter().enumerate().zip(scales) {
            if scale == 0.0 {
                continue;
            }
            // The surface of the slices from each on.
            let mut right = [0.0; BINS];
            let mut all = Bin::EMPTY;
            for (area, bin) in right.iter_mut().zip(bins).rev() {
                all.grow(bin.low, bin.high, bin.count);
                *area = all.half_area();
            }
            let mut left = Bin::EMPTY;
            for (bin, (slice, right)) in bins.iter().zip(right).enumerate() {
                if left.count > 0 && slice.count > 0 {
                    let [first, other] = [left.count, self.spheres.len() - left.count].map(leaves);
                    let cost = left.half_area() * first as f32 + right * other as f32;
                    if cost < least_cost && first + other <= most {
                        least_cost = cost;
                        best = Some(Cut { axis, bin, scale, first: left.count, cost });
                    }
                }
                left.grow(slice.low, slice.high, slice.count);
            }
        }
        best
    }

    /// Moves the spheres before a cut to the front.
    pub(super) fn cut(&mut self, bounds: &Bounds, cut: &Cut) {
        // Of three, as a mask that the compiler sees.
        let axis = cut.axis % 3;
        let (least, scale) = (bounds.least[axis], cut.scale);
        let end = self.spheres.len();
        let before = self.gather(0, end, |sphere| bin_of(sphere[axis], least, scale) < cut.bin);
        debug_assert_eq!(before, cut.first, "counted and gathered alike");
    }
}
