//! Pixels in place of cells: the picture that cells approximate, row by row.

use super::Renderer;
use super::tracer::{Places, SampleGrid, Traced, Tracer};
use crate::color::Srgb;
use crate::scene::Scene;
use crate::structure::choose::Workload;
use crate::structure::scene::PictureSearch;
use crate::structure::search::Tracing;
use crate::style::Style;
use crate::view::View;
use spherule_kernel::{Camera, Tier};

/// Pixels across a cell.
const ACROSS_A_CELL: u32 = 8;
/// Samples across a pixel, and down.
const SAMPLES: u32 = 4;
/// Pixels across a tile, and down: what a thread traces at a time.
const TILE: (u32, u32) = (32, 16);
const TILE_AREA: usize = (TILE.0 * TILE.1) as usize;
/// The most pixels that are kept until they are handed on, unless a row of tiles has more.
const STRIP: u32 = 1 << 18;

/// The pixels of a picture, and the rays through them.
#[derive(Clone, Copy, Debug)]
pub struct PixelGrid {
    samples: SampleGrid,
}

impl PixelGrid {
    /// Of a picture of `columns` x `rows` cells: 8 pixels across a cell, and as many down as make them square, so far
    /// as whole numbers do.
    #[must_use]
    pub fn new(view: &View, style: &Style, columns: u16, rows: u16) -> Self {
        let down = (ACROSS_A_CELL as f32 / style.cell_aspect).round().max(1.0) as u32;
        let width = u32::from(columns) * ACROSS_A_CELL * SAMPLES;
        let height = u32::from(rows) * down * SAMPLES;
        let camera = view.camera(width, height, style.picture_aspect(columns, rows));
        Self { samples: SampleGrid { camera, width, height } }
    }

    /// Pixels across the picture, and down.
    #[must_use]
    pub fn size(&self) -> (u32, u32) {
        (self.samples.width / SAMPLES, self.samples.height / SAMPLES)
    }

    /// The camera's rays, against so many spheres.
    #[must_use]
    pub fn workload(&self, spheres: usize) -> Workload {
        let rays = self.samples.width as usize * self.samples.height as usize;
        Workload::of_pictures(1.0, rays, spheres)
    }
}

impl Renderer<'_> {
    /// Draws `scene` into the pixels of `grid`, and hands row after row on to `take`: red, green and blue of every
    /// pixel. `search` finds the spheres of that scene from the grid's view.
    ///
    /// # Errors
    /// The first of `take`.
    pub fn draw_pixels<E>(
        &self,
        scene: &Scene,
        search: &PictureSearch<'_>,
        accuracy: Tier,
        grid: &PixelGrid,
        mut take: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        let tracing = Tracing { tier: accuracy, level: self.level, coherence: search.coherence };
        let traced = Traced { tracing, scene, search };
        let (width, height) = grid.size();
        let across = width.div_ceil(TILE.0);
        let strip_height = TILE.1 * (STRIP / (width * TILE.1).max(1)).max(1);
        let tiles_in = |rows: u32| across * rows.div_ceil(TILE.1);
        // Tile after tile, each of the whole area.
        let mut strip = vec![[0; 3]; tiles_in(strip_height.min(height)) as usize * TILE_AREA];
        let (mut tracers, mut row) = (Vec::new(), Vec::new());
        for top in (0..height).step_by(strip_height as usize) {
            let rows = strip_height.min(height - top);
            let tiles = strip.chunks_mut(TILE_AREA).zip(0..tiles_in(rows));
            self.threads.share(&mut tracers, tiles, |tracer, (pixels, tile)| {
                let corner = (tile % across * TILE.0, top + tile / across * TILE.1);
                trace_tile(tracer, &traced, grid, corner, pixels);
            });
            for y in 0..rows {
                row.clear();
                let first = (y / TILE.1 * across) as usize;
                for tile in strip.chunks(TILE_AREA).skip(first).take(across as usize) {
                    let start = (y % TILE.1 * TILE.0) as usize;
                    row.extend_from_slice(tile[start..start + TILE.0 as usize].as_flattened());
                }
                take(&row[..3 * width as usize])?;
            }
        }
        Ok(())
    }
}

/// Fills the `pixels` of the tile with this corner; those outside the picture are left alone.
fn trace_tile(
    tracer: &mut Tracer,
    traced: &Traced<'_>,
    grid: &PixelGrid,
    (left, top): (u32, u32),
    pixels: &mut [[u8; 3]],
) {
    let (width, height) = grid.size();
    let corners = Camera::tile_corners::<[f32; 16]>(
        TILE.0.min(width - left) * SAMPLES,
        TILE.1.min(height - top) * SAMPLES,
    )
    .map(|(x, y)| (left * SAMPLES + x, top * SAMPLES + y));
    let share = 1.0 / (SAMPLES * SAMPLES) as f32;
    let places = |corner| {
        let of_column = |x| (x / SAMPLES - left) as usize;
        Places::new(corner, of_column, |y| ((y / SAMPLES - top) * TILE.0) as usize)
    };
    let (light, _) = tracer.trace(traced, &grid.samples, corners, (pixels.len(), share), places);
    for (pixel, &light) in pixels.iter_mut().zip(light) {
        *pixel = Srgb::from_linear(light).0;
    }
}

#[cfg(test)]
mod tests;
