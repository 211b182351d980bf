//! A pixel a cell: a character with as much ink as the pixel has light.

use crate::cells::{Cell, Color};
use crate::color::{lightness, luminance};
use crate::palette::Palette;
use crate::style::ColorDepth;
use spherule_kernel::Vec3;

/// Characters from little ink to much, and the part of the cell that their ink covers, in
/// thousandths: the mean of Unifont and `DejaVu` Sans Mono, in both of which it grows.
const RAMP: [(char, f32); 10] = [
    (' ', 0.0),
    ('.', 29.0),
    (':', 58.0),
    (';', 70.0),
    ('=', 103.0),
    ('x', 134.0),
    ('o', 167.0),
    ('%', 191.0),
    ('#', 230.0),
    ('@', 249.0),
];

/// The last of the ramp has the ink that stands for full light.
const FULL: f32 = RAMP[RAMP.len() - 1].1;

/// The character whose ink, beside that of the fullest, looks most like `light`, and that ink:
/// 0 for a space, 1 for the fullest.
#[must_use]
fn glyph(light: f32) -> (char, f32) {
    let wanted = lightness(light);
    let distance = |ink: f32| (lightness(ink / FULL) - wanted).abs();
    let mut best = RAMP[0];
    for candidate in &RAMP[1..] {
        if distance(candidate.1) < distance(best.1) {
            best = *candidate;
        }
    }
    (best.0, best.1 / FULL)
}

/// The cells of a row of pixels.
///
/// Without colour the character shows the luminance. With colour it shows the brightest channel,
/// and its colour makes up for the ink: ink times colour is the pixel.
pub fn write_row(pixels: &[Vec3], palette: &mut Palette, cells: &mut [Cell]) {
    for (cell, &pixel) in cells.iter_mut().zip(pixels) {
        *cell = if palette.depth() == ColorDepth::Never {
            Cell { glyph: glyph(luminance(pixel)).0, ..Cell::BLANK }
        } else {
            match glyph(pixel.max_element()) {
                (' ', _) => Cell::BLANK,
                (glyph, ink) => Cell {
                    glyph,
                    foreground: palette.nearest(pixel / ink),
                    background: Color::Default,
                },
            }
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ink_and_characters_grow_together() {
        assert!(RAMP.windows(2).all(|pair| pair[0].1 < pair[1].1));
        let shown: Vec<_> = (0..=10_000).map(|step| glyph(step as f32 / 10_000.0).1).collect();
        assert!(shown.windows(2).all(|pair| pair[0] <= pair[1]));
        let mut distinct = shown;
        distinct.dedup();
        assert_eq!(distinct.len(), RAMP.len());
    }

    #[test]
    fn black_is_blank_and_white_is_full() {
        assert_eq!(glyph(0.0).0, ' ');
        assert_eq!(glyph(1.0).0, '@');
        assert_eq!(glyph(f32::NAN).0, ' ');
    }

    #[test]
    fn colour_makes_up_for_ink() {
        let mut cells = [Cell::BLANK];
        let mut palette = Palette::new(ColorDepth::Truecolor);
        write_row(&[Vec3::new(1.0, 0.0, 0.0)], &mut palette, &mut cells);
        assert_eq!(cells[0].glyph, '@');
        assert_eq!(cells[0].foreground, Color::Rgb([255, 0, 0]));
    }
}
