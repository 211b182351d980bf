//! Samples of a cell, gathered by area into a grid of equal bins.

use super::columns::{Columns, Line, lines};
use super::masks::overlap;
use spherule_kernel::Vec3;

/// How a grid of samples is spread over a grid of bins. A sample stands for the area around it; where a bin's edge cuts
/// that area, each side gets its part.
#[derive(Clone, Debug)]
pub struct Bins {
    /// How much of each sample lies in a bin; bin after bin.
    shares: Vec<Line>,
    /// Where the shares of each bin end.
    ends: Vec<usize>,
    /// Bins a sample.
    scale: f32,
}

impl Bins {
    /// Spreads so many samples over `across` x `down` bins.
    #[must_use]
    pub fn new((across, down): (usize, usize), samples: (u32, u32)) -> Self {
        let (width, height) = (samples.0 as usize, samples.1 as usize);
        let (mut shares, mut ends) = (Vec::new(), Vec::new());
        for bin in 0..across * down {
            let share = |sample| {
                overlap((sample % width, width), (bin % across, across))
                    * overlap((sample / width, height), (bin / across, down))
            };
            let of_bin: Vec<f32> = (0..width * height).map(share).collect();
            shares.extend(lines(&of_bin, width));
            ends.push(shares.len());
        }
        Self { shares, ends, scale: (across * down) as f32 / (width * height) as f32 }
    }

    /// How much of each sample lies in bin `bin`, between 0 and 1.
    #[must_use]
    #[inline]
    pub fn shares(&self, bin: usize) -> &[Line] {
        let start = if bin == 0 { 0 } else { self.ends[bin - 1] };
        &self.shares[start..self.ends[bin]]
    }

    /// The mean of every bin; those past the grid's last are 0.
    #[must_use]
    #[inline]
    pub fn means<const N: usize>(&self, colors: &Columns) -> [Vec3; N] {
        let mut means = [Vec3::ZERO; N];
        let mut start = 0;
        for (mean, &end) in means.iter_mut().zip(&self.ends) {
            *mean = self.scale * colors.weighted_sum(self.shares[start..end].iter().copied());
            start = end;
        }
        means
    }
}

#[cfg(test)]
mod tests;
