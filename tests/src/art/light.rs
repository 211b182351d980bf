//! Pictures in linear light.

use super::cell::{HEIGHT, WIDTH};
use super::font::Font;
use super::palette::Rgb;
use super::screen::Screen;
use super::srgb::{decoded, encoded};
use super::{cell, geometry};
use std::collections::HashMap;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// A rectangle of pixels; 1 is the display's full intensity.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Pixels side by side.
    pub width: usize,
    /// Red, green and blue, row by row from the top left.
    pub pixels: Vec<[f32; 3]>,
}

impl Light {
    /// Makes a picture of encoded colours, row by row.
    #[must_use]
    pub fn of_colors(width: usize, colors: impl IntoIterator<Item = Rgb>) -> Self {
        Self { width, pixels: colors.into_iter().map(decoded).collect() }
    }

    /// Makes a picture of a screen. Each pixel mixes the two colours of its cell in the shares that
    /// the glyph gives.
    ///
    /// # Errors
    /// If the font lacks a glyph.
    pub fn of_screen(screen: &Screen, font: Font) -> Result<Self, String> {
        let width = usize::from(screen.columns) * WIDTH;
        let mut pixels = vec![[0.0; 3]; screen.cells.len() * WIDTH * HEIGHT];
        let mut known = HashMap::<char, cell::Coverage>::new();
        for (index, shown) in screen.cells.iter().enumerate() {
            let coverage = match known.get(&shown.glyph) {
                Some(coverage) => coverage,
                None => {
                    let glyph = shown.glyph;
                    let coverage = geometry::coverage(glyph)
                        .or_else(|| font.coverage(glyph))
                        .ok_or_else(|| format!("{} has no {glyph:?}", font.word()))?;
                    known.entry(glyph).or_insert(coverage)
                }
            };
            let (ink, behind) = (decoded(shown.ink), decoded(shown.behind));
            let columns = usize::from(screen.columns);
            let corner = index / columns * HEIGHT * width + index % columns * WIDTH;
            for (y, shares) in coverage.chunks_exact(WIDTH).enumerate() {
                let row = &mut pixels[corner + y * width..][..WIDTH];
                for (pixel, share) in row.iter_mut().zip(shares) {
                    for channel in 0..3 {
                        pixel[channel] = share * ink[channel] + (1.0 - share) * behind[channel];
                    }
                }
            }
        }
        Ok(Self { width, pixels })
    }

    /// Reads a PNG of 8-bit red, green and blue.
    ///
    /// # Errors
    /// If the PNG cannot be read, or is of another kind.
    pub fn read_png(path: &Path) -> Result<Self, String> {
        let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let file = File::open(path).map_err(|error| failed(&error))?;
        let mut reader =
            png::Decoder::new(BufReader::new(file)).read_info().map_err(|error| failed(&error))?;
        if reader.output_color_type() != (png::ColorType::Rgb, png::BitDepth::Eight) {
            return Err(failed(&"not 8-bit RGB"));
        }
        let size = reader.output_buffer_size().ok_or_else(|| failed(&"too large"))?;
        let mut bytes = vec![0; size];
        let frame = reader.next_frame(&mut bytes).map_err(|error| failed(&error))?;
        let colors = bytes.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]);
        Ok(Self::of_colors(frame.width as usize, colors))
    }

    /// The picture as a display with 8 bits a channel shows it.
    #[must_use]
    pub fn colors(&self) -> Vec<Rgb> {
        self.pixels.iter().copied().map(encoded).collect()
    }

    /// Pixels one above the other.
    #[must_use]
    pub fn height(&self) -> usize {
        self.pixels.len().checked_div(self.width).unwrap_or(0)
    }

    /// The picture seen from so far away that a point is as wide as a Gaussian of this deviation,
    /// in pixels. Beyond an edge the picture continues as at the edge.
    #[must_use]
    pub fn blurred(&self, deviation: f32) -> Self {
        let reach = (3.0 * deviation + 0.5) as usize;
        let bell = |x: usize| (-((x as f32 - reach as f32) / deviation).powi(2) / 2.0).exp();
        let mut weights: Vec<f32> = (0..=2 * reach).map(bell).collect();
        let sum: f32 = weights.iter().sum();
        weights.iter_mut().for_each(|weight| *weight /= sum);
        let weights = &weights;

        let height = self.height();
        let mut across = vec![[0.0; 3]; self.pixels.len()];
        let mut padded = Vec::new();
        for (row, sums) in
            self.pixels.chunks_exact(self.width).zip(across.chunks_exact_mut(self.width))
        {
            padded.clear();
            padded.extend(std::iter::repeat_n(row[0], reach));
            padded.extend_from_slice(row);
            padded.extend(std::iter::repeat_n(row[self.width - 1], reach));
            for (offset, &weight) in weights.iter().enumerate() {
                add(weight, &padded[offset..], sums);
            }
        }
        let mut pixels = vec![[0.0; 3]; self.pixels.len()];
        for (y, sums) in pixels.chunks_exact_mut(self.width).enumerate() {
            for (offset, &weight) in weights.iter().enumerate() {
                let source = (y + offset).saturating_sub(reach).min(height - 1);
                add(weight, &across[source * self.width..], sums);
            }
        }
        Self { width: self.width, pixels }
    }
}

/// Adds a multiple of `row` to `sums`.
fn add(weight: f32, row: &[[f32; 3]], sums: &mut [[f32; 3]]) {
    for (sum, light) in sums.as_flattened_mut().iter_mut().zip(row.as_flattened()) {
        *sum += weight * light;
    }
}
