//! Letters and dots, as fonts draw them in a cell of 8x16 pixels.

use super::cell::{Coverage, HEIGHT, WIDTH, even};
use ab_glyph_rasterizer::{Point, Rasterizer, point};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster};
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, HintingInstance, HintingOptions, OutlinePen};
use skrifa::{FontRef, MetadataProvider};
use spleen_font::FONT_8X16;
use std::cell::RefCell;
use unifont_bitmap::Unifont;

/// A font of a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Font {
    /// GNU Unifont: bitmaps of 8x16 pixels.
    Unifont,
    /// `DejaVu` Sans Mono, antialiased and hinted.
    DejaVuSansMono,
    /// Spleen: bitmaps of 8x16 pixels, as consoles have them. ASCII alone.
    Spleen,
    /// Noto Sans Mono, antialiased, 16 pixels high. Glyphs are 7 wide, so one column is empty. ASCII alone.
    NotoSansMono,
}

/// The size whose advance is 8 pixels.
const SIZE: f32 = 13.0;
/// Rows above the base line: 13 of ascent and 4 of descent are centred on 16, the odd half upwards.
const BASE_LINE: f32 = 12.0;

impl Font {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::Unifont, Self::DejaVuSansMono, Self::Spleen, Self::NotoSansMono];

    /// The name of the font in one word.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Unifont => "unifont",
            Self::DejaVuSansMono => "dejavu",
            Self::Spleen => "spleen",
            Self::NotoSansMono => "noto",
        }
    }

    /// What the font's glyph covers; `None` if the font has no glyph. Dots of braille are always Unifont's.
    #[must_use]
    pub fn coverage(self, character: char) -> Option<Coverage> {
        let is_dots = ('\u{2800}'..='\u{28ff}').contains(&character);
        match self {
            Self::DejaVuSansMono if !is_dots => outline(character),
            Self::Spleen if !is_dots => console(character),
            Self::NotoSansMono if !is_dots => raster(character),
            _ => bitmap(character),
        }
    }
}

/// The glyphs of Spleen: a head of 4 bytes, which the crate's own reader parses wrongly, then 16 rows for each
/// character.
fn console(character: char) -> Option<Coverage> {
    let place = 4 + HEIGHT * usize::from(u8::try_from(character).ok().filter(u8::is_ascii)?);
    let rows = FONT_8X16.get(place..place + HEIGHT)?;
    let is_on = |pixel: usize| rows[pixel / WIDTH] >> (7 - pixel % WIDTH) & 1 == 1;
    Some(std::array::from_fn(|pixel| f32::from(u8::from(is_on(pixel)))))
}

/// The glyphs of Noto.
fn raster(character: char) -> Option<Coverage> {
    let glyph = get_raster(character, FontWeight::Regular, RasterHeight::Size16)?;
    let mut coverage = even(0.0);
    for (row, shares) in coverage.chunks_exact_mut(WIDTH).zip(glyph.rows()) {
        for (share, &level) in row.iter_mut().zip(shares) {
            *share = f32::from(level) / 255.0;
        }
    }
    Some(coverage)
}

fn bitmap(character: char) -> Option<Coverage> {
    thread_local! {
        static FONT: RefCell<Unifont> = RefCell::new(Unifont::open());
    }
    FONT.with_borrow_mut(|font| {
        // The glyph for characters that the font lacks.
        let replacement =
            font.load_bitmap(u32::from(char::REPLACEMENT_CHARACTER)).get_bytes().to_vec();
        let glyph = font.load_bitmap(u32::from(character));
        let bytes = glyph.get_bytes();
        // A wide glyph is squeezed into the cell.
        let dots = 8 * bytes.len() / (WIDTH * HEIGHT);
        (bytes != replacement).then(|| {
            std::array::from_fn(|pixel| {
                let first = pixel * dots;
                let is_on = |dot: &usize| bytes[dot / 8] >> (7 - dot % 8) & 1 == 1;
                (first..first + dots).filter(is_on).count() as f32 / dots as f32
            })
        })
    })
}

fn outline(character: char) -> Option<Coverage> {
    let font = FontRef::new(dejavu::sans_mono::regular()).ok()?;
    let outlines = font.outline_glyphs();
    let glyph = outlines.get(font.charmap().map(character)?)?;
    let (size, location) = (Size::new(SIZE), LocationRef::default());
    let hinting =
        HintingInstance::new(&outlines, size, location, HintingOptions::default()).ok()?;
    let mut pen = Pen::default();
    glyph.draw(DrawSettings::hinted(&hinting, false), &mut pen).ok()?;
    let mut coverage = [0.0; WIDTH * HEIGHT];
    // Overlapping contours count once.
    pen.area.for_each_pixel(|pixel, share| coverage[pixel] = share.min(1.0));
    Some(coverage)
}

/// Draws an outline into a cell; ink beyond its edges is lost.
struct Pen {
    area: Rasterizer,
    start: Point,
    at: Point,
}

impl Default for Pen {
    fn default() -> Self {
        let [start, at] = [point(0.0, 0.0); 2];
        Self { area: Rasterizer::new(WIDTH, HEIGHT), start, at }
    }
}

impl Pen {
    /// Draws straight steps, since the rasterizer's own steps are as wide as the bow of a small letter.
    fn curve(&mut self, at: impl Fn(f32) -> Point) {
        for step in 1..=STEPS {
            let to = at(f32::from(step) / f32::from(STEPS));
            self.area.draw_line(self.at, to);
            self.at = to;
        }
    }
}

/// Steps of a curve.
const STEPS: u8 = 16;

/// The point at the share `t` of the way from `a` to `b`.
fn mix(a: Point, b: Point, t: f32) -> Point {
    point(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y))
}

/// Flips y, since rows count downwards.
fn place(x: f32, y: f32) -> Point {
    point(x, BASE_LINE - y)
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.start = place(x, y);
        self.at = self.start;
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let to = place(x, y);
        self.area.draw_line(self.at, to);
        self.at = to;
    }

    fn quad_to(&mut self, cx0: f32, cy0: f32, x: f32, y: f32) {
        let to = place(x, y);
        let (from, control) = (self.at, place(cx0, cy0));
        self.curve(|t| mix(mix(from, control, t), mix(control, to, t), t));
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        let to = place(x, y);
        let (from, first, second) = (self.at, place(cx0, cy0), place(cx1, cy1));
        self.curve(|t| {
            let [a, b, c] = [mix(from, first, t), mix(first, second, t), mix(second, to, t)];
            mix(mix(a, b, t), mix(b, c, t), t)
        });
    }

    fn close(&mut self) {
        self.area.draw_line(self.at, self.start);
        self.at = self.start;
    }
}
