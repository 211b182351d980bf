//! From fitted glyphs to cells: the colours that the terminal has.

use super::dither::Dither;
use super::dots::Dots;
use super::eye::Eye;
use super::fitted::Fitted;
use super::residual::{Handing, Residual};
use super::shades::Shades;
use super::tone::Tones;
use super::{Cell, Color};
use crate::color::{Srgb, oklab};
use crate::palette::{Theme, entries};
use crate::style::{Charset, ColorDepth, Style};
use spherule_kernel::Vec3;

/// In motion a cell that shows one entry of a palette goes on to show one, up to this squared distance of ink and paper in `OKLab`. A cell
/// that shows two entries goes on to show two while they differ. (With 256 colours the error of changes on flake is 1.02 of chafa's; 1.07
/// if all cells below the distance show one, 1.02 if none does.)
const ALIKE: f32 = 0.05 * 0.05;

/// What light becomes.
#[derive(Debug, Default)]
enum Colors {
    /// No colours, but letters and their tones.
    #[default]
    Letters,
    /// No colours, but parts of cells that are on or off.
    Dots(Dots),
    /// 16 of a theme.
    Shades(Shades),
    /// The xterm palette.
    Dither(Dither),
    /// 24 bits.
    All,
}

/// Paints, and keeps its memory.
#[derive(Debug, Default)]
pub struct Painter {
    /// What `colors` was made for.
    made_for: Option<(ColorDepth, Theme, Charset)>,
    colors: Colors,
    residual: Residual,
    corrected: Vec<[Vec3; 2]>,
    tones: Tones,
}

impl Painter {
    /// Fills `cells`, whole rows of so many `columns` from row `first` on, by `fits` that begin with row `known`. In a picture that is not
    /// `steady`, colours are not mixed, and `before` has the cells of the frame before, from some row on. The eye says how much is handed
    /// on.
    pub fn paint(
        &mut self,
        (style, eye, steady): (&Style, Eye, bool),
        (fits, known): (&[Fitted], usize),
        columns: usize,
        first: usize,
        cells: &mut [Cell],
        before: Option<(&[Cell], usize)>,
    ) {
        self.make_for(style);
        let rows = first - known..first - known + cells.len() / columns;
        let own = &fits[rows.start * columns..rows.end * columns];
        if style.depth != ColorDepth::Never {
            let handing = Handing::new(eye.handed, style.charset);
            self.residual.correct(fits, columns, rows.clone(), handing, &mut self.corrected);
        }
        let colors = self.corrected.iter();
        let places = (first..).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let cells = cells.iter_mut().zip(own);
        match &mut self.colors {
            Colors::Letters => {
                let before = before.map(|(cells, row)| (cells, row - known));
                let glyphs = self.tones.choose(fits, columns, rows, before);
                for ((cell, _), &glyph) in cells.zip(glyphs) {
                    *cell = Cell { glyph, ..Cell::BLANK };
                }
            }
            Colors::Dots(dots) => {
                for ((cell, fit), place) in cells.zip(places) {
                    *cell = Cell { glyph: dots.glyph(&fit.parts, place), ..Cell::BLANK };
                }
            }
            Colors::Shades(shades) => {
                for ((cell, fit), &colors) in cells.zip(colors) {
                    *cell = shades.cell(fit, colors);
                }
            }
            Colors::Dither(dither) if !steady => {
                // What neighbours lack is not added: here and there it would cross the border between two entries, which costs a tenth of
                // the bytes.
                let start = before.map_or(0, |(_, row)| (first - row) * columns);
                for (index, (cell, fit)) in cells.enumerate() {
                    let before = before.and_then(|(cells, _)| cells.get(start + index));
                    let apart = (oklab(fit.ink) - oklab(fit.paper)).length_squared();
                    let before =
                        before.map(layers).filter(|&(glyph, _)| glyph == ' ' || glyph == fit.glyph);
                    *cell = match before {
                        Some((' ', [_, one])) if apart < ALIKE => {
                            let mean = fit.paper + fit.share() * (fit.ink - fit.paper);
                            let mean = dither.as_before(mean, Some(one));
                            two_colors(' ', mean, mean)
                        }
                        _ => {
                            let ink = dither.as_before(fit.ink, before.map(|(_, [ink, _])| ink));
                            let paper =
                                dither.as_before(fit.paper, before.map(|(_, [_, paper])| paper));
                            two_colors(fit.glyph, ink, paper)
                        }
                    };
                }
            }
            Colors::Dither(dither) => {
                for (((cell, fit), &[ink, paper]), (column, row)) in cells.zip(colors).zip(places) {
                    let ink = dither.color(ink, (column, 2 * row));
                    let paper = dither.color(paper, (column, 2 * row + 1));
                    *cell = two_colors(fit.glyph, ink, paper);
                }
            }
            Colors::All => {
                for ((cell, fit), colors) in cells.zip(colors) {
                    let [ink, paper] = colors.map(|color| Color::Rgb(Srgb::from_linear(color).0));
                    *cell = two_colors(fit.glyph, ink, paper);
                }
            }
        }
    }

    fn make_for(&mut self, style: &Style) {
        let key = Some((style.depth, style.theme, style.charset));
        if self.made_for == key {
            return;
        }
        let entries = entries(style.depth, &style.theme);
        self.colors = match style.depth {
            ColorDepth::Never if style.charset == Charset::Ascii => Colors::Letters,
            ColorDepth::Never => Colors::Dots(Dots::new(style.charset)),
            ColorDepth::Ansi16 => Colors::Shades(Shades::new(entries, style.charset)),
            ColorDepth::Ansi256 => Colors::Dither(Dither::new(entries)),
            ColorDepth::Truecolor => Colors::All,
        };
        self.made_for = key;
    }
}

/// A cell's glyph, and the colours of its ink and paper: a space has one for both.
fn layers(cell: &Cell) -> (char, [Color; 2]) {
    let ink = if cell.glyph == ' ' { cell.background } else { cell.foreground };
    (cell.glyph, [ink, cell.background])
}

/// A cell; a space if there is nothing to tell apart.
fn two_colors(glyph: char, foreground: Color, background: Color) -> Cell {
    if foreground == background || glyph == ' ' {
        Cell { glyph: ' ', foreground: Color::Default, background }
    } else {
        Cell { glyph, foreground, background }
    }
}

#[cfg(test)]
mod tests;
