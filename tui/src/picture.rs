//! A picture in linear light: the sum of shading, before it becomes characters.

use spherule_kernel::Vec3;

/// Pixels in linear light, in whatever order their owner counts them.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    pixels: Vec<Vec3>,
}

/// A picture in encoded pixels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Image {
    /// Pixels side by side.
    pub width: u32,
    /// Rows of them.
    pub height: u32,
    /// Red, green and blue of every pixel, row by row from the top left.
    pub rgb: Vec<u8>,
}

impl Picture {
    /// Makes it so many black pixels; the memory is kept.
    pub fn reset(&mut self, pixels: usize) {
        self.pixels.clear();
        self.pixels.resize(pixels, Vec3::ZERO);
    }

    /// Adds `light` to a pixel.
    #[inline]
    pub fn add(&mut self, pixel: usize, light: Vec3) {
        self.pixels[pixel] += light;
    }

    /// All pixels, to be changed.
    pub fn pixels_mut(&mut self) -> &mut [Vec3] {
        &mut self.pixels
    }

    /// All pixels.
    #[must_use]
    pub fn pixels(&self) -> &[Vec3] {
        &self.pixels
    }
}
