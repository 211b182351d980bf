//! Signals that end, stop or continue the process while the viewer has the terminal.
//!
//! A thread of its own takes them, so that a long frame does not hold them up.

use super::screen::{leave, restore, resume};
use crossterm::terminal;
use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// How long a terminal that takes no output may hold up the end of the process.
const GRACE: Duration = Duration::from_secs(1);

/// Starts to watch, once a process: handlers cannot be taken away again.
pub(super) fn watch() -> io::Result<()> {
    static WATCHING: AtomicBool = AtomicBool::new(false);
    if WATCHING.swap(true, SeqCst) {
        return Ok(());
    }
    let mut signals = Signals::new([SIGTERM, SIGHUP, SIGINT, SIGQUIT, SIGTSTP, SIGCONT])?;
    thread::Builder::new().name("signals".into()).spawn(move || {
        for signal in signals.forever() {
            match signal {
                SIGCONT => resume(),
                SIGTSTP => {
                    leave();
                    let _ = emulate_default_handler(signal);
                }
                _ => die_by(signal),
            }
        }
    })?;
    Ok(())
}

/// Restores, then lets the signal do what it does to a process without a handler, so that whoever
/// waits for us learns of it.
pub(super) fn die_by(signal: i32) {
    let (done, restored) = mpsc::channel();
    let restoring = thread::Builder::new().spawn(move || {
        restore();
        let _ = done.send(());
    });
    if restoring.is_ok() {
        let _ = restored.recv_timeout(GRACE);
    }
    // A terminal that is stopped by Ctrl-S takes no bytes, but modes it does.
    let _ = terminal::disable_raw_mode();
    let _ = emulate_default_handler(signal);
}
