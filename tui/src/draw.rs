//! From a scene to cells: the whole pipeline in one page.

mod finish;
mod need;
pub mod pixels;
mod plan;
mod sample_grid;
mod spending;
mod strip;
mod tracer;

pub use spending::{Effort, Spending};

use crate::cells::CellGrid;
use crate::samples::CellSamples;
use crate::scene::Scene;
use crate::structure::Structure;
use crate::structure::choose::Workload;
use crate::structure::picture_search::{PictureSearch, Setting};
use crate::structure::search::{Search, Tracing};
use crate::style::Style;
use crate::threads::Threads;
use crate::view::View;
use plan::Plan;
use sample_grid::{SampleGrid, Traced};
use spherule_kernel::{Camera, Coherence, Level, Tier};
use std::ops::Range;
use strip::Strip;

/// A drawn picture.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The picture.
    pub cells: CellGrid,
    /// What it took.
    pub effort: Effort,
}

/// Draws `scene` as `view` sees it into `columns` x `rows` cells, on this thread, by brute force, and without aids.
///
/// To draw more than once, keep a [`Renderer`].
#[must_use]
pub fn draw(scene: &Scene, view: &View, style: &Style, columns: u16, rows: u16) -> Drawn {
    let threads = Threads::default();
    let mut renderer = Renderer::new(Level::best(), &threads);
    let search = brute_force(scene, view);
    renderer.draw(scene, &search, view, style, (columns, rows), Spending::ByNeed)
}

/// The search of a picture without a structure.
#[must_use]
pub fn brute_force<'a>(scene: &'a Scene, view: &View) -> PictureSearch<'a> {
    let camera = Search::Brute(scene.spheres());
    let lights = scene.lighting.lights(view);
    let to_lights = if scene.shadows { vec![camera; lights.len()] } else { Vec::new() };
    PictureSearch {
        structure: Structure::Brute,
        coherence: Coherence::Coherent,
        camera,
        lights,
        to_lights,
        setting: Setting::default(),
    }
}

/// The camera of a picture and the size of its grid of samples: sample `(ix, iy)` is the ray
/// `camera.get_ray(ix, iy)`.
#[must_use]
pub fn sample_grid(view: &View, style: &Style, columns: u16, rows: u16) -> (Camera, u32, u32) {
    let samples = CellSamples::new(style);
    let grid = SampleGrid::new(view, style, samples, columns, rows);
    (grid.camera, grid.width, grid.height)
}

/// The work of the camera rays of so many such pictures, against so many spheres.
///
/// Shadow rays are left out: only the picture shows how many there are.
#[must_use]
pub fn picture_workload(
    spheres: usize,
    style: &Style,
    columns: u16,
    rows: u16,
    pictures: f64,
) -> Workload {
    let samples = CellSamples::new(style);
    let cells = usize::from(columns) * usize::from(rows);
    Workload::of_pictures(pictures, cells * samples.count() as usize, spheres)
}

/// Cells that are drawn at a time, in whole rows, so that the largest picture fits into memory. Smaller pictures are drawn at once.
const STRIP: usize = 1 << 17;
/// The most of a strip's few samples, unless a row has more: their light takes 100 MB.
const STRIP_SAMPLES: usize = 1 << 23;

/// How many columns beside a cell influence it: one of samples, two of fits, and one more that letters look at. Edges reach farther.
const BESIDE: usize = 4;
/// The first column of a part is a multiple of this, as packets and the pattern of dither need it.
const ALIGNED: u16 = 8;

/// Draws pictures, and keeps its memory from frame to frame.
#[derive(Debug)]
pub struct Renderer<'a> {
    level: Level,
    threads: &'a Threads,
    strip: Strip,
    /// The most cells of a strip, unless a row has more.
    most_cells: usize,
}

impl<'a> Renderer<'a> {
    /// `level` and `threads` change no picture, only how long it takes.
    #[must_use]
    pub fn new(level: Level, threads: &'a Threads) -> Self {
        Self { level, threads, strip: Strip::default(), most_cells: STRIP }
    }

    /// The instructions that it draws by, and its threads.
    #[must_use]
    pub fn machine(&self) -> (Level, &'a Threads) {
        (self.level, self.threads)
    }

