//! The viewer: input to state, state to picture, picture to terminal, until somebody quits.
//!
//! All input that is there is taken before a frame is drawn, so a slow link gets fewer frames, not late ones. A frame
//! of a movement gets no more samples than there is time for; when the movement is over, a full frame follows. After
//! that nothing is drawn and nothing is sent, except how far a measurement is.

mod colors;
mod command_line;
pub mod film;
mod flow;
mod frame;
mod hand;
mod help;
mod keys;
mod meter;
mod notice;
mod pace;
mod picking;
mod pixel_frame;
mod pixels;
mod printable;
mod recording;
mod seam;
mod session;
mod shown;
mod state;
mod status;
mod table;

use crate::arguments::SceneArguments;
use crate::choice::Auto;
use crate::coloring::ColorBy;
use crate::coloring::scale::Range;
use crate::compare::error_map::ErrorMapper;
use crate::compare::split::Times;
use crate::draw::Renderer;
use crate::encode::Encoder;
use crate::error::{Error, write_stdout};
use crate::pixels::Output;
use crate::scene::Scene;
use crate::scene::framing;
use crate::structure::scene::SceneStructures;
use crate::terminal::color_depth::{ColorChoice, Surroundings};
use crate::terminal::{Incoming, LONGEST_BACKLOG, Reply, Terminal, lost};
use colors::Colors;
use crossterm::event::Event;
use film::Film;
use flow::Flow;
use meter::Meter;
use pace::Pace;
use pixels::Pixels;
use session::Viewer;
use shown::Outcome;
use state::State;
pub use state::{ORBIT_STEP, PAN_STEP, Start, ZOOM_STEP};
use std::env;
use std::mem;
use std::sync::Arc;
use std::time::{Duration, Instant};
use table::Table;

/// The most frames a second while something moves; over SSH, a key waits for every frame sent before it.
const LOCAL_RATE: u16 = 60;
const REMOTE_RATE: u16 = 30;
/// Set, the key `!` panics. There is no other way to test that the terminal survives a panic of
/// the real program; it has no effect unless the variable is set.
const PANIC_SWITCH: &str = "SPHERULE_TEST_PANIC";

/// The terminal, and what the user says of it.
#[derive(Debug)]
pub struct Wire {
    /// The terminal of the viewer.
    pub terminal: Terminal,
    /// What decides how many colours there are: what the terminal says late counts, too.
    pub surroundings: Surroundings,
    /// What `--color` says.
    pub color: ColorChoice,
    /// The most frames a second; `None`: as many as suit the link.
    pub rate: Auto<u16>,
    /// Whether every frame is sent as it is, and not one that looks alike.
    pub lossless: bool,
    /// What `--output` says.
    pub output: Output,
    /// What the command line says of the scene.
    pub asked: SceneArguments,
}

/// Shows `scene`, which has its own colours, on the terminal until the user quits: from `start` on, coloured by
/// `color_by`, and drawn by `renderer` with the chosen one of its `structures`.
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
    (wire, film): (Wire, Option<Film>),
) -> Result<(), Error> {
    let Wire { terminal, surroundings, color, rate, lossless, output, asked } = wire;
    let usual = if env::var_os("SSH_CONNECTION").is_some() { REMOTE_RATE } else { LOCAL_RATE };
    let interval = Duration::from_secs(1) / u32::from(rate.unwrap_or(usual)).max(1);
    let colors = Colors::new(&scene, color_by, range);
    let mut viewer = Viewer {
        scene,
        film,
        structures,
        surroundings,
        color,
        lossless,
        pixels: Pixels::new(output, &terminal),
        terminal,
        asked,
        notice: None,
        told: Vec::new(),
        recording: None,
        failure: None,
        pending_removal: Vec::new(),
        flow: Flow::default(),
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
    viewer.heed_abilities();
    viewer.say_no_pixels();
    viewer.learn_size().map_err(|error| lost(&error))?;
    viewer.say_too_large();
    let mut last_frame: Option<Instant> = None;
    let mut stale = true;
    loop {
        let film = viewer.film.as_ref().and_then(Film::wait);
        let wait = viewer.wait(stale, last_frame).into_iter().chain(film).min();
        match viewer.take_input(wait)? {
            Outcome::Quit => return viewer.leave(),
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
        let due = picture.into_iter().chain(table).min()?;
        // An answer is input, so it ends this wait sooner.
        Some(self.flow.wait(Instant::now()).map_or(due, |flow| flow.max(due)))
    }

    /// Waits for input, for ever without `wait`, and takes all there is.
    fn take_input(&mut self, wait: Option<Duration>) -> Result<Outcome, Error> {
        let mut outcome = Outcome::Unchanged;
        let mut wait = wait;
        for _ in 0..LONGEST_BACKLOG {
            let incoming = self.terminal.next_event(wait).map_err(|error| lost(&error))?;
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
            if matches!(event, Event::Key(_)) && self.notice.take().is_some() {
                outcome = outcome.and(Outcome::Changed);
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
                // The terminal may have moved its cells about, even if the size is the same.
                Some(keys::Input::Resize) => {
                    self.encoder.forget();
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

    /// Goes on to the next frame of the file, if it is time and it is there; returns whether there is news to show.
    fn go_on(&mut self) -> bool {
        let Some(film) = &mut self.film else { return false };
        let Some(scene) = film.next() else { return film.take_news() };
        self.structures.go_on(scene.list());
        self.scene = scene;
        self.colors.begin_anew();
        self.table.close();
        // The last picture is of another scene.
        self.picture = None;
        true
    }

    /// Gives the terminal back, and then tells what there is to tell.
    fn leave(mut self) -> Result<(), Error> {
        if self.recording.is_some() {
            self.record();
        }
        let (told, failure) = (mem::take(&mut self.told), self.failure.take());
        drop(self);
        if !told.is_empty() {
            write_stdout((told.join("\n") + "\n").as_bytes())?;
        }
        failure.map_or(Ok(()), Err)
    }

    /// Adapts to what the terminal can do.
    fn heed_abilities(&mut self) -> Outcome {
        let abilities = self.terminal.abilities();
        self.encoder.set_synchronized(abilities.synchronized);
        self.surroundings.told = abilities.truecolor;
        self.state.set_depth(self.surroundings.depth(self.color))
    }
}
