//! A row of a table of mmCIF: words and quotes. Grammar: "CIF 1.1 syntax", IUCr.

use crate::scene::input::Line;
use crate::scene::read_error::ReadError;
use std::ops::Range;

/// The values of a row, which may go over several lines.
#[derive(Default)]
pub(super) struct Row {
    text: Vec<u8>,
    pub(super) words: Vec<Range<usize>>,
}

impl Row {
    pub(super) fn is_begun(&self) -> bool {
        !self.words.is_empty()
    }

    pub(super) fn clear(&mut self) {
        self.text.clear();
        self.words.clear();
    }

    pub(super) fn word(&self, column: usize) -> &[u8] {
        &self.text[self.words[column].clone()]
    }

    /// As `word`, but empty where there is none: `.` or `?`.
    pub(super) fn value(&self, column: Option<usize>) -> &[u8] {
        match column.map(|column| self.word(column)) {
            None | Some(b"." | b"?") => b"",
            Some(word) => word,
        }
    }

    /// Adds the values of a line.
    ///
    /// # Errors
    /// [`ReadError`] if a quote does not end in it.
    pub(super) fn add(&mut self, line: &Line<'_>) -> Result<(), ReadError> {
        let from = self.text.len();
        self.text.extend_from_slice(line.bytes);
        self.text.push(b' ');
        let text = &self.text;
        let mut at = from;
        while at < text.len() {
            if text[at] <= b' ' {
                at += 1;
                continue;
            }
            let quote = text[at];
            if quote == b'#' {
                break;
            }
            if quote == b'\'' || quote == b'"' {
                // A quote ends a value only before white space.
                let end = (at + 1..text.len() - 1)
                    .find(|&end| text[end] == quote && text[end + 1] <= b' ');
                let Some(end) = end else {
                    return Err(line.error(at - from, "a quote that does not end in its line"));
                };
                self.words.push(at + 1..end);
                at = end + 1;
            } else {
                let start = at;
                while text[at] > b' ' {
                    at += 1;
                }
                self.words.push(start..at);
            }
        }
        Ok(())
    }
}
