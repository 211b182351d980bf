//! Pixels in place of cells: the picture that cells approximate, row by row.

use super::Renderer;
use super::finish::Finish;
use super::sample_grid::{SampleGrid, Traced};
use super::tracer::{Places, Tracer};
use crate::color::Srgb;
use crate::picture::Image;
use crate::samples::CellSamples;
use crate::scene::Scene;
use crate::shade::silhouettes::{Seen, SeenGrid};
use crate::structure::choose::Workload;
use crate::structure::picture_search::PictureSearch;
use crate::style::Style;
use crate::view::View;
use spherule_kernel::{Camera, Tier, Vec3};
use std::convert::Infallible;

/// Pixels across a cell.
const ACROSS_A_CELL: u32 = 8;
/// Samples across a pixel, and down.
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
    view: View,
    style: Style,
    /// Columns and rows of cells.
    cells: (u16, u16),
    /// Pixels across a cell, and down.
    cell: (u32, u32),
}

impl PixelGrid {
    /// The pixels of a picture of `columns` x `rows` cells: 8 across a cell, and as many down as make them square in a
    /// [square](Self::square) style.
    #[must_use]
    pub fn new(view: &View, style: &Style, columns: u16, rows: u16) -> Self {
        Self::in_cells(view, style, (columns, rows), Self::usual_cell(style), SAMPLES)
    }

