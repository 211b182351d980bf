//! The viewer: input to state, state to picture, picture to terminal, until somebody quits.
//!
//! All input that is there is taken before a frame is drawn, so a slow link gets fewer frames,
//! not late ones. A frame of a movement gets no more samples than there is time for; when it is over, a full one
//! follows. Then nothing is drawn and nothing is sent, but how far a measurement is.

pub mod film;
mod frame;
mod hand;
mod help;
mod keys;
mod meter;
mod pace;
mod picking;
mod seam;
mod session;
mod state;
mod status;
mod table;

use crate::compare::error_map::ErrorMapper;
use crate::compare::split::Times;
use crate::draw::Renderer;
use crate::encode::Encoder;
use crate::error::Error;
use crate::scene::Scene;
use crate::scene::framing;
use crate::structure::scene::SceneStructures;
use crate::terminal::{LONGEST_BACKLOG, Terminal, lost};
use film::Film;
use meter::Meter;
use pace::Pace;
use session::Viewer;
pub use state::{ORBIT_STEP, PAN_STEP, Start, ZOOM_STEP};
use state::{Outcome, State};
use std::env;
use std::sync::Arc;
use std::time::{Duration, Instant};
use table::Table;

/// Frames a second while something moves, at most; over SSH every frame is waited for by the
/// keys behind it.
const LOCAL_RATE: u32 = 60;
const REMOTE_RATE: u32 = 30;
/// Set, the key `!` panics. There is no other way to test that the terminal survives a panic of
/// the real program; it has no effect unless the variable is set.
const PANIC_SWITCH: &str = "SPHERULE_TEST_PANIC";

/// Shows `scene` on the terminal, from `start` on, drawn by `renderer` with the chosen one of its
/// `structures`, until the user quits.
///
/// # Errors
/// [`Error::Running`] if there is no terminal to read keys from, or it goes away, or there is no
/// memory for a structure.
pub fn run(
    scene: &Arc<Scene>,
    structures: SceneStructures<'_>,
    start: Start,
    renderer: Renderer<'_>,
    film: Option<Film>,
) -> Result<(), Error> {
    let rate = if env::var_os("SSH_CONNECTION").is_some() { REMOTE_RATE } else { LOCAL_RATE };
    let interval = Duration::from_secs(1) / rate;
    let mut viewer = Viewer {
        scene: Arc::clone(scene),
        film,
        structures,
        terminal: Terminal::enter().map_err(|error| lost(&error))?,
        state: State::new(start),
        renderer,
        mapper: ErrorMapper::default(),
        times: Times::default(),
        encoder: Encoder::new(),
        meter: Meter::default(),
        pace: Pace::new(interval),
        table: Table::default(),
        picture: None,
        bytes: Vec::new(),
        panic_key: env::var_os(PANIC_SWITCH).is_some(),
    };
    viewer.learn_size().map_err(|error| lost(&error))?;
    let mut last_frame: Option<Instant> = None;
    let mut stale = true;
    loop {
        let film = viewer.film.as_ref().and_then(Film::wait);
        let wait = viewer.wait(stale, last_frame).into_iter().chain(film).min();
        match viewer.take_input(wait)? {
            Outcome::Quit => return Ok(()),
            Outcome::Changed => stale = true,
            Outcome::Unchanged => {}
        }
        stale |= viewer.go_on();
        if viewer.wait(stale, last_frame) == Some(Duration::ZERO) {
            let now = Instant::now();
            let moving = stale || viewer.state.shown.spinning;
            if let Some(last_frame) = last_frame {
                viewer.state.advance(now - last_frame);
            }
            viewer.show_frame(now, moving)?;
            last_frame = Some(now);
            stale = false;
        }
    }
}

impl Viewer<'_> {
    /// How long until a frame is due; for ever if there is none to draw.
    fn wait(&self, stale: bool, last_frame: Option<Instant>) -> Option<Duration> {
        let (shown, since_last) = (&self.state.shown, last_frame.map(|at| at.elapsed()));
        let picture = self.pace.wait(stale || shown.spinning, since_last);
        let table = self.table.wait(shown, self.state.size(), since_last);
        picture.into_iter().chain(table).min()
    }

    /// Waits for input, for ever without `wait`, and takes all there is.
    fn take_input(&mut self, wait: Option<Duration>) -> Result<Outcome, Error> {
        let mut outcome = Outcome::Unchanged;
        let mut wait = wait;
        for _ in 0..LONGEST_BACKLOG {
            let event = self.terminal.next_event(wait).map_err(|error| lost(&error))?;
            let Some(event) = event else { break };
            wait = Some(Duration::ZERO);
            if self.panic_key && keys::is_panic(&event) {
                panic!("asked for by {PANIC_SWITCH}");
            }
            match keys::input(&event) {
                Some(keys::Input::Suspend) => {
                    self.terminal.suspend().map_err(|error| lost(&error))?;
                }
                // The terminal may have moved its cells about, even if the size is the same.
                Some(keys::Input::Resize) => {
                    self.encoder.forget();
                    self.learn_size().map_err(|error| lost(&error))?;
                    outcome = Outcome::Changed;
                }
                Some(keys::Input::FrameAll) => {
                    let all = framing::subject(self.scene.spheres());
                    outcome = outcome.and(self.state.frame(all));
                }
                Some(keys::Input::FramePicked) => {
                    let picked = self.pick()?.and_then(|pick| Some(pick.sphere?.sphere));
                    if let Some(sphere) = picked {
                        outcome = outcome.and(self.state.frame(sphere));
                    }
                }
                Some(keys::Input::Spin) if self.plays() => {
                    self.film.iter_mut().for_each(Film::play);
                    outcome = outcome.and(Outcome::Changed);
                }
                Some(keys::Input::Step(forward)) if self.film.is_some() => {
                    self.film.iter_mut().for_each(|film| film.step(forward));
                    outcome = outcome.and(Outcome::Changed);
                }
                Some(input) => outcome = outcome.and(self.state.apply(input)),
                None => {}
            }
            if outcome == Outcome::Quit {
                break;
            }
        }
        if self.terminal.was_resumed() {
            self.encoder.forget();
            outcome = outcome.and(Outcome::Changed);
        }
        Ok(outcome)
    }

    /// Whether there is something to play.
    fn plays(&self) -> bool {
        self.film.as_ref().is_some_and(Film::has_more)
    }

    /// Goes on to the next frame of the file, if it is time and it is there.
    fn go_on(&mut self) -> bool {
        let Some(scene) = self.film.as_mut().and_then(Film::next) else { return false };
        self.structures.go_on(scene.list());
        self.scene = scene;
        // It is of another scene.
        self.picture = None;
        true
    }
}
