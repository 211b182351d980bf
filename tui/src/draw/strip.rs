//! Some rows of a picture, from rays to cells, in four passes over bands of rows; each needs what the one before made
//! of the rows around its own.
//!
//! 1. *Sample*: a few rays in every cell.
//! 2. *Judge*: how far the few disagree. Then it is known what all cells need, and decided what they get.
//! 3. *Fit*: many rays where they are granted, and the glyph and colours of each cell.
//! 4. *Paint*: what a cell cannot show goes to its neighbours, and light becomes the colours that the terminal has.
//!
//! What a band gets depends on nothing else, so the picture is the same for every number of threads.

use super::finish::Finish;
use super::need::Looks;
use super::plan::{Plan, Sampling};
use super::spending::{Effort, Grant};
use super::tracer::{Places, Tracer};
use crate::cells::fit::{FitMemory, Fitted};
use crate::cells::paint::Painter;
use crate::cells::{Cell, change};
use crate::color::oklab;
use crate::shade::silhouettes::{Seen, SeenGrid};
use crate::style::{Charset, ColorDepth};
use crate::threads::Threads;
use spherule_kernel::{Camera, Vec3};
use std::iter;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// How many rows of cells are traced at a time: enough rays for the kernel to share the
/// preparation of the spheres among, few enough to stay in the cache and to keep all threads busy
/// to the end, and a multiple of a packet's height whatever the samples.
const BAND: usize = 4;

/// Of the many samples, so many are traced at a time: as above, and no more memory if all cells are in need.
const AT_ONCE: usize = 1 << 12;

/// How many rows of fits around a row have a part in its cells.
const HALO: usize = 2;

/// The memory of a strip.
#[derive(Debug, Default)]
pub(super) struct Strip {
    /// Of the few samples, cell by cell.
    light: Vec<Vec3>,
    /// What they show, if edges are to be seen.
    seen: Vec<Seen>,
    /// The same in `OKLab`.
    looks: Vec<Vec3>,
    /// How far those of a cell disagree.
    needs: Vec<f32>,
    /// Of those in need.
    sorted: Vec<f32>,
    /// Of the frame before until they are made anew.
    fits: Vec<Fitted>,
    /// The cells that were made of them.
    shown: Vec<Cell>,
    /// Which rows and columns they are of, in which characters and colours.
    fits_of: Option<(Range<usize>, usize, usize, Charset, ColorDepth)>,
    /// Whether they were drawn at rest.
    at_rest: bool,
    /// One a thread.
    workers: Vec<Worker>,
}

/// The memory of a thread.
#[derive(Debug, Default)]
struct Worker {
    tracer: Tracer,
    painter: Painter,
    /// Of the fit.
    memory: FitMemory,
    /// The cells of a band that need many samples.
    needy: Vec<(u32, u32)>,
    /// Which of those each cell of a band is, if it is one.
    places: Vec<usize>,
    /// The light of many samples, with edges.
    finished: Vec<Vec3>,
}

/// Rows of cells, from the first on, counted over the whole picture.
fn rows_around(rows: &Range<usize>, halo: usize, all: usize) -> Range<usize> {
    rows.start.saturating_sub(halo)..(rows.end + halo).min(all)
}

/// Writes how every sample looks, in `OKLab`. Many are as the one before: background.
fn write_looks(light: &[Vec3], looks: &mut [Vec3]) {
    let mut last = (Vec3::ZERO, oklab(Vec3::ZERO));
    for (look, &light) in looks.iter_mut().zip(light) {
        if light != last.0 {
            last = (light, oklab(light));
        }
        *look = last.1;
    }
}

/// Chunks of what is there; empty ones without end if nothing is.
fn chunks_or_nothing<T>(all: &mut [T], size: usize) -> impl Iterator<Item = &mut [T]> {
    let nothing = all.is_empty();
    all.chunks_mut(size.max(1))
        .chain(iter::repeat_with(Default::default).take_while(move |_: &&mut [T]| nothing))
}

