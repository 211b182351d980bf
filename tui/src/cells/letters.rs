//! Letters: the one whose ink is where the light is.
//!
//! With colour, letters are first compared by least squares. A letter covers the share `g` of each of 4 x 8 bins, in which the cell looks
//! like `t`; their means are `G` and `T`. Seen as bins, the step from paper to ink that fits best is `sum (g-G)(t-T) / sum (g-G)^2`. Seen
//! as pixels, which are either ink or paper, it is the difference of the means of both, `sum (g-G)(t-T) / n G(1-G)`. This step is less,
//! since a thin letter in a loud colour stands out from what it is to stand for. The [eye](super::eye) is somewhere between the two; steps
//! are cut to what a display has. Of the letters that gain most, and the space, the one that [misses least](super::layers) is taken. (With
//! bins alone, the FLIP of letters was 0.98 to 1.10 of chafa's, and their SSIM 0.03 to 0.07 below.) In motion, [changes](super::change)
//! count, too. Without colour the letter must have the tone as well as the shape: see [`tone`].

use super::bins::Bins;
use super::change;
use super::eye::Eye;
use super::fitted::{FitMemory, Fitted, rank};
use super::layers::{Medians, mixed};
use super::letter::{ACROSS, BINS, LETTERS, Letter, of_parts};
use super::tone;
use crate::color::roots;
use crate::style::ColorDepth;
use spherule_kernel::Vec3;
use std::array;

/// A step that takes away less variance than this is not worth a letter.
const FLAT: f32 = 2e-7;
/// How many letters are compared with the samples one by one, besides the space.
const TRIED: usize = 3;

/// Fits letters to cells that have so many samples.
#[derive(Clone, Debug)]
pub struct LetterFitter {
    /// `None` if there is one sample a bin.
    bins: Option<Bins>,
    /// Samples side by side.
    across: usize,
    /// Whether ink and paper have colours.
    colored: bool,
    eye: Eye,
}

impl LetterFitter {
    pub(super) fn new(depth: ColorDepth, eye: Eye, samples: (u32, u32)) -> Self {
        let grid = (ACROSS, BINS / ACROSS);
        let across = samples.0 as usize;
        let is_it = (across, samples.1 as usize) == grid;
        let bins = (!is_it).then(|| Bins::new(grid, samples));
        Self { bins, across, colored: depth != ColorDepth::Never, eye }
    }

    pub(super) fn fit(
        &self,
        light: &[Vec3],
        memory: &mut FitMemory,
        before: Option<&Fitted>,
    ) -> Fitted {
        let FitMemory { light: samples, looks: columns, layers } = memory;
        let light: [Vec3; BINS] = match &self.bins {
            None => array::from_fn(|bin| light[bin]),
            Some(bins) => {
                samples.take(light, self.across);
                bins.means(samples)
            }
        };
        let parts = of_parts(&light);
        if !self.colored {
            let letter = tone::alone(&parts);
            let (glyph, cover) = (letter.glyph, letter.cover);
            return Fitted { glyph, cover, ink: Vec3::ONE, parts, ..Fitted::NONE };
        }
        let looks = light.map(roots);
        let mean = looks.iter().sum::<Vec3>() / BINS as f32;
        columns.take(&looks, ACROSS);
        let sum = columns.sum();

        let mut best = [(FLAT, (&LETTERS[0], Vec3::ZERO)); TRIED];
        let fit_of = |letter: &'static Letter| {
            let of_pixels = BINS as f32 * letter.mean * (1.0 - letter.mean);
            let energy = of_pixels + self.eye.lent * (letter.energy - of_pixels);
            let pull = columns.times(&letter.ink) - letter.mean * sum;
            let step = possible_step(letter, pull / energy, mean);
            let gain = (step * (2.0 * pull - energy * step)).element_sum() / BINS as f32;
            (gain, (letter, step))
        };
        for letter in &LETTERS[1..] {
            rank(&mut best, fit_of(letter));
        }
        let space = (0.0, (&LETTERS[0], Vec3::ZERO));
        let tried = best.into_iter().filter(|&(gain, _)| gain > FLAT);
        if let Some(before) = before {
            let kept = LETTERS[1..].iter().find(|letter| letter.glyph == before.glyph).map(fit_of);
            let part_looks = of_parts(&looks);
            let variance =
                looks.iter().map(|look| look.distance_squared(mean)).sum::<f32>() / BINS as f32;
            let mut least = (f32::INFINITY, Fitted::NONE);
            for (gain, (letter, step)) in tried.chain(kept).chain([space]) {
                let paper = mean - letter.mean * step;
                let colors = [paper + step, paper].map(|look| look.max(Vec3::ZERO));
                let excess = change::excess(&letter.cover, colors, &part_looks);
                let cost = change::cost(variance - gain, letter.glyph, &excess, before);
                if cost < least.0 {
                    let [ink, paper] = colors.map(|look| look * look);
                    let (glyph, cover) = (letter.glyph, letter.cover);
                    least = (cost, Fitted { glyph, cover, ink, paper, parts, excess });
                }
            }
            return least.1;
        }
        let mut least = (f32::INFINITY, Fitted { parts, ..Fitted::NONE });
        for (_, (letter, step)) in tried.chain([space]) {
            let paper = mean - letter.mean * step;
            let means = [paper + step, paper];
            layers.take(BINS, letter.lines());
            let Medians { looks, missed } = layers.medians(columns, means);
            if missed < least.0 {
                let [ink, paper] = [0, 1]
                    .map(|layer| mixed(looks[layer], means[layer] * means[layer], self.eye.means));
                let (glyph, cover) = (letter.glyph, letter.cover);
                least = (missed, Fitted { glyph, cover, ink, paper, parts, ..Fitted::NONE });
            }
        }
        least.1
    }
}

/// The part of a step that leaves ink and paper between black and full light.
fn possible_step(letter: &Letter, step: Vec3, mean: Vec3) -> Vec3 {
    let (covered, free) = (letter.mean, 1.0 - letter.mean);
    let up = (mean / covered).min((Vec3::ONE - mean) / free);
    let down = ((Vec3::ONE - mean) / covered).min(mean / free);
    step.min(up).max(-down)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::columns::order;

    #[test]
    fn light_in_the_shape_of_a_letter_is_that_letter() {
        let fitters = [(4, 8), (8, 16)]
            .map(|samples| LetterFitter::new(ColorDepth::Truecolor, Eye::at(1e6), samples));
        let mut found = 0;
        for letter in &LETTERS[1..] {
            let mut look = [0.0; BINS];
            let lines = letter.ink.iter().flat_map(|line| line.to_array());
            for (bin, ink) in order(ACROSS, BINS).zip(lines) {
                look[bin] = 0.2 + 0.5 * ink;
            }
            // A sample a bin; then four.
            let light = [1, 2].map(|times| {
                let bin = |x: usize, y: usize| look[y / times * ACROSS + x / times];
                let rows = (0..8 * times).flat_map(|y| (0..ACROSS * times).map(move |x| (x, y)));
                rows.map(|(x, y)| Vec3::splat(bin(x, y) * bin(x, y))).collect::<Vec<_>>()
            });
            let [one, four] =
                [0, 1].map(|grid| fitters[grid].fit(&light[grid], &mut FitMemory::default(), None));
            assert_eq!(one.glyph, four.glyph);
            assert!((one.ink - four.ink).abs().max_element() < 1e-4, "{}", letter.glyph);
            found += usize::from(one.glyph == letter.glyph);
        }
        // (For the others, a letter that is much like them misses less.)
        assert!(found >= 81, "{found} of 94");
    }
}
