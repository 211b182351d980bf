//! Neighbours make up for what a cell cannot show with two colours: one step of back-projection.
//!
//! From across the room an eye sees the picture blurred by some half of a cell's width. The difference between the samples and what the
//! glyphs show is blurred alike, in linear light. The part of it that comes to lie on a glyph's ink, or on its paper, is added to that
//! colour: the farther away the [eye](super::eye) is, the more.
//!
//! From the chair a correction is seen as a mark of its own. So a colour stays within what was sampled under it: what is even
//! stays even, whatever lies beside it, and nothing is handed across a silhouette. (Up to 0.75 and 1.3 of it, as once, drew a ring of darker
//! cells around every ball: with halves, FLIP was 0.02 to 0.1 more of chafa's, for 0.3 to 1.1 dB from afar.)
//!
//! Source: M. Irani and S. Peleg, "Improving resolution by image registration", 1991, for the step.

use super::fitted::Fitted;
use crate::color::roots;
use crate::style::Charset;
use spherule_kernel::Vec3;
use std::ops::Range;

/// A Gaussian whose sigma is a part of a cell, that is half a cell's width, cut at three sigma; it adds up to one.
pub(super) const TAPS: [f32; 7] = [
    0.004_433_048,
    0.054_005_58,
    0.242_036_23,
    0.399_050_28,
    0.242_036_23,
    0.054_005_58,
    0.004_433_048,
];
const RADIUS: usize = TAPS.len() / 2;

/// Corrects colours, and keeps its memory.
#[derive(Clone, Debug, Default)]
pub struct Residual {
    /// A row of parts, with a margin on both sides; three numbers a part.
    row: Vec<f32>,
    /// Rows of parts, blurred from left to right.
    blurred: Vec<f32>,
}

/// A part counts as a layer's own if the layer covers more than this of it: letters cover less than half of any part.
const SOME: f32 = 0.1;

/// A part that looks farther from a colour than this, as a distance of square roots of light, is beyond a silhouette: where glyphs are
/// fine, nothing is handed across it. (With 0.2, FLIP of sextants is 0.006 less of chafa's, and flake has 0.6 dB less from afar.)
const SILHOUETTE: f32 = 0.3;

/// How much is handed on, and across what.
#[derive(Clone, Copy, Debug)]
pub struct Handing {
    /// The share of what is lacking that is handed on.
    pub share: f32,
    /// The square of the distance beyond which a part says nothing of a colour.
    across: f32,
}

impl Handing {
    /// Hands on so much in these characters. Halves, quarters and letters are so coarse that from afar they need what is beyond
    /// silhouettes, too: with a limit of 0.2, halves of marbles are 1.2 dB behind chafa's.
    #[must_use]
    pub fn new(share: f32, charset: Charset) -> Self {
        let is_fine = matches!(charset, Charset::Sextant | Charset::Octant | Charset::Block);
        Self { share, across: if is_fine { SILHOUETTE * SILHOUETTE } else { f32::INFINITY } }
    }
}

/// How dark and how bright a correction may make ink (0) or paper (1): as its own parts are, and no more. So an even area stays even;
/// otherwise a neighbour's edge would be seen in it as a mark of its own.
fn limits(fit: &Fitted, layer: usize, color: Vec3, across: f32) -> [Vec3; 2] {
    let (mut low, mut high) = (color, color);
    let look = roots(color);
    for (&part, cover) in fit.parts.iter().zip(fit.cover) {
        let own = if layer == 0 { cover } else { 1.0 - cover };
        if own > SOME && (roots(part) - look).length_squared() < across {
            low = low.min(part);
            high = high.max(part);
        }
    }
    // Light may be more than a display has.
    [low, high].map(|limit| limit.clamp(Vec3::ZERO, Vec3::ONE))
}