    /// Draws `scene` as `view` sees it into so many columns and rows of cells, for no more than `spending`. `search` finds the spheres of
    /// that scene from that view. If pictures of one size follow each other with [`Spending::AtMost`], glyphs stay as they were where that
    /// is about as good.
    #[must_use]
    pub fn draw(
        &mut self,
        scene: &Scene,
        search: &PictureSearch<'_>,
        view: &View,
        style: &Style,
        (columns, rows): (u16, u16),
        spending: Spending,
    ) -> Drawn {
        let mut cells = CellGrid::new(columns, rows);
        let traced = self.traced(scene, search, style.accuracy);
        let plan = Plan::new(traced, view, style, (columns, rows), spending);
        let effort = self.in_strips(&plan, &mut cells);
        Drawn { cells, effort }
    }

    /// Draws the columns `part` of the picture of [`Renderer::draw`], cell for cell the same. Columns beside them that influence their
    /// glyphs and colours are drawn too. Letters without colour, which are chosen beside each other, may differ where the part ends; so may
    /// what a movement has no time for.
    #[must_use]
    pub fn draw_columns(
        &mut self,
        (scene, search): (&Scene, &PictureSearch<'_>),
        view: &View,
        style: &Style,
        (columns, rows): (u16, u16),
        part: Range<u16>,
        spending: Spending,
    ) -> Drawn {
        let traced = self.traced(scene, search, style.accuracy);
        let plan = Plan::new(traced, view, style, (columns, rows), spending);
        let [of_edges, _] = plan.edges_reach();
        let beside = u16::try_from(of_edges.saturating_add(BESIDE)).unwrap_or(u16::MAX);
        let from = part.start.saturating_sub(beside) / ALIGNED * ALIGNED;
        let drawn = from..part.end.saturating_add(beside).min(columns);
        let width = drawn.len();
        let plan = plan.only(drawn);
        let mut all = CellGrid::new(width as u16, rows);
        let effort = self.in_strips(&plan, &mut all);
        let mut cells = CellGrid::new(part.len() as u16, rows);
        let lines = cells.cells_mut().chunks_mut(part.len().max(1));
        for (line, all) in lines.zip(all.cells().chunks(width.max(1))) {
            line.copy_from_slice(&all[usize::from(part.start - from)..][..part.len()]);
        }
        Drawn { cells, effort }
    }

    /// Draws what is planned, strip by strip.
    fn in_strips(&mut self, plan: &Plan<'_>, cells: &mut CellGrid) -> Effort {
        let (columns, samples) = (cells.columns(), plan.few.samples.count());
        let height = usize::from(self.strip_rows(columns, samples));
        let strips = cells.cells_mut().chunks_mut((height * usize::from(columns)).max(1));
        strips.zip((0..).step_by(height)).fold(Effort::NONE, |effort, (cells, first)| {
            effort.and(self.strip.draw(plan, self.threads, first, cells))
        })
    }

    /// Draws the picture of [`Renderer::draw`] by need, and hands strip after strip of whole rows on to `take`, from the top.
    ///
    /// # Errors
    /// The first error of `take`.
    pub fn draw_strips<E>(
        &mut self,
        scene: &Scene,
        search: &PictureSearch<'_>,
        view: &View,
        style: &Style,
        (columns, rows): (u16, u16),
        mut take: impl FnMut(&CellGrid) -> Result<(), E>,
    ) -> Result<(), E> {
        let traced = self.traced(scene, search, style.accuracy);
        let plan = Plan::new(traced, view, style, (columns, rows), Spending::ByNeed);
        let height = self.strip_rows(columns, plan.few.samples.count());
        for first in (0..rows).step_by(height.into()) {
            let mut cells = CellGrid::new(columns, height.min(rows - first));
            self.strip.draw(&plan, self.threads, first.into(), cells.cells_mut());
            take(&cells)?;
        }
        Ok(())
    }

    /// How many rows of so many cells, of so many samples each, are drawn at a time.
    fn strip_rows(&self, columns: u16, samples: u32) -> u16 {
        let most_cells = self.most_cells.min(STRIP_SAMPLES / samples.max(1) as usize);
        let rows = most_cells / usize::from(columns.max(1));
        u16::try_from(rows).unwrap_or(u16::MAX).max(1)
    }

    fn traced<'b>(&self, scene: &'b Scene, search: &'b PictureSearch<'b>, tier: Tier) -> Traced<'b>
    where
        'a: 'b,
    {
        let tracing = Tracing { tier, level: self.level, coherence: search.coherence };
        Traced { tracing, scene, search, threads: self.threads }
    }
}

#[cfg(test)]
mod tests;
