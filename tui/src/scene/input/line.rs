//! A line of an input.

use crate::scene::read_error::ReadError;

/// The longest line, in bytes: a million columns have room.
pub(in crate::scene) const LONGEST_LINE: usize = 16 << 20;

/// A line, and where it is.
#[derive(Clone, Copy, Debug)]
pub(in crate::scene) struct Line<'a> {
    /// Without its end; the first line without its byte order mark.
    pub(in crate::scene) bytes: &'a [u8],
    /// From 1.
    pub(in crate::scene) number: usize,
    pub(super) source: &'a str,
}

impl<'a> Line<'a> {
    /// The error that this byte of the line is wrong.
    pub(in crate::scene) fn error(&self, byte: usize, what: impl Into<String>) -> ReadError {
        let before = self.bytes.get(..byte).unwrap_or(self.bytes);
        let column = String::from_utf8_lossy(before).chars().count() + 1;
        ReadError::at(self.source, self.number, column, what)
    }

    /// The line without white space at both ends.
    pub(in crate::scene) fn trimmed(&self) -> &'a [u8] {
        self.bytes.trim_ascii()
    }
}
