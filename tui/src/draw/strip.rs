//! Some rows of a picture, from rays to cells, in four passes over bands of rows. Each pass needs what the one before
//! made of the rows around its own.
//!
//! 1. *Sample*: a few rays in every cell.
//! 2. *Judge*: how far the few disagree. Then the needs of all cells are known, and it is decided what they get.
//! 3. *Fit*: many rays where they are granted, and the glyph and colours of each cell.
//! 4. *Paint*: what a cell cannot show goes to its neighbours, and light becomes the colours that the terminal has.
//!
//! What a band gets depends on nothing else, so the picture is the same for every number of threads.

mod worker;

use super::finish::Finish;
use super::need::Looks;
use super::plan::Plan;
use super::spending::{Effort, Grant};
use crate::cells::fit::Fitted;
use crate::cells::{Cell, change};
use crate::color::oklab;
use crate::shade::silhouettes::{Seen, SeenGrid};
use crate::style::{Charset, ColorDepth};
use crate::threads::Threads;
use spherule_kernel::Vec3;
use std::iter;
use std::mem::swap;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use worker::Worker;

/// How many rows of cells are traced at a time: enough rays for the kernel to share the
/// preparation of the spheres among, few enough to stay in the cache and to keep all threads busy
/// to the end, and a multiple of a packet's height whatever the samples.
const BAND: usize = 4;

/// How many rows of fits around a row influence its cells.
const HALO: usize = 2;
/// How many rows of samples around a row influence its fits. Edges reach farther.
const AROUND: usize = 1;

/// The memory of a strip.
#[derive(Debug, Default)]
pub(super) struct Strip {
    /// The light of the few samples, cell by cell.
    light: Vec<Vec3>,
    /// What the few samples show, if edges are to be seen.
    seen: Vec<Seen>,
    /// The light in `OKLab`, if cells may be in need.
    looks: Vec<Vec3>,
    /// How far the few samples of a cell disagree.
    needs: Vec<f32>,
    /// The needs of cells in need.
    sorted: Vec<f32>,
    /// What is kept of the last picture, or of both parts of one that are drawn by turns: first of the part that was drawn last.
    kept: [Kept; 2],
    /// One a thread.
    workers: Vec<Worker>,
}

/// What is kept from frame to frame.
#[derive(Debug, Default)]
struct Kept {
    /// The fits of the frame before, until they are made anew.
    fits: Vec<Fitted>,
    /// The cells that were made of the fits.
    shown: Vec<Cell>,
    /// What the fits are of.
    of: Option<Place>,
    /// Whether the fits were drawn at rest.
    at_rest: bool,
}

/// Rows and columns, and their characters and colours.
#[derive(Debug, PartialEq)]
struct Place {
    rows: Range<usize>,
    columns: Range<usize>,
    charset: Charset,
    depth: ColorDepth,
}

/// The rows and so many around them, of `all` rows of the picture.
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

/// Chunks of `all`; endless empty ones if it is empty.
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
        let [_, of_edges] = plan.edges_reach();
        let sampled = rows_around(&fitted, AROUND + of_edges, plan.rows);
        let band = BAND * plan.columns;
        let (samples, shadow_rays) = (AtomicU64::new(0), AtomicU64::new(0));
        let count = |(traced, shadows)| {
            samples.fetch_add(traced, Ordering::Relaxed);
            shadow_rays.fetch_add(shadows, Ordering::Relaxed);
        };
        let Self { light, seen, looks, needs, sorted, kept: [kept, other], workers } = self;

        let few = plan.few.samples.count() as usize;
        light.resize(sampled.len() * plan.columns * few, Vec3::ZERO);
        looks.resize(if plan.many.is_empty() { 0 } else { light.len() }, Vec3::ZERO);
        let edges = plan.finish.as_ref().filter(|finish| finish.edges);
        seen.resize(if edges.is_some() { light.len() } else { 0 }, Seen::NOTHING);
        let bands = light.chunks_mut(band * few).zip(chunks_or_nothing(looks, band * few));
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
            let bands = light.chunks_mut(band * few).zip(chunks_or_nothing(looks, band * few));
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

        let place = Place {
            rows: fitted.clone(),
            columns: plan.left..plan.left + plan.columns,
            charset: plan.style.charset,
            depth: plan.style.depth,
        };
        if kept.of.as_ref().is_none_or(|of| of.columns != place.columns) {
            swap(kept, other);
        }
        let Kept { fits, shown, of, at_rest } = kept;
        // Fits of another place, or of cells of another kind, say nothing.
        if plan.is_steady || of.as_ref() != Some(&place) {
            fits.clear();
            shown.clear();
        }
        *of = Some(place);
        // A movement begins with what was there at rest.
        if *at_rest && !plan.is_steady {
            fits.iter_mut().for_each(change::at_rest);
        }
        *at_rest = plan.is_steady;
        fits.resize(fitted.len() * plan.columns, Fitted::NONE);
        let bands = fits.chunks_mut(band).zip(needs.chunks(band));
        let bands = bands.zip(fitted.clone().step_by(BAND));
        let (known, edges) = ((&**light, sampled.start), edges.as_ref().map(|(_, grid)| grid));
        threads.share(workers, bands, |worker, ((fits, needs), first)| {
            count(worker.fit(plan, many, known, first, (fits, needs), edges));
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
        if threads.are_stopped() {
            // Some of it is of this picture, and some of the last.
            *of = None;
        }
        let samples = samples.into_inner();
        let rays = samples + shadow_rays.into_inner();
        Effort { samples, rays, is_full: plan.is_steady && grant == Grant::FULL }
    }
}
