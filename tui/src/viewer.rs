//! The viewer: input to state, state to picture, picture to terminal, until somebody quits.
//!
//! All input that is there is taken before a frame is drawn, so a slow link gets fewer frames,
//! not late ones. A frame of a movement gets no more samples than there is time for; when it is over, a full one
//! follows. Then nothing is drawn and nothing is sent.

mod hand;
mod help;
mod keys;
mod meter;
mod pace;
mod picking;
mod state;
mod status;

use crate::cells::CellGrid;
use crate::choice::Auto;
use crate::draw::{Drawn, Effort, Renderer, picture_workload};
use crate::encode::Encoder;
use crate::error::{Error, cause};
use crate::pick::{Pick, cell_ray, report};
use crate::scene::Scene;
use crate::scene::framing::bounding_sphere;
use crate::structure::Structure;
use crate::structure::scene::SceneStructures;
use crate::style::Style;
use crate::terminal::Terminal;
use crate::view::View;
use meter::{Frame, Meter};
use pace::Pace;
use spherule_kernel::Sphere;
pub use state::{ORBIT_STEP, PAN_STEP, ZOOM_STEP};
use state::{Outcome, Shown, State};
use std::env;
use std::io;
use std::time::{Duration, Instant};

/// Frames a second while something moves, at most; over SSH every frame is waited for by the
/// keys behind it.
const LOCAL_RATE: u32 = 60;
const REMOTE_RATE: u32 = 30;
/// Events taken before a frame is drawn all the same: whoever pastes a file sees something.
const LONGEST_BACKLOG: usize = 4096;
/// As `--size` has it: a terminal that claims more is not believed.
const LARGEST_SIZE: u16 = 4096;
/// Set, the key `!` panics. There is no other way to test that the terminal survives a panic of
/// the real program; it harms nobody who does not ask for it.
const PANIC_SWITCH: &str = "SPHERULE_TEST_PANIC";

