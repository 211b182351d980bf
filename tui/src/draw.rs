//! From a scene to cells: the whole pipeline in one page.

mod need;
mod packet_order;
pub mod pixels;
mod plan;
mod strip;
mod tracer;

pub use packet_order::packet_corners;

use crate::cells::CellGrid;
use crate::samples::CellSamples;
use crate::scene::Scene;
use crate::structure::Structure;
use crate::structure::choose::Workload;
use crate::structure::scene::PictureSearch;
use crate::structure::search::{Search, Tracing};
use crate::style::Style;
use crate::threads::Threads;
use crate::view::View;
use plan::Plan;
use spherule_kernel::{Camera, Coherence, Level};
use strip::Strip;
use tracer::{SampleGrid, Traced};

/// A drawn picture and what it took.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The picture.
    pub cells: CellGrid,
    /// How many rays were traced, shadow rays among them.
    pub rays: u64,
}

/// Draws `scene` as `view` sees it into `columns` x `rows` cells, on this thread and by brute force.
///
/// To draw more than once, keep a [`Renderer`].
#[must_use]
pub fn draw(scene: &Scene, view: &View, style: &Style, columns: u16, rows: u16) -> Drawn {
    let camera = Search::Brute(scene.spheres());
    let lights = scene.lighting.lights(view);
    let to_lights = vec![camera; lights.len()];
    let search = PictureSearch {
        structure: Structure::Brute,
        coherence: Coherence::Coherent,
        camera,
        lights,
        to_lights,
    };
    let threads = Threads::default();
    let mut renderer = Renderer::new(Level::best(), &threads);
    renderer.draw(scene, &search, view, style, columns, rows)
}

/// The camera of a picture and the size of its grid of samples: sample `(ix, iy)` is the ray
/// `camera.get_ray(ix, iy)`.
#[must_use]
pub fn sample_grid(view: &View, style: &Style, columns: u16, rows: u16) -> (Camera, u32, u32) {
    let samples = CellSamples::new(style);
    let grid = SampleGrid::new(view, style, samples, columns, rows);
    (grid.camera, grid.width, grid.height)
}

/// The camera rays of so many such pictures, against so many spheres.
///
/// Without shadow rays: how many there are, only the picture shows.
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

/// Rows of cells that are drawn at a time, so that the largest picture fits into memory; of smaller ones, all.
const STRIP: usize = 128;

/// Draws, and keeps its memory from frame to frame.
#[derive(Debug)]
pub struct Renderer<'a> {
    level: Level,
    threads: &'a Threads,
    strip: Strip,
}

impl<'a> Renderer<'a> {
    /// `level` and `threads` change no picture, only how long it takes.
    #[must_use]
    pub fn new(level: Level, threads: &'a Threads) -> Self {
        Self { level, threads, strip: Strip::default() }
    }

    /// Draws `scene` as `view` sees it into `columns` x `rows` cells; `search` finds the spheres
    /// of that scene from that view.
    #[must_use]
    pub fn draw(
        &mut self,
        scene: &Scene,
        search: &PictureSearch<'_>,
        view: &View,
        style: &Style,
        columns: u16,
        rows: u16,
    ) -> Drawn {
        let mut cells = CellGrid::new(columns, rows);
        let tracing =
            Tracing { tier: style.accuracy, level: self.level, coherence: search.coherence };
        let traced = Traced { tracing, scene, search };
        let plan = Plan::new(traced, view, style, columns, rows);
        let mut rays = 0;
        let strips = cells.cells_mut().chunks_mut((STRIP * usize::from(columns)).max(1));
        for (cells, first) in strips.zip((0..).step_by(STRIP)) {
            rays += self.strip.draw(&plan, self.threads, first, cells);
        }
        Drawn { cells, rays }
    }
}
