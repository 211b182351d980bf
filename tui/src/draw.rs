//! From a scene to cells: the whole pipeline in one page.

use crate::cells::{CellGrid, ascii, half};
use crate::palette::Palette;
use crate::picture::Picture;
use crate::samples::CellSamples;
use crate::scene::Scene;
use crate::shade::{Shader, SurfacePoint};
use crate::view::View;
use spherule_kernel::dispatch::{Level, Packet, nearest};
use spherule_kernel::{
    Accuracy, Camera, Exact, Fast, HitPacket, Lanes, RayPacket, Spheres, Stable,
};

/// Which tier decides hits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AccuracyChoice {
    /// The textbook form.
    Fast,
    /// The best form of plain `f32`.
    Stable,
    /// As in real arithmetic. The default, since it costs no more than `Stable`.
    #[default]
    Exact,
}

impl AccuracyChoice {
    /// All of them, the fastest first.
    pub const ALL: [Self; 3] = [Self::Fast, Self::Stable, Self::Exact];

    /// The name on the command line and in reports.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Fast => Fast::NAME,
            Self::Stable => Stable::NAME,
            Self::Exact => Exact::NAME,
        }
    }
}

/// How many colours there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorDepth {
    /// None: glyphs alone.
    Never,
    /// The 16 of the user's theme.
    Ansi16,
    /// The xterm palette.
    Ansi256,
    /// 24 bits.
    Truecolor,
}

/// Which characters may be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Charset {
    /// Printable ASCII.
    Ascii,
    /// Half blocks: two pixels a cell.
    Half,
}

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Which tier decides hits.
    pub accuracy: AccuracyChoice,
    /// Which characters may be used.
    pub charset: Charset,
    /// How many colours there are.
    pub depth: ColorDepth,
    /// Rays a cell, at least one.
    pub samples: u32,
    /// Width of a cell over its height.
    pub cell_aspect: f32,
}

/// A drawn picture and what it took.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The picture.
    pub cells: CellGrid,
    /// How many rays were traced, shadow rays among them.
    pub rays: u64,
}

/// How many rows of cells are traced at a time: enough rays for the kernel to share the
/// preparation of the spheres among, few enough to stay in the cache, and a multiple of a
/// packet's height whatever the samples.
const BAND: u16 = 4;

/// Draws `scene` as `view` sees it into `columns` x `rows` cells, with the best that the CPU has.
///
/// Who draws more than once keeps a [`Renderer`].
#[must_use]
pub fn draw(scene: &Scene, view: &View, style: &Style, columns: u16, rows: u16) -> Drawn {
    Renderer::default().draw(scene, view, style, columns, rows)
}

/// The camera of a picture and the size of its grid of samples: sample `(ix, iy)` is the ray
/// `camera.get_ray(ix, iy)`.
#[must_use]
pub fn sample_grid(view: &View, style: &Style, columns: u16, rows: u16) -> (Camera, u32, u32) {
    let samples = CellSamples::new(style);
    let (width, height) = (u32::from(columns) * samples.across, u32::from(rows) * samples.down);
    let aspect = picture_aspect(style, columns, rows);
    (view.camera(width, height, aspect), width, height)
}

/// Width over height of a picture of `columns` x `rows` cells; 1 where it has no area.
#[must_use]
pub fn picture_aspect(style: &Style, columns: u16, rows: u16) -> f64 {
    if columns == 0 || rows == 0 {
        return 1.0;
    }
    f64::from(columns) * f64::from(style.cell_aspect) / f64::from(rows)
}

/// Draws, and keeps its memory from frame to frame.
#[derive(Debug)]
pub struct Renderer {
    level: Level,
    rays: Vec<RayPacket<Packet>>,
    hits: Vec<HitPacket<Packet>>,
    shader: Shader,
    picture: Picture,
    palette: Palette,
}

impl Default for Renderer {
    fn default() -> Self {
        Self::new(Level::best())
    }
}

impl Renderer {
    /// Without memory yet; `level` changes no picture, only how long it takes.
    #[must_use]
    pub fn new(level: Level) -> Self {
        Self {
            level,
            rays: Vec::new(),
            hits: Vec::new(),
            shader: Shader::default(),
            picture: Picture::default(),
            palette: Palette::new(ColorDepth::Never),
        }
    }

