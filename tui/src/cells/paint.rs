//! From fitted glyphs to cells: the colours that the terminal has.

use super::fit::Fitted;
use super::residual::Residual;
use super::{Cell, Color};
use crate::palette::Palette;
use crate::style::{ColorDepth, Style};
use spherule_kernel::Vec3;

/// Paints, and keeps its memory.
#[derive(Debug)]
pub struct Painter {
    palette: Palette,
    residual: Residual,
    corrected: Vec<[Vec3; 2]>,
}

impl Default for Painter {
    fn default() -> Self {
        Self {
            palette: Palette::new(ColorDepth::Never),
            residual: Residual::default(),
            corrected: Vec::new(),
        }
    }
}

impl Painter {
    /// Fills `cells`, whole rows of so many `columns` from row `first` on, by `fits` that begin with row `known`.
    pub fn paint(
        &mut self,
        style: &Style,
        (fits, known): (&[Fitted], usize),
        columns: usize,
        first: usize,
        cells: &mut [Cell],
    ) {
        if self.palette.depth() != style.depth {
            self.palette = Palette::new(style.depth);
        }
        let rows = first - known..first - known + cells.len() / columns;
        let own = &fits[rows.start * columns..rows.end * columns];
        if style.depth == ColorDepth::Never {
            for (cell, fit) in cells.iter_mut().zip(own) {
                *cell = Cell { glyph: fit.glyph, ..Cell::BLANK };
            }
            return;
        }
        self.residual.correct(fits, columns, rows, &mut self.corrected);
        for ((cell, fit), colors) in cells.iter_mut().zip(own).zip(&self.corrected) {
            let [foreground, background] = colors.map(|color| self.palette.nearest(color));
            *cell = if foreground == background || fit.glyph == ' ' {
                Cell { glyph: ' ', foreground: Color::Default, background }
            } else {
                Cell { glyph: fit.glyph, foreground, background }
            };
        }
    }
}
