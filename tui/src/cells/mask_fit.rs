//! The mask or wedge and the two colours that come nearest to the samples of a cell.
//!
//! Glyphs are first compared by least squares, which are quick. For a mask, the best two colours are the means of what it fills and of what
//! it leaves, and the best mask takes most of the samples' variance away (`best_mask.rs`). A wedge, whose bins are partly filled, is
//! treated as a letter: it takes away `sum (g-G)(t-T)` squared over `sum (g-G)^2`, see [`letters`](super::letters).
//!
//! Of the best of each grid, the two that gain most are compared with the samples themselves. The one that [misses least](super::layers) is
//! taken, in its colours. In motion, [changes](super::change) count, and the glyph of the frame before is compared, too.
//!
//! All is compared by square roots of linear light. Of other spaces `OKLab` was as good, at ten times the cost, except that
//! glyphs of all kinds together scored below sextants alone on flake; linear light lost 1 dB on marbles.

use super::best_mask::MaskSearch;
use super::bins::Bins;
use super::braille;
use super::change;
use super::columns::Columns;
use super::eye::Eye;
use super::fitted::{FitMemory, Fitted, rank};
use super::layers::{Medians, mixed};
use super::masks::{Family, Mask, repertoire};
use super::wedges::{self, WEDGES, Wedge};
use crate::style::Charset;
use spherule_kernel::Vec3;

/// A variance of square roots that cannot be seen: the cell gets one colour.
const FLAT: f32 = 1e-6;

