//! Samples of a cell, gathered by area into a grid of equal bins.

use super::masks::overlap;
use spherule_kernel::Vec3;

/// How a grid of samples is spread over a grid of bins; a sample stands for the area around it, and where a bin's edge
/// cuts that, each side gets its part.
#[derive(Clone, Debug)]
pub struct Bins {
    /// Sample, bin, and the part of the bin that the sample is.
    shares: Vec<(u16, u16, f32)>,
}

impl Bins {
    /// Of `across` x `down` bins from so many samples; both row by row.
    #[must_use]
    pub fn new((across, down): (usize, usize), samples: (u32, u32)) -> Self {
        let (width, height) = (samples.0 as usize, samples.1 as usize);
        let cells =
            (0..across * down).flat_map(|bin| (0..width * height).map(move |sample| (bin, sample)));
        let share = |bin: usize, sample: usize| {
            overlap((bin % across, across), (sample % width, width))
                * overlap((bin / across, down), (sample / width, height))
        };
        let shares = cells.map(|(bin, sample)| (sample as u16, bin as u16, share(bin, sample)));
        Self { shares: shares.filter(|&(_, _, share)| share > 0.0).collect() }
    }

    /// The mean of every bin; those past the grid's last are 0.
    #[must_use]
    #[inline]
    pub fn means<const N: usize>(&self, samples: &[Vec3]) -> [Vec3; N] {
        let mut means = [Vec3::ZERO; N];
        for &(sample, bin, share) in &self.shares {
            means[usize::from(bin)] += share * samples[usize::from(sample)];
        }
        means
    }
}

#[cfg(test)]
mod tests;
