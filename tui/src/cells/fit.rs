//! The glyph and the two colours that come nearest to what was sampled of a cell.
//!
//! Least squares: for a mask, the best two colours are the means of what it fills and of what it leaves, and the best
//! mask is the one that takes most of the samples' variance away. With the mean of the cell subtracted, a mask that
//! fills `n` of `m` equal bins whose sum is `s` takes away `|s|^2 (1/n + 1/(m-n)) / m` of it. The sums of all masks of
//! a grid are those of the masks of its lower four bins plus those of its upper four.
//!
//! Masks are compared by square roots of linear light. The colours are means in linear light, which is what the eye
//! averages. Of other spaces `OKLab` was as good, at ten times the cost, except that glyphs of all kinds together scored
//! below sextants alone on flake; linear light lost 1 dB on marbles.

use super::bins::Bins;
use super::letters::LetterFitter;
use super::masks::{Cover, Family, Mask, repertoire};
use crate::color::{luminance, roots};
use crate::samples::CellSamples;
use crate::style::{Charset, Style};
use spherule_kernel::Vec3;

/// A variance of square roots that nobody sees: the cell gets one colour.
const FLAT: f32 = 1e-6;

/// A glyph, and linear light for what it fills, for what it leaves, and for the 2 x 4 parts of the cell as they were
/// sampled.
#[derive(Clone, Copy, Debug)]
pub struct Fitted {
    /// The character.
    pub glyph: char,
    /// What it fills of each part.
    pub cover: Cover,
    /// The light of what it fills.
    pub ink: Vec3,
    /// The light of what it leaves.
    pub paper: Vec3,
    /// The light of the parts.
    pub parts: [Vec3; 8],
}

impl Fitted {
    /// Black.
    pub const NONE: Self = Self {
        glyph: ' ',
        cover: Mask::SPACE.cover,
        ink: Vec3::ZERO,
        paper: Vec3::ZERO,
        parts: [Vec3::ZERO; 8],
    };

    /// How much of the cell the glyph covers.
    #[must_use]
    pub fn share(&self) -> f32 {
        self.cover.iter().sum::<f32>() / 8.0
    }
}

/// Fits glyphs to cells that have so many samples.
#[derive(Clone, Debug)]
pub enum Fitter {
    /// Geometry, in two colours.
    Masks(MaskFitter),
    /// Letters.
    Letters(LetterFitter),
}

impl Fitter {
    /// Of what `style` asks for.
    #[must_use]
    pub fn new(style: &Style, samples: CellSamples) -> Self {
        let grid = (samples.across, samples.down);
        match style.charset {
            Charset::Ascii => Self::Letters(LetterFitter::new(style.depth, grid)),
            charset => Self::Masks(MaskFitter::new(charset, grid)),
        }
    }

    /// The fit to `light`, the cell's samples row by row; `memory` is used and left as it happens to be.
    #[must_use]
    pub fn fit(&self, light: &[Vec3], memory: &mut Vec<Vec3>) -> Fitted {
        match self {
            Self::Masks(fitter) => fitter.fit(light, memory),
            Self::Letters(fitter) => fitter.fit(light),
        }
    }
}

/// Fits masks of a charset.
#[derive(Clone, Debug)]
pub struct MaskFitter {
    parts: Bins,
    families: Vec<(Bins, &'static Family)>,
    /// Whether bins are dots, which fill only some of them.
    dots: bool,
}

impl MaskFitter {
    /// Glyphs that are finer than the samples are left out: nothing speaks for them.
    fn new(charset: Charset, samples: (u32, u32)) -> Self {
        let fine = |family: &&Family| {
            family.across <= samples.0 as usize && family.down <= samples.1 as usize
        };
        let families = repertoire(charset).families.iter().filter(fine);
        let bins = |family: &Family| Bins::new((family.across, family.down), samples);
        Self {
            parts: Bins::new((2, 4), samples),
            families: families.map(|family| (bins(family), family)).collect(),
            dots: charset == Charset::Braille,
        }
    }

