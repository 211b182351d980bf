//! Signals that end, stop or continue the process while the viewer has the terminal.
//!
//! A thread of its own takes them, so that a long frame does not hold them up.

use super::screen::{leave, restore, resume};
use crate::error::signal::{self, ENDING, at_last, end_by, heard};
use crossterm::terminal;
use signal_hook::consts::{SIGCONT, SIGHUP, SIGTSTP};
use signal_hook::low_level::emulate_default_handler;
use std::io;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};

/// What is done last before the process ends.
static LAST: OnceLock<fn()> = OnceLock::new();

/// From now on `last` is called before a signal, or a terminal that is gone, ends the process.
pub(super) fn do_last(last: fn()) {
    let _ = LAST.set(last);
}

/// Starts to watch, once a process: handlers cannot be taken away again.
pub(super) fn watch() -> io::Result<()> {
    static WATCHING: AtomicBool = AtomicBool::new(false);
    if WATCHING.swap(true, SeqCst) {
        return Ok(());
    }
    // A viewer without its terminal has nothing to do, whatever its starter ignores.
    let heard = heard();
    let ending = ENDING.into_iter().filter(|signal| *signal == SIGHUP || heard.contains(signal));
    signal::watch(ending.chain([SIGTSTP, SIGCONT]), |signal| match signal {
        SIGCONT => resume(),
        SIGTSTP => {
            leave();
            let _ = emulate_default_handler(signal);
        }
        _ => die_by(signal),
    })
}

/// Restores and does what is to be done last, then lets the signal do what it does to a process without a handler, so that whoever
/// waits for us learns of it.
pub(super) fn die_by(signal: i32) {
    at_last(restore);
    // A terminal that is stopped by Ctrl-S takes no bytes, but modes it does.
    let _ = terminal::disable_raw_mode();
    if let Some(last) = LAST.get() {
        last();
    }
    end_by(signal);
}
