//! The terminal while the viewer has it, and as it was before.
//!
//! It is given back on every way out: [`Terminal`] is dropped on quit and on error, a panic hook
//! comes before the message of a panic, and a thread watches for signals (see `signals`). Giving
//! back twice does no harm.

mod abilities;
pub mod color_depth;
mod input;
mod job;
pub mod locale;
pub mod multiplexer;
mod reply;
mod screen;
mod signals;
mod size;
mod tty;
mod unanswered;
mod variable;
mod wish;

use crate::error::caught::before_message;
use crate::error::{Error, cause};
pub use abilities::{ASKED_IMAGE, Abilities, Uses};
use abilities::{PATIENCE, questions};
pub use input::Incoming;
use input::{Input, or_hung_up};
use multiplexer::Multiplexer;
pub use reply::Reply;
pub use size::{pixels_of_cell, size_of_stdout};
use std::collections::VecDeque;
use std::io;
use std::sync::Once;
use std::time::{Duration, Instant};
pub(crate) use variable::variable;
pub use wish::{Wish, wish};

/// The most events that are taken before something is drawn all the same: whoever pastes a file sees something.
pub const LONGEST_BACKLOG: usize = 4096;

/// The terminal in raw mode, on its alternate screen. Dropping it gives it back.
#[derive(Debug)]
pub struct Terminal {
    input: Input,
    abilities: Abilities,
    /// Whether the terminal behind tmux has still to answer.
    awaits_behind: bool,
    /// What the user did while answers were waited for.
    early: VecDeque<Incoming>,
}

/// Asks how far the terminal has come (DSR 5): it answers when it has taken everything before.
const ASK_STATUS: &[u8] = b"\x1b[5n";

impl Terminal {
    /// Takes the terminal. If `may_ask`, asks it what it can do of all that there are `uses` for, and waits for the answers
    /// for at most a fifth of a second.
    ///
    /// # Errors
    /// If there is no terminal to read keys from, or it does not do what it is told.
    pub fn enter(may_ask: bool, uses: Uses) -> io::Result<Self> {
        signals::watch()?;
        restore_before_panic_message();
        let mut this = Self {
            input: Input::open().map_err(|error| screen::no_terminal(&error))?,
            abilities: Abilities::default(),
            awaits_behind: false,
            early: VecDeque::new(),
        };
        screen::enter()?;
        if may_ask {
            this.ask(uses)?;
        }
        Ok(this)
    }

    fn ask(&mut self, uses: Uses) -> io::Result<()> {
        self.input.await_answers(true);
        let multiplexer = Multiplexer::of_process();
        screen::show(&questions(&variable("TERM"), multiplexer, uses))?;
        // tmux itself answers first; the terminal behind it may never be asked.
        self.awaits_behind = uses.kitty && multiplexer == Some(Multiplexer::Tmux);
        let asked = Instant::now();
        unanswered::asked_first(asked);
        let deadline = asked + PATIENCE;
        while !self.abilities.has_answered || self.awaits_behind {
            let left = deadline.saturating_duration_since(Instant::now());
            match self.input.next(Some(left))? {
                Some(Incoming::Reply(reply)) => self.learn(reply),
                Some(incoming) => self.early.push_back(incoming),
                None => break,
            }
        }
        Ok(())
    }

    fn learn(&mut self, reply: Reply) {
        // What is just the window's size is no limit: it grows with the window.
        let is_window =
            matches!(reply, Reply::SixelPixels(width, height) if self.is_window(width, height));
        if !is_window {
            self.abilities.learn(reply);
        }
        match reply {
            Reply::Status => unanswered::answered(),
            Reply::Image(ASKED_IMAGE, _) => self.awaits_behind = false,
            _ => {}
        }
        if !self.abilities.has_answered {
            return;
        }
        if !self.awaits_behind {
            unanswered::answered_first();
        }
        let now = Instant::now();
        if unanswered::until(now).is_none_or(|end| end <= now) {
            self.input.await_answers(false);
        }
    }

    /// Whether the window has so many pixels now, apart from what is left over beside its cells.
    fn is_window(&self, width: u32, height: u32) -> bool {
        let (Some(cell), Ok(cells)) = (pixels_of_cell(self.abilities.cell_pixels), self.size())
        else {
            return false;
        };
        let is_side = |pixels: u32, count: u16, cell: u32| {
            let all = u32::from(count) * cell;
            (all..all + cell).contains(&pixels)
        };
        is_side(width, cells.0, cell.0) && is_side(height, cells.1, cell.1)
    }

