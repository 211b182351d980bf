//! Cells to bytes, by a writer of our own: the caller has already decided about colour, and a
//! library that reads the environment again would decide otherwise.
//!
//! [`full`] writes lines for a pipe or a file. [`Encoder`] writes what changed, for a terminal in
//! raw mode; it knows what that terminal shows, which need not be what was wanted: where that looks alike, it may stay.
//! What is shown is remembered, so errors do not add up, and a frame without tolerance makes good for all of them.

mod cursor;
mod perceived;
mod sgr;
#[cfg(test)]
mod tests;
mod tolerance;

use crate::cells::{Cell, CellGrid};
use cursor::{Cursor, push_glyph};
use sgr::Pen;
use tolerance::{Tolerance, look_same};

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

/// What a frame may save.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Economy {
    /// How far off in `OKLab` a cell of one colour may stay, at most 0.03; one that takes more bytes may be farther off,
    /// though no part of it three times as far, or by more than 0.03.
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

    /// Tells whether the terminal holds its picture back between the brackets of mode 2026: then frames have them.
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

    /// After a resize, a suspension, or anything else that may have written to the screen.
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

    /// Appends what makes the terminal show `next`, or what is as near as `economy` says: a part of a frame, without
    /// brackets.
    ///
    /// Without anything shown, or if that has another size, the screen is cleared first.
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

    /// Appends what makes the terminal show `row` of `next` just as it is, and no other; nothing if nothing is known of
    /// the rest, or there is no such row.
    pub fn encode_row(&mut self, next: &CellGrid, row: u16, out: &mut Vec<u8>) {
        let Some(shown) = &mut self.shown else { return };
        if row < next.rows().min(shown.rows()) && next.columns() == shown.columns() {
            self.tolerance.set(0.0);
            let mut update = Update::new(&self.tolerance, usize::MAX);
            update.row(row, next, shown.marked(), shown, out);
            update.pen.put_down(out);
        }
    }

    /// Appends what clears the screen, and takes note of it; nothing if a screen of this size is known.
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

    /// Something else was drawn over the first `rows`: what is not blank in `next` must be written again.
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

/// A frame that is being written.
struct Update<'a> {
    cursor: Cursor,
    pen: Pen,
    tolerance: &'a Tolerance,
    /// From this length of the output on, nothing more is written.
    end: usize,
    /// Whether nothing has been left or written that only looks alike.
    is_exact: bool,
}

impl<'a> Update<'a> {
    fn new(tolerance: &'a Tolerance, end: usize) -> Self {
        Self { cursor: Cursor::LOST, pen: Pen::RESET, tolerance, end, is_exact: true }
    }

    fn row(
        &mut self,
        row: u16,
        next: &CellGrid,
        was_marked: Option<(u16, u16)>,
        shown: &mut CellGrid,
        out: &mut Vec<u8>,
    ) {
        let (wanted, columns) = (next.row(row), next.columns());
        let first = usize::from(row) * usize::from(columns);
        let shown = &mut shown.cells_mut()[first..first + wanted.len()];
        let marked = next.marked().and_then(|(column, of)| (of == row).then_some(column));
        for (column, cell) in (0..columns).zip(wanted) {
            let index = usize::from(column);
            let is_marked = marked == Some(column);
            let same_mark = is_marked == (was_marked == Some((column, row)));
            if same_mark && look_same(&shown[index], cell) {
                continue;
            }
            // A mark is where it should be, whatever it costs.
            let error = self.tolerance.error(&shown[index], cell);
            let way = self.cursor.way_to(row, column);
            // Nothing is shown in less than a byte.
            let stays = out.len() >= self.end || error <= self.tolerance.price(way + 1);
            if same_mark && stays {
                self.is_exact = false;
                continue;
            }
            let best = self.best(cell, way);
            let may_stay = error <= best.cost;
            if same_mark && may_stay {
                self.is_exact = false;
                continue;
            }
            let gap = Gap { row, column, wanted, marked };
            if !self.rewrite_gap(&gap, shown, out) {
                self.cursor.go_to(row, column, out);
            }
            if is_marked {
                self.pen.put_down(out);
                out.extend_from_slice(INVERSE);
                self.pen.take_up(cell, out);
                push_glyph(cell.glyph, out);
                out.extend_from_slice(RESET);
                self.pen = Pen::RESET;
                shown[index] = *cell;
            } else {
                self.pen.take_up(&best.sent, out);
                push_glyph(best.sent.glyph, out);
                self.is_exact &= look_same(&best.seen, cell);
                shown[index] = best.seen;
            }
            self.cursor.advance(columns);
        }
    }