/// Darkens the edges of the few samples of the cells from row `first` of the grid on.
fn darken(finish: &Finish<'_>, grid: &SeenGrid<'_>, first: usize, light: &mut [Vec3]) {
    let (across, down) = grid.samples;
    let start = first * grid.columns * across * down;
    for (index, (light, seen)) in light.iter_mut().zip(&grid.seen[start..]).enumerate() {
        let (cell, sample) = (index / (across * down), index % (across * down));
        let x = cell % grid.columns * across + sample % across;
        let y = (first + cell / grid.columns) * down + sample / across;
        finish.darken(light, seen, grid, (x as f32, y as f32));
    }
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
        let Self { light, seen, looks, needs, sorted, fits, shown, fits_of, at_rest, workers } =
            self;

        let few = plan.few.samples.count() as usize;
        light.resize(sampled.len() * plan.columns * few, Vec3::ZERO);
        looks.resize(light.len(), Vec3::ZERO);
        let edges = plan.finish.as_ref().filter(|finish| finish.edges);
        seen.resize(if edges.is_some() { light.len() } else { 0 }, Seen::NOTHING);
        let bands = light.chunks_mut(band * few).zip(looks.chunks_mut(band * few));
        let bands = bands.zip(chunks_or_nothing(seen, band * few));
        let bands = bands.zip(sampled.clone().step_by(BAND));
        threads.share(workers, bands, |worker, (((light, looks), seen), first)| {
            count(worker.sample(plan, first, light, seen));
            if edges.is_none() {
                write_looks(light, looks);
            }
        });
        let edges = edges.map(|finish| (finish, finish.grid(seen, plan.columns)));
        if let Some((finish, grid)) = &edges {
            let bands = light.chunks_mut(band * few).zip(looks.chunks_mut(band * few));
            threads.share(workers, bands.zip((0..).step_by(BAND)), |_, ((light, looks), first)| {
                darken(finish, grid, first, light);
                write_looks(light, looks);
            });
        }

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

        // Of another place, or of cells of another kind, what was there says nothing.
        let place =
            Some((fitted.clone(), plan.left, plan.columns, plan.style.charset, plan.style.depth));
        if plan.is_steady || *fits_of != place {
            fits.clear();
            shown.clear();
        }
        *fits_of = place;
        // A movement begins with what was there at rest.
        if *at_rest && !plan.is_steady {
            fits.iter_mut().for_each(change::at_rest);
        }
        *at_rest = plan.is_steady;
        fits.resize(fitted.len() * plan.columns, Fitted::NONE);
        let bands = fits.chunks_mut(band).zip(needs.chunks(band));
        let bands = bands.zip(fitted.clone().step_by(BAND));
        let known = (&**light, sampled.start);
        threads.share(workers, bands, |worker, ((fits, needs), first)| {
            count(worker.fit(
                plan,
                many,
                known,
                first,
                (fits, needs),
                edges.as_ref().map(|(_, grid)| grid),
            ));
        });

        let before = Some((&**shown, rows.start)).filter(|(shown, _)| shown.len() == cells.len());
        let bands = cells.chunks_mut(band).zip(rows.clone().step_by(BAND));
        threads.share(workers, bands, |worker, (cells, first)| {
            let known = (&**fits, fitted.start);
            let how = (plan.style, plan.eye, plan.is_steady);
            worker.painter.paint(how, known, plan.columns, first, cells, before);
        });
        shown.clear();
        shown.extend_from_slice(cells);
        let samples = samples.into_inner();
        let rays = samples + shadow_rays.into_inner();
        Effort { samples, rays, is_full: plan.is_steady && grant == Grant::FULL }
    }
}