/// Fits masks of a charset.
#[derive(Clone, Debug)]
pub struct MaskFitter {
    /// Samples side by side.
    across: usize,
    parts: Bins,
    families: Vec<(Bins, &'static Family, MaskSearch)>,
    /// Whether there are wedges, too.
    wedges: bool,
    /// Whether bins are dots, which fill only a part of them.
    dots: bool,
    /// How many glyphs are compared with the samples one by one.
    tried: usize,
    eye: Eye,
}

/// How many glyphs are compared with the samples one by one: those that take the most variance away. (With one, FLIP is 0.01 more of
/// chafa's; three are as good as two.)
const TRIED: usize = 2;
/// For so few samples the means stand for the medians.
const FEW: usize = 4;

/// A glyph that may be the best: of a grid, or a wedge.
#[derive(Clone, Copy)]
enum Candidate<'a> {
    Mask(&'a Bins, &'a Family, &'a Mask),
    Wedge(&'static Wedge),
}

impl MaskFitter {
    /// Leaves out glyphs that are finer than the samples: nothing speaks for them.
    pub(super) fn new(charset: Charset, eye: Eye, samples: (u32, u32)) -> Self {
        let fine = |family: &&Family| {
            family.across <= samples.0 as usize && family.down <= samples.1 as usize
        };
        let families = repertoire(charset).families.iter().filter(fine);
        let bins = |family: &Family| Bins::new((family.across, family.down), samples);
        let across = wedges::ACROSS as u32;
        Self {
            across: samples.0 as usize,
            parts: Bins::new((2, 4), samples),
            families: families
                .map(|family| (bins(family), family, MaskSearch::new(family)))
                .collect(),
            wedges: charset == Charset::Block && samples == (across, across),
            dots: charset == Charset::Braille,
            // (Trying both halves loses 0.5 to 1.5 dB from afar, and comes no nearer.)
            tried: if charset == Charset::Half { 1 } else { TRIED },
            eye,
        }
    }

    pub(super) fn fit(
        &self,
        light: &[Vec3],
        memory: &mut FitMemory,
        before: Option<&Fitted>,
    ) -> Fitted {
        let FitMemory { light: columns, looks, layers } = memory;
        columns.take(light, self.across);
        looks.take_roots(columns);
        let parts = self.parts.means(columns);
        let share = 1.0 / light.len() as f32;
        let mean_look = share * looks.sum();

        // The best mask of each grid, and the best wedge: those that take most away.
        let mut best: [(f32, Option<Candidate<'_>>); TRIED] = [(FLAT, None); TRIED];
        for (bins, family, search) in &self.families {
            let means = bins.means(looks).map(|look| look - mean_look);
            let (gain, mask) = search.best(&means);
            rank(&mut best, (gain, Some(Candidate::Mask(bins, family, mask))));
        }
        if self.wedges {
            let (gain, wedge) = best_wedge(looks);
            rank(&mut best, (gain, Some(Candidate::Wedge(wedge))));
        }
        let mean = share * columns.sum();
        let mut one_color = Fitted { ink: mean, paper: mean, parts, ..Fitted::NONE };
        let mut part_looks = [Vec3::ZERO; 8];
        if before.is_some() {
            part_looks = self.parts.means(looks);
            one_color.excess = change::excess(&one_color.cover, [mean_look; 2], &part_looks);
            (one_color.ink, one_color.paper) = (mean_look * mean_look, mean_look * mean_look);
        }

        if self.dots {
            return match best[0].1 {
                Some(Candidate::Mask(bins, family, mask)) => {
                    let colors = layer_means(family, mask, &bins.means(looks));
                    braille::dots(mask.bits, colors, mean_look, self.eye.lent, parts)
                }
                _ => one_color,
            };
        }
        // Of those the one that misses least of the samples.
        let mut least = (f32::INFINITY, one_color);
        let tried = best.iter().take(self.tried).filter_map(|&(_, candidate)| candidate);
        let kept = best[0].1.and(before).and_then(|before| self.candidate(before.glyph));
        for candidate in tried.chain(kept) {
            let (glyph, of_parts) = match candidate {
                Candidate::Mask(bins, family, mask) => {
                    let filled = (0..family.bins()).filter(|bin| mask.bits >> bin & 1 == 1);
                    layers.take(light.len(), filled.flat_map(|bin| bins.shares(bin)).copied());
                    (mask.glyph, mask.cover)
                }
                Candidate::Wedge(wedge) => {
                    layers.take(light.len(), wedge.lines.iter().copied());
                    (wedge.glyph, wedge.cover)
                }
            };
            let means = layers.means(looks);
            if let Some(before) = before {
                let excess = change::excess(&of_parts, means, &part_looks);
                let cost = change::cost(layers.spread(looks, means), glyph, &excess, before);
                if cost < least.0 {
                    let [ink, paper] = means.map(|look| look * look);
                    least = (cost, Fitted { glyph, cover: of_parts, ink, paper, parts, excess });
                }
                continue;
            }
            let Medians { looks, missed } = if light.len() > FEW {
                layers.medians(looks, means)
            } else {
                Medians { looks: means, missed: 0.0 }
            };
            if missed < least.0 {
                let means = if self.eye.means > 0.0 { layers.means(columns) } else { means };
                let [ink, paper] =
                    [0, 1].map(|layer| mixed(looks[layer], means[layer], self.eye.means));
                least =
                    (missed, Fitted { glyph, cover: of_parts, ink, paper, parts, ..Fitted::NONE });
            }
        }
        least.1
    }

    /// The candidate that has this glyph.
    fn candidate(&self, glyph: char) -> Option<Candidate<'_>> {
        let mask = self.families.iter().find_map(|(bins, family, _)| {
            let mask = family.masks.iter().find(|mask| mask.glyph == glyph)?;
            Some(Candidate::Mask(bins, family, mask))
        });
        let wedge = || WEDGES.iter().find(|wedge| wedge.glyph == glyph).map(Candidate::Wedge);
        mask.or_else(|| wedge().filter(|_| self.wedges))
    }
}

/// The means of what a mask fills and of what it leaves.
fn layer_means(family: &Family, mask: &Mask, means: &[Vec3; 8]) -> [Vec3; 2] {
    let filled = mask.bits.count_ones() as f32;
    let sum = |bits: u8| {
        let bins = (0..family.bins()).filter(|bin| bits >> bin & 1 == 1);
        bins.map(|bin| means[bin]).sum::<Vec3>()
    };
    [sum(mask.bits) / filled, sum(!mask.bits) / (family.bins() as f32 - filled)]
}

/// The wedge that takes most of the variance away, and how much.
fn best_wedge(looks: &Columns) -> (f32, &'static Wedge) {
    let sum = looks.sum();
    let mut best = (0.0, &WEDGES[0]);
    for wedge in &*WEDGES {
        let pull = looks.weighted_sum(wedge.lines.iter().copied()) - wedge.mean * sum;
        let gain = pull.length_squared() / (wedge.energy * wedges::BINS as f32);
        if gain > best.0 {
            best = (gain, wedge);
        }
    }
    best
}

#[cfg(test)]
mod tests;
