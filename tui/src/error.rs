//! How the program ends without success: the exit codes, and the one line on stderr.

pub mod broken_off;
pub mod caught;
pub mod signal;
pub mod stdout;

use crate::harmless;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

/// Why the program ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// Bad use, or input that cannot be read: exit code 2.
    Input(String),
    /// A failure while running, such as an output that cannot be written: exit code 1.
    Running(String),
    /// The reader of the output closed it: a success.
    ReaderGone,
}

impl Error {
    /// The error of an output called `name` that cannot be written.
    #[must_use]
    pub fn of_output(name: &str, error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::ReaderGone,
            _ => Self::Running(format!("{name}: {}", cause(error))),
        }
    }

    /// The same of an output to the file `path`; `-` is standard output.
    pub(crate) fn of_file(path: &Path, error: &io::Error) -> Self {
        let name =
            if path == Path::new("-") { "standard output".into() } else { path.to_string_lossy() };
        Self::of_output(&name, error)
    }

    /// Writes the error to stderr, in one line whatever names it holds, and returns the exit code.
    #[must_use]
    pub fn report(&self) -> ExitCode {
        let (message, code) = match self {
            Self::Input(message) => (message, 2),
            Self::Running(message) => (message, 1),
            Self::ReaderGone => return ExitCode::SUCCESS,
        };
        // If stderr is closed too, the exit code must do.
        let _ = writeln!(io::stderr(), "spherule: {}", harmless::line(message));
        ExitCode::from(code)
    }
}

/// What went wrong, without the number that the operating system gives it.
#[must_use]
pub fn cause(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_lowercase()
}

/// The line and the column of a byte of `text`, in characters, both from 1.
pub(crate) fn place_in(text: &str, byte: usize) -> (usize, usize) {
    let before = text.get(..byte).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|&letter| letter != '\n').count() + 1;
    (line, column)
}

/// Writes all `bytes` to standard output.
///
/// # Errors
/// [`Error`] if that fails.
pub fn write_stdout(bytes: &[u8]) -> Result<(), Error> {
    broken_off::write(bytes).map_err(|error| Error::of_output("standard output", &error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_counted_in_lines_and_characters() {
        let places = [0, 1, 2, 4, 6].map(|byte| place_in("a\nßb\n", byte));
        assert_eq!(places, [(1, 1), (1, 2), (2, 1), (2, 2), (3, 1)]);
    }
}
