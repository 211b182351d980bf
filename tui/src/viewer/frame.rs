//! One frame: a picture, what is written over it, and the status line, in one write.

use super::film::Film;
use super::meter::Frame;
use super::state::Shown;
use super::table::{Means, Subject};
use super::{Viewer, help, picking, picture_rows, status};
use crate::cells::CellGrid;
use crate::compare::Comparison;
use crate::compare::legend::MapPainter;
use crate::compare::split::{Split, SplitPicture};
use crate::draw::{Drawn, Effort, picture_workload};
use crate::error::Error;
use crate::pick::{Pick, cell_ray, report};
use crate::structure::{Order, Structure};
use crate::terminal::lost;
use crate::tradeoff::chart;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A picture without what is written over it.
#[derive(Debug)]
pub(super) struct Picture {
    /// What it is of.
    of: Shown,
    /// Columns and rows.
    size: (u16, u16),
    /// How its rays found spheres.
    searched: (Order, Structure),
    drawn: Drawn,
}

impl Viewer<'_> {
    /// Draws and sends one frame, in one write.
    pub(super) fn show_frame(&mut self, now: Instant, moving: bool) -> Result<(), Error> {
        let (columns, rows) = self.learn_size().map_err(|error| lost(&error))?;
        if columns == 0 || rows == 0 {
            self.pace.drawn(Effort::NONE, Duration::ZERO);
            return Ok(());
        }
        let status_row = picture_rows(rows);
        let (size, started) = ((columns, status_row), Instant::now());
        let pictured = self.state.shown.pictured();
        let subject = Subject::new(&pictured, size);
        // Where nothing but what is written over it has changed, it is not drawn again.
        let last = self.picture.take();
        let rests = last.as_ref().is_some_and(|last| Subject::new(&last.of, last.size) == subject);
        let same =
            |last: &Picture| last.of == pictured && last.size == size && last.drawn.effort.is_full;
        let (picture, drawing) = match last.filter(same) {
            Some(last) => (last, None),
            None => {
                let picture = self.draw(size, moving)?;
                (picture, Some(started.elapsed()))
            }
        };

        let mut cells = CellGrid::new(columns, rows);
        let drawn = &picture.drawn;
        cells.cells_mut()[..drawn.cells.cells().len()].copy_from_slice(drawn.cells.cells());
        self.write_over(&mut cells, status_row, (subject, rests))?;
        // The picture first: then the status line can tell what it cost.
        self.bytes.clear();
        if let Some(shown) = self.encoder.shown() {
            let last_row = usize::from(status_row) * usize::from(columns);
            if shown.cells().len() == cells.cells().len() {
                cells.cells_mut()[last_row..].copy_from_slice(&shown.cells()[last_row..]);
            }
        }
        self.encoder.encode(cells.clone(), &mut self.bytes);
        let figures = match drawing {
            None => self.meter.figures(),
            Some(drawing) => {
                let (making, rays) = (started.elapsed(), drawn.effort.rays);
                let frame = Frame { drawing, making, rays, bytes: self.bytes.len() };
                self.meter.count(frame, now)
            }
        };
        let film = self.film.as_ref().filter(|film| film.has_more()).map(Film::status);
        status::write(
            &mut cells,
            status_row,
            (&self.state, film.as_deref()),
            picture.searched,
            figures,
        );
        self.encoder.encode(cells, &mut self.bytes);
        self.picture = Some(picture);
        self.terminal.show(&self.bytes).map_err(|error| lost(&error))
    }

    /// Draws the picture of the moment.
    fn draw(&mut self, size: (u16, u16), moving: bool) -> Result<Picture, Error> {
        self.colors.show(&mut self.scene, self.state.shown.coloring);
        let Shown { view, style, structure, comparison, .. } = &self.state.shown;
        self.structures.set_aids(style.aids);
        let (count, lighting) = (self.scene.spheres().len(), &self.scene.lighting);
        let workload = picture_workload(count, style, size.0, size.1, f64::INFINITY);
        let search = self.structures.picture(*structure, &workload, view, lighting)?;
        let (scene, spending) = ((&*self.scene, &search), self.pace.spending(moving));
        let started = Instant::now();
        let drawn = match comparison {
            None => self.renderer.draw(&self.scene, &search, view, style, size, spending),
            Some(Comparison::Split(tiers)) => {
                let split = Split { tiers: *tiers, seam: self.state.seam() };
                let SplitPicture { mut drawn, ns_a_ray } =
                    split.draw(&mut self.renderer, scene, view, style, size, spending);
                // What is wrong is counted at rest: it takes as long as a picture.
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
        Ok(Picture { of: self.state.shown.pictured(), size, searched, drawn })
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

    /// What is picked, of what would be drawn now.
    pub(super) fn pick(&mut self) -> Result<Option<Pick<'_>>, Error> {
        let Shown { view, style, structure, cursor, .. } = &self.state.shown;
        let Some(cursor) = cursor else { return Ok(None) };
        let (size, lighting) = (self.state.size(), &self.scene.lighting);
        let count = self.scene.spheres().len();
        let workload = picture_workload(count, style, size.0, size.1, f64::INFINITY);
        let search = self.structures.picture(*structure, &workload, view, lighting)?;
        let ray = cell_ray(view, style, size, (cursor.column, cursor.row));
        let level = self.renderer.machine().0;
        Ok(ray.map(|ray| Pick::new(&self.scene, &search, level, ray)))
    }
}
