//! Cells to bytes, by a writer of our own: the caller has already decided about colour, and a
//! library that reads the environment again would decide otherwise.
//!
//! [`full`] writes lines for a pipe or a file. [`Encoder`] writes what changed, for a terminal in
//! raw mode; it knows what that terminal shows.

mod cursor;
mod sgr;
#[cfg(test)]
mod tests;

use crate::cells::{Cell, CellGrid};
use cursor::{Cursor, push_glyph};
use sgr::Pen;

/// From here on a terminal that can hold back its picture does.
const BEGIN_SYNCHRONIZED: &[u8] = b"\x1b[?2026h";
/// Shows what was held back.
const END_SYNCHRONIZED: &[u8] = b"\x1b[?2026l";
/// The terminal's own colours, a blank screen, the cursor at the top left.
const CLEAR: &[u8] = b"\x1b[m\x1b[2J\x1b[H";
/// Ink and paper exchanged, which needs no colour; until the next reset.
const INVERSE: &[u8] = b"\x1b[7m";
const RESET: &[u8] = b"\x1b[m";
/// Two colours of 24 bits and a glyph; reserved a cell, so that a frame allocates once.
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

/// Appends what turns a terminal that shows `previous` into one that shows `next`, or nothing if
/// they look the same. Without `previous`, or with one of another size, the screen is cleared
/// first. The terminal must be in raw mode; its pen is reset before and after.
pub fn diff(previous: Option<&CellGrid>, next: &CellGrid, out: &mut Vec<u8>) {
    let start = out.len();
    out.extend_from_slice(BEGIN_SYNCHRONIZED);
    let header = out.len();
    let same_size =
        |grid: &&CellGrid| (grid.columns(), grid.rows()) == (next.columns(), next.rows());
    if let Some(previous) = previous.filter(same_size) {
        let shown = |index: usize| previous.cells()[index];
        changed_cells(shown, previous.marked(), Cursor::LOST, next, out);
        if out.len() == header {
            out.truncate(start);
            return;
        }
    } else {
        out.extend_from_slice(CLEAR);
        changed_cells(|_| Cell::BLANK, None, Cursor::HOME, next, out);
    }
    out.extend_from_slice(END_SYNCHRONIZED);
}

fn changed_cells(
    shown: impl Fn(usize) -> Cell,
    was_marked: Option<(u16, u16)>,
    mut cursor: Cursor,
    next: &CellGrid,
    out: &mut Vec<u8>,
) {
    let mut pen = Pen::RESET;
    for row in 0..next.rows() {
        let cells = next.row(row);
        let first = usize::from(row) * cells.len();
        let marked = next.marked().and_then(|(column, of)| (of == row).then_some(column));
        for (column, cell) in (0..next.columns()).zip(cells) {
            let is_marked = marked == Some(column);
            let same_mark = is_marked == (was_marked == Some((column, row)));
            if same_mark && look_same(&shown(first + usize::from(column)), cell) {
                continue;
            }
            if !cursor.rewrite_gap(row, column, (cells, marked), &pen, out) {
                cursor.go_to(row, column, out);
            }
            if is_marked {
                pen.put_down(out);
                out.extend_from_slice(INVERSE);
                pen.take_up(cell, out);
                push_glyph(cell.glyph, out);
                out.extend_from_slice(RESET);
                pen = Pen::RESET;
                cursor.advance(next.columns());
                continue;
            }
            let cell = pen.nearer_form(cell);
            pen.take_up(&cell, out);
            push_glyph(cell.glyph, out);
            cursor.advance(next.columns());
        }
    }
    pen.put_down(out);
}

/// The ink of a space cannot be seen.
fn look_same(a: &Cell, b: &Cell) -> bool {
    a.background == b.background
        && a.glyph == b.glyph
        && (a.foreground == b.foreground || a.glyph == ' ')
}

/// Remembers what the terminal shows, so that a frame costs only what it changes.
#[derive(Debug, Default)]
pub struct Encoder {
    shown: Option<CellGrid>,
}

impl Encoder {
    /// Knows nothing yet: the first frame is a full one.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// What the terminal shows, as far as is known.
    #[must_use]
    pub fn shown(&self) -> Option<&CellGrid> {
        self.shown.as_ref()
    }

    /// After a resize, a suspension, or anything else that may have written to the screen.
    pub fn forget(&mut self) {
        self.shown = None;
    }

    /// Appends what makes the terminal show `next`; nothing if it does already.
    pub fn encode(&mut self, next: CellGrid, out: &mut Vec<u8>) {
        diff(self.shown.as_ref(), &next, out);
        self.shown = Some(next);
    }
}
