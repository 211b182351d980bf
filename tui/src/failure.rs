//! How the program ends when it does not succeed: the exit codes, and the one line on stderr.

use std::io::{self, Write};
use std::process::ExitCode;

/// Why the program ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// Bad use, or input that cannot be read: exit code 2.
    Input(String),
    /// Something failed while running, an output that cannot be written among it: exit code 1.
    Running(String),
    /// Whoever read the output wants no more of it: a success.
    ReaderGone,
}

impl Failure {
    /// An output called `name` that cannot be written.
    #[must_use]
    pub fn of_output(name: &str, error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::ReaderGone,
            _ => Self::Running(format!("{name}: {}", cause(error))),
        }
    }

    /// Says on stderr what went wrong, in one line whatever names it holds, and returns the code
    /// to exit with.
    #[must_use]
    pub fn report(&self) -> ExitCode {
        let (message, code) = match self {
            Self::Input(message) => (message, 2),
            Self::Running(message) => (message, 1),
            Self::ReaderGone => return ExitCode::SUCCESS,
        };
        let printable =
            |c: char| if c.is_control() { c.escape_default().collect() } else { c.to_string() };
        let line: String = message.chars().map(printable).collect();
        // Where stderr is closed too, the exit code must do.
        let _ = writeln!(io::stderr(), "spherule: {line}");
        ExitCode::from(code)
    }
}

/// What went wrong, without the number that the operating system gives it.
#[must_use]
pub fn cause(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_lowercase()
}

/// Writes `bytes` to standard output, at once and to the end.
///
/// # Errors
/// [`Failure`] where that cannot be done.
pub fn write_stdout(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    let written = stdout.write_all(bytes).and_then(|()| stdout.flush());
    written.map_err(|error| Failure::of_output("standard output", &error))
}
