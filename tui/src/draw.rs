//! From a scene to cells: the whole pipeline in one page.

mod band;
mod tile_order;

pub use tile_order::tile_order;

use crate::cells::CellGrid;
use crate::samples::CellSamples;
use crate::scene::Scene;
use crate::structure::{PictureSearch, RaysKind, Search, Workload, picture_kind};
use crate::threads::Threads;
use crate::view::View;
use band::{BAND, BandPainter, Frame};
use spherule_kernel::dispatch::Level;
use spherule_kernel::{Accuracy, Camera, Exact, Fast, Stable};
use std::sync::atomic::{AtomicU64, Ordering};

/// Which tier decides hits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AccuracyChoice {
    /// The textbook form.
    Fast,
    /// The best form of plain `f32`.
    Stable,
    /// As in real arithmetic. The default, since it costs no more than `Stable`.
    #[default]
    Exact,
}

impl AccuracyChoice {
    /// All of them, the fastest first.
    pub const ALL: [Self; 3] = [Self::Fast, Self::Stable, Self::Exact];

    /// The name on the command line and in reports.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Fast => Fast::NAME,
            Self::Stable => Stable::NAME,
            Self::Exact => Exact::NAME,
        }
    }
}

/// How many colours there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorDepth {
    /// None: glyphs alone.
    Never,
    /// The 16 of the user's theme.
    Ansi16,
    /// The xterm palette.
    Ansi256,
    /// 24 bits.
    Truecolor,
}

/// Which characters may be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Charset {
    /// Printable ASCII.
    Ascii,
    /// Half blocks: two pixels a cell.
    Half,
}

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Which tier decides hits.
    pub accuracy: AccuracyChoice,
    /// Which characters may be used.
    pub charset: Charset,
    /// How many colours there are.
    pub depth: ColorDepth,
    /// Rays a cell, at least one.
    pub samples: u32,
    /// Width of a cell over its height.
    pub cell_aspect: f32,
}

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
/// Who draws more than once keeps a [`Renderer`].
#[must_use]
pub fn draw(scene: &Scene, view: &View, style: &Style, columns: u16, rows: u16) -> Drawn {
    let search = Search::brute(scene.spheres());
    let lights = vec![search; scene.lights.len()];
    let search = PictureSearch { kind: RaysKind::Coherent, camera: search, lights };
    let threads = Threads::default();
    let mut renderer = Renderer::new(Level::best(), &threads);
    renderer.draw(scene, &search, view, style, columns, rows)
}

/// The camera of a picture and the size of its grid of samples: sample `(ix, iy)` is the ray
/// `camera.get_ray(ix, iy)`.
#[must_use]
pub fn sample_grid(view: &View, style: &Style, columns: u16, rows: u16) -> (Camera, u32, u32) {
    let samples = CellSamples::new(style);
    let (width, height) = (u32::from(columns) * samples.across, u32::from(rows) * samples.down);
    let aspect = picture_aspect(style, columns, rows);
    (view.camera(width, height, aspect), width, height)
}

/// What the camera's rays of so many such pictures ask of a structure over so many spheres.
///
/// Shadow rays are not counted: how many there are, the picture shows.
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
    let rays = cells * (samples.across * samples.down) as usize;
    Workload { rays, pictures, kind: picture_kind(spheres, rays) }
}

/// Width over height of a picture of `columns` x `rows` cells; 1 where it has no area.
#[must_use]
pub fn picture_aspect(style: &Style, columns: u16, rows: u16) -> f64 {
    if columns == 0 || rows == 0 {
        return 1.0;
    }
    f64::from(columns) * f64::from(style.cell_aspect) / f64::from(rows)
}

/// Draws, and keeps its memory from frame to frame.
#[derive(Debug)]
pub struct Renderer<'a> {
    level: Level,
    threads: &'a Threads,
    /// One a thread.
    painters: Vec<BandPainter>,
}

impl<'a> Renderer<'a> {
    /// Without memory yet; `level` and `threads` change no picture, only how long it takes.
    #[must_use]
    pub fn new(level: Level, threads: &'a Threads) -> Self {
        Self { level, threads, painters: Vec::new() }
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
        let (camera, width, height) = sample_grid(view, style, columns, rows);
        let frame = Frame { level: self.level, scene, search, style, camera, width, height };
        match style.accuracy {
            AccuracyChoice::Fast => self.draw_as::<Fast>(&frame, columns, rows),
            AccuracyChoice::Stable => self.draw_as::<Stable>(&frame, columns, rows),
            AccuracyChoice::Exact => self.draw_as::<Exact>(&frame, columns, rows),
        }
    }

    fn draw_as<A: Accuracy>(&mut self, frame: &Frame<'_>, columns: u16, rows: u16) -> Drawn {
        let mut cells = CellGrid::new(columns, rows);
        let shadow_rays = AtomicU64::new(0);
        let band = usize::from(columns) * BAND;
        let bands = cells.cells_mut().chunks_mut(band.max(1)).zip((0..).step_by(BAND));
        self.threads.share(&mut self.painters, bands, |painter, (cells, first)| {
            let count = painter.paint::<A>(frame, first, cells);
            shadow_rays.fetch_add(count, Ordering::Relaxed);
        });
        let camera_rays = u64::from(frame.width) * u64::from(frame.height);
        Drawn { cells, rays: camera_rays + shadow_rays.into_inner() }
    }
}
