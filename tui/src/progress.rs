//! What a person sees while there is nothing to read yet.

use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

/// How long a picture may take before its progress is shown.
pub const PATIENCE: Duration = Duration::from_secs(1);

/// A line on standard error, on a terminal only, that is written over, and gone in the end.
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

    /// Shows what is being done, without a share: no one knows how much of it is done.
    pub fn say(&mut self, doing: &str) {
        self.write(format!("{doing} ..."));
    }

    /// Shows what is being done, and the share of it that is done, from 0 to 1.
    pub fn show(&mut self, doing: &str, share: f64) {
        self.write(format!("{doing}: {:3.0} %", 100.0 * share));
    }

    fn write(&mut self, text: String) {
        if !self.on_terminal || Instant::now() < self.from {
            return;
        }
        if self.shown.as_ref() != Some(&text) {
            // If progress cannot be shown, the work still goes on.
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
