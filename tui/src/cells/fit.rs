//! A glyph and two colours for a cell: by whichever fitter the character set has.

use super::eye::Eye;
pub use super::fitted::{FitMemory, Fitted};
use super::letters::LetterFitter;
use super::mask_fit::MaskFitter;
use crate::samples::CellSamples;
use crate::style::{Charset, Style};
use spherule_kernel::Vec3;

/// Fits glyphs to cells that have so many samples.
#[derive(Clone, Debug)]
pub enum Fitter {
    /// Geometry, in two colours.
    Masks(MaskFitter),
    /// Letters.
    Letters(LetterFitter),
}

impl Fitter {
    /// A fitter for what `style` asks for, and for an eye.
    #[must_use]
    pub fn new(style: &Style, eye: Eye, samples: CellSamples) -> Self {
        let grid = (samples.across, samples.down);
        match style.charset {
            Charset::Ascii => Self::Letters(LetterFitter::new(style.depth, eye, grid)),
            _ => Self::Masks(MaskFitter::new(style.charset, eye, grid)),
        }
    }

    /// Returns the fit to `light`, the cell's samples row by row. The contents of `memory` do not matter. In motion, `before` is what
    /// the cell was, and says how it [changes](super::change); [`Fitted::NONE`] if there was nothing.
    #[must_use]
    pub fn fit(&self, light: &[Vec3], memory: &mut FitMemory, before: Option<&Fitted>) -> Fitted {
        match self {
            Self::Masks(fitter) => fitter.fit(light, memory, before),
            Self::Letters(fitter) => fitter.fit(light, memory, before),
        }
    }
}
