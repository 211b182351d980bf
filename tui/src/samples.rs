//! Where in a picture of cells the rays go: every cell gets the same small grid of samples, and some a finer one.

use crate::style::{Charset, Style};

/// The most rays a cell that can be asked for: 16 x 16.
pub const MOST_SAMPLES: u32 = 256;

/// The samples of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellSamples {
    /// Samples side by side.
    pub across: u32,
    /// Samples one above the other.
    pub down: u32,
}

impl CellSamples {
    /// What every cell gets if samples go where they are needed.
    pub const FEW: Self = Self { across: 2, down: 2 };

    /// What every cell gets: [`CellSamples::FEW`], unless `style` names a number. Then it is a grid of that number whose spacing is as
    /// square as can be.
    ///
    /// If no grid of that number comes near a square (a prime number of samples; an odd number in blocks, whose halves get as many each),
    /// the next larger number that does is taken. 0 counts as 1, and more than [`MOST_SAMPLES`] as [`MOST_SAMPLES`].
    #[must_use]
    pub fn new(style: &Style) -> Self {
        let Some(samples) = style.samples else { return Self::FEW };
        let halves = match style.charset {
            Charset::Ascii => 1,
            _ => 2,
        };
        let wanted = samples.clamp(1, MOST_SAMPLES);
        // Half of the squareness is worth as much as a quarter more rays.
        let cost = |across: u32, down: u32| {
            let spacing = style.cell_aspect * down as f32 / across as f32;
            let excess = (across * down) as f32 / wanted as f32;
            spacing.ln().abs() + 3.0 * excess.ln()
        };
        let mut best = (1, wanted.next_multiple_of(halves));
        for across in 2..=wanted {
            let down = wanted.div_ceil(across).next_multiple_of(halves);
            // Glyphs are fitted to no more samples than can be asked for.
            if across * down > MOST_SAMPLES {
                continue;
            }
            // Of two grids that are as good, the wider is taken: edges that are nearly upright are the harder.
            if cost(across, down) <= cost(best.0, best.1) {
                best = (across, down);
            }
        }
        Self { across: best.0, down: best.1 }
    }

    /// What a cell gets that needs more than [`CellSamples::FEW`]; `None` if every cell gets the same.
    ///
    /// These are whole packets, and as fine as the glyphs.
    #[must_use]
    pub fn many(style: &Style) -> Option<Self> {
        let (across, down) = match style.charset {
            Charset::Sextant => (4, 12),
            // Twelve rows, as sextants want them, gain 0.2 to 0.3 dB, and take a third more of a frame.
            Charset::Block => (8, 8),
            _ => (4, 8),
        };
        style.samples.is_none().then_some(Self { across, down })
    }

    /// A finer grid for the same cells in motion, if there is time: the mean of few samples is noise, which flickers. (The error of
    /// changes, halves: 0.1 to 0.2 of chafa's.) All blocks need their own grid, and get `None`.
    #[must_use]
    pub fn finer(self, charset: Charset) -> Option<Self> {
        let down = if charset == Charset::Sextant { 12 } else { 16 };
        (charset != Charset::Block).then_some(Self { across: 8, down })
    }

    /// Coarser grids for the same cells, the finest first. They are whole packets, too.
    pub fn coarser(self) -> impl Iterator<Item = Self> {
        let grids = [(4, 12), (4, 8), (4, 4)].map(|(across, down)| Self { across, down });
        grids.into_iter().filter(move |grid| grid.count() < self.count())
    }

    /// How many they are.
    #[must_use]
    pub fn count(self) -> u32 {
        self.across * self.down
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::masks::{Repertoire, repertoire};
    use clap::ValueEnum;
    use spherule_kernel::Camera;

    fn grid(charset: Charset, samples: u32, cell_aspect: f32) -> (u32, u32) {
        let style = Style { charset, samples: Some(samples), cell_aspect, ..Style::PLAIN };
        let grid = CellSamples::new(&style);
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
            let (across, down) = grid(Charset::Block, samples, 0.5);
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

    #[test]
    fn no_grid_has_more_than_can_be_asked_for() {
        for charset in [Charset::Ascii, Charset::Half, Charset::Sextant, Charset::Block] {
            for cell_aspect in [0.2, 0.4, 0.45, 0.5, 0.6, 1.0, 2.0] {
                for samples in 1..=2 * MOST_SAMPLES {
                    let (across, down) = grid(charset, samples, cell_aspect);
                    assert!(
                        across * down <= MOST_SAMPLES,
                        "{charset:?} {samples}: {across} x {down}"
                    );
                }
            }
        }
    }

    #[test]
    fn many_are_whole_packets_and_as_fine_as_the_glyphs() {
        let (width, height) = Camera::tile::<[f32; 16]>();
        for &charset in Charset::value_variants() {
            let style = Style { charset, samples: None, ..Style::PLAIN };
            assert_eq!(CellSamples::new(&style), CellSamples::FEW);
            let many = CellSamples::many(&style).expect("by need");
            assert_eq!((many.across % width, many.down % height), (0, 0), "{charset:?}");
            assert!(many.count() <= MOST_SAMPLES);
            if charset != Charset::Ascii {
                let Repertoire { families, mosaic } = repertoire(charset);
                for family in families {
                    let (across, down) = (family.across as u32, family.down as u32);
                    assert!(across <= many.across && down <= many.down, "{charset:?}: {family:?}");
                }
                // No sample is cut by a bin of the mosaic.
                let (across, down) = (mosaic.0 as u32, mosaic.1 as u32);
                assert_eq!((many.across % across, many.down % down), (0, 0), "{charset:?}");
            }
            assert_eq!(CellSamples::many(&Style { samples: Some(4), ..style }), None);
        }
    }
}
