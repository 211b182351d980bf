//! A few rows of cells, from rays to characters: the work of one thread at a time.

use super::packet_order::packet_corners;
use super::tracer::{SampleGrid, Traced, Tracer};
use crate::cells::{Cell, ascii, half};
use crate::palette::Palette;
use crate::samples::CellSamples;
use crate::style::{Charset, ColorDepth, Style};

/// How many rows of cells are traced at a time: enough rays for the kernel to share the
/// preparation of the spheres among, few enough to stay in the cache and to keep all threads busy
/// to the end, and a multiple of a packet's height whatever the samples.
pub(super) const BAND: usize = 4;

/// What a picture is of, and how it is made.
#[derive(Debug)]
pub(super) struct Frame<'a> {
    pub(super) traced: Traced<'a>,
    pub(super) style: &'a Style,
    pub(super) grid: SampleGrid,
}

/// Draws bands, and keeps its memory from one to the next.
#[derive(Debug)]
pub(super) struct BandPainter {
    tracer: Tracer,
    palette: Palette,
}

impl Default for BandPainter {
    fn default() -> Self {
        Self { tracer: Tracer::default(), palette: Palette::new(ColorDepth::Never) }
    }
}

impl BandPainter {
    /// Fills `cells`, whole rows of the picture from row `first` on, and returns how many shadow
    /// rays that took.
    pub(super) fn paint(&mut self, frame: &Frame<'_>, first: usize, cells: &mut [Cell]) -> u64 {
        let Frame { traced, style, grid } = frame;
        let samples = CellSamples::new(style);
        let columns = (grid.width / samples.across) as usize;
        let rows = cells.len() / columns;
        let top = first as u32 * samples.down;
        let bottom = top + rows as u32 * samples.down;
        let pixel_height = samples.down / samples.pixels;
        let pixels = cells.len() * samples.pixels as usize;
        let share = 1.0 / samples.per_pixel() as f32;
        let corners = packet_corners(grid.width, bottom - top).map(|(x, y)| (x, top + y));
        let (light, shadow_rays) =
            self.tracer.trace(traced, grid, corners, (pixels, share), |x, y| {
                let row = (y - top) / pixel_height;
                (y < bottom).then(|| row as usize * columns + (x / samples.across) as usize)
            });

        // Characters.
        if self.palette.depth() != style.depth {
            self.palette = Palette::new(style.depth);
        }
        for (index, (row, cells)) in (first..).zip(cells.chunks_mut(columns)).enumerate() {
            let pixels = |row: usize| &light[row * columns..(row + 1) * columns];
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
}
