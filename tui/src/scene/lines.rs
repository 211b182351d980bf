//! Lines of an input that may be hostile: none may be endless.

use super::read_error::ReadError;
use std::io::{BufRead, Read};

/// The longest line, in bytes.
pub(super) const LONGEST_LINE: u64 = 1 << 16;

/// Reads line by line and counts.
#[derive(Debug)]
pub(super) struct Lines<'a, R> {
    reader: R,
    source: &'a str,
    number: usize,
    bytes: Vec<u8>,
}

impl<'a, R: BufRead> Lines<'a, R> {
    /// Before the first line; `source` is the name of the input in errors.
    pub(super) fn new(reader: R, source: &'a str) -> Self {
        Self { reader, source, number: 0, bytes: Vec::new() }
    }

    /// The number of the last line read, from 1.
    pub(super) fn number(&self) -> usize {
        self.number
    }

    /// The next line without its end, `None` after the last. What is no UTF-8 is replaced; a
    /// byte order mark before the first line is left out.
    ///
    /// # Errors
    /// [`ReadError`] if reading fails, or the line is longer than [`LONGEST_LINE`].
    pub(super) fn next(&mut self) -> Result<Option<String>, ReadError> {
        self.bytes.clear();
        let mut limited = self.reader.by_ref().take(LONGEST_LINE + 1);
        match limited.read_until(b'\n', &mut self.bytes) {
            Ok(0) => return Ok(None),
            Ok(_) => self.number += 1,
            Err(error) => return Err(ReadError::whole(self.source, error.to_string())),
        }
        if self.bytes.len() as u64 > LONGEST_LINE {
            let what = format!("a line of more than {LONGEST_LINE} bytes");
            return Err(ReadError::at(self.source, self.number, 1, what));
        }
        let text = String::from_utf8_lossy(&self.bytes);
        let text = text.trim_end_matches(['\n', '\r']);
        let text = if self.number == 1 { text.trim_start_matches('\u{feff}') } else { text };
        Ok(Some(text.to_owned()))
    }
}
