//! What one thread does of a strip: it samples bands of rows, and fits glyphs to their cells.

use crate::cells::fit::{FitMemory, Fitted};
use crate::cells::paint::Painter;
use crate::draw::plan::{Plan, Sampling};
use crate::draw::sample_grid::SampleGrid;
use crate::draw::tracer::{Places, Tracer};
use crate::shade::silhouettes::{Seen, SeenGrid};
use spherule_kernel::{Camera, Vec3};

/// How many of the many samples are traced at a time: few enough to stay in the cache, and no more memory if all cells are in need.
const AT_ONCE: usize = 1 << 12;
/// About how many of the few samples are traced at a time: those of a band, unless it is very wide or they are many.
const FEW_AT_ONCE: usize = 1 << 16;

/// The memory of a thread.
#[derive(Debug, Default)]
pub(super) struct Worker {
    tracer: Tracer,
    pub(super) painter: Painter,
    /// The memory of the fit.
    memory: FitMemory,
    /// The cells of a band that need many samples.
    needy: Vec<(u32, u32)>,
    /// Which of `needy` each cell of a band is, if any.
    places: Vec<usize>,
    /// The light of many samples, with edges.
    finished: Vec<Vec3>,
}

impl Worker {
    /// Writes the light of the few samples of the cells from row `first` on, cell by cell, and what they show, if that is asked. Returns
    /// how many samples and shadow rays that took.
    pub(super) fn sample(
        &mut self,
        plan: &Plan<'_>,
        first: usize,
        light: &mut [Vec3],
        seen: &mut [Seen],
    ) -> (u64, u64) {
        let Sampling { samples, grid, .. } = &plan.few;
        let how = (&plan.traced, plan.finish.as_ref());
        let (columns, count) = (plan.columns, samples.count() as usize);
        let rows = light.len() / (columns * count);
        // Whole packets.
        let (tile_width, _) = Camera::tile::<[f32; 16]>();
        let at_once = (FEW_AT_ONCE / (rows * count)).max(1).next_multiple_of(tile_width as usize);
        let mut rays = 0;
        for from in (0..columns).step_by(at_once) {
            let width = at_once.min(columns - from);
            let left = plan.left + from;
            // As if the picture ended with these columns.
            let grid = SampleGrid { width: (left + width) as u32 * samples.across, ..*grid };
            let rows = first..first + rows;
            let traced = self.tracer.trace_cells(how, (*samples, &grid), (left, width), rows);
            let (place, line) = (from * count, columns * count);
            put(traced.pixels, width * count, light, (place, line));
            put(traced.seen, width * count, seen, (place, line));
            rays += traced.other_rays;
        }
        (light.len() as u64, rays)
    }

    /// Fits glyphs to the cells from row `first` on. Cells whose needs are above the number in `many` get its samples. Takes the light of
    /// the few samples, and the row that they begin with.
    pub(super) fn fit(
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
        // The fit of the last cell whose samples are all the same: much of a picture is background.
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
            if plan.traced.threads.are_stopped() {
                break;
            }
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
                    let samples = finished.iter_mut().zip(traced.seen).enumerate();
                    for (index, (light, seen)) in samples {
                        let (column, row) = needy[index / count];
                        let sample = (index % count) as u32;
                        let x = (column as usize - plan.left) as u32 * across + sample % across;
                        let y = (row as usize - known) as u32 * down + sample / across;
                        let place = seen_grid.place((x, y), (across, down));
                        finish.darken(light, seen, seen_grid, place);
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

/// Writes rows of so many values into `all`, each at this place of a longer line; nothing if nothing is asked.
fn put<T: Copy>(rows: &[T], width: usize, all: &mut [T], (place, line): (usize, usize)) {
    for (line, row) in all.chunks_mut(line).zip(rows.chunks(width)) {
        line[place..][..width].copy_from_slice(row);
    }
}