    /// The same for cells of so many pixels, with so many samples across a pixel, and as many down.
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
        Self {
            samples: SampleGrid { camera, width, height },
            across,
            view: *view,
            style: *style,
            cells: (columns, rows),
            cell,
        }
    }

    /// The style with the shape of a cell that whole pixels give it: in a file pixels are square, and spheres are to be round.
    #[must_use]
    pub fn square(style: &Style) -> Style {
        let (width, height) = Self::usual_cell(style);
        Style { cell_aspect: width as f32 / height as f32, ..*style }
    }

    /// The pixels across and down a cell of which nothing is known but its shape.
    #[must_use]
    pub fn usual_cell(style: &Style) -> (u32, u32) {
        (ACROSS_A_CELL, (ACROSS_A_CELL as f32 / style.cell_aspect).round().max(1.0) as u32)
    }

    /// Pixels across the picture, and down.
    #[must_use]
    pub fn size(&self) -> (u32, u32) {
        (self.samples.width / self.across, self.samples.height / self.across)
    }

    /// The work of the camera's rays, against so many spheres.
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
    /// The first error of `take`.
    pub fn draw_pixels<E>(
        &self,
        scene: &Scene,
        search: &PictureSearch<'_>,
        accuracy: Tier,
        grid: &PixelGrid,
        mut take: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        let traced = self.traced(scene, search, accuracy);
        let (style, (columns, cell_rows)) = (&grid.style, grid.cells);
        let few = CellSamples::FEW;
        let few_grid = SampleGrid::new(&grid.view, style, few, columns, cell_rows);
        let finish = Finish::new(&traced, &grid.view, style, (few, &few_grid));
        let (width, height) = grid.size();
        let across = width.div_ceil(TILE.0);
        let strip_height = TILE.1 * (STRIP / (width * TILE.1).max(1)).max(1);
        let tiles_in = |rows: u32| across * rows.div_ceil(TILE.1);
        // Tile after tile, each of the whole area.
        let mut strip = vec![[0; 3]; tiles_in(strip_height.min(height)) as usize * TILE_AREA];
        let (mut tracers, mut row, mut seen) = (Vec::<Worker>::new(), Vec::new(), Vec::new());
        for top in (0..height).step_by(strip_height as usize) {
            let rows = strip_height.min(height - top);
            // What the cells of these rows and around them show, if edges are to be seen.
            let first = (top / grid.cell.1).saturating_sub(1) as usize;
            let last = ((top + rows).div_ceil(grid.cell.1) + 1).min(cell_rows.into()) as usize;
            let edges = finish.as_ref().filter(|finish| finish.edges).map(|finish| {
                let a_row = usize::from(columns) * few.count() as usize;
                seen.clear();
                seen.resize((last - first) * a_row, Seen::NOTHING);
                let lines = seen.chunks_mut(a_row.max(1)).zip(first..);
                self.threads.share(&mut tracers, lines, |worker, (seen, row)| {
                    let (how, part) = ((&traced, Some(finish)), (0, columns.into()));
                    let tracer = &mut worker.tracer;
                    let shown = tracer.trace_cells(how, (few, &few_grid), part, row..row + 1);
                    seen.copy_from_slice(shown.seen);
                });
                (finish.grid(&seen, columns.into()), first)
            });
            let tiles = strip.chunks_mut(TILE_AREA).zip(0..tiles_in(rows));
            self.threads.share(&mut tracers, tiles, |worker, (pixels, tile)| {
                let corner = (tile % across * TILE.0, top + tile / across * TILE.1);
                match &finish {
                    None => trace_tile(&mut worker.tracer, &traced, grid, corner, pixels),
                    Some(finish) => {
                        let how = (&traced, finish, edges.as_ref());
                        finish_tile(worker, how, grid, corner, pixels);
                    }
                }
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

/// The packets of the tile with this corner.
fn tile_corners(
    grid: &PixelGrid,
    (left, top): (u32, u32),
) -> impl Iterator<Item = (u32, u32)> + use<> {
    let (width, height) = grid.size();
    let ((across, down), samples) =
        ((TILE.0.min(width - left), TILE.1.min(height - top)), grid.across);
    Camera::tile_corners::<[f32; 16]>(across * samples, down * samples)
        .map(move |(x, y)| (left * samples + x, top * samples + y))
}

/// The memory of a thread.
#[derive(Debug, Default)]
struct Worker {
    tracer: Tracer,
    /// Samples of a tile.
    finished: Vec<Vec3>,
}

/// As `trace_tile`, but finishes samples one by one. Takes the grid by which edges get dark, and the row of cells that it begins with.
fn finish_tile(
    Worker { tracer, finished }: &mut Worker,
    (traced, finish, edges): (&Traced<'_>, &Finish<'_>, Option<&(SeenGrid<'_>, usize)>),
    grid: &PixelGrid,
    (left, top): (u32, u32),
    pixels: &mut [[u8; 3]],
) {
    let corners = tile_corners(grid, (left, top));
    let samples_across = grid.across;
    let row = TILE.0 * samples_across;
    let places = |corner| {
        Places::new(
            corner,
            |x| (x - left * samples_across) as usize,
            |y| ((y - top * samples_across) * row) as usize,
        )
    };
    let samples = pixels.len() * (samples_across * samples_across) as usize;
    let traced =
        tracer.trace((traced, Some(finish)), &grid.samples, corners, (samples, 1.0), places);
    finished.clear();
    finished.extend_from_slice(traced.pixels);
    if let Some((seen_grid, first)) = edges {
        let (across, down) = (grid.cell.0 * samples_across, grid.cell.1 * samples_across);
        let above = *first as u32 * down;
        for (index, (light, seen)) in (0..).zip(finished.iter_mut().zip(traced.seen)) {
            let (x, y) =
                (left * samples_across + index % row, top * samples_across + index / row - above);
            let place = seen_grid.place((x, y), (across, down));
            finish.darken(light, seen, seen_grid, place);
        }
    }
    for (index, pixel) in (0..).zip(pixels) {
        let (left, top) = (index % TILE.0 * samples_across, index / TILE.0 * samples_across);
        let lines = (top..top + samples_across).map(|y| (y * row + left) as usize);
        let sum: Vec3 = lines
            .flat_map(|start| &finished[start..start + samples_across as usize])
            .copied()
            .sum();
        *pixel = Srgb::from_linear(sum / (samples_across * samples_across) as f32).0;
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
    let corners = tile_corners(grid, (left, top));
    let across = grid.across;
    let share = 1.0 / (across * across) as f32;
    let places = |corner| {
        let of_column = |x| (x / across - left) as usize;
        Places::new(corner, of_column, |y| ((y / across - top) * TILE.0) as usize)
    };
    let how = (traced, None);
    let traced = tracer.trace(how, &grid.samples, corners, (pixels.len(), share), places);
    for (pixel, &light) in pixels.iter_mut().zip(traced.pixels) {
        *pixel = Srgb::from_linear(light).0;
    }
}

#[cfg(test)]
mod tests;
