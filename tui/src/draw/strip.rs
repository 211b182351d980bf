//! Some rows of a picture, from rays to cells, in three passes over bands of rows; each needs what the one before made
//! of the rows around its own.
//!
//! 1. *Sample*: a few rays in every cell.
//! 2. *Fit*: many where the few disagree, and the glyph and colours of each cell.
//! 3. *Paint*: what a cell cannot show goes to its neighbours, and light becomes the colours that the terminal has.
//!
//! What a band gets depends on nothing else, so the picture is the same for every number of threads.

use super::need::Looks;
use super::packet_order::packet_corners;
use super::plan::{Plan, Sampling};
use super::tracer::Tracer;
use crate::cells::Cell;
use crate::cells::fit::Fitted;
use crate::cells::paint::Painter;
use crate::color::oklab;
use crate::threads::Threads;
use spherule_kernel::{Camera, Vec3};
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// How many rows of cells are traced at a time: enough rays for the kernel to share the
/// preparation of the spheres among, few enough to stay in the cache and to keep all threads busy
/// to the end, and a multiple of a packet's height whatever the samples.
const BAND: usize = 4;

/// Above this distance from a plane, in `OKLab`, a cell's samples are too few.
pub(super) const ENOUGH: f32 = 0.03;

/// The memory of a strip.
#[derive(Debug, Default)]
pub(super) struct Strip {
    /// Of the few samples, cell by cell.
    light: Vec<Vec3>,
    /// The same in `OKLab`.
    looks: Vec<Vec3>,
    fits: Vec<Fitted>,
    /// One a thread.
    workers: Vec<Worker>,
}

/// The memory of a thread.
#[derive(Debug, Default)]
struct Worker {
    tracer: Tracer,
    painter: Painter,
    looks: Vec<Vec3>,
    /// The cells of a band that need many samples.
    needy: Vec<(u32, u32)>,
    /// Where the samples of each cell of a band begin, if it is one of those.
    places: Vec<Option<usize>>,
}

/// Rows of cells, from the first on, counted over the whole picture.
fn rows_around(rows: &Range<usize>, halo: usize, all: usize) -> Range<usize> {
    rows.start.saturating_sub(halo)..(rows.end + halo).min(all)
}

impl Strip {
    /// Fills `cells`, whole rows from `first` on; returns how many rays that took.
    pub(super) fn draw(
        &mut self,
        plan: &Plan<'_>,
        threads: &Threads,
        first: usize,
        cells: &mut [Cell],
    ) -> u64 {
        let rows = first..first + cells.len() / plan.columns;
        let fitted = rows_around(&rows, 1, plan.rows);
        let sampled = rows_around(&fitted, 1, plan.rows);
        let band = BAND * plan.columns;
        let rays = AtomicU64::new(0);
        let Self { light, looks, fits, workers } = self;

        let count = plan.few.samples.count() as usize;
        light.resize(sampled.len() * plan.columns * count, Vec3::ZERO);
        looks.resize(light.len(), Vec3::ZERO);
        let bands = light.chunks_mut(band * count).zip(looks.chunks_mut(band * count));
        let bands = bands.zip(sampled.clone().step_by(BAND));
        threads.share(workers, bands, |worker, ((light, looks), first)| {
            rays.fetch_add(worker.sample(plan, first, light), Ordering::Relaxed);
            looks.iter_mut().zip(light).for_each(|(look, &mut light)| *look = oklab(light));
        });

        fits.resize(fitted.len() * plan.columns, Fitted::NONE);
        let bands = fits.chunks_mut(band).zip(fitted.clone().step_by(BAND));
        let known = Looks { looks, columns: plan.columns, rows: sampled.len() };
        let known = (&**light, known, sampled.start);
        threads.share(workers, bands, |worker, (fits, first)| {
            rays.fetch_add(worker.fit(plan, known, first, fits), Ordering::Relaxed);
        });

        let bands = cells.chunks_mut(band).zip(rows.step_by(BAND));
        threads.share(workers, bands, |worker, (cells, first)| {
            let known = (&**fits, fitted.start);
            worker.painter.paint(plan.style, known, plan.columns, first, cells);
        });
        rays.into_inner()
    }
}

impl Worker {
    /// Writes the light of the few samples of the cells from row `first` on; cell by cell.
    fn sample(&mut self, plan: &Plan<'_>, first: usize, light: &mut [Vec3]) -> u64 {
        let Sampling { samples, grid, .. } = &plan.few;
        let (across, down, columns) = (samples.across, samples.down, plan.columns as u32);
        let rows = light.len() as u32 / samples.count() / columns;
        let top = first as u32 * down;
        let bottom = top + rows * down;
        let corners = packet_corners(grid.width, bottom - top).map(|(x, y)| (x, top + y));
        let place = |x, y| {
            let cell = (y - top) / down * columns + x / across;
            let sample = y % down * across + x % across;
            (y < bottom).then_some((cell * samples.count() + sample) as usize)
        };
        let (traced, shadow_rays) =
            self.tracer.trace(&plan.traced, grid, corners, (light.len(), 1.0), place);
        light.copy_from_slice(traced);
        light.len() as u64 + shadow_rays
    }

    /// Fits glyphs to the cells from row `first` on. What is known: the light of the few samples, how they look, and
    /// which row they begin with.
    fn fit(
        &mut self,
        plan: &Plan<'_>,
        (light, looks, known): (&[Vec3], Looks<'_>, usize),
        first: usize,
        fits: &mut [Fitted],
    ) -> u64 {
        let columns = plan.columns;
        self.needy.clear();
        self.places.clear();
        let few = plan.few.samples.count() as usize;
        for (cell, fit) in fits.iter_mut().enumerate() {
            let (column, row) = (cell % columns, first + cell / columns - known);
            if plan.many.is_some() && looks.need(column, row) > ENOUGH {
                self.places.push(Some(self.needy.len()));
                self.needy.push((column as u32, (first + cell / columns) as u32));
                continue;
            }
            self.places.push(None);
            let start = (row * columns + column) * few;
            let samples = start..start + few;
            *fit = plan.few.fitter.fit(&light[samples.clone()], &looks.looks[samples]);
        }
        let Some(many) = plan.many.as_ref().filter(|_| !self.needy.is_empty()) else { return 0 };

        // The packets of a cell one after the other.
        let Sampling { samples, grid, fitter } = many;
        let (across, down) = (samples.across, samples.down);
        let (tile_width, tile_height) = Camera::tile::<[f32; 16]>();
        let corners = self.needy.iter().flat_map(|&(column, row)| {
            let tiles = (0..down).step_by(tile_height as usize);
            tiles.flat_map(move |y| {
                let tiles = (0..across).step_by(tile_width as usize);
                tiles.map(move |x| (column * across + x, row * down + y))
            })
        });
        let count = samples.count() as usize;
        let places = &self.places;
        let place = |x, y| {
            let cell = (y / down) as usize - first;
            let place = places[cell * columns + (x / across) as usize]?;
            Some(place * count + (y % down * across + x % across) as usize)
        };
        let pixels = self.needy.len() * count;
        let (traced, shadow_rays) =
            self.tracer.trace(&plan.traced, grid, corners, (pixels, 1.0), place);
        for (&(column, row), light) in self.needy.iter().zip(traced.chunks(count)) {
            let cell = (row as usize - first) * columns + column as usize;
            self.looks.clear();
            self.looks.extend(light.iter().map(|&light| oklab(light)));
            fits[cell] = fitter.fit(light, &self.looks);
        }
        pixels as u64 + shadow_rays
    }
}
