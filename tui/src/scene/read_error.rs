//! Why an input is not a scene.

use crate::error::{cause, place_in};
use std::{fmt, io};

/// What is wrong, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadError {
    /// The file as the user named it; `-` for standard input.
    pub source: String,
    /// The line, from 1; `None` for the whole file.
    pub line: Option<usize>,
    /// The column in characters, from 1.
    pub column: Option<usize>,
    /// What is wrong with it.
    pub what: String,
    /// Whether the input ends too early, so that it may be valid when more of it has been written.
    pub ends_early: bool,
    /// Whether it is a frame without particles, behind which there may be others.
    pub is_empty_frame: bool,
}

impl ReadError {
    /// About a file as a whole.
    #[must_use]
    pub fn whole(source: &str, what: impl Into<String>) -> Self {
        let (source, what) = (source.to_owned(), what.into());
        Self { source, line: None, column: None, what, ends_early: false, is_empty_frame: false }
    }

    /// About a place in a file.
    #[must_use]
    pub fn at(source: &str, line: usize, column: usize, what: impl Into<String>) -> Self {
        Self { line: Some(line), column: Some(column), ..Self::whole(source, what) }
    }

    /// About a byte of a file that is all in `text`.
    pub(super) fn in_text(source: &str, text: &str, byte: usize, what: impl Into<String>) -> Self {
        let (line, column) = place_in(text, byte);
        Self::at(source, line, column, what)
    }

    /// About a file that cannot be read: makes an error of the system's.
    pub(super) fn io(source: &str) -> impl Fn(io::Error) -> Self {
        move |error| Self::whole(source, cause(&error))
    }

    /// The same, of an input that ends too early.
    #[must_use]
    pub fn of_end(self) -> Self {
        Self { ends_early: true, ..self }
    }

    /// The same, of a frame without particles, all of which has been read.
    #[must_use]
    pub fn of_empty_frame(self) -> Self {
        Self { is_empty_frame: true, ..self }
    }
}

impl fmt::Display for ReadError {
    /// `file:line:column: what`.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        // An empty name would not be seen.
        formatter.write_str(if self.source.is_empty() { "''" } else { self.source.as_str() })?;
        for place in [self.line, self.column].into_iter().flatten() {
            write!(formatter, ":{place}")?;
        }
        write!(formatter, ": {}", self.what)
    }
}

impl std::error::Error for ReadError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_empty_name_is_seen() {
        assert_eq!(ReadError::whole("", "no such file").to_string(), "'': no such file");
        assert_eq!(ReadError::at("a", 1, 2, "wrong").to_string(), "a:1:2: wrong");
    }
}
