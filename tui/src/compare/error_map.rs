//! What a tier gets wrong in every cell of a picture. The camera's packets are traced by the tier and by `Exact` with the same search;
//! every ray gets a verdict, and every cell the worst of its rays.
//!
//! This is not the way of a picture: nothing is shaded, and nothing here costs a picture anything.

use super::verdict::{Class, Counts, Verdict};
use crate::draw::{Effort, sample_grid};
use crate::samples::CellSamples;
use crate::scene::Scene;
use crate::structure::picture_search::PictureSearch;
use crate::structure::search::{Scratch, Tracing};
use crate::style::Style;
use crate::threads::Threads;
use crate::view::View;
use spherule_kernel::{Camera, CameraTiles, HitPacket, Level, RayPacket, Tier};
use std::ops::Range;

/// How many rows of cells are traced at a time: as many as for a picture, so that packets go through a structure together as they do there.
const BAND: usize = 4;
/// Cells between two reports of progress.
const STRIP: usize = 1 << 17;

/// What is wrong with a picture, cell by cell.
#[derive(Clone, Debug)]
pub struct ErrorMap {
    /// The tier that was held against `Exact`.
    pub tier: Tier,
    /// How many samples a cell has, across and down.
    pub samples: (u32, u32),
    /// The counts of all rays.
    pub counts: Counts,
    columns: u16,
    /// The worst class of each cell.
    classes: Vec<Class>,
}

/// Makes [error maps](ErrorMap), and keeps its memory.
#[derive(Debug, Default)]
pub struct ErrorMapper {
    /// One a thread.
    workers: Vec<Worker>,
}

/// The memory of a thread.
#[derive(Debug, Default)]
struct Worker {
    tiles: Vec<(u32, u32)>,
    rays: Vec<RayPacket>,
    answers: Vec<HitPacket>,
    truths: Vec<HitPacket>,
    scratch: Scratch,
}

/// A grid of samples over the whole picture, and what finds its hits.
struct Sampled<'a> {
    scene: &'a Scene,
    search: &'a PictureSearch<'a>,
    tracing: Tracing,
    threads: &'a Threads,
    camera: Camera,
    /// The first column of cells, and how many there are.
    columns: (u32, u32),
    samples: CellSamples,
}

