//! From a scene to cells: the whole pipeline in one page.

use crate::cells::CellGrid;
use crate::scene::Scene;
use crate::view::View;

/// Which tier decides hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AccuracyChoice {
    /// The textbook form.
    Fast,
    /// The best form of plain `f32`.
    Stable,
}

/// How many colours there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorDepth {
    /// None: glyphs alone.
    Never,
    /// The 16 of the user's theme.
    Ansi16,
    /// The xterm palette.
    Ansi256,
    /// 24 bits.
    Truecolor,
}

/// Which characters may be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Charset {
    /// Printable ASCII.
    Ascii,
    /// Half blocks: two pixels a cell.
    Half,
}

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Which tier decides hits.
    pub accuracy: AccuracyChoice,
    /// Which characters may be used.
    pub charset: Charset,
    /// How many colours there are.
    pub depth: ColorDepth,
    /// Rays a cell, at least one.
    pub samples: u32,
    /// Width of a cell over its height.
    pub cell_aspect: f32,
}

/// A drawn picture and what it took.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The picture.
    pub cells: CellGrid,
    /// How many rays were traced, shadow rays among them.
    pub rays: u64,
}

/// Draws `scene` as `view` sees it into `columns` x `rows` cells.
#[must_use]
pub fn draw(_scene: &Scene, _view: &View, _style: &Style, columns: u16, rows: u16) -> Drawn {
    Drawn { cells: CellGrid::new(columns, rows), rays: 0 }
}
