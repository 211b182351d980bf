//! From packets of camera rays to light: the work of one thread at a time.

use super::finish::Finish;
use super::sample_grid::{SampleGrid, Traced};
use crate::picture::Picture;
use crate::samples::CellSamples;
use crate::shade::Shader;
use crate::shade::silhouettes::Seen;
use crate::structure::search::Scratch;
use spherule_kernel::{Camera, CameraTiles, HitPacket, RayPacket, Vec3};
use std::array;
use std::ops::Range;

/// Columns and rows of samples in a packet.
const TILE: (u32, u32) = Camera::tile::<[f32; 16]>();

/// Which pixels the samples of a packet belong to: each to the sum of the numbers of its column and of its row. So
/// eight numbers are found instead of sixteen, each by division.
#[derive(Clone, Copy, Debug)]
pub(super) struct Places {
    columns: [usize; TILE.0 as usize],
    rows: [usize; TILE.1 as usize],
}

impl Places {
    /// The places of the packet with this top left sample.
    #[inline]
    pub(super) fn new(
        (left, top): (u32, u32),
        of_column: impl Fn(u32) -> usize,
        of_row: impl Fn(u32) -> usize,
    ) -> Self {
        Self {
            columns: array::from_fn(|x| of_column(left + x as u32)),
            rows: array::from_fn(|y| of_row(top + y as u32)),
        }
    }
}

/// Traces packets, and keeps its memory from one call to the next.
#[derive(Debug, Default)]
pub(super) struct Tracer {
    corners: Vec<(u32, u32)>,
    rays: Vec<RayPacket>,
    hits: Vec<HitPacket>,
    scratch: Scratch,
    shader: Shader,
    picture: Picture,
    /// What each pixel shows.
    seen: Vec<Seen>,
}

/// What was traced.
#[derive(Clone, Copy, Debug)]
pub(super) struct Light<'a> {
    /// The light of every pixel.
    pub(super) pixels: &'a [Vec3],
    /// What each of them shows, if pixels are samples that are to be finished.
    pub(super) seen: &'a [Seen],
    /// How many rays it took besides the camera's.
    pub(super) other_rays: u64,
}

impl Tracer {
    /// Traces all samples of some columns and rows of cells, cell by cell, as if the picture ended with these rows.
    pub(super) fn trace_cells(
        &mut self,
        how: (&Traced<'_>, Option<&Finish<'_>>),
        (samples, grid): (CellSamples, &SampleGrid),
        (left, columns): (usize, usize),
        rows: Range<usize>,
    ) -> Light<'_> {
        let (across, down, count) = (samples.across, samples.down, samples.count());
        let columns = columns as u32;
        let (left, top) = (left as u32 * across, rows.start as u32 * down);
        let height = rows.len() as u32 * down;
        let grid = SampleGrid { height: top + height, ..*grid };
        let corners = Camera::tile_corners::<[f32; 16]>(grid.width - left, height)
            .map(|(x, y)| (left + x, top + y));
        let places = |corner| {
            let of_column = |x| ((x - left) / across * count + x % across) as usize;
            Places::new(corner, of_column, |y: u32| {
                let y = y - top;
                (y / down * columns * count + y % down * across) as usize
            })
        };
        let pixels = rows.len() * (columns * count) as usize;
        self.trace(how, &grid, corners, (pixels, 1.0), places)
    }

    /// Traces the packets of `grid` whose top left samples are `corners`, and returns the light of so many `pixels`. If
    /// the light is to be finished, pixels are samples, and have faded already.
    ///
    /// Every sample adds its `share` to the pixel that `places` names, in the order of the packets, so that sums are
    /// the same whoever computes them. When the threads are stopped, the light is worthless.
    pub(super) fn trace(
        &mut self,
        (traced, finish): (&Traced<'_>, Option<&Finish<'_>>),
        grid: &SampleGrid,
        corners: impl Iterator<Item = (u32, u32)>,
        (pixels, share): (usize, f32),
        places: impl Fn((u32, u32)) -> Places,
    ) -> Light<'_> {
        let &Traced { tracing, scene, search, threads } = traced;
        let &SampleGrid { camera, width, height } = grid;

        // Rays, and what they meet.
        self.corners.clear();
        self.corners.extend(corners);
        self.rays.resize(self.corners.len(), RayPacket::inactive());
        self.hits.resize(self.corners.len(), HitPacket::none());
        let tiles = CameraTiles { camera, size: (width, height), corners: &self.corners };
        let memory = (&mut self.scratch, threads);
        search.camera.tile_hits(tracing, memory, tiles, &mut self.rays, &mut self.hits);

        // The background is light already; what was met is noted for the shader.
        self.picture.reset(pixels);
        self.shader.show_openness(search.setting.around.is_some());
        self.seen.clear();
        self.seen.resize(if finish.is_some() { pixels } else { 0 }, Seen::NOTHING);
        if threads.are_stopped() {
            // Hits may be those of another call, even of another scene.
            return Light { pixels: self.picture.pixels(), seen: &self.seen, other_rays: 0 };
        }
        let background = share * scene.background.to_linear();
        for (&(left, top), hits) in self.corners.iter().zip(&self.hits) {
            self.shader.begin_packet();
            let places = places((left, top));
            for (lane, hit) in hits.hits().enumerate() {
                let (x, y) = (lane as u32 % TILE.0, lane as u32 / TILE.0);
                if left + x >= width || top + y >= height {
                    continue;
                }
                let pixel = places.columns[x as usize] + places.rows[y as usize];
                let met = hit.and_then(|hit| scene.colors().get(hit.sphere as usize));
                match met {
                    Some(color) => {
                        let color = share * color.to_linear();
                        self.shader.add(scene, &mut self.picture, lane, pixel as u32, color);
                    }
                    None => self.picture.add(pixel, background),
                }
                if let (Some(finish), Some(hit)) = (finish, hit) {
                    self.seen[pixel] = finish.seen(hit);
                }
            }
        }

        // Light.
        let hits = (&*self.rays, &*self.hits);
        let memory = (&mut self.scratch, threads);
        let other_rays = self.shader.light(tracing, memory, scene, search, hits, &mut self.picture);
        if let Some(finish) = finish {
            for (light, seen) in self.picture.pixels_mut().iter_mut().zip(&self.seen) {
                finish.fade(light, seen);
            }
        }
        Light { pixels: self.picture.pixels(), seen: &self.seen, other_rays }
    }
}