    /// Draws `scene` as `view` sees it into `columns` x `rows` cells.
    #[must_use]
    pub fn draw(
        &mut self,
        scene: &Scene,
        view: &View,
        style: &Style,
        columns: u16,
        rows: u16,
    ) -> Drawn {
        if self.palette.depth() != style.depth {
            self.palette = Palette::new(style.depth);
        }
        match style.accuracy {
            AccuracyChoice::Fast => self.draw_as::<Fast>(scene, view, style, columns, rows),
            AccuracyChoice::Stable => self.draw_as::<Stable>(scene, view, style, columns, rows),
            AccuracyChoice::Exact => self.draw_as::<Exact>(scene, view, style, columns, rows),
        }
    }

    fn draw_as<A: Accuracy>(
        &mut self,
        scene: &Scene,
        view: &View,
        style: &Style,
        columns: u16,
        rows: u16,
    ) -> Drawn {
        let (camera, width, height) = sample_grid(view, style, columns, rows);
        let samples = CellSamples::new(style);
        let mut drawn = Drawn {
            cells: CellGrid::new(columns, rows),
            rays: u64::from(width) * u64::from(height),
        };
        if columns == 0 {
            return drawn;
        }
        for first in (0..rows).step_by(usize::from(BAND)) {
            let band = BAND.min(rows - first);
            let top = u32::from(first) * samples.down;
            let bottom = top + u32::from(band) * samples.down;

            // Rays, and what they meet.
            self.aim(&camera, width, top..bottom, height);
            self.hits.resize(self.rays.len(), HitPacket::<Packet>::none());
            nearest::<A>(self.level, &self.rays, scene.spheres(), &mut self.hits);

            // Light.
            let pixel_rows = u32::from(band) * samples.pixels;
            self.picture.reset(usize::from(columns), pixel_rows as usize);
            self.gather(scene, samples, width, top..bottom);
            drawn.rays += self.shader.light::<A>(self.level, scene, &mut self.picture);

            // Characters.
            let cells = drawn.cells.cells_mut();
            for row in 0..band {
                let start = usize::from(first + row) * usize::from(columns);
                let cells = &mut cells[start..start + usize::from(columns)];
                let pixels = |row: u16| self.picture.row(usize::from(row));
                match style.charset {
                    Charset::Ascii => ascii::write_row(pixels(row), &mut self.palette, cells),
                    Charset::Half => {
                        let (upper, lower) = (pixels(2 * row), pixels(2 * row + 1));
                        half::write_row(upper, lower, first + row, &mut self.palette, cells);
                    }
                }
            }
        }
        drawn
    }

    /// Fills the packets with the tiles of some rows of samples, row of tiles by row of tiles.
    fn aim(&mut self, camera: &Camera, width: u32, rows: std::ops::Range<u32>, height: u32) {
        let (across, down) = Camera::tile::<Packet>();
        self.rays.clear();
        for iy in rows.step_by(down as usize) {
            for ix in (0..width).step_by(across as usize) {
                self.rays.push(camera.packet::<Packet>(ix, iy, width, height));
            }
        }
    }

    /// Hands what the rays met to the shader, and the background to the picture where they met
    /// nothing; in the order of [`Renderer::aim`].
    fn gather(
        &mut self,
        scene: &Scene,
        samples: CellSamples,
        width: u32,
        rows: std::ops::Range<u32>,
    ) {
        let (across, down) = Camera::tile::<Packet>();
        let tiles = width.div_ceil(across);
        let share = 1.0 / samples.per_pixel() as f32;
        let background = share * scene.background.to_linear();
        let spheres: Spheres<'_> = scene.spheres();
        let columns = width / samples.across;
        let pixel_height = samples.down / samples.pixels;
        for (index, (rays, hits)) in self.rays.iter().zip(&self.hits).enumerate() {
            let tile_x = index as u32 % tiles * across;
            let tile_y = index as u32 / tiles * down;
            for lane in 0..Packet::COUNT as u32 {
                let (x, y) = (tile_x + lane % across, tile_y + lane / across);
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
