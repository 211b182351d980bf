//! The figures: how near a picture comes to the truth.

use super::cell::{HEIGHT, WIDTH};
use super::flip::Reference;
use super::light::Light;
use super::palette::Rgb;
use super::ssim;

/// Higher is better, except of `flip`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// The mean of FLIP, from reading distance or from the distance that the truth was made for: the difference that an eye sees. Lower is
    /// better.
    pub flip: f64,
    /// Likeness of structure: SSIM of luma, pixels as they are.
    pub ssim: f64,
    /// Pixel by pixel, in dB: encoded red, green and blue.
    pub psnr: f64,
    /// From across the room, in dB: a blur of half a cell's width goes before the comparison, so that dots and letters
    /// become tones.
    pub far: f64,
    /// Nose to the screen, in dB: pixel by pixel, in OKLab.
    pub near: f64,
    /// The correlation of lightness from across the room: it measures shape alone, whatever the brightness and the contrast.
    pub correlation: f64,
}

/// Pixels a degree of the eye's field from reading distance: a cell of 8 pixels, 2.2 mm wide, from 60 cm is 0.21 degrees.
pub const READING: f32 = 38.0;

/// The deviation of the blur from across the room: half a cell's width. An eye resolves a twelfth of a degree of cells
/// 2.2 mm wide from about four metres.
const BLUR: f32 = WIDTH as f32 / 2.0;

/// The picture that pictures in cells stand for.
#[derive(Clone, Debug)]
pub struct Truth {
    columns: u16,
    rows: u16,
    colors: Vec<Rgb>,
    seen: Reference,
    luma: Vec<f64>,
    near: Vec<[f32; 3]>,
    far: Vec<[f32; 3]>,
}

impl Truth {
    /// A picture of 8x16 pixels a cell, seen from reading distance.
    ///
    /// # Errors
    /// If it is not cut into cells.
    pub fn new(light: &Light) -> Result<Self, String> {
        Self::seen_at(light, READING)
    }

    /// The same, seen from a distance at which a degree of the eye's field has `pixels_a_degree` pixels.
    ///
    /// # Errors
    /// If it is not cut into cells.
    pub fn seen_at(light: &Light, pixels_a_degree: f32) -> Result<Self, String> {
        let (width, height) = (light.width, light.height());
        let count = |pixels: usize, cell: usize| {
            let whole = pixels > 0 && pixels.is_multiple_of(cell);
            let cells = whole.then_some(pixels / cell).and_then(|cells| u16::try_from(cells).ok());
            cells.ok_or_else(|| format!("{width}x{height} pixels are no cells of {WIDTH}x{HEIGHT}"))
        };
        let (columns, rows) = (count(width, WIDTH)?, count(height, HEIGHT)?);
        let colors = light.colors();
        Ok(Self {
            columns,
            rows,
            seen: Reference::new(width, &colors, pixels_a_degree),
            luma: ssim::luma(&colors),
            colors,
            near: oklab(light),
            far: oklab(&light.blurred(BLUR)),
        })
    }

    /// Columns and rows.
    #[must_use]
    pub fn cells(&self) -> (u16, u16) {
        (self.columns, self.rows)
    }

    /// How near a picture of the same size comes to the truth.
    ///
    /// # Panics
    /// If the picture has another size.
    #[must_use]
    pub fn figures(&self, light: &Light) -> Figures {
        assert_eq!(light.pixels.len(), self.near.len(), "another size");
        let far = oklab(&light.blurred(BLUR));
        let colors = light.colors();
        Figures {
            flip: self.seen.mean(&colors),
            ssim: ssim::mean(light.width, &ssim::luma(&colors), &self.luma),
            psnr: psnr(&colors, &self.colors),
            far: decibels(&far, &self.far),
            near: decibels(&oklab(light), &self.near),
            correlation: correlation(&far, &self.far),
        }
    }
}

/// Lightness, green to red, blue to yellow: equal steps look equal (Björn Ottosson, 2020).
#[must_use]
pub fn oklab(light: &Light) -> Vec<[f32; 3]> {
    const CONES: [[f32; 3]; 3] = [
        [0.412_221_46, 0.536_332_55, 0.051_445_995],
        [0.211_903_5, 0.680_699_5, 0.107_396_96],
        [0.088_302_46, 0.281_718_85, 0.629_978_7],
    ];
    const OPPONENTS: [[f32; 3]; 3] = [
        [0.210_454_26, 0.793_617_8, -0.004_072_047],
        [1.977_998_5, -2.428_592_2, 0.450_593_7],
        [0.025_904_037, 0.782_771_77, -0.808_675_77],
    ];
    let times = |matrix: &[[f32; 3]; 3], v: [f32; 3]| {
        matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    };
    light
        .pixels
        .iter()
        .map(|&pixel| times(&OPPONENTS, times(&CONES, pixel).map(f32::cbrt)))
        .collect()
}

/// The ratio of 255 to the root of the mean squared difference of a channel; 120 for pictures that are the same.
fn psnr(picture: &[Rgb], truth: &[Rgb]) -> f64 {
    let channels = || picture.as_flattened().iter().zip(truth.as_flattened());
    let sum: f64 = channels().map(|(&a, &b)| (f64::from(a) - f64::from(b)).powi(2)).sum();
    let mean = sum / channels().count() as f64;
    -10.0 * (mean / (255.0 * 255.0)).max(1e-12).log10()
}

/// The ratio of 1 to the mean squared distance; 120 for pictures that are the same.
fn decibels(picture: &[[f32; 3]], truth: &[[f32; 3]]) -> f64 {
    let pairs = picture.as_flattened().iter().zip(truth.as_flattened());
    let sum: f64 = pairs.map(|(&a, &b)| f64::from(a - b).powi(2)).sum();
    -10.0 * (sum / picture.len() as f64).max(1e-12).log10()
}

/// The correlation of lightness; 0 if one picture has a single lightness.
fn correlation(picture: &[[f32; 3]], truth: &[[f32; 3]]) -> f64 {
    let count = picture.len() as f64;
    let mean =
        |pixels: &[[f32; 3]]| pixels.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / count;
    let means = [mean(picture), mean(truth)];
    let [mut both, mut first, mut second] = [0.0; 3];
    for (a, b) in picture.iter().zip(truth) {
        let (a, b) = (f64::from(a[0]) - means[0], f64::from(b[0]) - means[1]);
        both += a * b;
        first += a * a;
        second += b * b;
    }
    // An even picture keeps a small rest from rounding.
    if first.min(second) <= 1e-9 * count { 0.0 } else { both / (first * second).sqrt() }
}
