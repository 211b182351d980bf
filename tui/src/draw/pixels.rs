//! Pixels in place of cells: the picture that cells approximate, row by row.

use super::Renderer;
use super::tracer::{Places, SampleGrid, Traced, Tracer};
use crate::color::Srgb;
use crate::picture::Image;
use crate::scene::Scene;
use crate::structure::choose::Workload;
use crate::structure::scene::PictureSearch;
use crate::structure::search::Tracing;
use crate::style::Style;
use crate::view::View;
use spherule_kernel::{Camera, Tier};
use std::convert::Infallible;

/// Pixels across a cell.
const ACROSS_A_CELL: u32 = 8;
/// Samples across a pixel, and down, where nothing is saved.
pub const SAMPLES: u32 = 4;
/// Pixels across a tile, and down: what a thread traces at a time.
const TILE: (u32, u32) = (32, 16);
const TILE_AREA: usize = (TILE.0 * TILE.1) as usize;
/// The most pixels that are kept until they are handed on, unless a row of tiles has more.
const STRIP: u32 = 1 << 18;

/// The pixels of a picture, and the rays through them.
#[derive(Clone, Copy, Debug)]
pub struct PixelGrid {
    samples: SampleGrid,
    /// Samples across a pixel, and down.
    across: u32,
}

impl PixelGrid {
    /// Of a picture of `columns` x `rows` cells: 8 pixels across a cell, and as many down as make them square, so far
    /// as whole numbers do.
    #[must_use]
    pub fn new(view: &View, style: &Style, columns: u16, rows: u16) -> Self {
        Self::in_cells(view, style, (columns, rows), Self::usual_cell(style), SAMPLES)
    }

    /// Of cells of so many pixels, with so many samples across a pixel, and as many down.
    #[must_use]
    pub fn in_cells(
        view: &View,
        style: &Style,
        (columns, rows): (u16, u16),
        cell: (u32, u32),
        across: u32,
    ) -> Self {
        let width = u32::from(columns) * cell.0 * across;
        let height = u32::from(rows) * cell.1 * across;
        let camera = view.camera(width, height, style.picture_aspect(columns, rows));
        Self { samples: SampleGrid { camera, width, height }, across }
    }

    /// The pixels of a cell across, and down, of which nothing is known but its shape.
    #[must_use]
    pub fn usual_cell(style: &Style) -> (u32, u32) {
        (ACROSS_A_CELL, (ACROSS_A_CELL as f32 / style.cell_aspect).round().max(1.0) as u32)
    }

    /// Pixels across the picture, and down.
    #[must_use]
    pub fn size(&self) -> (u32, u32) {
        (self.samples.width / self.across, self.samples.height / self.across)
    }

    /// The camera's rays, against so many spheres.
    #[must_use]
    pub fn workload(&self, spheres: usize) -> Workload {
        let rays = self.samples.width as usize * self.samples.height as usize;
        Workload::of_pictures(1.0, rays, spheres)
    }
}

impl Renderer<'_> {
    /// Draws `scene` into the pixels of `grid`, all at once.
    #[must_use]
    pub fn draw_image(
        &self,
        scene: &Scene,
        search: &PictureSearch<'_>,
        accuracy: Tier,
        grid: &PixelGrid,
    ) -> Image {
        let (width, height) = grid.size();
        let mut rgb = Vec::with_capacity(3 * width as usize * height as usize);
        let taken: Result<(), Infallible> =
            self.draw_pixels(scene, search, accuracy, grid, |row| {
                rgb.extend_from_slice(row);
                Ok(())
            });
        let Ok(()) = taken;
        Image { width, height, rgb }
    }

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
    let ((width, height), across) = (grid.size(), grid.across);
    let corners = Camera::tile_corners::<[f32; 16]>(
        TILE.0.min(width - left) * across,
        TILE.1.min(height - top) * across,
    )
    .map(|(x, y)| (left * across + x, top * across + y));
    let share = 1.0 / (across * across) as f32;
    let places = |corner| {
        let of_column = |x| (x / across - left) as usize;
        Places::new(corner, of_column, |y| ((y / across - top) * TILE.0) as usize)
    };
    let (light, _) = tracer.trace(traced, &grid.samples, corners, (pixels.len(), share), places);
    for (pixel, &light) in pixels.iter_mut().zip(light) {
        *pixel = Srgb::from_linear(light).0;
    }
}

#[cfg(test)]
mod tests;
