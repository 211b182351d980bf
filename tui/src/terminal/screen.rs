//! The screen and modes of the terminal: taken, given back, and written to, by any thread.

use super::unanswered;
use crate::error::stdout::write;
use crossterm::terminal;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::thread;
use std::time::{Duration, Instant};

/// The alternate screen; no cursor; no wrapping, so that a terminal that has just shrunk does not
/// scroll; presses, drags and the wheel of the mouse in decimal coordinates.
const ENTER: &[u8] = b"\x1b[?1049h\x1b[?25l\x1b[?7l\x1b[?1000h\x1b[?1002h\x1b[?1006h";
/// The reverse, whatever a broken-off frame has left behind. Where there is no alternate screen, such as in GNU screen and on
/// Linux's console, the prompt comes where the status line was.
const LEAVE: &[u8] = b"\x1b[?2026l\x1b[m\x1b[?1006l\x1b[?1002l\x1b[?1000l\x1b[?7h\x1b[?25h\
    \x1b[999;1H\x1b[K\x1b[?1049l";
/// A thread that is stuck in writing must not keep the others from giving the terminal back. One that gives it back is
/// waited for, as long as it waits for answers.
const PATIENCE: Duration = Duration::from_millis(800);

/// Between [`Terminal::enter`] and the last restoration, suspended or not.
static RUNNING: AtomicBool = AtomicBool::new(false);
/// The alternate screen is up and the modes are ours.
static SHOWN: AtomicBool = AtomicBool::new(false);
/// The screen was taken back after a suspension, and nothing has been drawn since.
static RESUMED: AtomicBool = AtomicBool::new(false);
/// What removes images that were sent, before the rest is given back.
static REMOVAL: Mutex<Vec<u8>> = Mutex::new(Vec::new());
/// Held while bytes or modes go to the terminal.
static OUTPUT: Mutex<()> = Mutex::new(());

/// Takes the terminal for the viewer.
pub(super) fn enter() -> io::Result<()> {
    let _output = output();
    RUNNING.store(true, SeqCst);
    take()
}

/// Sends `bytes` in one piece, or drops them if the terminal is given back just now; returns whether it has sent them.
pub(super) fn show(bytes: &[u8]) -> io::Result<bool> {
    // Whoever gives the terminal back holds the output until the last answers are read, perhaps by this thread.
    if !SHOWN.load(SeqCst) {
        return Ok(false);
    }
    let _output = output();
    if bytes.is_empty() || !SHOWN.load(SeqCst) {
        return Ok(false);
    }
    write(bytes)?;
    Ok(true)
}

/// Whether the screen was taken again since the last call.
pub(super) fn was_resumed() -> bool {
    RESUMED.swap(false, SeqCst)
}

/// Gives the terminal back for good.
pub(super) fn restore() {
    RUNNING.store(false, SeqCst);
    leave();
}

/// Gives the terminal back, if we have it. Whoever gets an error here is on the way out.
pub(super) fn leave() {
    let _output = output();
    if SHOWN.swap(false, SeqCst) {
        // Outside of raw mode answers would be echoed. A terminal that is gone answers nothing.
        if write(&leaving()).is_ok() {
            unanswered::let_come();
        }
        let _ = terminal::disable_raw_mode();
    }
}

pub(super) fn no_terminal(error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("no terminal to read keys from: {error}"))
}

/// Takes the terminal; the output is held by the caller.
fn take() -> io::Result<()> {
    terminal::enable_raw_mode().map_err(|error| no_terminal(&error))?;
    SHOWN.store(true, SeqCst);
    write(ENTER)
}

/// After SIGCONT: takes the terminal again and wakes the viewer up.
pub(super) fn resume() {
    {
        let _output = output();
        if !RUNNING.load(SeqCst) {
            return;
        }
        // After SIGSTOP from outside, nothing was given back, and what the modes are is not known.
        if SHOWN.load(SeqCst) {
            let _ = write(&leaving());
            let _ = terminal::disable_raw_mode();
        }
        if take().is_err() {
            return;
        }
        RESUMED.store(true, SeqCst);
    }
    // A resize wakes up the viewer, which may be waiting for a key.
    let _ = signal_hook::low_level::raise(signal_hook::consts::SIGWINCH);
}

/// From now on `bytes` are sent before the terminal is given back.
pub(super) fn set_removal(bytes: Vec<u8>) {
    *REMOVAL.lock().unwrap_or_else(PoisonError::into_inner) = bytes;
}

/// All that gives the terminal back, in one piece.
fn leaving() -> Vec<u8> {
    let removal = REMOVAL.lock().unwrap_or_else(PoisonError::into_inner);
    [removal.as_slice(), LEAVE].concat()
}

/// The right to write, or after a while no right but still the need.
fn output() -> Option<MutexGuard<'static, ()>> {
    let deadline = Instant::now() + PATIENCE;
    loop {
        match OUTPUT.try_lock() {
            Ok(guard) => return Some(guard),
            Err(TryLockError::Poisoned(poisoned)) => return Some(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) if Instant::now() >= deadline => return None,
            Err(TryLockError::WouldBlock) => thread::sleep(Duration::from_millis(1)),
        }
    }
}
