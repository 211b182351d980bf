//! The letters: printable ASCII, and where its ink is.

use super::columns::{LANES, Line, order};
use super::masks::Cover;
use crate::ink::{DEJAVU_SANS_MONO, UNIFONT, coverage};
use std::array;
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

/// All letters, the space first.
pub(super) static LETTERS: LazyLock<Vec<Letter>> = LazyLock::new(|| {
    let letter = |glyph| {
        let ink = |font| coverage(font, glyph).unwrap_or([0.0; BINS]);
        let (one, other) = (ink(&UNIFONT), ink(&DEJAVU_SANS_MONO));
        let ink: [f32; BINS] = array::from_fn(|bin| (one[bin] + other[bin]) / 2.0);
        let mean = ink.iter().sum::<f32>() / BINS as f32;
        let cover = array::from_fn(|part| {
            let first = part / 2 * 8 + part % 2 * 2;
            (ink[first] + ink[first + 1] + ink[first + 4] + ink[first + 5]) / 4.0
        });
        let energy = ink.iter().map(|ink| (ink - mean) * (ink - mean)).sum();
        let mut places = order(ACROSS, BINS);
        let ink = array::from_fn(|_| {
            f32x8::new(array::from_fn(|_| places.next().map_or(0.0, |bin| ink[bin])))
        });
        Letter { glyph, cover, mean, ink, energy }
    };
    (' '..='~').map(letter).collect()
});
