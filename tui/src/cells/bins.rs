//! Samples of a cell, gathered by area into a grid of equal bins.

use super::masks::overlap;
use spherule_kernel::Vec3;

/// How a grid of samples is spread over a grid of bins; a sample stands for the area around it, and where a bin's edge
/// cuts that, each side gets its part.
#[derive(Clone, Debug)]
pub struct Bins {
    /// Sample, and the part of the bin that it is; bin after bin, so that a sum stays in a register.
    shares: Vec<(u32, f32)>,
    /// Where the shares of each bin end.
    ends: Vec<usize>,
}

impl Bins {
    /// Of `across` x `down` bins from so many samples; both row by row.
    #[must_use]
    pub fn new((across, down): (usize, usize), samples: (u32, u32)) -> Self {
        let (width, height) = (samples.0 as usize, samples.1 as usize);
        let (mut shares, mut ends) = (Vec::new(), Vec::new());
        for bin in 0..across * down {
            for sample in 0..width * height {
                let share = overlap((bin % across, across), (sample % width, width))
                    * overlap((bin / across, down), (sample / width, height));
                if share > 0.0 {
                    shares.push((sample as u32, share));
                }
            }
            ends.push(shares.len());
        }
        Self { shares, ends }
    }

    /// The mean of every bin; those past the grid's last are 0.
    #[must_use]
    #[inline]
    pub fn means<const N: usize>(&self, samples: &[Vec3]) -> [Vec3; N] {
        let mut means = [Vec3::ZERO; N];
        let mut start = 0;
        for (mean, &end) in means.iter_mut().zip(&self.ends) {
            for &(sample, share) in &self.shares[start..end] {
                *mean += share * samples[sample as usize];
            }
            start = end;
        }
        means
    }

    /// Adds to `cover` how much of each sample lies in bin `bin`.
    #[inline]
    pub fn cover(&self, bin: usize, cover: &mut [f32]) {
        let start = if bin == 0 { 0 } else { self.ends[bin - 1] };
        let samples_a_bin = cover.len() as f32 / self.ends.len() as f32;
        for &(sample, share) in &self.shares[start..self.ends[bin]] {
            cover[sample as usize] += samples_a_bin * share;
        }
    }
}

#[cfg(test)]
mod tests;
