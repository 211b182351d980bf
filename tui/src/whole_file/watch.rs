//! Files that are being written, and the signals that end the process: all of them are removed before it ends.

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::{fs, io, thread};
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
        let hang_up = if is_ignored(SIGHUP) { None } else { Some(SIGHUP) };
        let mut signals = Signals::new([SIGINT, SIGTERM].into_iter().chain(hang_up))?;
        thread::Builder::new().name("signals".into()).spawn(move || {
            for signal in signals.forever() {
                // It is held to the end, so that no further file is begun.
                let unfinished = unfinished();
                for path in &unfinished.paths {
                    let _ = fs::remove_file(path);
                }
                let _ = emulate_default_handler(signal);
            }
        })?;
        self.is_waiting = true;
        Ok(())
    }
}

/// Whether whoever started the process wants a signal to do nothing, as `nohup` does with SIGHUP: a handler would undo
/// that. Linux tells; on other systems it is assumed.
fn is_ignored(signal: i32) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_none_or(|mask| mask >> (signal - 1) & 1 == 1)
}
