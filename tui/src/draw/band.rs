//! A few rows of cells, from rays to characters: the work of one thread at a time.

use super::{Charset, ColorDepth, Style, tile_order};
use crate::cells::{Cell, ascii, half};
use crate::palette::Palette;
use crate::picture::Picture;
use crate::samples::CellSamples;
use crate::scene::Scene;
use crate::shade::{Shader, SurfacePoint};
use crate::structure::{PictureSearch, TileLists};
use spherule_kernel::dispatch::{Level, Packet};
use spherule_kernel::{Accuracy, Camera, HitPacket, Lanes, RayPacket, Spheres};
use std::ops::Range;

/// How many rows of cells are traced at a time: enough rays for the kernel to share the
/// preparation of the spheres among, few enough to stay in the cache and to keep all threads busy
/// to the end, and a multiple of a packet's height whatever the samples.
pub(super) const BAND: usize = 4;

/// What a picture is of, and how it is made.
#[derive(Debug)]
pub(super) struct Frame<'a> {
    pub(super) level: Level,
    pub(super) scene: &'a Scene,
    pub(super) search: &'a PictureSearch<'a>,
    pub(super) style: &'a Style,
    pub(super) camera: Camera,
    /// Of the grid of samples.
    pub(super) width: u32,
    pub(super) height: u32,
}

/// Draws bands, and keeps its memory from one to the next.
#[derive(Debug)]
pub(super) struct BandPainter {
    rays: Vec<RayPacket<Packet>>,
    hits: Vec<HitPacket<Packet>>,
    lists: TileLists,
    shader: Shader,
    picture: Picture,
    palette: Palette,
}

impl Default for BandPainter {
    fn default() -> Self {
        Self {
            rays: Vec::new(),
            hits: Vec::new(),
            lists: TileLists::default(),
            shader: Shader::default(),
            picture: Picture::default(),
            palette: Palette::new(ColorDepth::Never),
        }
    }
}

impl BandPainter {
    /// Fills `cells`, whole rows of the picture from row `first` on, and returns how many shadow
    /// rays that took.
    pub(super) fn paint<A: Accuracy>(
        &mut self,
        frame: &Frame<'_>,
        first: usize,
        cells: &mut [Cell],
    ) -> u64 {
        let &Frame { level, scene, search, style, .. } = frame;
        let samples = CellSamples::new(style);
        let columns = (frame.width / samples.across) as usize;
        let rows = (first..).take(cells.len() / columns);
        let top = first as u32 * samples.down;
        let bottom = top + rows.clone().count() as u32 * samples.down;

        // Rays, and what they meet.
        self.aim(frame, top..bottom);
        self.hits.resize(self.rays.len(), HitPacket::<Packet>::none());
        let (rays, lists) = (&self.rays, &mut self.lists);
        search.camera.nearest::<A>(level, search.kind, rays, lists, &mut self.hits);

        // Light.
        let pixel_rows = cells.len() / columns * samples.pixels as usize;
        self.picture.reset(columns, pixel_rows);
        self.gather(frame, samples, top..bottom);
        let lists = &mut self.lists;
        let shadow_rays = self.shader.light::<A>(level, scene, search, lists, &mut self.picture);

        // Characters.
        if self.palette.depth() != style.depth {
            self.palette = Palette::new(style.depth);
        }
        for (index, (row, cells)) in rows.zip(cells.chunks_mut(columns)).enumerate() {
            let pixels = |row: usize| self.picture.row(row);
            match style.charset {
                Charset::Ascii => ascii::write_row(pixels(index), &mut self.palette, cells),
                Charset::Half => {
                    let (upper, lower) = (pixels(2 * index), pixels(2 * index + 1));
                    half::write_row(upper, lower, row as u16, &mut self.palette, cells);
                }
            }
        }
        shadow_rays
    }

    /// Fills the packets with the tiles of some rows of samples.
    fn aim(&mut self, frame: &Frame<'_>, rows: Range<u32>) {
        let &Frame { camera, width, height, .. } = frame;
        let (across, down) = Camera::tile::<Packet>();
        let tiles = tile_order(width.div_ceil(across), (rows.end - rows.start).div_ceil(down));
        self.rays.clear();
        self.rays.extend(tiles.map(|(column, row)| {
            camera.packet::<Packet>(column * across, rows.start + row * down, width, height)
        }));
    }

    /// Hands what the rays met to the shader, and the background to the picture where they met
    /// nothing; in the order of [`BandPainter::aim`].
    fn gather(&mut self, frame: &Frame<'_>, samples: CellSamples, rows: Range<u32>) {
        let &Frame { scene, width, .. } = frame;
        let (across, down) = Camera::tile::<Packet>();
        let tiles = tile_order(width.div_ceil(across), (rows.end - rows.start).div_ceil(down));
        let share = 1.0 / samples.per_pixel() as f32;
        let background = share * scene.background.to_linear();
        let spheres: Spheres<'_> = scene.spheres();
        let columns = width / samples.across;
        let pixel_height = samples.down / samples.pixels;
        for ((column, row), (rays, hits)) in tiles.zip(self.rays.iter().zip(&self.hits)) {
            for lane in 0..Packet::COUNT as u32 {
                let (x, y) = (column * across + lane % across, row * down + lane / across);
                if x >= width || rows.start + y >= rows.end {
                    continue;
                }
                let pixel = y / pixel_height * columns + x / samples.across;
                let met = hits.hit(lane as usize).and_then(|hit| {
                    let index = hit.sphere as usize;
                    Some((hit.t, spheres.get(index)?, scene.colors().get(index)?))
                });
                let Some((t, sphere, color)) = met else {
                    self.picture.add(pixel as usize, background);
                    continue;
                };
                let color = share * color.to_linear();
                self.shader.add(scene, &mut self.picture, pixel, color, || {
                    SurfacePoint::new(&rays.ray(lane as usize), t, &sphere)
                });
            }
        }
    }
}
