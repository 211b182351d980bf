//! Letters: the one whose ink is where the light is.
//!
//! With colour, ink and paper are the least squares of the cell: for a letter that covers the share `g` of each of
//! 4 x 8 bins, light `t` there, and means `G` and `T`, the step from paper to ink that fits best is
//! `sum (g-G)(t-T) / sum (g-G)^2`, cut to what a display has, and paper is `T - G step`. Ink and paper mix in linear
//! light, so there they are fitted. Without colour the letter must have the tone as well as the shape: see [`tone`].

use super::bins::Bins;
use super::fit::Fitted;
use super::masks::Cover;
use super::tone;
use crate::ink::{DEJAVU_SANS_MONO, UNIFONT, coverage};
use crate::style::ColorDepth;
use spherule_kernel::Vec3;
use std::array;
use std::sync::LazyLock;

/// The parts of a cell in which ink is measured: 4 x 8.
const BINS: usize = 32;
/// A step in linear light that takes away less variance than this is not worth a letter.
const FLAT: f32 = 2e-7;

/// A letter, by the mean of both fonts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Letter {
    pub(super) glyph: char,
    /// Of 2 x 4 parts.
    pub(super) cover: Cover,
    /// The share of the cell that is covered.
    pub(super) mean: f32,
    /// The share of each bin, less the mean; and the sum of its squares.
    shape: [f32; BINS],
    energy: f32,
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
        Letter { glyph, cover, mean, shape, energy }
    };
    (' '..='~').map(letter).collect()
});

/// Fits letters to cells that have so many samples.
#[derive(Clone, Debug)]
pub struct LetterFitter {
    bins: Bins,
    /// Whether ink and paper have colours.
    colored: bool,
}

impl LetterFitter {
    pub(super) fn new(depth: ColorDepth, samples: (u32, u32)) -> Self {
        Self { bins: Bins::new((4, 8), samples), colored: depth != ColorDepth::Never }
    }

    pub(super) fn fit(&self, light: &[Vec3]) -> Fitted {
        let light: [Vec3; BINS] = self.bins.means(light);
        let parts = array::from_fn(|part| {
            let first = part / 2 * 8 + part % 2 * 2;
            (light[first] + light[first + 1] + light[first + 4] + light[first + 5]) / 4.0
        });
        let mean = light.iter().sum::<Vec3>() / BINS as f32;
        if !self.colored {
            let letter = tone::alone(&parts);
            let (glyph, cover) = (letter.glyph, letter.cover);
            return Fitted { glyph, cover, ink: Vec3::ONE, paper: Vec3::ZERO, parts };
        }
        // One array a channel: the compiler adds up eight bins at a time.
        let channels: [[f32; BINS]; 3] = array::from_fn(|axis| light.map(|light| light[axis]));
        let mut best = (FLAT, &LETTERS[0], Vec3::ZERO);
        for letter in &LETTERS[1..] {
            let pull = Vec3::from_array(channels.map(|channel| dot(&letter.shape, &channel)));
            let step = possible_step(letter, pull / letter.energy, mean);
            let gain = (step * (2.0 * pull - letter.energy * step)).element_sum() / BINS as f32;
            if gain > best.0 {
                best = (gain, letter, step);
            }
        }
        let (_, letter, step) = best;
        let paper = mean - letter.mean * step;
        Fitted { glyph: letter.glyph, cover: letter.cover, ink: paper + step, paper, parts }
    }
}

/// The part of a step that leaves ink and paper between black and full light.
fn possible_step(letter: &Letter, step: Vec3, mean: Vec3) -> Vec3 {
    let (covered, free) = (letter.mean, 1.0 - letter.mean);
    let up = (mean / covered).min((Vec3::ONE - mean) / free);
    let down = ((Vec3::ONE - mean) / covered).min(mean / free);
    step.min(up).max(-down)
}

fn dot(a: &[f32; BINS], b: &[f32; BINS]) -> f32 {
    let mut sums = [0.0; 8];
    for (a, b) in a.chunks_exact(8).zip(b.chunks_exact(8)) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    sums.iter().sum()
}