impl Residual {
    /// Writes to `corrected` the colours of ink and paper of the cells of `rows`. What their neighbours in `fits`, a picture of so many
    /// `columns`, cannot show is added to them, as far as `handing` says. Past the edges the picture goes on as it ends.
    pub fn correct(
        &mut self,
        fits: &[Fitted],
        columns: usize,
        rows: Range<usize>,
        handing: Handing,
        corrected: &mut Vec<[Vec3; 2]>,
    ) {
        if handing.share == 0.0 {
            corrected.clear();
            let own = &fits[rows.start * columns..rows.end * columns];
            corrected.extend(own.iter().map(|fit| [fit.ink, fit.paper]));
            return;
        }
        let (height, width) = (4 * (fits.len() / columns), 2 * columns * 3);
        let (first, last) = (4 * rows.start, 4 * rows.end);
        self.blurred.clear();
        for row in first..last + 2 * RADIUS {
            let row = row.saturating_sub(RADIUS).min(height - 1);
            self.blur_row(&fits[row / 4 * columns..][..columns], row % 4);
        }
        let mut seen = vec![0.0; width];
        let mut sums = vec![[Vec3::ZERO; 2]; columns];
        let mut covers = vec![[0.0; 2]; columns];
        corrected.clear();
        for row in rows {
            sums.fill([Vec3::ZERO; 2]);
            covers.fill([0.0; 2]);
            let fits = &fits[row * columns..][..columns];
            for part_row in 0..4 {
                // From top to bottom.
                seen.fill(0.0);
                let start = 4 * row + part_row - first;
                for (tap, row) in TAPS.iter().zip(self.blurred[start * width..].chunks(width)) {
                    seen.iter_mut().zip(row).for_each(|(seen, value)| *seen += tap * value);
                }
                for (column, fit) in fits.iter().enumerate() {
                    for side in 0..2 {
                        let seen = Vec3::from_slice(&seen[3 * (2 * column + side)..]);
                        let cover = fit.cover[2 * part_row + side];
                        for (layer, cover) in [cover, 1.0 - cover].into_iter().enumerate() {
                            sums[column][layer] += cover * seen;
                            covers[column][layer] += cover;
                        }
                    }
                }
            }
            corrected.extend(fits.iter().zip(&sums).zip(&covers).map(|((fit, sums), covers)| {
                [0, 1].map(|layer| {
                    let color = if layer == 0 { fit.ink } else { fit.paper };
                    // A layer that covers nothing has no colour.
                    let cover = covers[layer];
                    if cover <= 0.0 || sums[layer] == Vec3::ZERO {
                        return color;
                    }
                    let more = handing.share * sums[layer] / cover;
                    let [low, high] = limits(fit, layer, color, handing.across);
                    (color + more).clamp(low, high)
                })
            }));
        }
    }

    /// Appends what the parts of a row of cells lack, blurred from left to right.
    fn blur_row(&mut self, fits: &[Fitted], part_row: usize) {
        let row = &mut self.row;
        row.clear();
        row.resize(3 * RADIUS, 0.0);
        for fit in fits {
            for part in [2 * part_row, 2 * part_row + 1] {
                let shown = fit.paper + fit.cover[part] * (fit.ink - fit.paper);
                row.extend_from_slice(&(fit.parts[part] - shown).to_array());
            }
        }
        let end = row.len();
        for _ in 0..RADIUS {
            row.extend_from_within(end - 3..end);
        }
        let (margin, first) = row.split_at_mut(3 * RADIUS);
        margin.chunks_mut(3).for_each(|part| part.copy_from_slice(&first[..3]));

        let start = self.blurred.len();
        let width = end - 3 * RADIUS;
        self.blurred.resize(start + width, 0.0);
        for (tap, from) in TAPS.iter().zip((0..).step_by(3)) {
            let blurred = &mut self.blurred[start..];
            let shifted = &self.row[from..from + width];
            blurred.iter_mut().zip(shifted).for_each(|(blurred, value)| *blurred += tap * value);
        }
    }
}

#[cfg(test)]
mod tests;