    /// The form of `cell` that costs least, where the cursor needs so many bytes to be there.
    fn best(&self, cell: &Cell, way: usize) -> Form {
        let mut best = Form { sent: *cell, seen: *cell, cost: f32::INFINITY, bytes: usize::MAX };
        for (sent, seen) in self.pen.forms(cell) {
            let bytes = self.pen.bytes(&sent);
            let price = self.tolerance.price(bytes + way);
            if price > best.cost {
                continue;
            }
            let cost = price + self.tolerance.error(&seen, cell);
            if (cost, bytes) < (best.cost, best.bytes) {
                best = Form { sent, seen, cost, bytes };
            }
        }
        best
    }

    /// Crosses cells that may stay by writing them again, if the pen suits them and that is no longer
    /// than a jump. Whether the cursor is now where it should be.
    fn rewrite_gap(&mut self, gap: &Gap<'_>, shown: &mut [Cell], out: &mut Vec<u8>) -> bool {
        let Some(from) = self.cursor.column_in(gap.row).filter(|&from| from <= gap.column) else {
            return false;
        };
        let columns = from..gap.column;
        if columns.is_empty() {
            return true;
        }
        let most = Cursor::jump_length(gap.column - from);
        let cells = usize::from(from)..usize::from(gap.column);
        // A glyph has at least one byte: a wide gap need not be looked at.
        if gap.marked.is_some_and(|marked| columns.contains(&marked))
            || cells.len() > most
            || gap.wanted[cells.clone()].iter().map(|cell| cell.glyph.len_utf8()).sum::<usize>()
                > most
            || !self.pays_to_rewrite(&gap.wanted[cells.clone()], &shown[cells.clone()], most)
        {
            return false;
        }
        for index in cells {
            let cell = &gap.wanted[index];
            push_glyph(cell.glyph, out);
            shown[index] = self.pen.painted(cell.glyph);
            self.is_exact &= look_same(&shown[index], cell);
        }
        self.cursor.cross_to(gap.column);
        true
    }

    /// Whether it costs less to draw cells with the pen's own colours, in place of what is shown, than to jump in so many
    /// bytes.
    fn pays_to_rewrite(&self, wanted: &[Cell], shown: &[Cell], jump: usize) -> bool {
        let (mut drawn, mut left) = (0.0, self.tolerance.price(jump));
        for (wanted, shown) in wanted.iter().zip(shown) {
            let painted = self.pen.painted(wanted.glyph);
            drawn += self.tolerance.error(&painted, wanted);
            drawn += self.tolerance.price(self.pen.bytes(&painted));
            left += self.tolerance.error(shown, wanted);
        }
        drawn <= left
    }
}

/// What is sent for a cell.
struct Form {
    sent: Cell,
    /// The same, as the cell names it.
    seen: Cell,
    /// Its error, and the price of its bytes and of the way there.
    cost: f32,
    bytes: usize,
}

/// Cells between the cursor and the column where something is to be written.
struct Gap<'a> {
    row: u16,
    column: u16,
    /// Of the whole row.
    wanted: &'a [Cell],
    /// The column in it that is marked, which no pen suits.
    marked: Option<u16>,
}
