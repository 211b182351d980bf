//! From packets of camera rays to light: the work of one thread at a time.

use crate::picture::Picture;
use crate::samples::CellSamples;
use crate::scene::Scene;
use crate::shade::Shader;
use crate::structure::scene::PictureSearch;
use crate::structure::search::{Scratch, Tracing};
use crate::style::Style;
use crate::view::View;
use spherule_kernel::{Camera, CameraTiles, HitPacket, RayPacket, Vec3};
use std::array;

/// What is traced, and how.
#[derive(Clone, Copy, Debug)]
pub(super) struct Traced<'a> {
    pub(super) tracing: Tracing,
    pub(super) scene: &'a Scene,
    pub(super) search: &'a PictureSearch<'a>,
}

/// A grid of samples over the whole picture: sample `(x, y)` is the ray `camera.get_ray(x, y)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct SampleGrid {
    pub(super) camera: Camera,
    pub(super) width: u32,
    pub(super) height: u32,
}

impl SampleGrid {
    /// So many samples in every cell of a picture of `columns` x `rows`.
    pub(super) fn new(
        view: &View,
        style: &Style,
        samples: CellSamples,
        columns: u16,
        rows: u16,
    ) -> Self {
        let (width, height) = (u32::from(columns) * samples.across, u32::from(rows) * samples.down);
        let camera = view.camera(width, height, style.picture_aspect(columns, rows));
        Self { camera, width, height }
    }
}

/// Columns and rows of samples in a packet.
const TILE: (u32, u32) = Camera::tile::<[f32; 16]>();

/// Which pixels the samples of a packet belong to: each to the sum of what its column and its row have here. So there
/// are eight numbers to be found in place of sixteen, each by division.
#[derive(Clone, Copy, Debug)]
pub(super) struct Places {
    columns: [usize; TILE.0 as usize],
    rows: [usize; TILE.1 as usize],
}

impl Places {
    /// Of the packet with this top left sample.
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

/// Traces, and keeps its memory from one call to the next.
#[derive(Debug, Default)]
pub(super) struct Tracer {
    corners: Vec<(u32, u32)>,
    rays: Vec<RayPacket>,
    hits: Vec<HitPacket>,
    scratch: Scratch,
    shader: Shader,
    picture: Picture,
}

impl Tracer {
    /// Traces the packets of `grid` whose top left samples are `corners`, and returns the light of so many `pixels`
    /// and how many shadow rays it took.
    ///
    /// Every sample adds its `share` to the pixel that `places` names. In the order of the packets, so that sums are
    /// the same whoever computes them.
    pub(super) fn trace(
        &mut self,
        traced: &Traced<'_>,
        grid: &SampleGrid,
        corners: impl Iterator<Item = (u32, u32)>,
        (pixels, share): (usize, f32),
        places: impl Fn((u32, u32)) -> Places,
    ) -> (&[Vec3], u64) {
        let &Traced { tracing, scene, search } = traced;
        let &SampleGrid { camera, width, height } = grid;

        // Rays, and what they meet.
        self.corners.clear();
        self.corners.extend(corners);
        self.rays.resize(self.corners.len(), RayPacket::inactive());
        self.hits.resize(self.corners.len(), HitPacket::none());
        let tiles = CameraTiles { camera, size: (width, height), corners: &self.corners };
        let (rays, hits) = (&mut self.rays, &mut self.hits);
        search.camera.tile_hits(tracing, &mut self.scratch, tiles, rays, hits);

        // The background is light already; what was met is noted for the shader.
        self.picture.reset(pixels);
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
            }
        }

        // Light.
        let hits = (&*self.rays, &*self.hits);
        let shadow_rays =
            self.shader.light(tracing, &mut self.scratch, scene, search, hits, &mut self.picture);
        (self.picture.pixels(), shadow_rays)
    }
}
