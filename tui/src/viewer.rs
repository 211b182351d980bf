//! The viewer: input to state, state to picture, picture to terminal, until somebody quits.
//!
//! All input that is there is taken before a frame is drawn, so a slow link gets fewer frames,
//! not late ones. A frame of a movement gets no more samples than there is time for; when it is over, a full one
//! follows. Then nothing is drawn and nothing is sent, but how far a measurement is.

mod colors;
pub mod film;
mod frame;
mod hand;
mod help;
mod keys;
mod meter;
mod pace;
mod picking;
mod seam;
mod state;
mod status;
mod table;

use crate::choice::Auto;
use crate::coloring::ColorBy;
use crate::coloring::scale::Range;
use crate::compare::Comparison;
use crate::compare::error_map::ErrorMapper;
use crate::compare::split::Times;
use crate::draw::Renderer;
use crate::encode::Encoder;
use crate::error::Error;
use crate::scene::Scene;
use crate::scene::framing;
use crate::structure::Structure;
use crate::structure::scene::SceneStructures;
use crate::style::Style;
use crate::terminal::{LONGEST_BACKLOG, Terminal, lost};
use crate::view::View;
use colors::Colors;
use film::Film;
use frame::Picture;
use meter::Meter;
use pace::Pace;
pub use state::{ORBIT_STEP, PAN_STEP, ZOOM_STEP};
use state::{Outcome, State};
use std::env;
use std::io;
use std::sync::Arc;
use std::time::{Duration, Instant};
use table::Table;

/// Frames a second while something moves, at most; over SSH every frame is waited for by the
/// keys behind it.
const LOCAL_RATE: u32 = 60;
const REMOTE_RATE: u32 = 30;
/// Set, the key `!` panics. There is no other way to test that the terminal survives a panic of
/// the real program; it harms nobody who does not ask for it.
const PANIC_SWITCH: &str = "SPHERULE_TEST_PANIC";

/// What the viewer shows first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// From where.
    pub view: View,
    /// How.
    pub style: Style,
    /// Which structure is asked for.
    pub structure: Auto<Structure>,
    /// What tiers are held against each other, if they are.
    pub comparison: Option<Comparison>,
    /// Whether there is a table of what every tier takes and gets wrong.
    pub table: bool,
    /// Whether it is said what colours mean.
    pub legend: bool,
}

/// Shows `scene`, which has its own colours, on the terminal, coloured by something and from `start` on, drawn by `renderer` with the chosen one of its
/// `structures`, until the user quits.
///
/// # Errors
/// [`Error::Running`] if there is no terminal to read keys from, or it goes away, or there is no
/// memory for a structure.
pub fn run(
    scene: Arc<Scene>,
    (color_by, range): (&ColorBy, Option<Range>),
    structures: SceneStructures<'_>,
    start: Start,
    renderer: Renderer<'_>,
    film: Option<Film>,
) -> Result<(), Error> {
    let rate = if env::var_os("SSH_CONNECTION").is_some() { REMOTE_RATE } else { LOCAL_RATE };
    let interval = Duration::from_secs(1) / rate;
    let colors = Colors::new(&scene, color_by, range);
    let mut viewer = Viewer {
        scene,
        film,
        structures,
        terminal: Terminal::enter().map_err(|error| lost(&error))?,
        state: State::new(start, colors.start()),
        colors,
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

/// The rows of the picture, of so many of the terminal: the last is the status line's, if there are two.
fn picture_rows(rows: u16) -> u16 {
    if rows >= 2 { rows - 1 } else { rows }
}

struct Viewer<'a> {
    scene: Arc<Scene>,
    colors: Colors,
    /// Its file, if it may have more frames.
    film: Option<Film>,
    structures: SceneStructures<'a>,
    terminal: Terminal,
    state: State,
    renderer: Renderer<'a>,
    mapper: ErrorMapper,
    times: Times,
    encoder: Encoder,
    meter: Meter,
    pace: Pace,
    table: Table,
    /// The last.
    picture: Option<Picture>,
    /// Kept from frame to frame for its memory.
    bytes: Vec<u8>,
    panic_key: bool,
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
        self.colors.begin_anew();
        // It is of another scene.
        self.picture = None;
        true
    }

    /// Asks the terminal for its size, which may be without a cell.
    fn learn_size(&mut self) -> io::Result<(u16, u16)> {
        let (columns, rows) = self.terminal.size()?;
        self.state.set_size(columns, picture_rows(rows));
        Ok((columns, rows))
    }
}