impl Worker {
    /// Writes the light of the few samples of the cells from row `first` on, cell by cell, and what they show, if that is
    /// asked; returns how many samples
    /// and shadow rays that took.
    fn sample(
        &mut self,
        plan: &Plan<'_>,
        first: usize,
        light: &mut [Vec3],
        seen: &mut [Seen],
    ) -> (u64, u64) {
        let Sampling { samples, grid, .. } = &plan.few;
        let how = (&plan.traced, plan.finish.as_ref());
        let rows = first..first + light.len() / (plan.columns * samples.count() as usize);
        let part = (plan.left, plan.columns);
        let traced = self.tracer.trace_cells(how, (*samples, grid), part, rows);
        light.copy_from_slice(traced.pixels);
        if !seen.is_empty() {
            seen.copy_from_slice(traced.seen);
        }
        (light.len() as u64, traced.other_rays)
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
        edges: Option<&SeenGrid<'_>>,
    ) -> (u64, u64) {
        let columns = plan.columns;
        self.needy.clear();
        self.places.clear();
        let few = plan.few.samples.count() as usize;
        // What was made of the last cell whose samples are all the same: of background there is much.
        let mut flat: Option<(Vec3, Fitted)> = None;
        for (cell, (fit, &need)) in fits.iter_mut().zip(needs).enumerate() {
            if many.is_some_and(|(_, above)| need > above) {
                self.places.push(self.needy.len());
                let column = plan.left + cell % columns;
                self.needy.push((column as u32, (first + cell / columns) as u32));
                continue;
            }
            self.places.push(usize::MAX);
            let start = ((first - known) * columns + cell) * few;
            let light = &light[start..start + few];
            let is_flat = light.iter().all(|&other| other == light[0]);
            *fit = match flat {
                Some((color, fit)) if is_flat && color == light[0] => fit,
                _ => {
                    let before = *fit;
                    let before = (!plan.is_steady).then_some(&before);
                    plan.few.fitter.fit(light, &mut self.memory, before)
                }
            };
            if is_flat {
                flat = Some((light[0], *fit));
            }
        }
        let edges = edges.map(|grid| (grid, known));
        many.map_or((0, 0), |(many, _)| self.fit_needy(plan, many, first, fits, edges))
    }

    /// Fits glyphs to those of the cells from row `first` on that get many samples.
    fn fit_needy(
        &mut self,
        plan: &Plan<'_>,
        many: &Sampling,
        first: usize,
        fits: &mut [Fitted],
        edges: Option<(&SeenGrid<'_>, usize)>,
    ) -> (u64, u64) {
        let Self { tracer, memory, needy, places, finished, .. } = self;
        let columns = plan.columns;
        let Sampling { samples, grid, fitter } = many;
        let (across, down, count) = (samples.across, samples.down, samples.count() as usize);
        let (tile_width, tile_height) = Camera::tile::<[f32; 16]>();
        let at_once = (AT_ONCE / count).max(1);
        let mut rays = 0;
        for (needy, begin) in needy.chunks(at_once).zip((0..).step_by(at_once)) {
            // The packets of a cell one after the other.
            let corners = needy.iter().flat_map(|&(column, row)| {
                let tiles = (0..down).step_by(tile_height as usize);
                tiles.flat_map(move |y| {
                    let tiles = (0..across).step_by(tile_width as usize);
                    tiles.map(move |x| (column * across + x, row * down + y))
                })
            });
            let at = |(left, top): (u32, u32)| {
                let row = ((top / down) as usize - first) * columns;
                let cell = row + (left / across) as usize - plan.left;
                let start = (places[cell] - begin) * count;
                let of_column = |x| start + (x % across) as usize;
                Places::new((left, top), of_column, |y| (y % down * across) as usize)
            };
            let pixels = (needy.len() * count, 1.0);
            let how = (&plan.traced, plan.finish.as_ref());
            let traced = tracer.trace(how, grid, corners, pixels, at);
            rays += traced.other_rays;
            let light = match (&plan.finish, edges) {
                (Some(finish), Some((seen_grid, known))) => {
                    finished.clear();
                    finished.extend_from_slice(traced.pixels);
                    let (few_across, few_down) = seen_grid.samples;
                    let samples = finished.iter_mut().zip(traced.seen).enumerate();
                    for (index, (light, seen)) in samples {
                        let (column, row) = needy[index / count];
                        let sample = (index % count) as u32;
                        let x = (column as usize - plan.left) as u32 * across + sample % across;
                        let y = (row as usize - known) as u32 * down + sample / across;
                        let x = Finish::place(x, across, few_across as u32);
                        let y = Finish::place(y, down, few_down as u32);
                        finish.darken(light, seen, seen_grid, (x, y));
                    }
                    &**finished
                }
                _ => traced.pixels,
            };
            for (&(column, row), light) in needy.iter().zip(light.chunks(count)) {
                let cell = (row as usize - first) * columns + column as usize - plan.left;
                let before = fits[cell];
                fits[cell] = fitter.fit(light, memory, (!plan.is_steady).then_some(&before));
            }
        }
        ((needy.len() * count) as u64, rays)
    }
}
