//! Character cells: what a terminal shows, before any escape sequence.

mod best_mask;
pub mod bins;
pub mod braille;
pub mod change;
pub mod columns;
pub mod dither;
pub mod dots;
pub mod eye;
pub mod fit;
mod fitted;
pub mod layers;
mod letter;
pub mod letters;
pub mod mask_fit;
pub mod masks;
pub mod paint;
pub mod residual;
pub mod shades;
pub mod tone;
pub mod wedges;

pub use crate::palette::Color;

/// One character and its colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    /// A character one column wide.
    pub glyph: char,
    /// The colour of its ink.
    pub foreground: Color,
    /// The colour behind it.
    pub background: Color,
}

impl Cell {
    /// A space in the terminal's own colours.
    pub const BLANK: Self =
        Self { glyph: ' ', foreground: Color::Default, background: Color::Default };
}

/// A rectangle of cells, row by row from the top left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellGrid {
    columns: u16,
    rows: u16,
    cells: Vec<Cell>,
    marked: Option<(u16, u16)>,
}

impl CellGrid {
    /// Blank cells.
    #[must_use]
    pub fn new(columns: u16, rows: u16) -> Self {
        let count = usize::from(columns) * usize::from(rows);
        Self { columns, rows, cells: vec![Cell::BLANK; count], marked: None }
    }

    /// How many cells a row has.
    #[must_use]
    pub fn columns(&self) -> u16 {
        self.columns
    }

    /// How many rows.
    #[must_use]
    pub fn rows(&self) -> u16 {
        self.rows
    }

    /// All cells, row by row.
    #[must_use]
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// All cells, row by row, to be changed.
    pub fn cells_mut(&mut self) -> &mut [Cell] {
        &mut self.cells
    }

    /// The cells of `row`, none past the last.
    #[must_use]
    pub fn row(&self, row: u16) -> &[Cell] {
        let start = usize::from(row) * usize::from(self.columns);
        self.cells.get(start..start + usize::from(self.columns)).unwrap_or(&[])
    }

    /// The characters of each row.
    #[cfg(test)]
    pub(crate) fn lines(&self) -> Vec<String> {
        (0..self.rows).map(|row| self.row(row).iter().map(|cell| cell.glyph).collect()).collect()
    }

    /// Marks one cell or none, and no other: a terminal shows it with ink and paper exchanged, whatever its colours.
    pub fn set_mark(&mut self, marked: Option<(u16, u16)>) {
        self.marked = marked;
    }

    /// Column and row of the cell that is marked.
    #[must_use]
    pub fn marked(&self) -> Option<(u16, u16)> {
        self.marked
    }

    /// Writes `text` from `(column, row)` on, cut at the right edge.
    pub fn write(
        &mut self,
        column: u16,
        row: u16,
        text: &str,
        foreground: Color,
        background: Color,
    ) {
        if row >= self.rows {
            return;
        }
        let start = usize::from(row) * usize::from(self.columns);
        let line = &mut self.cells[start..start + usize::from(self.columns)];
        for (cell, glyph) in line.iter_mut().skip(usize::from(column)).zip(text.chars()) {
            *cell = Cell { glyph, foreground, background };
        }
    }
}
