//! One picture, written at once: as a tier sees it, as it is wrong, in two halves, or below a table.

use crate::cells::CellGrid;
use crate::coloring::legend::Legend;
use crate::compare::error_map::ErrorMapper;
use crate::compare::legend::MapPainter;
use crate::compare::split::Split;
use crate::draw::{Renderer, Spending};
use crate::encode;
use crate::error::{Error, write_stdout};
use crate::progress::{PATIENCE, Progress};
use crate::scene::Scene;
use crate::structure::picture_search::PictureSearch;
use crate::structure::scene::SceneStructures;
use crate::style::{Aids, Style};
use crate::tradeoff::Question;
use crate::tradeoff::chart::{self, Standing};
use crate::view::View;
use spherule_kernel::Tier;

/// Rows of an error map that are written at a time.
const MAP_STRIP: u16 = 32;

/// What is drawn, and whether it goes to a terminal.
pub(super) struct Once<'a> {
    pub(super) scene: &'a Scene,
    pub(super) view: View,
    pub(super) style: Style,
    /// Columns and rows.
    pub(super) size: (u16, u16),
    pub(super) is_terminal: bool,
}

impl Once<'_> {
    /// Progress of drawing; `None` on a terminal, where the picture itself shows it.
    fn progress(&self) -> Option<Progress> {
        (!self.is_terminal).then(|| Progress::after(PATIENCE))
    }

    /// Writes the scene as the tier of the style sees it. With a `legend`, what colours mean is written over the
    /// picture, which then is not written in strips.
    pub(super) fn picture(
        &self,
        renderer: &mut Renderer<'_>,
        search: &PictureSearch<'_>,
        legend: Option<Legend>,
    ) -> Result<(), Error> {
        if let Some(legend) = legend {
            let mut cells = self.drawn(renderer, search);
            legend.write(&mut cells, self.size.1, &self.style);
            return write(&cells);
        }
        let (mut done, mut progress) = (0_u32, self.progress());
        renderer.draw_strips(self.scene, search, &self.view, &self.style, self.size, |cells| {
            write(cells)?;
            done += u32::from(cells.rows());
            if let Some(progress) = &mut progress {
                progress.show("drawing", f64::from(done) / f64::from(self.size.1));
            }
            Ok(())
        })
    }

    /// Draws the scene as the tier of the style sees it.
    pub(super) fn drawn(
        &self,
        renderer: &mut Renderer<'_>,
        search: &PictureSearch<'_>,
    ) -> CellGrid {
        let need = Spending::ByNeed;
        renderer.draw(self.scene, search, &self.view, &self.style, self.size, need).cells
    }

    /// Writes what the tier of the style gets wrong: in strips, since bytes take more memory than classes.
    pub(super) fn errors(
        &self,
        renderer: &Renderer<'_>,
        search: &PictureSearch<'_>,
    ) -> Result<(), Error> {
        let (scene, machine, mut progress) =
            ((self.scene, search), renderer.machine(), self.progress());
        let mut mapper = ErrorMapper::default();
        let map = mapper.map(scene, &self.view, &self.style, self.size, machine, |share| {
            if let Some(progress) = &mut progress {
                progress.show("drawing", share);
            }
        });
        drop(progress);
        let (painter, (_, rows)) = (MapPainter::new(&self.style), map.size());
        for first in (0..rows).step_by(MAP_STRIP.into()) {
            let strip = first..first.saturating_add(MAP_STRIP).min(rows);
            write(&painter.cells(&map, strip))?;
        }
        Ok(())
    }

    /// Writes the picture by two tiers, side by side.
    pub(super) fn split(
        &self,
        tiers: [Tier; 2],
        renderer: &mut Renderer<'_>,
        search: &PictureSearch<'_>,
    ) -> Result<(), Error> {
        let Self { scene, view, style, size, .. } = self;
        let split = Split { tiers, seam: size.0 / 2 };
        let (scene, need) = ((*scene, search), Spending::ByNeed);
        let mut cells = split.draw(renderer, scene, view, style, *size, need).cells;
        let mapper = &mut ErrorMapper::default();
        let figures = split.figures(renderer, mapper, scene, view, style, *size);
        split.write(&mut cells, size.1, Some(figures));
        write(&cells)
    }

    /// Writes the picture in `cells`, and over it what is measured.
    pub(super) fn table(
        &self,
        mut cells: CellGrid,
        question: &Question<'_>,
        structures: &mut SceneStructures<'_>,
    ) -> Result<(), Error> {
        // Only rays of the camera and rays to lights are measured.
        structures.set_aids(Aids::NONE);
        let mut progress = Progress::after(PATIENCE);
        let report = question.measure(structures, &mut |step, share| {
            progress.show(step.doing(), share);
            true
        })?;
        drop(progress);
        let standing = report.map_or(Standing::Waiting, Standing::Done);
        chart::write(&mut cells, self.size.1, &self.style, &standing);
        write(&cells)
    }
}

fn write(cells: &CellGrid) -> Result<(), Error> {
    let mut bytes = Vec::new();
    encode::full(cells, &mut bytes);
    write_stdout(&bytes)
}
