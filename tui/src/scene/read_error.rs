//! Why an input is no scene.

use std::fmt;

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
}

impl ReadError {
    /// About a file as a whole.
    #[must_use]
    pub fn whole(source: &str, what: impl Into<String>) -> Self {
        Self { source: source.to_owned(), line: None, column: None, what: what.into() }
    }

    /// About a place in a file.
    #[must_use]
    pub fn at(source: &str, line: usize, column: usize, what: impl Into<String>) -> Self {
        Self { line: Some(line), column: Some(column), ..Self::whole(source, what) }
    }
}

impl fmt::Display for ReadError {
    /// `file:line:column: what`.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}", self.source)?;
        for place in [self.line, self.column].into_iter().flatten() {
            write!(formatter, ":{place}")?;
        }
        write!(formatter, ": {}", self.what)
    }
}

impl std::error::Error for ReadError {}
