//! Dots of Braille in two colours, where a cell is the lighter; they are brighter for an eye far away.

use super::fitted::Fitted;
use super::masks::repertoire;
use crate::color::luminance;
use crate::style::Charset;
use spherule_kernel::Vec3;

/// The part of its bin that a dot of Braille fills, in most fonts.
pub(super) const DOT: f32 = 0.25;

/// Dots where a cell is the lighter. They are brighter than the light there, since they cover little.
pub(super) fn dots(
    bits: u8,
    [ink, paper]: [Vec3; 2],
    mean: Vec3,
    lent: f32,
    parts: [Vec3; 8],
) -> Fitted {
    let darker = luminance(ink) < luminance(paper);
    let (bits, ink) = if darker { (!bits, paper) } else { (bits, ink) };
    let glyphs = &repertoire(Charset::Braille).mosaic.2;
    let cover = std::array::from_fn(|bin| if bits >> bin & 1 == 1 { DOT } else { 0.0 });
    // As for letters, the covered share is `g`, and its mean `G`.
    let filled = bits.count_ones() as f32 / 8.0;
    let share = DOT * filled;
    let of_bins = DOT * DOT * filled * (1.0 - filled);
    let of_pixels = share * (1.0 - share);
    let energy = of_pixels + lent * (of_bins - of_pixels);
    let step = share * (ink - mean) / energy;
    let [ink, paper] = [mean + (1.0 - share) * step, mean - share * step]
        .map(|look| look.clamp(Vec3::ZERO, Vec3::ONE))
        .map(|look| look * look);
    Fitted { glyph: glyphs[usize::from(bits)], cover, ink, paper, parts, ..Fitted::NONE }
}
