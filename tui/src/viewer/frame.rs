//! One frame: a picture, what is written over it, and the status line, in one write.

use super::film::Film;
use super::meter::Frame;
use super::pace::Debt;
use super::pixel_frame::NO_TEXT;
use super::session::{Picture, Viewer, picture_rows};
use super::shown::Shown;
use super::table::{Means, Subject};
use super::{help, notice, picking, status};
use crate::cells::CellGrid;
use crate::compare::Comparison;
use crate::compare::legend::MapPainter;
use crate::compare::split::{Split, SplitPicture};
use crate::draw::{Drawn, picture_workload};
use crate::encode::Economy;
use crate::error::Error;
use crate::pick::{Pick, cell_ray, report};
use crate::terminal::lost;
use crate::tradeoff::chart;
use std::io;
use std::sync::Arc;
use std::time::Instant;

impl Viewer<'_> {
    /// Draws and sends one frame, in one write.
    pub(super) fn show_frame(&mut self, now: Instant, moving: bool) -> Result<(), Error> {
        let (columns, rows) = self.learn_size().map_err(|error| lost(&error))?;
        if columns == 0 || rows == 0 {
            self.pace.rest();
            return Ok(());
        }
        let status_row = picture_rows(rows);
        let (size, started) = ((columns, status_row), Instant::now());
        let pictured = self.state.shown.pictured();
        let subject = Subject::new(&pictured, size);
        // The picture is not drawn again where nothing has changed except what is written over it.
        let last = self.picture.take();
        let rests = last.as_ref().is_some_and(|last| Subject::new(&last.of, last.size) == subject);
        let protocol = self.protocol();
        if protocol.is_none() {
            self.remove_images();
        }
        // A font of another size may leave columns and rows as they are.
        let cell = protocol.map(|protocol| self.pixels_of_cell(protocol, size));
        let same = |last: &Picture| {
            last.of == pictured
                && last.size == size
                && last.cell == cell
                && last.drawn.effort.is_full
        };
        let (picture, drawing) = match last.filter(same) {
            Some(last) => (last, None),
            None => {
                self.colors.show(&mut self.scene, self.state.shown.coloring);
                self.structures.set_aids(self.state.shown.style.aids);
                let picture = match cell {
                    Some(cell) => self.draw_pixels(cell, size, moving)?,
                    None => self.draw(size, moving)?,
                };
                (picture, Some(started.elapsed()))
            }
        };

        let mut cells = CellGrid::new(columns, rows);
        let drawn = &picture.drawn;
        cells.cells_mut()[..drawn.cells.cells().len()].copy_from_slice(drawn.cells.cells());
        self.write_over(&mut cells, status_row, (subject, rests))?;
        if let Some(notice) = &self.notice {
            notice::write(&mut cells, status_row, notice);
        }
        // The picture is encoded first, so that the status line can tell what it cost.
        self.bytes.clear();
        self.bytes.append(&mut self.pending_removal);
        // A passing frame may merely look alike; at rest all is sent, a part at a time if the link
        // is slow.
        let economy = match (moving, self.lossless || picture.image.is_some()) {
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
        let is_exact = self.encoder.is_exact();
        self.pace.owes(match (is_exact, moving) {
            (true, _) => Debt::None,
            (false, true) => Debt::AtRest,
            (false, false) => Debt::Now,
        });
        let figures = match drawing {
            None => self.meter.figures(),
            Some(drawing) => {
                let (making, rays) = (started.elapsed(), drawn.effort.rays);
                let (bytes, round_trip) = (self.bytes.len(), self.flow.round_trip());
                let frame = Frame { drawing, making, rays, bytes, round_trip };
                self.meter.count(frame, now)
            }
        };
        let film = self.film.as_ref().filter(|film| film.has_status()).map(Film::status);
        status::write(
            &mut cells,
            status_row,
            (&self.state, film.as_deref()),
            picture.searched,
            figures,
        );
        self.encoder.encode_row(&cells, status_row, &mut self.bytes);
        self.encoder.bracket(0, &mut self.bytes);
        if picture.image.is_none() {
            self.note_recording(&cells, now, economy);
        }
        self.picture = Some(picture);
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
        Ok(())
    }

    /// Takes note of a frame of cells, if there is a recording.
    fn note_recording(&mut self, cells: &CellGrid, now: Instant, economy: Economy) {
        let Some(recording) = &mut self.recording else { return };
        recording.frame(cells, now, Economy { most_bytes: usize::MAX, ..economy });
        if recording.is_full() {
            self.record();
        }
    }

    /// Draws the picture of the moment in pixels, so many a cell.
    fn draw_pixels(
        &mut self,
        cell: (u32, u32),
        size: (u16, u16),
        moving: bool,
    ) -> Result<Picture, Error> {
        let started = Instant::now();
        let (image, effort, searched) = self.draw_image(cell, size, moving)?;
        self.pace.drawn(effort, started.elapsed());
        let mut cells = CellGrid::new(size.0, size.1);
        cells.cells_mut().fill(NO_TEXT);
        let (of, drawn, image) =
            (self.state.shown.pictured(), Drawn { cells, effort }, Some(image));
        Ok(Picture { of, size, cell: Some(cell), searched, drawn, image })
    }

    /// Draws the picture of the moment.
    fn draw(&mut self, size: (u16, u16), moving: bool) -> Result<Picture, Error> {
        let Shown { view, style, structure, comparison, .. } = &self.state.shown;
        let count = self.scene.spheres().len();
        let workload = picture_workload(count, style, size.0, size.1, f64::INFINITY);
        let search = self.structures.picture(*structure, &workload, view, &self.scene)?;
        let (scene, spending) = ((&*self.scene, &search), self.pace.spending(moving));
        let started = Instant::now();
        let drawn = match comparison {
            None => self.renderer.draw(&self.scene, &search, view, style, size, spending),
            Some(Comparison::Split(tiers)) => {
                let split = Split { tiers: *tiers, seam: self.state.seam() };
                let SplitPicture { mut drawn, ns_a_ray } =
                    split.draw(&mut self.renderer, scene, view, style, size, spending);
                // Wrong answers are counted at rest: counting takes as long as a picture.
                let figures = (!moving).then(|| {
                    split.figures(&self.renderer, &mut self.mapper, scene, view, style, size)
                });
                let medians = self.times.medians(*tiers, ns_a_ray);
                split.write(&mut drawn.cells, size.1, medians, figures);
                drawn.effort.is_full &= !moving;
                drawn
            }
            Some(Comparison::Errors) => {
                let machine = self.renderer.machine();
                let map = self.mapper.map(scene, view, style, size, machine, |_| {});
                // All of it, at every pace.
                let cells = MapPainter::new(style).cells(&map, 0..size.1);
                Drawn { cells, effort: map.effort() }
            }
        };
        self.pace.drawn(drawn.effort, started.elapsed());
        let searched = (search.order(), search.structure);
        let of = self.state.shown.pictured();
        Ok(Picture { of, size, cell: None, searched, drawn, image: None })
    }

    /// Writes what is open over the first `rows` rows: the table of a subject, a pick, the keys.
    fn write_over(
        &mut self,
        cells: &mut CellGrid,
        rows: u16,
        (subject, rests): (Subject, bool),
    ) -> Result<(), Error> {
        if self.state.shown.table {
            let means = || Means {
                scene: Arc::clone(&self.scene),
                style: self.state.shown.style,
                tree: self.structures.tree(),
                order: self.structures.order(),
                level: self.renderer.machine().0,
            };
            let standing = self.table.standing(subject, rests, means);
            chart::write(cells, rows, &self.state.shown.style, &standing);
        } else {
            self.table.close();
        }
        if let Some(cursor) = self.state.shown.cursor {
            // In ASCII: a cell holds no glyph that is two columns wide, and a label may.
            let printable = |label: &str| label.escape_default().to_string();
            let pick = self.pick()?;
            let lines = pick.map(|pick| report::lines(&pick, printable)).unwrap_or_default();
            picking::write(cells, rows, cursor, &lines);
        }
        if let Some(legend) = self.colors.legend.as_ref().filter(|_| self.state.shown.legend) {
            legend.write(cells, rows, &self.state.shown.style);
        }
        if self.state.shown.help {
            help::write(cells, rows);
        }
        Ok(())
    }

    /// What is picked, in the picture that would be drawn now.
    pub(super) fn pick(&mut self) -> Result<Option<Pick<'_>>, Error> {
        let Shown { view, style, structure, cursor, .. } = &self.state.shown;
        let Some(cursor) = cursor else { return Ok(None) };
        let (size, count) = (self.state.size(), self.scene.spheres().len());
        let workload = picture_workload(count, style, size.0, size.1, f64::INFINITY);
        let search = self.structures.picture(*structure, &workload, view, &self.scene)?;
        let ray = cell_ray(view, style, size, (cursor.column, cursor.row));
        let level = self.renderer.machine().0;
        Ok(ray.map(|ray| Pick::new(&self.scene, &search, level, ray)))
    }
}
