//! An input line by line.

use super::line::LONGEST_LINE;
use super::{Input, Line};
use crate::scene::read_error::ReadError;

impl Input {
    /// The next line; `None` after the last.
    ///
    /// # Errors
    /// [`ReadError`] if reading fails, or the line is longer than [`LONGEST_LINE`].
    pub(in crate::scene) fn line(&mut self) -> Result<Option<Line<'_>>, ReadError> {
        match self.find_end()? {
            Some(length) => Ok(Some(self.take_line(length))),
            None => Ok(None),
        }
    }

    /// The next line, which there must be: else the input ends early, as `what` says.
    ///
    /// # Errors
    /// As [`Self::line`], and if there is none.
    pub(in crate::scene) fn line_or(
        &mut self,
        what: impl FnOnce() -> String,
    ) -> Result<Line<'_>, ReadError> {
        match self.find_end()? {
            Some(length) => Ok(self.take_line(length)),
            None => Err(self.ends(what())),
        }
    }

    /// The next line, which there must be: else the input ends before `what`.
    ///
    /// # Errors
    /// As [`Self::line_or`].
    pub(in crate::scene) fn expect(&mut self, what: &str) -> Result<Line<'_>, ReadError> {
        self.line_or(|| format!("the file ends before {what}"))
    }

    /// How long the next line is; `None` after the last.
    fn find_end(&mut self) -> Result<Option<usize>, ReadError> {
        let mut searched = 0;
        loop {
            let rest = &self.buffer[self.start + searched..self.end];
            if let Some(length) = memchr::memchr(b'\n', rest) {
                return Ok(Some(searched + length));
            }
            searched += rest.len();
            if searched > LONGEST_LINE {
                let what = format!("a line of more than {} MiB", LONGEST_LINE >> 20);
                return Err(ReadError::at(&self.source, self.number + 1, 1, what));
            }
            if !self.fill()? {
                return Ok((searched > 0).then_some(searched));
            }
        }
    }

    /// Takes the next line, which is so long.
    fn take_line(&mut self, length: usize) -> Line<'_> {
        self.last = self.place();
        let end = self.start + length;
        self.terminated = end < self.end;
        let mut bytes = &self.buffer[self.start..end];
        self.start = end + usize::from(self.terminated);
        self.number += 1;
        if let Some(without) = bytes.strip_suffix(b"\r") {
            bytes = without;
        }
        if self.number == 1 {
            bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        }
        Line { bytes, number: self.number, source: &self.source }
    }
}
