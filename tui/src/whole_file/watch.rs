//! Files that are being written, and the signals that end the process: all of them are removed before it ends.

use crate::error::signal::{self, end_by, heard};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::{fs, io};
use tempfile::NamedTempFile;

/// Removes a file if the user or the system ends the process.
#[derive(Debug)]
pub struct Watch {
    path: PathBuf,
}

impl Watch {
    /// Watches the file that `make` makes, from its first moment on.
    ///
    /// # Errors
    /// If it cannot be made, or nothing can wait for signals.
    pub(super) fn over(
        make: impl FnOnce() -> io::Result<NamedTempFile>,
    ) -> io::Result<(Self, NamedTempFile)> {
        let mut unfinished = unfinished();
        unfinished.await_signals()?;
        let file = make()?;
        let path = file.path().to_owned();
        unfinished.paths.insert(path.clone());
        Ok((Self { path }, file))
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        unfinished().paths.remove(&self.path);
    }
}

/// The files that there are under other names.
struct Unfinished {
    paths: BTreeSet<PathBuf>,
    is_waiting: bool,
}

fn unfinished() -> MutexGuard<'static, Unfinished> {
    static UNFINISHED: Mutex<Unfinished> =
        Mutex::new(Unfinished { paths: BTreeSet::new(), is_waiting: false });
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Unfinished {
    /// Waits for signals from the first file on. One thread waits: of several, the first would end the process before the others
    /// have removed their files.
    fn await_signals(&mut self) -> io::Result<()> {
        if self.is_waiting {
            return Ok(());
        }
        signal::watch(heard(), |signal| {
            // It is held to the end, so that no further file is begun.
            let unfinished = unfinished();
            for path in &unfinished.paths {
                let _ = fs::remove_file(path);
            }
            end_by(signal);
        })?;
        self.is_waiting = true;
        Ok(())
    }
}
