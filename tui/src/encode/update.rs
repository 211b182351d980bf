//! A frame as it is written: cell by cell, in the form that costs least.

use super::ahead::{self, Layer};
use super::cursor::{Cursor, push_glyph};
use super::sgr::{Pen, RESET};
use super::tolerance::{Tolerance, ink, look_same};
use crate::cells::{Cell, CellGrid};

/// Exchanges ink and paper, which needs no colour, until the next reset.
const INVERSE: &[u8] = b"\x1b[7m";

/// A frame that is being written.
pub(super) struct Update<'a> {
    pub(super) cursor: Cursor,
    pub(super) pen: Pen,
    tolerance: &'a Tolerance,
    /// From this length of the output on, nothing more is written.
    pub(super) end: usize,
    /// Whether nothing has been left or written that only looks alike.
    pub(super) is_exact: bool,
    /// The errors of leaving each cell of the row that is being written as it is.
    errors: Vec<f32>,
}

impl<'a> Update<'a> {
    pub(super) fn new(tolerance: &'a Tolerance, end: usize) -> Self {
        Self {
            cursor: Cursor::LOST,
            pen: Pen::RESET,
            tolerance,
            end,
            is_exact: true,
            errors: Vec::new(),
        }
    }

    /// Appends what makes the terminal show `row` of `next`, and takes note of it in `shown`.
    pub(super) fn row(
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
        self.errors.clear();
        let pairs = shown.iter().zip(wanted);
        self.errors.extend(pairs.map(|(shown, wanted)| self.tolerance.error(shown, wanted)));
        for (column, cell) in (0..columns).zip(wanted) {
            let index = usize::from(column);
            let is_marked = marked == Some(column);
            let same_mark = is_marked == (was_marked == Some((column, row)));
            if same_mark && look_same(&shown[index], cell) {
                continue;
            }
            // A mark is where it should be, whatever it costs.
            let error = self.errors[index];
            let way = self.cursor.way_to(row, column);
            // Every change takes a byte at least: this decides most cells that stay.
            let is_cheap = out.len() >= self.end || error <= self.tolerance.price(way + 1);
            let best = if same_mark && is_cheap { None } else { Some(self.best(cell, way)) };
            let best = best.filter(|best| !same_mark || error > best.cost);
            let Some(best) = best else {
                self.is_exact = false;
                continue;
            };
            let best = if is_marked { best } else { self.suited_ahead(best, cell, wanted, index) };
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

    /// The form of `cell` that costs least, if it takes so many bytes to move the cursor there.
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

    /// `best` with colours that suit the cells to come as well, if it sends any. (With ink and paper exchanged too, no byte was saved.)
    fn suited_ahead(&self, best: Form, cell: &Cell, wanted: &[Cell], index: usize) -> Form {
        let Form { sent, seen, .. } = best;
        if self.tolerance.is_none() || sent != seen {
            return best;
        }
        let next = index + 1;
        let color = |layer, own, share| {
            let (next, errors) = (&wanted[next..], &self.errors[next..]);
            ahead::color(self.tolerance, layer, (own, share), next, errors)
        };
        let (mut suited, ink) = (sent, ink(sent.glyph));
        if ink < 1.0 && self.pen.background != sent.background {
            suited.background = color(Layer::Paper, sent.background, 1.0 - ink);
        }
        if ink > 0.0 && self.pen.foreground != sent.foreground {
            suited.foreground = color(Layer::Ink, sent.foreground, ink);
        }
        if self.tolerance.error(&suited, cell).is_finite() {
            Form { sent: suited, seen: suited, ..best }
        } else {
            best
        }
    }

    /// Crosses cells that may stay by writing them again, if the pen suits them and that is no longer than a jump. Returns whether the
    /// cursor is now where it should be.
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

    /// Whether drawing cells with the pen's own colours, instead of what is shown, costs less than a jump of so many bytes.
    fn pays_to_rewrite(&self, wanted: &[Cell], shown: &[Cell], jump: usize) -> bool {
        let (mut drawn, mut left) = (0.0, self.tolerance.price(jump));
        for (wanted, shown) in wanted.iter().zip(shown) {
            let painted = self.pen.painted(wanted.glyph);
            drawn += self.tolerance.error(&painted, wanted);
            drawn += self.tolerance.price(self.pen.bytes(&painted));
            left += self.tolerance.error(shown, wanted);
        }
        // Cells that are left since bytes did not suffice are infinitely far off; that is no reason for other errors.
        drawn.is_finite() && drawn <= left
    }
}

/// What is sent for a cell.
struct Form {
    sent: Cell,
    /// The same, as the wanted cell names it.
    seen: Cell,
    /// Its error, and the price of its bytes and of the way there.
    cost: f32,
    bytes: usize,
}

/// Cells between the cursor and the column where something is to be written.
struct Gap<'a> {
    row: u16,
    column: u16,
    /// The wanted cells of the whole row.
    wanted: &'a [Cell],
    /// The column in it that is marked, which no pen suits.
    marked: Option<u16>,
}
