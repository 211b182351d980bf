//! What a person sees while there is nothing to read yet.

use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

/// A line on standard error that is written over, and gone in the end; on a terminal alone.
#[derive(Debug)]
pub struct Progress {
    on_terminal: bool,
    /// Nothing is shown before.
    from: Instant,
    shown: Option<String>,
}

impl Progress {
    /// Shows nothing yet, nor within `wait`.
    #[must_use]
    pub fn after(wait: Duration) -> Self {
        let on_terminal = io::stderr().is_terminal();
        Self { on_terminal, from: Instant::now() + wait, shown: None }
    }

    /// Shows at once what is being done, of which nobody knows how much is.
    #[must_use]
    pub fn say(doing: &str) -> Self {
        let mut progress = Self::after(Duration::ZERO);
        progress.write(format!("{doing} ..."));
        progress
    }

    /// Shows what is being done and how much of it is, from 0 to 1.
    pub fn show(&mut self, doing: &str, share: f64) {
        self.write(format!("{doing}: {:3.0} %", 100.0 * share));
    }

    fn write(&mut self, text: String) {
        if !self.on_terminal || Instant::now() < self.from {
            return;
        }
        if self.shown.as_ref() != Some(&text) {
            // If it cannot be shown, what is done still comes.
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
