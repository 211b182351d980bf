//! The viewer: input to state, state to picture, picture to terminal, until somebody quits.
//!
//! All input that is there is taken before a frame is drawn, so a slow link gets fewer frames, not late ones. A frame
//! of a movement gets no more samples than there is time for; when the movement is over, a full frame follows. After
//! that nothing is drawn and nothing is sent, except how far a measurement is. Input is taken, too, while a picture is
//! drawn that takes long.

mod attended;
mod colors;
mod command_line;
pub mod film;
mod flow;
mod frame;
mod hand;
mod help;
mod inputs;
mod keys;
mod meanwhile;
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
mod studio;
mod table;
mod wanted;
mod worker;

use crate::arguments::PictureArguments;
use crate::draw::Renderer;
use crate::encode::Encoder;
use crate::error::{Error, write_stdout};
use crate::scene::Scene;
use crate::structure::scene::SceneStructures;
use crate::terminal::color_depth::Surroundings;
use crate::terminal::{Terminal, lost};
use colors::Colors;
use film::Film;
use flow::Flow;
use inputs::PANIC_SWITCH;
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
use studio::Studio;
use table::Table;

/// The most frames a second while something moves; over SSH, a key waits for every frame sent before it.
const LOCAL_RATE: u16 = 60;
const REMOTE_RATE: u16 = 30;

/// The terminal, and what the user says of it.
#[derive(Debug)]
pub struct Wire {
    /// The terminal of the viewer.
    pub terminal: Terminal,
    /// What decides how many colours there are: what the terminal says late counts, too.
    pub surroundings: Surroundings,
    /// What the command line says.
    pub asked: PictureArguments,
}

/// Shows `scene`, which has its own colours, on the terminal until the user quits: from `start` on, and drawn by
/// `renderer` with the chosen one of its `structures`.
///
/// # Errors
/// [`Error::Running`] if there is no terminal to read keys from, or it goes away, or there is no
/// memory for a structure.
pub fn run(
    scene: Arc<Scene>,
    structures: SceneStructures<'_>,
    start: Start,
    renderer: Renderer<'_>,
    (wire, film): (Wire, Option<Film>),
) -> Result<(), Error> {
    let Wire { terminal, surroundings, asked } = wire;
    let usual = if env::var_os("SSH_CONNECTION").is_some() { REMOTE_RATE } else { LOCAL_RATE };
    let interval = Duration::from_secs(1) / u32::from(asked.fps.unwrap_or(usual)).max(1);
    let colors = Colors::new(&scene, &asked.crowd.color_by(&scene), asked.crowd.range);
    let mut viewer = Viewer {
        scene,
        changes: 0,
        film,
        surroundings,
        pixels: Pixels::new(asked.output, &terminal),
        terminal,
        asked,
        framed: None,
        postponed: None,
        entered: None,
        notice: None,
        owes_notice: false,
        told: Vec::new(),
        failure: None,
        pending_removal: Vec::new(),
        flow: Flow::default(),
        state: State::new(start, colors.start()),
        colors,
        encoder: Encoder::new(),
        meter: Meter::default(),
        pace: Pace::new(interval),
        table: Table::default(),
        picture: None,
        bytes: Vec::new(),
        panic_key: env::var_os(PANIC_SWITCH).is_some(),
    };
    let mut studio = Studio::new(structures, renderer);
    viewer.terminal.do_last(recording::keep);
    viewer.heed_abilities();
    viewer.say_no_pixels();
    let result = viewer.show_until_quit(&mut studio);
    viewer.leave(result)
}

impl Viewer {
    /// Takes input and shows frames until the user quits.
    fn show_until_quit(&mut self, studio: &mut Studio<'_>) -> Result<(), Error> {
        self.learn_size().map_err(|error| lost(&error))?;
        self.say_too_large();
        let mut last_frame: Option<Instant> = None;
        let mut stale = true;
        loop {
            let film = self.film.as_ref();
            let film = [film.and_then(Film::wait), film.and_then(Film::wait_for_status)];
            let film = film.into_iter().flatten();
            let wait = self.wait(stale, last_frame).into_iter().chain(film).min();
            match self.take_input(Some(&mut *studio), wait)? {
                Outcome::Quit => return Ok(()),
                Outcome::Changed => stale = true,
                Outcome::Unchanged => {}
            }
            stale |= self.go_on(studio);
            if self.wait(stale, last_frame) == Some(Duration::ZERO) {
                let now = Instant::now();
                let moving = stale || self.state.shown.spinning;
                if let Some(last_frame) = last_frame {
                    self.state.advance(now - last_frame);
                }
                let meanwhile = self.show_frame(studio, now, moving)?;
                if meanwhile == Outcome::Quit {
                    return Ok(());
                }
                last_frame = Some(now);
                stale = meanwhile == Outcome::Changed;
            }
        }
    }

    /// How long until a frame is due; for ever if there is none to draw.
    fn wait(&self, stale: bool, last_frame: Option<Instant>) -> Option<Duration> {
        let (shown, since_last) = (&self.state.shown, last_frame.map(|at| at.elapsed()));
        let picture = self.pace.wait(stale || shown.spinning, since_last);
        let table = self.table.wait(shown, self.state.size(), since_last);
        let due = picture.into_iter().chain(table).min()?;
        // An answer is input, so it ends this wait sooner.
        Some(self.flow.wait(Instant::now()).map_or(due, |flow| flow.max(due)))
    }

    /// Goes on to the next frame of the file, if it is time and it is there; returns whether there is something to show.
    fn go_on(&mut self, studio: &mut Studio<'_>) -> bool {
        let Some(film) = &mut self.film else { return false };
        let (scene, news, has_changed) = (film.next(), film.take_news(), film.has_changed());
        // A frame that is due has the status line of itself.
        let is_stale = !news.is_empty() || has_changed && self.wait(false, None).is_none();
        news.iter().for_each(|what| self.tell(what));
        let Some(scene) = scene else { return is_stale };
        studio.structures.go_on(scene.list());
        self.scene = scene;
        self.changes += 1;
        let colorings = self.colors.begin_anew(&self.scene);
        self.state.set_colorings(colorings);
        self.table.close();
        true
    }

    /// Gives the terminal back, and then tells what there is to tell, also if `result` is an error. Returns the first error.
    fn leave(mut self, result: Result<(), Error>) -> Result<(), Error> {
        self.end_recording();
        let (told, failure) = (mem::take(&mut self.told), self.failure.take());
        drop(self);
        let telling = if told.is_empty() {
            Ok(())
        } else {
            write_stdout((told.join("\n") + "\n").as_bytes())
        };
        result.and(telling).and(failure.map_or(Ok(()), Err))
    }
}
