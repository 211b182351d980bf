//! Two pixels a cell, one above the other: the upper in the ink of `▀`, the lower behind it.

use crate::cells::{Cell, Color};
use crate::color::luminance;
use crate::palette::Palette;
use crate::style::ColorDepth;
use spherule_kernel::Vec3;

/// The cells of two rows of pixels.
///
/// Halves of the same colour are a space on that colour. Without colour each half is on or off,
/// by ordered dither: so many of them are on as there is light.
pub fn write_row(
    upper: &[Vec3],
    lower: &[Vec3],
    row: u16,
    palette: &mut Palette,
    cells: &mut [Cell],
) {
    for (column, (cell, (&upper, &lower))) in
        cells.iter_mut().zip(upper.iter().zip(lower)).enumerate()
    {
        *cell = if palette.depth() == ColorDepth::Never {
            let halves = usize::from(row) * 2;
            let glyph = match (is_on(upper, column, halves), is_on(lower, column, halves + 1)) {
                (false, false) => ' ',
                (true, false) => '▀',
                (false, true) => '▄',
                (true, true) => '█',
            };
            Cell { glyph, ..Cell::BLANK }
        } else {
            let (foreground, background) = (palette.nearest(upper), palette.nearest(lower));
            if foreground == background {
                Cell { glyph: ' ', foreground: Color::Default, background }
            } else {
                Cell { glyph: '▀', foreground, background }
            }
        };
    }
}

/// Bayer's 4 x 4 matrix: the order in which pixels come on as the light grows.
const ORDER: [[u8; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// Whether the pixel at `(x, y)` is on.
fn is_on(light: Vec3, x: usize, y: usize) -> bool {
    luminance(light) * 16.0 > f32::from(ORDER[y % 4][x % 4]) + 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(depth: ColorDepth, upper: f32, lower: f32) -> Vec<Cell> {
        let mut cells = vec![Cell::BLANK; 4];
        let (upper, lower) = ([Vec3::splat(upper); 4], [Vec3::splat(lower); 4]);
        write_row(&upper, &lower, 0, &mut Palette::new(depth), &mut cells);
        cells
    }

    #[test]
    fn halves_have_their_colours() {
        let cell = row(ColorDepth::Truecolor, 1.0, 0.0)[0];
        let (foreground, background) = (Color::Rgb([255; 3]), Color::Rgb([0; 3]));
        assert_eq!(cell, Cell { glyph: '▀', foreground, background });
    }

    #[test]
    fn equal_halves_are_a_space() {
        let cell = row(ColorDepth::Ansi256, 1.0, 1.0)[0];
        let background = Color::Ansi256(231);
        assert_eq!(cell, Cell { glyph: ' ', foreground: Color::Default, background });
    }

    #[test]
    fn without_colour_halves_are_on_or_off() {
        let glyphs = |upper, lower| {
            row(ColorDepth::Never, upper, lower).iter().map(|cell| cell.glyph).collect::<String>()
        };
        assert_eq!(glyphs(1.0, 1.0), "████");
        assert_eq!(glyphs(0.0, 0.0), "    ");
        assert_eq!(glyphs(1.0, 0.0), "▀▀▀▀");
        assert_eq!(glyphs(0.0, 1.0), "▄▄▄▄");
        assert_eq!(glyphs(0.45, 0.45), "▀▄▀▄");
    }
}
