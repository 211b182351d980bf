//! How many particles a file says that it has, and as many lines.

use super::words::{count, excerpt};
use crate::scene::input::{Input, Line};
use crate::scene::read_error::ReadError;

/// How many particles there are, each in a line, as a line before them says.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stated {
    pub(super) count: usize,
    /// The line that says so.
    pub(super) line: usize,
    /// What particles are in this format.
    pub(super) called: &'static str,
}

impl Stated {
    /// As a line says that has nothing else.
    ///
    /// # Errors
    /// [`ReadError`] if it is no number.
    pub(super) fn atoms(line: &Line<'_>) -> Result<Self, ReadError> {
        let text = line.trimmed();
        match count(text) {
            Some(count) => Ok(Self { count, line: line.number, called: "atoms" }),
            None => Err(line.error(0, format!("{} is not a number of atoms", excerpt(text)))),
        }
    }

    /// The line of the next particle, behind those of so many.
    ///
    /// # Errors
    /// [`ReadError`] if there is none.
    pub(super) fn next<'a>(
        &self,
        input: &'a mut Input,
        behind: usize,
    ) -> Result<Line<'a>, ReadError> {
        input.line_or(|| {
            let Self { count, line, called } = self;
            format!("the file ends after {behind} of the {count} {called} that line {line} says")
        })
    }

    /// Leaves out the lines of all.
    ///
    /// # Errors
    /// [`ReadError`] if there are fewer.
    pub(super) fn skip(&self, input: &mut Input) -> Result<(), ReadError> {
        for particle in 0..self.count {
            self.next(input, particle)?;
        }
        Ok(())
    }

    /// The error that there are none: of a frame that has been read.
    pub(super) fn none(&self, source: &str, what: &str) -> ReadError {
        ReadError::at(source, self.line, 1, what).of_empty_frame()
    }

    /// The error that `line` is a further atom.
    pub(super) fn one_more(&self, line: &Line<'_>) -> ReadError {
        let Self { count, line: first, .. } = self;
        line.error(0, format!("one atom more than the {count} that line {first} says"))
    }
}
