//! What a person sees while there is nothing to read yet.

use std::io::{self, IsTerminal, Write};

/// A line on standard error that is written over, and gone in the end; on a terminal alone.
pub(super) struct Progress {
    on_terminal: bool,
    shown: Option<String>,
}

impl Progress {
    /// Shows nothing yet.
    pub(super) fn new() -> Self {
        Self { on_terminal: io::stderr().is_terminal(), shown: None }
    }

    /// Shows what is done and how much of it, from 0 to 1.
    pub(super) fn show(&mut self, what: &str, share: f64) {
        if !self.on_terminal {
            return;
        }
        let text = format!("measuring {what}: {:3.0} %", 100.0 * share);
        if self.shown.as_ref() != Some(&text) {
            // If it cannot be shown, the figures still come.
            let _ = write!(io::stderr(), "\r{text}\x1b[K");
            self.shown = Some(text);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.shown.is_some() {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
    }
}
