//! One frame: a picture, what is written over it, and the status line, in one write.

use super::film::Film;
use super::meter::Frame;
use super::pace::Debt;
use super::session::{Picture, Viewer};
use super::shown::Outcome;
use super::studio::Studio;
use super::table::{Means, Subject};
use super::{help, notice, picking, recording, status};
use crate::cells::CellGrid;
use crate::coloring::legend::Legend;
use crate::compare::Comparison;
use crate::encode::Economy;
use crate::error::Error;
use crate::pick::report;
use crate::terminal::lost;
use crate::tradeoff::chart;
use std::io;
use std::time::{Duration, Instant};

/// What the status line says first while a picture is drawn that takes long.
const DRAWING: &str = "drawing ...";

/// When and where a frame is shown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Occasion {
    /// When it was due, and when it was begun.
    now: Instant,
    started: Instant,
    /// The rows of the terminal.
    rows: u16,
    /// Whether it is one of a movement.
    pub(super) moving: bool,
}

/// What can be told besides a picture while none is drawn.
#[derive(Default)]
pub(super) struct Known {
    /// What the table is measured by, if it is open and the picture rests.
    means: Option<Means>,
    /// Lines about the cell that is picked.
    picked: Vec<String>,
}

impl Viewer {
    /// Draws and sends one frame, in one write. Returns what was asked for meanwhile; if that is another picture, this one
    /// is not shown.
    pub(super) fn show_frame(
        &mut self,
        studio: &mut Studio<'_>,
        now: Instant,
        moving: bool,
    ) -> Result<Outcome, Error> {
        let (columns, rows) = self.learn_size().map_err(|error| lost(&error))?;
        if columns == 0 || rows == 0 {
            self.pace.rest();
            return Ok(Outcome::Unchanged);
        }
        let started = Instant::now();
        let occasion = Occasion { now, started, rows, moving };
        if self.protocol().is_none() {
            self.remove_images();
        }
        let wanted = self.wanted();
        // Even if the picture stays: what was begun before may have been given up in other colours.
        if let Some(lack) = self.colors.show(&mut self.scene, wanted.pictured.coloring) {
            let frame = self.film.as_ref().map_or(0, Film::shown);
            self.tell(&format!("frame {frame} keeps its colours: {lack}"));
        }
        if let Some(subject) = self.framed.take() {
            studio.structures.frame(subject);
        }
        studio.structures.set_aids(wanted.pictured.style.aids);
        let last = self.picture.as_ref();
        let subject = |of: &Picture| (of.of.scene, Subject::new(&of.of.pictured, of.of.size));
        let before = last.map(subject);
        // The picture is not drawn again where nothing has changed except what is written over it.
        let is_same = last.is_some_and(|last| last.of == wanted && last.drawn.effort.is_full);
        let (mut outcome, mut drawing) = (Outcome::Unchanged, None);
        if !is_same {
            let (drawn, meanwhile) = self.draw(studio, wanted, &occasion)?;
            outcome = meanwhile;
            let Some((picture, time)) = drawn else {
                self.pace.gave_up();
                return Ok(outcome);
            };
            self.pace.drawn(picture.drawn.effort, time);
            let charset = |of: &Picture| of.of.pictured.style.charset;
            if self.picture.as_ref().is_some_and(|last| charset(last) != charset(&picture)) {
                // Since the key was pressed, the last picture may have been shown once more.
                self.encoder.forget();
            }
            self.picture = Some(picture);
            drawing = Some(started.elapsed());
        }
        let Some(mut picture) = self.picture.take() else { return Ok(outcome) };
        picture.legend.clone_from(&self.colors.legend);
        let shown = &self.state.shown;
        let rests = before == Some((wanted.scene, Subject::new(shown, wanted.size)));
        let means = (rests && shown.table).then(|| studio.means(&self.scene, shown));
        // Keys may have moved the view while the picture was drawn.
        let pick = studio.pick(&self.scene, &picture.of, shown.cursor)?;
        // In ASCII: a cell holds no glyph that is two columns wide, and a label may.
        let printable = |label: &str| label.escape_default().to_string();
        let picked = pick.map(|pick| report::lines(&pick, printable)).unwrap_or_default();
        self.present(&picture, Some(Known { means, picked }), drawing, &occasion)?;
        self.picture = Some(picture);
        Ok(outcome)
    }

