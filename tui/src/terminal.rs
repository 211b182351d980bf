//! The terminal while the viewer has it, and as it was before.
//!
//! It is given back on every way out: [`Terminal`] is dropped on quit and on error, a panic hook
//! comes before the message of a panic, and a thread watches for signals (see `signals`). Giving
//! back twice does no harm.

mod input;
mod signals;

use crossterm::event::Event;
use crossterm::terminal;
use input::Input;
use std::io;
use std::os::fd::AsFd;
use std::panic;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::sync::{Mutex, MutexGuard, Once, TryLockError};
use std::thread;
use std::time::{Duration, Instant};

/// The alternate screen; no cursor; no wrapping, so that a terminal that has just shrunk does not
/// scroll; presses, drags and the wheel of the mouse in decimal coordinates.
const ENTER: &[u8] = b"\x1b[?1049h\x1b[?25l\x1b[?7l\x1b[?1000h\x1b[?1002h\x1b[?1006h";
/// The reverse, whatever a broken-off frame has left behind.
const LEAVE: &[u8] =
    b"\x1b[?2026l\x1b[m\x1b[?1006l\x1b[?1002l\x1b[?1000l\x1b[?7h\x1b[?25h\x1b[?1049l";
/// A thread that is stuck in writing must not keep the others from giving the terminal back.
const PATIENCE: Duration = Duration::from_millis(500);

/// Between [`Terminal::enter`] and the last restoration, suspended or not.
static RUNNING: AtomicBool = AtomicBool::new(false);
/// The alternate screen is up and the modes are ours.
static SHOWN: AtomicBool = AtomicBool::new(false);
/// The screen was taken back after a suspension, and nothing has been drawn since.
static RESUMED: AtomicBool = AtomicBool::new(false);
/// Held while bytes or modes go to the terminal.
static OUTPUT: Mutex<()> = Mutex::new(());

/// The terminal in raw mode, on its alternate screen. Dropping it gives it back.
#[derive(Debug)]
pub struct Terminal {
    input: Input,
}

impl Terminal {
    /// Takes the terminal.
    ///
    /// # Errors
    /// If there is no terminal to read keys from, or it does not do what it is told.
    pub fn enter() -> io::Result<Self> {
        signals::watch()?;
        restore_before_panic_message();
        let this = Self { input: Input::open().map_err(|error| no_terminal(&error))? };
        let _output = output();
        RUNNING.store(true, SeqCst);
        take()?;
        Ok(this)
    }

    /// The next thing that the terminal has to say, if it does within `wait`; without, whenever
    /// it does. A resize tells that the size must be asked for, not what it is.
    ///
    /// # Errors
    /// If the terminal cannot be read.
    pub fn next_event(&mut self, wait: Option<Duration>) -> io::Result<Option<Event>> {
        self.input.next(wait)
    }

    /// Columns and rows; either may be 0.
    ///
    /// # Errors
    /// If the terminal does not tell.
    pub fn size(&self) -> io::Result<(u16, u16)> {
        terminal::size()
    }

    /// Sends `bytes` in one piece, or drops them if the terminal is given back just now.
    ///
    /// # Errors
    /// If the terminal is gone.
    pub fn show(&self, bytes: &[u8]) -> io::Result<()> {
        let _output = output();
        if bytes.is_empty() || !SHOWN.load(SeqCst) {
            return Ok(());
        }
        write(bytes)
    }

    /// Gives the terminal back and stops the process group, as Ctrl-Z does outside of raw mode.
    /// The screen is taken again by the thread that sees SIGCONT.
    ///
    /// # Errors
    /// If the group cannot be stopped.
    pub fn suspend(&self) -> io::Result<()> {
        leave();
        // SIGTSTP sent to oneself is dropped where the group is orphaned; SIGSTOP never is.
        rustix::process::kill_current_process_group(rustix::process::Signal::STOP)?;
        Ok(())
    }

    /// Whether the screen was taken again since the last call: nothing drawn before is on it.
    #[must_use]
    pub fn was_resumed(&self) -> bool {
        RESUMED.swap(false, SeqCst)
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        restore();
    }
}

/// Gives the terminal back for good.
fn restore() {
    RUNNING.store(false, SeqCst);
    leave();
}

/// Gives the terminal back, if we have it. Whoever gets an error here is on the way out.
fn leave() {
    let _output = output();
    if SHOWN.swap(false, SeqCst) {
        let _ = write(LEAVE);
        let _ = terminal::disable_raw_mode();
    }
}

fn no_terminal(error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("no terminal to read keys from: {error}"))
}

/// Takes the terminal; the output is held by the caller.
fn take() -> io::Result<()> {
    terminal::enable_raw_mode().map_err(|error| no_terminal(&error))?;
    SHOWN.store(true, SeqCst);
    write(ENTER)
}

/// After SIGCONT: takes the terminal again and wakes the viewer up.
fn resume() {
    {
        let _output = output();
        if !RUNNING.load(SeqCst) {
            return;
        }
        // Stopped by SIGSTOP from outside, nothing was given back; who knows what the modes are.
        if SHOWN.load(SeqCst) {
            let _ = write(LEAVE);
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

/// One `write(2)`, unless the terminal takes less at once. Not through `io::Stdout`: its buffer
/// cuts a frame at the last newline.
fn write(mut bytes: &[u8]) -> io::Result<()> {
    let stdout = io::stdout();
    while !bytes.is_empty() {
        match rustix::io::write(stdout.as_fd(), bytes) {
            Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
            Ok(written) => bytes = &bytes[written..],
            Err(rustix::io::Errno::INTR) => {}
            // Someone who shares the terminal has made it non-blocking.
            Err(rustix::io::Errno::AGAIN) => thread::sleep(Duration::from_millis(1)),
            Err(error) => return Err(error.into()),
        }
    }
    Ok(())
}

/// The message of a panic on the alternate screen would vanish with it.
fn restore_before_panic_message() {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let print = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            restore();
            print(panic);
        }));
    });
}
