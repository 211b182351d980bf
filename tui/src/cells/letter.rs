//! The letters: printable ASCII, and where its ink is.

use super::layers::in_lines;
use super::masks::Cover;
use crate::ink::{DEJAVU_SANS_MONO, UNIFONT, coverage};
use std::array;
use std::sync::LazyLock;
use wide::f32x8;

/// The parts of a cell in which ink is measured: 4 x 8.
pub(super) const BINS: usize = 32;

/// A letter, by the mean of both fonts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Letter {
    pub(super) glyph: char,
    /// Of 2 x 4 parts.
    pub(super) cover: Cover,
    /// The share of the cell that is covered.
    pub(super) mean: f32,
    /// The share of each bin; the same less the mean, and the sum of its squares.
    pub(super) ink: [f32; BINS],
    pub(super) shape: [f32x8; BINS / 8],
    pub(super) energy: f32,
}

/// All letters, the space first.
pub(super) static LETTERS: LazyLock<Vec<Letter>> = LazyLock::new(|| {
    let letter = |glyph| {
        let ink = |font| coverage(font, glyph).unwrap_or([0.0; BINS]);
        let (one, other) = (ink(&UNIFONT), ink(&DEJAVU_SANS_MONO));
        let ink: [f32; BINS] = array::from_fn(|bin| (one[bin] + other[bin]) / 2.0);
        let mean = ink.iter().sum::<f32>() / BINS as f32;
        let shape = ink.map(|ink| ink - mean);
        let cover = array::from_fn(|part| {
            let first = part / 2 * 8 + part % 2 * 2;
            (ink[first] + ink[first + 1] + ink[first + 4] + ink[first + 5]) / 4.0
        });
        let energy = shape.iter().map(|ink| ink * ink).sum();
        Letter { glyph, cover, mean, ink, shape: in_lines(&shape), energy }
    };
    (' '..='~').map(letter).collect()
});
