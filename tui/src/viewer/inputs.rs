//! Takes what comes from the terminal: what the user does, and what the terminal itself says.

use super::film::Film;
use super::keys;
use super::session::Viewer;
use super::shown::Outcome;
use super::studio::Studio;
use super::wanted::Wanted;
use crate::error::Error;
use crate::scene::framing;
use crate::terminal::{Incoming, LONGEST_BACKLOG, Reply, lost};
use crossterm::event::Event;
use std::time::{Duration, Instant};

/// Set, the key `!` panics. There is no other way to test that the terminal survives a panic of
/// the real program; it has no effect unless the variable is set.
pub(super) const PANIC_SWITCH: &str = "SPHERULE_TEST_PANIC";

impl Viewer {
    /// Waits for input, for ever without `wait`, and takes all there is. While the studio draws, it is lent; then what needs
    /// it is postponed.
    pub(super) fn take_input(
        &mut self,
        mut studio: Option<&mut Studio<'_>>,
        wait: Option<Duration>,
    ) -> Result<Outcome, Error> {
        let mut outcome = Outcome::Unchanged;
        let mut wait = wait;
        for _ in 0..LONGEST_BACKLOG {
            let incoming = match self.postponed.take() {
                Some(event) => Some(Incoming::User(event)),
                None => self.terminal.next_event(wait).map_err(|error| lost(&error))?,
            };
            let Some(incoming) = incoming else { break };
            wait = Some(Duration::ZERO);
            let event = match incoming {
                Incoming::User(event) => event,
                Incoming::Reply(reply) => {
                    if reply == Reply::Status {
                        self.flow.answered(Instant::now());
                    }
                    outcome = outcome.and(self.heed_image_reply(reply)).and(self.heed_abilities());
                    continue;
                }
            };
            let takes_notice = matches!(event, Event::Key(_)) && !self.owes_notice;
            if takes_notice && self.notice.take().is_some() {
                outcome = outcome.and(Outcome::Changed);
                // Of all that Escape closes, a word of the program is the first.
                if keys::input(&event) == Some(keys::Input::Escape) {
                    continue;
                }
            }
            if self.panic_key && keys::is_panic(&event) {
                panic!("asked for by {PANIC_SWITCH}");
            }
            match keys::input(&event) {
                Some(keys::Input::Suspend) => {
                    let was_stopped = self.terminal.suspend().map_err(|error| lost(&error))?;
                    if !was_stopped {
                        self.notice = Some("Ctrl-Z: there is no shell to continue it".to_owned());
                        outcome = outcome.and(Outcome::Changed);
                    }
                }
                // The terminal may have moved its cells about, even if the size is the same; or others have written.
                Some(keys::Input::Resize) => {
                    self.encoder.forget();
                    if self.flow.resized(Instant::now()) {
                        self.terminal.await_at_most(self.flow.open());
                        self.pixels.awaits_first = None;
                    }
                    self.learn_size().map_err(|error| lost(&error))?;
                    self.say_too_large();
                    outcome = Outcome::Changed;
                }
                Some(keys::Input::CommandLine) => {
                    self.tell_command_line();
                    outcome = outcome.and(Outcome::Changed);
                }
                Some(keys::Input::Record) => {
                    self.record();
                    outcome = outcome.and(Outcome::Changed);
                }
                Some(keys::Input::FrameAll) => {
                    let all = framing::subject(self.scene.spheres());
                    self.framed = Some(all);
                    outcome = outcome.and(self.state.frame(all));
                }
                Some(keys::Input::FramePicked) if self.state.shown.cursor.is_some() => {
                    let Some(studio) = studio.as_deref_mut() else {
                        // Held down, it asks for what is being drawn.
                        if self.entered == Some((self.wanted(), self.state.shown.cursor)) {
                            continue;
                        }
                        self.postponed = Some(event);
                        return Ok(outcome.and(Outcome::Changed));
                    };
                    let cursor = self.state.shown.cursor;
                    // What is seen, if it is of what is wanted: keys may have moved on.
                    let (seen, wanted) = (self.picture.as_ref().map(|last| last.of), self.wanted());
                    let is_of_it = |of: &Wanted| (of.scene, of.size) == (wanted.scene, wanted.size);
                    let of = seen.filter(is_of_it).unwrap_or(wanted);
                    let pick = studio.pick(&self.scene, &of, cursor)?;
                    if let Some(sphere) = pick.and_then(|pick| Some(pick.sphere?.sphere)) {
                        outcome = outcome.and(self.state.frame(sphere));
                    }
                    self.entered = Some((self.wanted(), self.state.shown.cursor));
                }
                Some(keys::Input::Spin) if self.plays() => {
                    self.film.iter_mut().for_each(Film::play);
                    outcome = outcome.and(Outcome::Changed);
                }
                Some(keys::Input::Step(forward)) if self.film.is_some() => {
                    self.film.iter_mut().for_each(|film| film.step(forward));
                    outcome = outcome.and(Outcome::Changed);
                }
                Some(input) => {
                    // Glyphs that the terminal draws wider than a cell must leave nothing behind.
                    if input == keys::Input::Charset {
                        self.encoder.forget();
                    }
                    outcome = outcome.and(self.state.apply(input));
                }
                None => {}
            }
            if outcome == Outcome::Quit {
                break;
            }
        }
        if self.terminal.was_resumed() {
            self.encoder.forget();
            self.flow.forget();
            // Whoever had the terminal has had the answer.
            self.pixels.awaits_first = None;
            outcome = outcome.and(Outcome::Changed);
        }
        Ok(outcome)
    }

    /// Whether there is something to play.
    fn plays(&self) -> bool {
        self.film.as_ref().is_some_and(Film::has_more)
    }

    /// Adapts to what the terminal can do.
    pub(super) fn heed_abilities(&mut self) -> Outcome {
        let abilities = self.terminal.abilities();
        self.encoder.set_synchronized(abilities.synchronized);
        self.surroundings.told = abilities.truecolor;
        self.state.set_depth(self.surroundings.depth(self.asked.color))
    }
}