    fn fit(&self, light: &[Vec3], looks: &mut Vec<Vec3>) -> Fitted {
        looks.clear();
        looks.extend(light.iter().map(|&light| roots(light)));
        let parts = self.parts.means(light);
        let share = 1.0 / light.len() as f32;
        let mean_look = share * looks.iter().sum::<Vec3>();

        // The best mask of each grid, and of those the best.
        let mut best = (FLAT, None);
        for (bins, family) in &self.families {
            let means = bins.means(looks).map(|look| look - mean_look);
            let (gain, mask) = best_mask(family, &means);
            if gain > best.0 {
                best = (gain, Some((bins, family, mask)));
            }
        }
        let mean = share * light.iter().sum::<Vec3>();
        let Some((bins, family, mask)) = best.1 else {
            return Fitted { ink: mean, paper: mean, parts, ..Fitted::NONE };
        };
        let means: [Vec3; 8] = bins.means(light);
        let filled = mask.bits.count_ones() as f32;
        let sum = |bits: u8| {
            let bins = (0..family.bins()).filter(|bin| bits >> bin & 1 == 1);
            bins.map(|bin| means[bin]).sum::<Vec3>()
        };
        let ink = sum(mask.bits) / filled;
        let paper = sum(!mask.bits) / (family.bins() as f32 - filled);
        if self.dots {
            return dots(mask.bits, [ink, paper], parts);
        }
        Fitted { glyph: mask.glyph, cover: mask.cover, ink, paper, parts }
    }
}

/// The part of its bin that a dot of Braille fills, in most fonts.
const DOT: f32 = 0.25;

/// Dots where a cell is the lighter, so bright that they make up for what they leave, so far as a display can.
fn dots(bits: u8, [ink, paper]: [Vec3; 2], parts: [Vec3; 8]) -> Fitted {
    let darker = luminance(ink) < luminance(paper);
    let (bits, ink, paper) = if darker { (!bits, paper, ink) } else { (bits, ink, paper) };
    let glyphs = &repertoire(Charset::Braille).mosaic.2;
    let cover = std::array::from_fn(|bin| if bits >> bin & 1 == 1 { DOT } else { 0.0 });
    let ink = (paper + (ink - paper) / DOT).clamp(Vec3::ZERO, Vec3::ONE);
    Fitted { glyph: glyphs[usize::from(bits)], cover, ink, paper, parts }
}

/// The mask that takes most of the variance away, and how much; the means of the bins are around 0.
fn best_mask<'a>(family: &'a Family, means: &[Vec3; 8]) -> (f32, &'a Mask) {
    // Halves: one mask of two bins, whose means are each other's opposites. Its gain is the square of either.
    if let ([mask], 2) = (&*family.masks, family.bins()) {
        return (means[usize::from(mask.bits >> 1)].length_squared(), mask);
    }
    // The sums of all sets of the lower four bins and of the upper four.
    let mut sums = [[Vec3::ZERO; 16]; 2];
    for (sums, means) in sums.iter_mut().zip(means.chunks(4)) {
        for set in 1..16_usize {
            let lowest = set.trailing_zeros() as usize;
            sums[set] = sums[set & (set - 1)] + means[lowest];
        }
    }
    let bins = family.bins();
    let weights: [f32; 8 + 1] = std::array::from_fn(|filled| {
        let left = bins.saturating_sub(filled).max(1);
        (1.0 / filled.max(1) as f32 + 1.0 / left as f32) / bins as f32
    });
    let mut best = (0.0, &family.masks[0]);
    for mask in &family.masks {
        let sum = sums[0][usize::from(mask.bits & 15)] + sums[1][usize::from(mask.bits >> 4)];
        let gain = sum.length_squared() * weights[mask.bits.count_ones() as usize];
        if gain > best.0 {
            best = (gain, mask);
        }
    }
    best
}

#[cfg(test)]
mod tests;
