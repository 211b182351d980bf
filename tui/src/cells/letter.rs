//! The letters: printable ASCII, and where its ink is.

use super::columns::{LANES, Line, order};
use super::masks::Cover;
use crate::ink::{DEJAVU_SANS_MONO, UNIFONT, coverage};
use std::array;
use std::ops::{Add, Div};
use std::sync::LazyLock;
use wide::f32x8;

/// Parts of a cell side by side in which ink is measured.
pub(super) const ACROSS: usize = 4;
/// All of them: 4 x 8.
pub(super) const BINS: usize = 32;

/// A letter, by the mean of both fonts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Letter {
    pub(super) glyph: char,
    /// The covered share of each of 2 x 4 parts.
    pub(super) cover: Cover,
    /// The share of the cell that is covered.
    pub(super) mean: f32,
    /// The share of each bin.
    pub(super) ink: [f32x8; BINS / LANES],
    /// The sum of squared differences of the shares from the mean.
    pub(super) energy: f32,
}

impl Letter {
    /// The share of each bin, line by line.
    pub(super) fn lines(&self) -> impl Iterator<Item = Line> + use<> {
        (0..).zip(self.ink)
    }
}

/// The means of 2 x 4 parts.
pub(super) fn of_parts<T>(bins: &[T; BINS]) -> [T; 8]
where
    T: Copy + Add<Output = T> + Div<f32, Output = T>,
{
    array::from_fn(|part| {
        let first = part / 2 * 8 + part % 2 * 2;
        (bins[first] + bins[first + 1] + bins[first + 4] + bins[first + 5]) / 4.0
    })
}

/// All letters, the space first.
pub(super) static LETTERS: LazyLock<Vec<Letter>> = LazyLock::new(|| {
    let letter = |glyph| {
        let ink = |font| coverage(font, glyph).unwrap_or([0.0; BINS]);
        let (one, other) = (ink(&UNIFONT), ink(&DEJAVU_SANS_MONO));
        let ink: [f32; BINS] = array::from_fn(|bin| (one[bin] + other[bin]) / 2.0);
        let mean = ink.iter().sum::<f32>() / BINS as f32;
        let cover = of_parts(&ink);
        let energy = ink.iter().map(|ink| (ink - mean) * (ink - mean)).sum();
        let mut places = order(ACROSS, BINS);
        let ink = array::from_fn(|_| {
            f32x8::new(array::from_fn(|_| places.next().map_or(0.0, |bin| ink[bin])))
        });
        Letter { glyph, cover, mean, ink, energy }
    };
    (' '..='~').map(letter).collect()
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_is_two_bins_by_two() {
        let bins = array::from_fn(|bin| bin as f32);
        assert_eq!(of_parts(&bins), [2.5, 4.5, 10.5, 12.5, 18.5, 20.5, 26.5, 28.5]);
    }
}
