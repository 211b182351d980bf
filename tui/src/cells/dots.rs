//! Blocks and dots without colour: each bin of a cell is on or off.
//!
//! This is ordered dither: as many bins are on as there is light, and which ones depends on the place alone.
//!
//! Source: B. E. Bayer, "An optimum method for two-level rendition of continuous-tone pictures", 1973.

use super::masks::{overlap, repertoire};
use crate::color::luminance;
use crate::style::Charset;
use spherule_kernel::Vec3;

/// The order in which bins come on as the light grows.
const ORDER: [[u8; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// The finest bins of a charset, and what they see of the 2 x 4 parts of a cell.
#[derive(Clone, Debug)]
pub struct Dots {
    across: usize,
    down: usize,
    glyphs: &'static [char],
    /// The share of each part in each bin.
    shares: Vec<[f32; 8]>,
}

impl Dots {
    /// The bins of `charset`.
    #[must_use]
    pub fn new(charset: Charset) -> Self {
        let (across, down, glyphs) = &repertoire(charset).mosaic;
        let share = |bin: usize, part: usize| {
            let (column, row) = (bin % across, bin / across);
            // Of the bin's area, not of the part's.
            overlap((column, *across), (part % 2, 2)) * overlap((row, *down), (part / 2, 4))
        };
        let shares = (0..across * down).map(|bin| std::array::from_fn(|part| share(bin, part)));
        Self { across: *across, down: *down, glyphs, shares: shares.collect() }
    }

    /// The glyph for a cell at `(column, row)` whose parts have this light.
    #[must_use]
    pub fn glyph(&self, parts: &[Vec3; 8], (column, row): (usize, usize)) -> char {
        let light = parts.map(luminance);
        let on = |bin: usize| {
            let (x, y) =
                (column * self.across + bin % self.across, row * self.down + bin / self.across);
            let light: f32 = self.shares[bin].iter().zip(&light).map(|(a, b)| a * b).sum();
            light * 16.0 > f32::from(ORDER[y % 4][x % 4]) + 0.5
        };
        let bits = (0..self.shares.len()).filter(|&bin| on(bin)).map(|bin| 1 << bin).sum::<usize>();
        self.glyphs[bits]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glyphs(charset: Charset, upper: f32, lower: f32) -> String {
        let parts = std::array::from_fn(|part| Vec3::splat(if part < 4 { upper } else { lower }));
        (0..4).map(|column| Dots::new(charset).glyph(&parts, (column, 0))).collect()
    }

    #[test]
    fn halves_are_on_or_off() {
        assert_eq!(glyphs(Charset::Half, 1.0, 1.0), "████");
        assert_eq!(glyphs(Charset::Half, 0.0, 0.0), "    ");
        assert_eq!(glyphs(Charset::Half, 1.0, 0.0), "▀▀▀▀");
        assert_eq!(glyphs(Charset::Half, 0.0, 1.0), "▄▄▄▄");
        assert_eq!(glyphs(Charset::Half, 0.45, 0.45), "▀▄▀▄");
    }

    #[test]
    fn finer_bins_are_on_or_off() {
        assert_eq!(glyphs(Charset::Braille, 1.0, 0.0), "⠛⠛⠛⠛");
        assert_eq!(glyphs(Charset::Octant, 0.0, 1.0), "▄▄▄▄");
        // The middle third is half in the light: some of it is on.
        assert_eq!(glyphs(Charset::Sextant, 1.0, 0.0).chars().next(), Some('🬊'));
    }
}
