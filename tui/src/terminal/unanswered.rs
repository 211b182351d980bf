//! Questions that the terminal has not answered. Whoever has it next would take the answers for keys.
//!
//! They are known to every thread, since threads that do not read the terminal give it back, too.

use super::abilities::PATIENCE;
use super::tty;
use rustix::termios::{QueueSelector, tcflush};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How long answers are waited for when the terminal is given back.
const LAST_WORDS: Duration = Duration::from_millis(500);
/// The time between two looks at what others have read.
const GLANCE: Duration = Duration::from_millis(2);

static QUESTIONS: Mutex<Questions> = Mutex::new(Questions::NONE);

#[derive(Debug)]
struct Questions {
    /// Questions that are open, besides those at the start.
    open: u32,
    /// Until when the answers at the start are waited for, while they have not come.
    first: Option<Instant>,
}

impl Questions {
    const NONE: Self = Self { open: 0, first: None };

    /// Until when answers are waited for by whoever gives the terminal back at `left`; `None` if there are none to come.
    ///
    /// A terminal that has answered once is known to answer. One that has not may do so late, or never: for its first
    /// answers the wait ends soon after it was asked, however late it is left.
    fn until(&self, left: Instant) -> Option<Instant> {
        if self.open > 0 { Some(left + LAST_WORDS) } else { self.first }
    }
}

fn questions() -> MutexGuard<'static, Questions> {
    QUESTIONS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The terminal was asked at `now` what it can do.
pub(super) fn asked_first(now: Instant) {
    questions().first = Some(now + PATIENCE + LAST_WORDS);
}

/// It has answered all that it ever will of that, and so has one behind it that was asked.
pub(super) fn answered_first() {
    questions().first = None;
}

/// The terminal is asked how far it has come.
pub(super) fn asked() {
    questions().open += 1;
}

/// It has answered that, or was not asked.
pub(super) fn answered() {
    let mut questions = questions();
    questions.open = questions.open.saturating_sub(1);
}

/// Of those questions the oldest will not be answered any more, so that at most `count` are open.
pub(super) fn keep(count: u32) {
    let mut questions = questions();
    questions.open = questions.open.min(count);
}

/// How many questions are open, besides those at the start.
pub(super) fn count() -> u32 {
    questions().open
}

/// No answer will come any more.
pub(super) fn forget() {
    *questions() = Questions::NONE;
}

/// Until when whoever gives the terminal back at `left` reads answers.
pub(super) fn until(left: Instant) -> Option<Instant> {
    questions().until(left)
}

/// Waits for the answers that are on their way. Whoever else reads the terminal takes them; what no one has read at the
/// end is dropped.
///
/// It does not read them itself: beside another reader that might wait for ever.
pub(super) fn let_come() {
    let left = Instant::now();
    while let Some(end) = until(left) {
        if Instant::now() < end {
            thread::sleep(GLANCE);
            continue;
        }
        // Else the terminal never answers, and what has come are keys.
        if end > left {
            let _ = tty::open().map(|tty| tcflush(tty, QueueSelector::IFlush));
        }
        forget();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_terminal_that_never_answered_is_not_waited_for_again() {
        let start = Instant::now();
        let later = start + Duration::from_secs(60);
        let asked = Questions { first: Some(start + LAST_WORDS), ..Questions::NONE };
        assert_eq!(asked.until(later), Some(start + LAST_WORDS));
        let both = Questions { open: 2, ..asked };
        assert_eq!(both.until(later), Some(later + LAST_WORDS));
        assert_eq!(Questions::NONE.until(later), None);
    }
}
