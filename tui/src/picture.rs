//! A picture in linear light: the sum of shading, before it becomes characters.

use spherule_kernel::Vec3;

/// A rectangle of pixels in linear light, row by row from the top left.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    width: usize,
    pixels: Vec<Vec3>,
}

impl Picture {
    /// Black, and of this size; the memory is kept.
    pub fn reset(&mut self, width: usize, height: usize) {
        self.width = width;
        self.pixels.clear();
        self.pixels.resize(width * height, Vec3::ZERO);
    }

    /// Adds `light` to a pixel, counted row by row.
    #[inline]
    pub fn add(&mut self, pixel: usize, light: Vec3) {
        self.pixels[pixel] += light;
    }

    /// The pixels of `row`.
    #[must_use]
    pub fn row(&self, row: usize) -> &[Vec3] {
        &self.pixels[row * self.width..(row + 1) * self.width]
    }
}
