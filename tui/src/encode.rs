//! Cells to bytes, by a writer of our own: the caller has already decided about colour, and a
//! library that reads the environment again would decide otherwise.
//!
//! [`full`] writes lines for a pipe or a file. [`Encoder`] writes what changed, for a terminal in raw mode. It knows what that terminal
//! shows, which need not be what was wanted: what looks alike may stay. It remembers what is shown, so errors do not add up, and a frame
//! without tolerance makes good for all of them.

mod ahead;
mod cursor;
mod perceived;
mod sgr;
#[cfg(test)]
mod tests;
mod tolerance;
mod update;

use crate::cells::{Cell, CellGrid};
use cursor::{Cursor, push_glyph};
use sgr::Pen;
use tolerance::Tolerance;
use update::Update;

/// From here on a terminal holds back its picture, if it can.
const BEGIN_SYNCHRONIZED: &[u8] = b"\x1b[?2026h";
/// Shows what was held back.
const END_SYNCHRONIZED: &[u8] = b"\x1b[?2026l";
/// The terminal's own colours, a blank screen, the cursor at the top left.
const CLEAR: &[u8] = b"\x1b[m\x1b[2J\x1b[H";
/// The bytes of two colours of 24 bits and a glyph: so many are reserved a cell, so that a frame allocates once.
const LONGEST_CELL: usize = 40;

/// Appends the whole grid: a line a row, closed by a reset if it has colour, and by a newline.
/// Without colour there is no escape sequence at all, and so no mark.
pub fn full(grid: &CellGrid, out: &mut Vec<u8>) {
    out.reserve(LONGEST_CELL * grid.cells().len() + usize::from(grid.rows()));
    for row in 0..grid.rows() {
        let mut pen = Pen::RESET;
        let mut colored = false;
        for cell in grid.row(row) {
            colored |= pen.take_up(cell, out);
            push_glyph(cell.glyph, out);
        }
        if colored {
            out.extend_from_slice(b"\x1b[0m");
        }
        out.push(b'\n');
    }
}

/// What a frame may save.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Economy {
    /// How far off in `OKLab` a cell of one colour may stay, at most 0.03. A cell that takes more bytes may be farther off, but no part of
    /// it three times as far, or by more than 0.03.
    pub tolerance: f32,
    /// After so many bytes the rest of the cells is left for the next frame, unless the screen was cleared.
    pub most_bytes: usize,
}

impl Economy {
    /// All is shown as it is wanted.
    pub const NONE: Self = Self { tolerance: 0.0, most_bytes: usize::MAX };
}

/// Remembers what the terminal shows, so that a frame costs only what it changes.
#[derive(Debug, Default)]
pub struct Encoder {
    shown: Option<CellGrid>,
    is_exact: bool,
    /// Whether the terminal holds its picture back between brackets.
    synchronized: bool,
    tolerance: Tolerance,
}

impl Encoder {
    /// Knows nothing yet: the first frame is a full one.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets whether the terminal holds its picture back between the brackets of mode 2026; if so, frames have them.
    pub fn set_synchronized(&mut self, synchronized: bool) {
        self.synchronized = synchronized;
    }

    /// What the terminal shows, as far as is known.
    #[must_use]
    pub fn shown(&self) -> Option<&CellGrid> {
        self.shown.as_ref()
    }

    /// Whether the terminal shows just what was wanted last, and not what looks alike.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.is_exact
    }

    /// Forgets what the terminal shows: after a resize, a suspension, or anything else that may have written to the screen.
    pub fn forget(&mut self) {
        self.shown = None;
    }

    /// Appends a frame: what makes the terminal show `next`; nothing if it does already. The terminal must be in raw mode;
    /// its pen is reset before and after.
    pub fn encode(&mut self, next: &CellGrid, out: &mut Vec<u8>) {
        let start = out.len();
        self.encode_part(next, Economy::NONE, out);
        self.bracket(start, out);
    }

    /// Appends what makes the terminal show `next`, or something as near as `economy` says: a part of a frame, without brackets.
    ///
    /// If it is not known what is shown, or that has another size, the screen is cleared first.
    pub fn encode_part(&mut self, next: &CellGrid, economy: Economy, out: &mut Vec<u8>) {
        let size = (next.columns(), next.rows());
        let same_size = |grid: &CellGrid| (grid.columns(), grid.rows()) == size;
        self.tolerance.set(economy.tolerance);
        let end = out.len().saturating_add(economy.most_bytes);
        let mut update = Update::new(&self.tolerance, end);
        let mut shown = self.shown.take().filter(same_size).unwrap_or_else(|| {
            out.extend_from_slice(CLEAR);
            update.cursor = Cursor::HOME;
            update.end = usize::MAX;
            CellGrid::new(size.0, size.1)
        });
        let was_marked = shown.marked();
        for row in 0..next.rows() {
            update.row(row, next, was_marked, &mut shown, out);
        }
        update.pen.put_down(out);
        shown.set_mark(next.marked());
        self.is_exact = update.is_exact;
        self.shown = Some(shown);
    }

    /// Appends what makes the terminal show `row` of `next` just as it is, and no other row. Appends nothing if it is not known what the
    /// rest shows, or if there is no such row.
    pub fn encode_row(&mut self, next: &CellGrid, row: u16, out: &mut Vec<u8>) {
        let Some(shown) = &mut self.shown else { return };
        if row < next.rows().min(shown.rows()) && next.columns() == shown.columns() {
            self.tolerance.set(0.0);
            let mut update = Update::new(&self.tolerance, usize::MAX);
            update.row(row, next, shown.marked(), shown, out);
            update.pen.put_down(out);
        }
    }

    /// Appends what clears the screen, and takes note of it, unless a screen of this size is known. Returns whether it did.
    pub fn clear(&mut self, columns: u16, rows: u16, out: &mut Vec<u8>) -> bool {
        let is_known = self
            .shown
            .as_ref()
            .is_some_and(|shown| (shown.columns(), shown.rows()) == (columns, rows));
        if !is_known {
            out.extend_from_slice(CLEAR);
            self.shown = Some(CellGrid::new(columns, rows));
        }
        !is_known
    }

    /// Takes note that something else was drawn over the first `rows`: what is not blank in `next` must be written again.
    pub fn covered(&mut self, rows: u16, next: &CellGrid) {
        let count = usize::from(rows) * usize::from(next.columns());
        let Some(shown) = &mut self.shown else { return };
        for (shown, wanted) in shown.cells_mut().iter_mut().zip(next.cells()).take(count) {
            let is_blank = *wanted == Cell::BLANK;
            *shown = if is_blank { Cell::BLANK } else { Cell { glyph: '\0', ..Cell::BLANK } };
        }
    }

    /// Puts what was appended since `start` between brackets, if there is anything and the terminal knows them.
    pub fn bracket(&self, start: usize, out: &mut Vec<u8>) {
        if self.synchronized && out.len() > start {
            out.splice(start..start, BEGIN_SYNCHRONIZED.iter().copied());
            out.extend_from_slice(END_SYNCHRONIZED);
        }
    }
}