    /// Sends a picture, which took so long to draw if it is new, what is written over it, and the status line. What is
    /// `known` is `None` while the next picture is drawn.
    pub(super) fn present(
        &mut self,
        picture: &Picture,
        known: Option<Known>,
        drawing: Option<Duration>,
        occasion: &Occasion,
    ) -> Result<(), Error> {
        let &Occasion { now, started, rows, moving } = occasion;
        let (columns, status_row) = picture.of.size;
        let (protocol, draws) = (self.protocol(), known.is_none());
        let mut cells = CellGrid::new(columns, rows);
        let drawn = &picture.drawn;
        cells.cells_mut()[..drawn.cells.cells().len()].copy_from_slice(drawn.cells.cells());
        // Colours of a map of errors mean something else.
        let is_map = picture.of.pictured.comparison == Some(Comparison::Errors);
        let legend = picture.legend.as_ref().filter(|_| !is_map);
        self.write_over(&mut cells, status_row, legend, known.unwrap_or_default());
        if let Some(notice) = &self.notice {
            notice::write(&mut cells, status_row, notice);
        }
        self.owes_notice = false;
        // The picture is encoded first, so that the status line can tell what it cost.
        self.bytes.clear();
        self.bytes.append(&mut self.pending_removal);
        // A passing frame may merely look alike; at rest all is sent, a part at a time if the link
        // is slow.
        let economy = match (moving, self.asked.lossless || picture.image.is_some()) {
            (false, _) => Economy { most_bytes: self.flow.most_bytes(), ..Economy::NONE },
            (true, false) => Economy { tolerance: self.flow.tolerance(), ..Economy::NONE },
            (true, true) => Economy::NONE,
        };
        if let (Some(protocol), Some(image)) = (protocol, &picture.image) {
            self.write_image(protocol, (image, drawing.is_some()), &mut cells, status_row);
        }
        if let Some(shown) = self.encoder.shown() {
            let last_row = usize::from(status_row) * usize::from(columns);
            if shown.cells().len() == cells.cells().len() {
                cells.cells_mut()[last_row..].copy_from_slice(&shown.cells()[last_row..]);
            }
        }
        self.encoder.encode_part(&cells, economy, &mut self.bytes);
        if !draws {
            self.pace.owes(match (self.encoder.is_exact(), moving) {
                (true, _) => Debt::None,
                (false, true) => Debt::AtRest,
                (false, false) => Debt::Now,
            });
        }
        let figures = match drawing {
            None => self.meter.figures(),
            Some(drawing) => {
                let (making, rays) = (started.elapsed(), drawn.effort.rays);
                let (bytes, round_trip) = (self.bytes.len(), self.flow.round_trip());
                let frame = Frame { drawing, making, rays, bytes, round_trip };
                self.meter.count(frame, now)
            }
        };
        let film = self.film.as_ref().and_then(Film::line);
        let first = film.into_iter().chain(draws.then(|| DRAWING.to_owned()));
        let first = first.collect::<Vec<_>>().join("  ");
        let structure = self.state.shown.structure.or(picture.structure);
        let (state, searched) = ((&self.state, &*first), (self.asked.scene.order, structure));
        status::write(&mut cells, status_row, state, searched, figures);
        self.encoder.encode_row(&cells, status_row, &mut self.bytes);
        self.encoder.bracket(0, &mut self.bytes);
        // Its time is that of the picture, and comes before that of what is shown meanwhile.
        if picture.image.is_none() && !draws {
            self.note_recording(&cells, now, economy);
        }
        self.send().map_err(|error| lost(&error))
    }

    /// Whether the terminal is asked after every frame how far it has come: only if it is known to
    /// tell.
    pub(super) fn asks_for_status(&self) -> bool {
        let abilities = self.terminal.abilities();
        abilities.has_answered && abilities.reports_status
    }

    /// Sends what is to be sent, and asks for an answer if the terminal gives any.
    fn send(&mut self) -> io::Result<()> {
        if self.bytes.is_empty() || !self.asks_for_status() {
            return self.terminal.show(&self.bytes);
        }
        let bytes = self.bytes.len();
        self.terminal.show_and_ask(&mut self.bytes)?;
        self.flow.sent(bytes, Instant::now());
        self.terminal.await_at_most(self.flow.open());
        Ok(())
    }

    /// Takes note of a frame of cells, if there is a recording.
    fn note_recording(&mut self, cells: &CellGrid, now: Instant, economy: Economy) {
        let mut current = recording::current();
        let Some(recording) = &mut *current else { return };
        recording.frame(cells, now, Economy { most_bytes: usize::MAX, ..economy });
        let is_full = recording.is_full();
        drop(current);
        if is_full {
            self.end_recording();
        }
    }

    /// Writes what is open over the first `rows` rows: the table, a pick, the picture's legend, the keys.
    fn write_over(
        &mut self,
        cells: &mut CellGrid,
        rows: u16,
        legend: Option<&Legend>,
        Known { means, picked }: Known,
    ) {
        if self.state.shown.table {
            let subject = Subject::new(&self.state.shown, (cells.columns(), rows));
            let standing = self.table.standing(subject, means);
            chart::write(cells, rows, &self.state.shown.style, &standing);
        } else {
            self.table.close();
        }
        if let Some(cursor) = self.state.shown.cursor {
            picking::write(cells, rows, cursor, &picked);
        }
        if let Some(legend) = legend.filter(|_| self.state.shown.legend) {
            legend.write(cells, rows, &self.state.shown.style);
        }
        if self.state.shown.help {
            help::write(cells, rows);
        }
    }
}