    /// What is known of the terminal by now.
    #[must_use]
    pub fn abilities(&self) -> &Abilities {
        &self.abilities
    }

    /// The next thing that the terminal has to say, if it comes within `wait`; without `wait`, whenever it comes. A
    /// resize tells that the size must be read, not what it is. An answer has already been noted.
    ///
    /// # Errors
    /// If the terminal cannot be read.
    pub fn next_event(&mut self, wait: Option<Duration>) -> io::Result<Option<Incoming>> {
        if let Some(early) = self.early.pop_front() {
            return Ok(Some(early));
        }
        let incoming = self.input.next(wait)?;
        if let Some(Incoming::Reply(reply)) = incoming {
            self.learn(reply);
        }
        Ok(incoming)
    }

    /// Columns and rows, each at most 4096; one of them may be 0. A terminal that knows neither, as on a serial line, has
    /// those of `COLUMNS` and `LINES`, or the usual ones, until it tells others.
    ///
    /// # Errors
    /// If the terminal does not tell.
    pub fn size(&self) -> io::Result<(u16, u16)> {
        size::size().map_err(or_hung_up)
    }

    /// Sends `bytes` in one piece, or drops them if the terminal is given back just now.
    ///
    /// # Errors
    /// If the terminal is gone.
    pub fn show(&self, bytes: &[u8]) -> io::Result<()> {
        screen::show(bytes).map_err(or_hung_up)?;
        Ok(())
    }

    /// Sends `bytes` in one piece, and asks the terminal to answer [`Reply::Status`] when it has taken them.
    ///
    /// # Errors
    /// If the terminal is gone.
    pub fn show_and_ask(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
        bytes.extend_from_slice(ASK_STATUS);
        // Before it is sent: whoever gives the terminal back meanwhile waits for the answer.
        unanswered::asked();
        self.input.await_answers(true);
        if !screen::show(bytes).map_err(or_hung_up)? {
            unanswered::answered();
        }
        Ok(())
    }

    /// How many frames are sent whose [`Reply::Status`] is still to come.
    #[must_use]
    pub fn open_questions(&self) -> u32 {
        unanswered::count()
    }

    /// Gives up the oldest answers, so that at most `count` are still to come.
    pub fn await_at_most(&self, count: u32) {
        unanswered::keep(count);
    }

    /// Sets the `bytes` that are sent before the terminal is given back, whenever that is: they remove images.
    pub fn remove_when_leaving(&self, bytes: Vec<u8>) {
        screen::set_removal(bytes);
    }

    /// Sets what is called after the terminal is given back, before a signal or a hang-up ends the process. It may be called by two threads
    /// at once, and keeps the process alive until it returns.
    pub fn do_last(&self, last: fn()) {
        signals::do_last(last);
    }

    /// Gives the terminal back and stops the process group, as Ctrl-Z does outside of raw mode, unless no shell could
    /// continue it; returns whether it was stopped. The screen is taken again by the thread that sees SIGCONT.
    ///
    /// # Errors
    /// If the group cannot be stopped.
    pub fn suspend(&mut self) -> io::Result<bool> {
        if !job::has_shell() {
            return Ok(false);
        }
        self.take_open_answers();
        screen::leave();
        // SIGTSTP would come to the thread that watches for it.
        rustix::process::kill_current_process_group(rustix::process::Signal::STOP)?;
        Ok(true)
    }

    /// Waits for the answers that are on their way: they would come to whoever has the terminal next, who would take them
    /// for keys.
    fn take_open_answers(&mut self) {
        let leaving = Instant::now();
        while let Some(deadline) = unanswered::until(leaving) {
            let left = deadline.saturating_duration_since(Instant::now());
            match self.input.next(Some(left)) {
                Ok(Some(Incoming::Reply(reply))) => self.learn(reply),
                Ok(Some(Incoming::User(_))) => {}
                Ok(None) | Err(_) => break,
            }
        }
        unanswered::forget();
    }

    /// Whether the screen was taken again since the last call: nothing drawn before is on it, and whoever had the terminal
    /// meanwhile has had its answers.
    #[must_use]
    pub fn was_resumed(&mut self) -> bool {
        let was_resumed = screen::was_resumed();
        if was_resumed {
            unanswered::forget();
        }
        was_resumed
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        self.take_open_answers();
        screen::restore();
    }
}

/// The error that the terminal is not there.
#[must_use]
pub fn lost(error: &io::Error) -> Error {
    Error::Running(format!("terminal: {}", cause(error)))
}

/// The message of a panic on the alternate screen would vanish with it. After one that is caught, the viewer goes on.
fn restore_before_panic_message() {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| before_message(screen::restore));
}