impl ErrorMapper {
    /// Compares the tier of `style` with `Exact` on the few samples of a picture of `scene` from `view`. `progress` gets the share done.
    /// `level` and `threads` change nothing but how long it takes; when the threads are stopped, the map is worthless.
    #[must_use]
    pub fn map(
        &mut self,
        scene: (&Scene, &PictureSearch<'_>),
        view: &View,
        style: &Style,
        size: (u16, u16),
        machine: (Level, &Threads),
        progress: impl FnMut(f64),
    ) -> ErrorMap {
        self.map_columns(scene, view, style, size, &(0..size.0), machine, progress)
    }

    /// The same, for some columns alone.
    #[must_use]
    #[expect(clippy::too_many_arguments, reason = "a picture, its part, and who computes it")]
    pub fn map_columns(
        &mut self,
        (scene, search): (&Scene, &PictureSearch<'_>),
        view: &View,
        style: &Style,
        (all_columns, rows): (u16, u16),
        part: &Range<u16>,
        (level, threads): (Level, &Threads),
        mut progress: impl FnMut(f64),
    ) -> ErrorMap {
        let tracing = Tracing { tier: style.accuracy, level, coherence: search.coherence };
        let (camera, ..) = sample_grid(view, style, all_columns, rows);
        let columns = part.end.saturating_sub(part.start);
        let samples = CellSamples::new(style);
        let sampled = Sampled {
            scene,
            search,
            tracing,
            threads,
            camera,
            columns: (part.start.into(), columns.into()),
            samples,
        };
        let columns_a_row = usize::from(columns).max(1);
        let mut classes = vec![Class::Miss; usize::from(columns) * usize::from(rows)];
        let mut counts = Counts::default();
        let (band, all) = (BAND * columns_a_row, classes.len());
        let strip = (STRIP / band).max(1) * band;
        for (strip, first) in classes.chunks_mut(strip).zip((0..).step_by(strip)) {
            let mut of_bands = vec![Counts::default(); strip.len().div_ceil(band)];
            let first_row = first / columns_a_row;
            let bands = strip.chunks_mut(band).zip(&mut of_bands);
            let bands = bands.zip((first_row..).step_by(BAND));
            threads.share(&mut self.workers, bands, |worker, ((classes, counts), row)| {
                *counts = worker.judge(&sampled, row as u32, classes);
            });
            counts = of_bands.iter().fold(counts, Counts::and);
            progress((first + strip.len()) as f64 / all as f64);
        }
        let samples = (samples.across, samples.down);
        ErrorMap { tier: style.accuracy, samples, counts, columns, classes }
    }
}

impl Worker {
    /// Writes the worst class of every cell from row `first` on.
    fn judge(&mut self, sampled: &Sampled<'_>, first: u32, classes: &mut [Class]) -> Counts {
        let &Sampled { scene, search, tracing, threads, ref camera, columns, samples } = sampled;
        let Self { tiles, rays, answers, truths, scratch } = self;
        let top = first * samples.down;
        let (left_column, columns) = columns;
        let left_sample = left_column * samples.across;
        let width = left_sample + columns * samples.across;
        // As if the picture ended with these rows, and these columns.
        let height = top + classes.len() as u32 / columns * samples.down;
        let corners = Camera::tile_corners::<[f32; 16]>(width - left_sample, height - top)
            .map(|(x, y)| (left_sample + x, top + y));
        tiles.clear();
        tiles.extend(corners);
        rays.resize(tiles.len(), RayPacket::inactive());
        let grid = CameraTiles { camera: *camera, size: (width, height), corners: tiles };
        let mut trace = |tier, hits: &mut Vec<HitPacket>| {
            hits.resize(rays.len(), HitPacket::none());
            let tracing = Tracing { tier, ..tracing };
            search.camera.tile_hits(tracing, (&mut *scratch, threads), grid, rays, hits);
        };
        trace(tracing.tier, answers);
        trace(Tier::Exact, truths);
        if threads.are_stopped() {
            // Hits may be those of another call, even of another scene.
            return Counts::default();
        }

        let (spheres, mut counts) = (scene.spheres(), Counts::default());
        let (tile_width, _) = Camera::tile::<[f32; 16]>();
        for ((&(left, top), rays), (answers, truths)) in
            tiles.iter().zip(&*rays).zip(answers.iter().zip(&*truths))
        {
            for (lane, (answer, truth)) in answers.hits().zip(truths.hits()).enumerate() {
                let (x, y) = (left + lane as u32 % tile_width, top + lane as u32 / tile_width);
                if x >= width || y >= height {
                    continue;
                }
                let verdict = Verdict::of(&rays.ray(lane), spheres, answer, truth);
                counts.add(verdict, (answer, truth), (x, y));
                let cell = (y / samples.down - first) * columns + x / samples.across - left_column;
                let class = &mut classes[cell as usize];
                *class = verdict.class.max(*class);
            }
        }
        counts
    }
}

impl ErrorMap {
    /// How many columns and rows of cells there are.
    #[must_use]
    pub fn size(&self) -> (u16, u16) {
        let rows = self.classes.len() / usize::from(self.columns).max(1);
        (self.columns, rows as u16)
    }

    /// The effort that it took: never less than all.
    #[must_use]
    pub fn effort(&self) -> Effort {
        let (across, down) = self.samples;
        let samples = self.classes.len() as u64 * u64::from(across * down);
        Effort { samples, rays: 2 * samples, is_full: true }
    }

    /// The worst class of every cell of `row`; none past the last.
    #[must_use]
    pub fn row(&self, row: u16) -> &[Class] {
        let start = usize::from(row) * usize::from(self.columns);
        self.classes.get(start..start + usize::from(self.columns)).unwrap_or(&[])
    }
}
