//! The terminal while the viewer has it, and as it was before.
//!
//! It is given back on every way out: [`Terminal`] is dropped on quit and on error, a panic hook
//! comes before the message of a panic, and a thread watches for signals (see `signals`). Giving
//! back twice does no harm.

pub mod color_depth;
mod input;
pub mod locale;
mod screen;
mod signals;
mod wish;

use crate::error::{Error, cause};
use crossterm::event::Event;
use crossterm::terminal;
use input::Input;
use std::io;
use std::panic;
use std::sync::Once;
use std::time::Duration;
pub use wish::{Wish, wish};

/// Events taken before something is drawn all the same: whoever pastes a file sees something.
pub const LONGEST_BACKLOG: usize = 4096;
/// As `--size` has it: a terminal that claims more is not believed.
const LARGEST_SIZE: u16 = 4096;

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
        let this = Self { input: Input::open().map_err(|error| screen::no_terminal(&error))? };
        screen::enter()?;
        Ok(this)
    }

    /// The next thing that the terminal has to say, if it does within `wait`; without, whenever
    /// it does. A resize tells that the size must be read, not what it is.
    ///
    /// # Errors
    /// If the terminal cannot be read.
    pub fn next_event(&mut self, wait: Option<Duration>) -> io::Result<Option<Event>> {
        self.input.next(wait)
    }

    /// Columns and rows, each at most 4096; either may be 0.
    ///
    /// # Errors
    /// If the terminal does not tell.
    pub fn size(&self) -> io::Result<(u16, u16)> {
        let (columns, rows) = terminal::size()?;
        Ok((columns.min(LARGEST_SIZE), rows.min(LARGEST_SIZE)))
    }

    /// Sends `bytes` in one piece, or drops them if the terminal is given back just now.
    ///
    /// # Errors
    /// If the terminal is gone.
    pub fn show(&self, bytes: &[u8]) -> io::Result<()> {
        screen::show(bytes)
    }

    /// Gives the terminal back and stops the process group, as Ctrl-Z does outside of raw mode.
    /// The screen is taken again by the thread that sees SIGCONT.
    ///
    /// # Errors
    /// If the group cannot be stopped.
    pub fn suspend(&self) -> io::Result<()> {
        screen::leave();
        // SIGTSTP sent to oneself is dropped where the group is orphaned; SIGSTOP never is.
        rustix::process::kill_current_process_group(rustix::process::Signal::STOP)?;
        Ok(())
    }

    /// Whether the screen was taken again since the last call: nothing drawn before is on it.
    #[must_use]
    pub fn was_resumed(&self) -> bool {
        screen::was_resumed()
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        screen::restore();
    }
}

/// The terminal is not there.
#[must_use]
pub fn lost(error: &io::Error) -> Error {
    Error::Running(format!("terminal: {}", cause(error)))
}

/// The message of a panic on the alternate screen would vanish with it.
fn restore_before_panic_message() {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let print = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            screen::restore();
            print(panic);
        }));
    });
}
