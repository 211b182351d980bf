//! The mask of a grid that takes most of the samples' variance away.
//!
//! With the mean of the cell subtracted, a mask that fills `n` of `m` equal bins whose sum is `s` takes away `|s|^2 (1/n + 1/(m-n)) / m`. A
//! mask and its complement take away the same, so only masks that leave the last bin are tried. The sums of all sets of bins are those of
//! the sets of the first three, eight side by side, plus those of the sets of the other bins. A grid that has few masks has bars: the sum
//! of bins in a row is the difference of two sums from the first bin on.

use super::masks::{Family, Mask};
use spherule_kernel::Vec3;
use std::array;
use std::ops::Range;
use wide::f32x8;

/// Sets of bins side by side.
const LANES: usize = 8;

/// Finds masks of a family.
#[derive(Clone, Debug)]
pub(super) struct MaskSearch {
    masks: &'static [Mask],
    /// The weight of the squared sum of every set without the last bin, in the order of their bits; empty if not all sets have a mask.
    weights: Vec<f32x8>,
    /// The mask of each such set, or of its complement.
    of_sets: Vec<u8>,
    /// The weight of the squared sum of each bar, and the bins that it fills.
    bars: Vec<(f32, Range<usize>)>,
}

impl MaskSearch {
    pub(super) fn new(family: &'static Family) -> Self {
        let (bins, sets) = (family.bins(), 1 << (family.bins() - 1));
        let is_full = family.masks.len() == sets - 1 && sets >= LANES;
        let all = if is_full { sets } else { 0 };
        let of_lane = |set| if set == 0 { 0.0 } else { weight(bins, set) };
        let weights = (0..all)
            .step_by(LANES)
            .map(|first| f32x8::new(array::from_fn(|lane| of_lane(first + lane))));
        let is_of = |mask: &Mask, set: usize| {
            let bits = usize::from(mask.bits);
            bits == set || bits ^ (2 * sets - 1) == set
        };
        let bar = |mask: &Mask| {
            let bits = usize::from(mask.bits);
            let bar = bits.trailing_zeros() as usize..bits.ilog2() as usize + 1;
            debug_assert_eq!(bar.len(), bits.count_ones() as usize);
            (weight(bins, bits), bar)
        };
        let bars = if is_full { &[] } else { &*family.masks };
        let of_set = |set| family.masks.iter().position(|mask| is_of(mask, set)).unwrap_or(0);
        Self {
            masks: &family.masks,
            weights: weights.collect(),
            bars: bars.iter().map(bar).collect(),
            of_sets: (0..all).map(|set| of_set(set) as u8).collect(),
        }
    }

    /// Returns the mask that takes most of the variance away, and how much. The mean of `means` must be 0.
    #[inline]
    pub(super) fn best(&self, means: &[Vec3; 8]) -> (f32, &'static Mask) {
        if !self.bars.is_empty() {
            return self.best_bar(means);
        }
        // Sets of the first three bins, one a lane.
        let has = |bin: usize| f32x8::new(array::from_fn(|lane| (lane >> bin & 1) as f32));
        let of_three: [f32x8; 3] = array::from_fn(|axis| {
            (0..3).fold(f32x8::ZERO, |sum, bin| sum + has(bin) * f32x8::splat(means[bin][axis]))
        });
        let [mut best, mut at] = [f32x8::ZERO; 2];
        for (place, &weight) in self.weights.iter().enumerate() {
            let others = (3..7).filter(|bin| place >> (bin - 3) & 1 == 1);
            let other = others.map(|bin| means[bin]).sum::<Vec3>();
            let [x, y, z] = [0, 1, 2].map(|axis| of_three[axis] + f32x8::splat(other[axis]));
            let gain = (x * x + y * y + z * z) * weight;
            let is_better = gain.simd_gt(best);
            best = is_better.select(gain, best);
            at = is_better.select(f32x8::splat((place * LANES) as f32), at);
        }
        // Of lanes that gain the most, the first is taken.
        let (gains, firsts) = (best.to_array(), at.to_array());
        let mut lane = 0;
        for other in 1..LANES {
            if gains[other] > gains[lane] {
                lane = other;
            }
        }
        (gains[lane], &self.masks[usize::from(self.of_sets[firsts[lane] as usize + lane])])
    }

    fn best_bar(&self, means: &[Vec3; 8]) -> (f32, &'static Mask) {
        let mut sums = [Vec3::ZERO; 8 + 1];
        for bin in 0..8 {
            sums[bin + 1] = sums[bin] + means[bin];
        }
        let mut best = (0.0, &self.masks[0]);
        for ((weight, bar), mask) in self.bars.iter().zip(self.masks) {
            let gain = (sums[bar.end] - sums[bar.start]).length_squared() * weight;
            if gain > best.0 {
                best = (gain, mask);
            }
        }
        best
    }
}

/// The weight of the squared sum of a set of bins.
fn weight(bins: usize, set: usize) -> f32 {
    let filled = set.count_ones() as f32;
    (1.0 / filled + 1.0 / (bins as f32 - filled)) / bins as f32
}
