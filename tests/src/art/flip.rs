//! FLIP: the difference that a person sees when one picture replaces the other (P. Andersson and others, "FLIP: A
//! Difference Evaluator for Alternating Images", 2020), computed by its authors' own code.

use super::palette::Rgb;
use nv_flip::{FlipImageRgb8, FlipPool, flip};

/// A picture that others are held against.
#[derive(Clone)]
pub struct Reference {
    image: FlipImageRgb8,
    size: (u32, u32),
    pixels_a_degree: f32,
}

impl std::fmt::Debug for Reference {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { size, pixels_a_degree, .. } = self;
        write!(formatter, "Reference({size:?}, {pixels_a_degree} pixels a degree)")
    }
}

impl Reference {
    /// Seen from where a degree of the eye's field has so many pixels.
    #[must_use]
    pub fn new(width: usize, colors: &[Rgb], pixels_a_degree: f32) -> Self {
        let size = (width as u32, (colors.len() / width) as u32);
        Self { image: image(size, colors), size, pixels_a_degree }
    }

    /// The mean over all pixels: 0 if nothing is seen, 1 at most.
    #[must_use]
    pub fn mean(&self, colors: &[Rgb]) -> f64 {
        let map = flip(self.image.clone(), image(self.size, colors), self.pixels_a_degree);
        f64::from(FlipPool::from_image(&map).mean())
    }
}

fn image((width, height): (u32, u32), colors: &[Rgb]) -> FlipImageRgb8 {
    FlipImageRgb8::with_data(width, height, colors.as_flattened())
}