/// Shows `scene` on the terminal, from `view` on, drawn by `renderer` with the chosen one of its
/// `structures`, until the user quits.
///
/// # Errors
/// [`Error::Running`] if there is no terminal to read keys from, or it goes away, or there is no
/// memory for a structure.
pub fn run(
    scene: &Scene,
    structures: SceneStructures<'_>,
    structure: Auto<Structure>,
    view: View,
    style: Style,
    renderer: Renderer<'_>,
) -> Result<(), Error> {
    let rate = if env::var_os("SSH_CONNECTION").is_some() { REMOTE_RATE } else { LOCAL_RATE };
    let interval = Duration::from_secs(1) / rate;
    let mut viewer = Viewer {
        scene,
        structures,
        terminal: Terminal::enter().map_err(|error| lost(&error))?,
        state: State::new(view, style, structure),
        renderer,
        encoder: Encoder::new(),
        meter: Meter::default(),
        pace: Pace::new(interval),
        drawn: None,
        bytes: Vec::new(),
        panic_key: env::var_os(PANIC_SWITCH).is_some(),
    };
    viewer.learn_size().map_err(|error| lost(&error))?;
    let mut last_frame: Option<Instant> = None;
    let mut stale = true;
    loop {
        let wait = viewer.wait(stale, last_frame);
        match viewer.take_input(wait)? {
            Outcome::Quit => return Ok(()),
            Outcome::Changed => stale = true,
            Outcome::Unchanged => {}
        }
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

/// The terminal is not there.
fn lost(error: &io::Error) -> Error {
    Error::Running(format!("terminal: {}", cause(error)))
}

struct Viewer<'a> {
    scene: &'a Scene,
    structures: SceneStructures<'a>,
    terminal: Terminal,
    state: State,
    renderer: Renderer<'a>,
    encoder: Encoder,
    meter: Meter,
    pace: Pace,
    /// The last picture, and what it is of: where the cursor alone has moved it is not drawn again.
    drawn: Option<(Shown, (u16, u16), Drawn)>,
    /// Kept from frame to frame for its memory.
    bytes: Vec<u8>,
    panic_key: bool,
}

impl Viewer<'_> {
    /// How long until a frame is due; for ever if there is none to draw.
    fn wait(&self, stale: bool, last_frame: Option<Instant>) -> Option<Duration> {
        let moving = stale || self.state.shown.spinning;
        self.pace.wait(moving, last_frame.map(|at| at.elapsed()))
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
                    let all = bounding_sphere(self.scene.spheres());
                    outcome = outcome.and(self.state.frame(all));
                }
                Some(keys::Input::FramePicked) => {
                    if let Some(sphere) = self.picked()? {
                        outcome = outcome.and(self.state.frame(sphere));
                    }
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

    /// Asks the terminal for its size, which may be without a cell.
    fn learn_size(&mut self) -> io::Result<(u16, u16)> {
        let (columns, rows) = self.terminal.size()?;
        let (columns, rows) = (columns.min(LARGEST_SIZE), rows.min(LARGEST_SIZE));
        self.state.set_size(columns, picture_rows(rows));
        Ok((columns, rows))
    }

    /// The sphere that is picked, of what would be drawn now.
    fn picked(&mut self) -> Result<Option<Sphere>, Error> {
        let Shown { view, style, structure, cursor, .. } = &self.state.shown;
        let Some(cursor) = cursor else { return Ok(None) };
        let (size, lighting) = (self.state.size(), &self.scene.lighting);
        let count = self.scene.spheres().len();
        let workload = picture_workload(count, style, size.0, size.1, f64::INFINITY);
        let search = self.structures.picture(*structure, &workload, view, lighting)?;
        let ray = cell_ray(view, style, size, (cursor.column, cursor.row));
        let pick = ray.map(|ray| Pick::new(self.scene, &search, self.renderer.level(), ray));
        Ok(pick.and_then(|pick| Some(pick.sphere?.sphere)))
    }

    /// Draws and sends one frame, in one write.
    fn show_frame(&mut self, now: Instant, moving: bool) -> Result<(), Error> {
        let (columns, rows) = self.learn_size().map_err(|error| lost(&error))?;
        if columns == 0 || rows == 0 {
            self.pace.drawn(Effort::NONE, Duration::ZERO);
            return Ok(());
        }
        let status_row = picture_rows(rows);
        let started = Instant::now();
        let Shown { view, style, structure, cursor, .. } = &self.state.shown;
        let count = self.scene.spheres().len();
        let workload = picture_workload(count, style, columns, status_row, f64::INFINITY);
        let lighting = &self.scene.lighting;
        let search = self.structures.picture(*structure, &workload, view, lighting)?;
        let searched = (search.order(), search.structure);
        let (size, spending) = ((columns, status_row), self.pace.spending(moving));
        let found = started.elapsed();
        let pictured = self.state.shown.pictured();
        let same = |(of, its_size, drawn): &(Shown, (u16, u16), Drawn)| {
            *of == pictured && *its_size == size && drawn.effort.is_full
        };
        let drawn = match self.drawn.take().filter(same) {
            Some((.., drawn)) => Drawn { effort: Effort::NONE, ..drawn },
            None => self.renderer.draw(self.scene, &search, view, style, size, spending),
        };
        let drawing = started.elapsed();
        self.pace.drawn(drawn.effort, drawing - found);

        let mut cells = CellGrid::new(columns, rows);
        cells.cells_mut()[..drawn.cells.cells().len()].copy_from_slice(drawn.cells.cells());
        if let Some(cursor) = *cursor {
            let cell = (cursor.column, cursor.row);
            let pick = cell_ray(view, style, size, cell)
                .map(|ray| Pick::new(self.scene, &search, self.renderer.level(), ray));
            // In ASCII: a cell holds no glyph that is two columns wide, and a label may.
            let printable = |label: &str| label.escape_default().to_string();
            let lines = pick.map(|pick| report::lines(&pick, printable)).unwrap_or_default();
            picking::write(&mut cells, status_row, cursor, &lines);
        }
        if self.state.shown.help {
            help::write(&mut cells, status_row);
        }
        // The picture first: then the status line can tell what it cost.
        self.bytes.clear();
        if let Some(shown) = self.encoder.shown() {
            let last_row = usize::from(status_row) * usize::from(columns);
            if shown.cells().len() == cells.cells().len() {
                cells.cells_mut()[last_row..].copy_from_slice(&shown.cells()[last_row..]);
            }
        }
        self.encoder.encode(cells.clone(), &mut self.bytes);
        let frame = Frame {
            drawing,
            making: started.elapsed(),
            rays: drawn.effort.rays,
            bytes: self.bytes.len(),
        };
        let figures = self.meter.count(frame, now);
        status::write(&mut cells, status_row, &self.state, searched, figures);
        self.encoder.encode(cells, &mut self.bytes);
        self.drawn = Some((pictured, size, drawn));
        self.terminal.show(&self.bytes).map_err(|error| lost(&error))
    }
}
