//! What a person sees while there is nothing to read yet.

use std::env;
use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

/// How long a picture may take before its progress is shown.
pub const PATIENCE: Duration = Duration::from_secs(1);

/// A line on standard error, on a terminal that is not dumb, that is written over, and gone in the end.
#[derive(Debug)]
pub struct Progress {
    /// Whether there is a terminal that can take the line away.
    is_shown: bool,
    /// Nothing is shown before.
    from: Instant,
    shown: Option<String>,
}

impl Progress {
    /// Shows nothing yet, nor within `wait`.
    #[must_use]
    pub fn after(wait: Duration) -> Self {
        let is_dumb = env::var_os("TERM").is_some_and(|term| term == "dumb");
        let is_shown = io::stderr().is_terminal() && !is_dumb;
        Self { is_shown, from: Instant::now() + wait, shown: None }
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
        if !self.is_shown || Instant::now() < self.from {
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
