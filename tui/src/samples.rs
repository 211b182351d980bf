//! Where in a picture of cells the rays go: every cell gets the same small grid of samples.

use crate::style::{Charset, Style};

/// The most rays a cell: 16 x 16.
pub const MOST_SAMPLES: u32 = 256;

/// The samples of a cell, and of its pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellSamples {
    /// Samples side by side in a cell; a pixel is as wide as its cell.
    pub across: u32,
    /// Samples one above the other in a cell: a multiple of `pixels`.
    pub down: u32,
    /// Pixels one above the other in a cell: two for half blocks.
    pub pixels: u32,
}

impl CellSamples {
    /// A grid of `style.samples` samples whose spacing is as square as can be.
    ///
    /// If no grid of that number comes near a square (a prime number of samples; an odd number in
    /// half blocks, whose halves get as many each), it is the next larger that does. 0 counts as 1,
    /// more than [`MOST_SAMPLES`] as that.
    #[must_use]
    pub fn new(style: &Style) -> Self {
        let pixels = match style.charset {
            Charset::Ascii => 1,
            Charset::Half => 2,
        };
        let wanted = style.samples.clamp(1, MOST_SAMPLES);
        // Half of the squareness is worth as much as a quarter more rays.
        let cost = |across: u32, down: u32| {
            let spacing = style.cell_aspect * down as f32 / across as f32;
            let excess = (across * down) as f32 / wanted as f32;
            spacing.ln().abs() + 3.0 * excess.ln()
        };
        let mut best = (1, wanted.next_multiple_of(pixels));
        for across in 2..=wanted {
            let down = wanted.div_ceil(across).next_multiple_of(pixels);
            // Of two grids as good, the wider: edges that are nearly upright are the harder.
            if cost(across, down) <= cost(best.0, best.1) {
                best = (across, down);
            }
        }
        Self { across: best.0, down: best.1, pixels }
    }

    /// How many samples a pixel has.
    #[must_use]
    pub fn per_pixel(self) -> u32 {
        self.across * self.down / self.pixels
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(charset: Charset, samples: u32, cell_aspect: f32) -> (u32, u32) {
        let grid = CellSamples::new(&Style { charset, samples, cell_aspect, ..Style::PLAIN });
        (grid.across, grid.down)
    }

    #[test]
    fn the_grid_is_near_square() {
        assert_eq!(grid(Charset::Ascii, 1, 0.5), (1, 1));
        assert_eq!(grid(Charset::Ascii, 2, 0.5), (1, 2));
        assert_eq!(grid(Charset::Ascii, 4, 0.5), (2, 2));
        assert_eq!(grid(Charset::Ascii, 8, 0.5), (2, 4));
        assert_eq!(grid(Charset::Ascii, 16, 1.0), (4, 4));
        assert_eq!(grid(Charset::Ascii, 18, 0.5), (3, 6));
    }

    #[test]
    fn halves_have_as_many_samples_each() {
        assert_eq!(grid(Charset::Half, 1, 0.5), (1, 2));
        assert_eq!(grid(Charset::Half, 4, 0.5), (2, 2));
        for samples in 1..=MOST_SAMPLES {
            let (across, down) = grid(Charset::Half, samples, 0.5);
            assert!(down % 2 == 0 && across * down >= samples, "{samples}: {across} x {down}");
        }
    }

    #[test]
    fn awkward_numbers_grow_a_little_and_never_much() {
        for samples in 1..=MOST_SAMPLES {
            let (across, down) = grid(Charset::Ascii, samples, 0.5);
            assert!(across * down >= samples && across * down <= samples + samples / 2 + 1);
        }
        assert_eq!(grid(Charset::Ascii, 0, 0.5), (1, 1));
        assert_eq!(grid(Charset::Ascii, u32::MAX, 0.5), grid(Charset::Ascii, 256, 0.5));
        assert_eq!(grid(Charset::Ascii, 9, f32::NAN), (1, 9));
    }
}
