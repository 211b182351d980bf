//! Some rows of a picture, from rays to cells, in four passes over bands of rows; each needs what the one before made
//! of the rows around its own.
//!
//! 1. *Sample*: a few rays in every cell.
//! 2. *Judge*: how far the few disagree. Then it is known what all cells need, and decided what they get.
//! 3. *Fit*: many rays where they are granted, and the glyph and colours of each cell.
//! 4. *Paint*: what a cell cannot show goes to its neighbours, and light becomes the colours that the terminal has.
//!
//! What a band gets depends on nothing else, so the picture is the same for every number of threads.

use super::need::Looks;
use super::packet_order::packet_corners;
use super::plan::{Plan, Sampling};
use super::spending::{Effort, Grant};
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

/// How many rows of fits around a row have a part in its cells.
const HALO: usize = 2;

/// Above this distance from a plane, in `OKLab`, a cell's samples are too few.
pub(super) const ENOUGH: f32 = 0.03;

/// The memory of a strip.
#[derive(Debug, Default)]
pub(super) struct Strip {
    /// Of the few samples, cell by cell.
    light: Vec<Vec3>,
    /// The same in `OKLab`.
    looks: Vec<Vec3>,
    /// How far those of a cell disagree.
    needs: Vec<f32>,
    /// Of those in need.
    sorted: Vec<f32>,
    fits: Vec<Fitted>,
    /// One a thread.
    workers: Vec<Worker>,
}

/// The memory of a thread.
#[derive(Debug, Default)]
struct Worker {
    tracer: Tracer,
    painter: Painter,
    /// Of the fit.
    memory: Vec<Vec3>,
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
    /// Fills `cells`, whole rows from `first` on.
    pub(super) fn draw(
        &mut self,
        plan: &Plan<'_>,
        threads: &Threads,
        first: usize,
        cells: &mut [Cell],
    ) -> Effort {
        let rows = first..first + cells.len() / plan.columns;
        let fitted = rows_around(&rows, HALO, plan.rows);
        let sampled = rows_around(&fitted, 1, plan.rows);
        let band = BAND * plan.columns;
        let (samples, shadow_rays) = (AtomicU64::new(0), AtomicU64::new(0));
        let count = |(traced, shadows)| {
            samples.fetch_add(traced, Ordering::Relaxed);
            shadow_rays.fetch_add(shadows, Ordering::Relaxed);
        };
        let Self { light, looks, needs, sorted, fits, workers } = self;

        let few = plan.few.samples.count() as usize;
        light.resize(sampled.len() * plan.columns * few, Vec3::ZERO);
        looks.resize(light.len(), Vec3::ZERO);
        let bands = light.chunks_mut(band * few).zip(looks.chunks_mut(band * few));
        let bands = bands.zip(sampled.clone().step_by(BAND));
        threads.share(workers, bands, |worker, ((light, looks), first)| {
            count(worker.sample(plan, first, light));
            looks.iter_mut().zip(light).for_each(|(look, &mut light)| *look = oklab(light));
        });

        needs.resize(fitted.len() * plan.columns, 0.0);
        let known = Looks { looks, columns: plan.columns, rows: sampled.len() };
        if !plan.many.is_empty() {
            let bands = needs.chunks_mut(band).zip((fitted.start - sampled.start..).step_by(BAND));
            threads.share(workers, bands, |_, (needs, first)| known.judge(first, needs));
        }
        let left = plan.spending.left(&rows, plan.rows, light.len() as u64);
        let grids: Vec<_> = plan.many.iter().map(|sampling| sampling.samples.count()).collect();
        let grant = left.grant(needs, &grids, sorted);
        let many = plan.many.get(grant.grid).map(|sampling| (sampling, grant.above));

        fits.resize(fitted.len() * plan.columns, Fitted::NONE);
        let bands = fits.chunks_mut(band).zip(needs.chunks(band));
        let bands = bands.zip(fitted.clone().step_by(BAND));
        let known = (&**light, sampled.start);
        threads.share(workers, bands, |worker, ((fits, needs), first)| {
            count(worker.fit(plan, many, known, first, (fits, needs)));
        });

        let bands = cells.chunks_mut(band).zip(rows.step_by(BAND));
        threads.share(workers, bands, |worker, (cells, first)| {
            let known = (&**fits, fitted.start);
            worker.painter.paint(plan.style, known, plan.columns, first, cells);
        });
        let samples = samples.into_inner();
        let rays = samples + shadow_rays.into_inner();
        Effort { samples, rays, is_full: grant == Grant::FULL }
    }
}

impl Worker {
    /// Writes the light of the few samples of the cells from row `first` on, cell by cell; returns how many samples and
    /// shadow rays that took.
    fn sample(&mut self, plan: &Plan<'_>, first: usize, light: &mut [Vec3]) -> (u64, u64) {
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
        (light.len() as u64, shadow_rays)
    }

    /// Fits glyphs to the cells from row `first` on, of which those get `many` samples whose needs are above something.
    /// What is known: the light of the few samples, and which row they begin with.
    fn fit(
        &mut self,
        plan: &Plan<'_>,
        many: Option<(&Sampling, f32)>,
        (light, known): (&[Vec3], usize),
        first: usize,
        (fits, needs): (&mut [Fitted], &[f32]),
    ) -> (u64, u64) {
        let columns = plan.columns;
        self.needy.clear();
        self.places.clear();
        let few = plan.few.samples.count() as usize;
        for (cell, (fit, &need)) in fits.iter_mut().zip(needs).enumerate() {
            if many.is_some_and(|(_, above)| need > above) {
                self.places.push(Some(self.needy.len()));
                self.needy.push(((cell % columns) as u32, (first + cell / columns) as u32));
                continue;
            }
            self.places.push(None);
            let start = ((first - known) * columns + cell) * few;
            let samples = start..start + few;
            *fit = plan.few.fitter.fit(&light[samples], &mut self.memory);
        }
        let Some((many, _)) = many.filter(|_| !self.needy.is_empty()) else { return (0, 0) };

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
            fits[cell] = fitter.fit(light, &mut self.memory);
        }
        (pixels as u64, shadow_rays)
    }
}
