//! Where the cursor is, and the shortest way to where it should be.

use crate::harmless::is_obeyed;

/// A control character, say from the name of a file, must not reach the terminal as one.
pub(super) fn printable(glyph: char) -> char {
    if is_obeyed(glyph) { '?' } else { glyph }
}

/// Appends a glyph, which moves the cursor.
pub(super) fn push_glyph(glyph: char, out: &mut Vec<u8>) {
    out.extend_from_slice(printable(glyph).encode_utf8(&mut [0; 4]).as_bytes());
}

/// A position from the top left, as far as it is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cursor {
    position: Option<(u16, u16)>,
    /// A glyph was written into the last column. Terminals disagree on which column the cursor is
    /// in then, so only ways that do not depend on it are taken.
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

    /// The column of the cursor, if that is known for sure and in this row.
    pub(super) fn column_in(&self, row: u16) -> Option<u16> {
        let (here, column) = self.position.filter(|_| !self.wrap_pending)?;
        (here == row).then_some(column)
    }

    /// How many bytes a jump over so many columns to the right takes.
    pub(super) fn jump_length(columns: u16) -> usize {
        let mut jump = Way::new();
        jump.right(columns);
        jump.length
    }

    /// About how many bytes the way there takes: none if the cursor is there.
    pub(super) fn way_to(&self, row: u16, column: u16) -> usize {
        /// `ESC [ 9 C`.
        const JUMP: usize = 4;
        if self.column_in(row) == Some(column) { 0 } else { JUMP }
    }

    /// Glyphs have been written up to this column, which is not past the last.
    pub(super) fn cross_to(&mut self, column: u16) {
        self.position = self.position.map(|(row, _)| (row, column));
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
