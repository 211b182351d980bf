//! A few rows of cells, from rays to characters: the work of one thread at a time.

use super::packet_order::packet_corners;
use crate::cells::{Cell, ascii, half};
use crate::palette::Palette;
use crate::picture::Picture;
use crate::samples::CellSamples;
use crate::scene::Scene;
use crate::shade::Shader;
use crate::structure::scene::PictureSearch;
use crate::structure::search::{Scratch, Tracing};
use crate::style::{Charset, ColorDepth, Style};
use spherule_kernel::{Camera, HitPacket, RayPacket};
use std::ops::Range;

/// How many rows of cells are traced at a time: enough rays for the kernel to share the
/// preparation of the spheres among, few enough to stay in the cache and to keep all threads busy
/// to the end, and a multiple of a packet's height whatever the samples.
pub(super) const BAND: usize = 4;

/// What a picture is of, and how it is made.
#[derive(Debug)]
pub(super) struct Frame<'a> {
    pub(super) tracing: Tracing,
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
    rays: Vec<RayPacket>,
    hits: Vec<HitPacket>,
    scratch: Scratch,
    shader: Shader,
    picture: Picture,
    palette: Palette,
}

impl Default for BandPainter {
    fn default() -> Self {
        Self {
            rays: Vec::new(),
            hits: Vec::new(),
            scratch: Scratch::default(),
            shader: Shader::default(),
            picture: Picture::default(),
            palette: Palette::new(ColorDepth::Never),
        }
    }
}

impl BandPainter {
    /// Fills `cells`, whole rows of the picture from row `first` on, and returns how many shadow
    /// rays that took.
    pub(super) fn paint(&mut self, frame: &Frame<'_>, first: usize, cells: &mut [Cell]) -> u64 {
        let &Frame { tracing, scene, search, style, camera, width, height } = frame;
        let samples = CellSamples::new(style);
        let columns = (width / samples.across) as usize;
        let rows = (first..).take(cells.len() / columns);
        let top = first as u32 * samples.down;
        let bottom = top + rows.clone().count() as u32 * samples.down;

        // Rays, and what they meet.
        self.rays.clear();
        let corners = packet_corners(width, bottom - top);
        self.rays.extend(corners.map(|(x, y)| camera.packet(x, top + y, width, height)));
        self.hits.resize(self.rays.len(), HitPacket::none());
        search.camera.closest_hits(tracing, &mut self.scratch, &self.rays, &mut self.hits);

        // Light.
        let pixel_rows = cells.len() / columns * samples.pixels as usize;
        self.picture.reset(columns, pixel_rows);
        self.gather(frame, samples, top..bottom);
        let scratch = &mut self.scratch;
        let hits = (&*self.rays, &*self.hits);
        let shadow_rays =
            self.shader.light(tracing, scratch, scene, search, hits, &mut self.picture);

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

    /// Hands the hits to the shader, and the background to the picture if a ray has no hit; in the
    /// order of the packets.
    fn gather(&mut self, frame: &Frame<'_>, samples: CellSamples, rows: Range<u32>) {
        let &Frame { scene, width, .. } = frame;
        let (across, _) = Camera::tile::<[f32; 16]>();
        let share = 1.0 / samples.per_pixel() as f32;
        let background = share * scene.background.to_linear();
        let columns = width / samples.across;
        let pixel_height = samples.down / samples.pixels;
        let corners = packet_corners(width, rows.end - rows.start);
        for ((left, top), hits) in corners.zip(&self.hits) {
            self.shader.begin_packet();
            for (lane, hit) in hits.hits().enumerate() {
                let (x, y) = (left + lane as u32 % across, top + lane as u32 / across);
                if x >= width || rows.start + y >= rows.end {
                    continue;
                }
                let pixel = y / pixel_height * columns + x / samples.across;
                let met = hit.and_then(|hit| {
                    let index = hit.sphere as usize;
                    scene.colors().get(index)
                });
                let Some(color) = met else {
                    self.picture.add(pixel as usize, background);
                    continue;
                };
                let color = share * color.to_linear();
                self.shader.add(scene, &mut self.picture, lane, pixel, color);
            }
        }
    }
}
