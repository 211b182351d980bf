//! Where the cursor is, and the shortest way to where it should be.

use super::sgr::Pen;
use crate::cells::Cell;

/// A control character, say from the name of a file, must not reach the terminal as one.
pub(super) fn printable(glyph: char) -> char {
    if glyph.is_control() { '?' } else { glyph }
}

/// Appends a glyph, which moves the cursor.
pub(super) fn push_glyph(glyph: char, out: &mut Vec<u8>) {
    out.extend_from_slice(printable(glyph).encode_utf8(&mut [0; 4]).as_bytes());
}

/// A position from the top left, as far as it is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cursor {
    position: Option<(u16, u16)>,
    /// A glyph was written into the last column: terminals disagree on which column the cursor is
    /// in, so only ways that do not depend on it are taken.
    wrap_pending: bool,
}

impl Cursor {
    /// At the top left.
    pub(super) const HOME: Self = Self { position: Some((0, 0)), wrap_pending: false };
    /// Anywhere.
    pub(super) const LOST: Self = Self { position: None, wrap_pending: false };

    /// A glyph has been written.
    pub(super) fn advance(&mut self, columns: u16) {
        if let Some((_, column)) = &mut self.position {
            *column += 1;
            self.wrap_pending = *column >= columns;
        }
    }

    /// Crosses unchanged cells by writing them again, if the pen suits them and that is no longer
    /// than a jump. `cells` is the row, and the column in it that is marked, which no pen suits. Whether the cursor is now
    /// at `column`.
    pub(super) fn rewrite_gap(
        &mut self,
        row: u16,
        column: u16,
        (cells, marked): (&[Cell], Option<u16>),
        pen: &Pen,
        out: &mut Vec<u8>,
    ) -> bool {
        let Some((here, from)) = self.position else { return false };
        if here != row || from > column || self.wrap_pending {
            return false;
        }
        if from == column {
            return true;
        }
        let gap = &cells[usize::from(from)..usize::from(column)];
        let mut jump = Way::new();
        jump.right(column - from);
        // A glyph has at least one byte: a wide gap need not be looked at.
        if marked.is_some_and(|marked| (from..column).contains(&marked))
            || gap.len() > jump.length
            || gap.iter().map(|cell| cell.glyph.len_utf8()).sum::<usize>() > jump.length
            || !gap.iter().all(|cell| pen.suits(cell))
        {
            return false;
        }
        for cell in gap {
            push_glyph(cell.glyph, out);
        }
        self.position = Some((row, column));
        true
    }

    /// Appends the shortest of the ways that lead down or to the right.
    pub(super) fn go_to(&mut self, row: u16, column: u16, out: &mut Vec<u8>) {
        let mut way = Way::new();
        way.absolute(row, column);
        if let Some((here, from)) = self.position.filter(|(here, _)| *here <= row) {
            let mut other = Way::new();
            other.push(b"\r");
            other.down(row - here);
            other.right(column);
            way = way.shorter(other);
            if !self.wrap_pending {
                let mut other = Way::new();
                other.down(row - here);
                if from <= column {
                    other.right(column - from);
                } else {
                    other.left(from - column);
                }
                way = way.shorter(other);
            }
        }
        out.extend_from_slice(way.bytes());
        *self = Self { position: Some((row, column)), wrap_pending: false };
    }
}

/// A sequence of movements; one that grows too long to be the shortest stays too long.
struct Way {
    bytes: [u8; Self::LIMIT],
    length: usize,
}

impl Way {
    /// `ESC [ 65535 ; 65535 H` has 14.
    const LIMIT: usize = 16;

    fn new() -> Self {
        Self { bytes: [0; Self::LIMIT], length: 0 }
    }

    fn push(&mut self, more: &[u8]) {
        if let Some(room) = self.bytes.get_mut(self.length..self.length + more.len()) {
            room.copy_from_slice(more);
            self.length += more.len();
        } else {
            self.length = usize::MAX / 2;
        }
    }

    fn number(&mut self, number: u16) {
        self.push(itoa::Buffer::new().format(number).as_bytes());
    }

    /// Parameters that are 1 can be left out.
    fn absolute(&mut self, row: u16, column: u16) {
        self.push(b"\x1b[");
        if row > 0 {
            self.number(row.saturating_add(1));
        }
        if column > 0 {
            self.push(b";");
            self.number(column.saturating_add(1));
        }
        self.push(b"H");
    }

    /// `ESC [ count last`.
    fn sequence(&mut self, count: u16, last: u8) {
        self.push(b"\x1b[");
        self.number(count);
        self.push(&[last]);
    }

    /// In raw mode a line feed only moves down; it never leaves the last row here.
    fn down(&mut self, count: u16) {
        match count {
            0..=8 => self.push(&[b'\n'; 8][..usize::from(count)]),
            _ => self.sequence(count, b'B'),
        }
    }

    fn right(&mut self, count: u16) {
        match count {
            0 => {}
            1 => self.push(b"\x1b[C"),
            _ => self.sequence(count, b'C'),
        }
    }

    fn left(&mut self, count: u16) {
        match count {
            0..=4 => self.push(&[b'\x08'; 4][..usize::from(count)]),
            _ => self.sequence(count, b'D'),
        }
    }

    fn shorter(self, other: Self) -> Self {
        if other.length < self.length { other } else { self }
    }

    fn bytes(&self) -> &[u8] {
        &self.bytes[..self.length]
    }
}
