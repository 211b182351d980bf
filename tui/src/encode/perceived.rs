//! Colours in `OKLab`, remembered. An update compares the same colours again and again, with the pen, with the cell before and with the
//! cell that was shown, and three cube roots cost more than all else that it does.

use crate::color::{Srgb, oklab};
use glam::Vec3;
use std::cell::Cell;

/// Places for colours, a power of two. A frame of 200x60 shows some thousands. (With 1 << 12 an update takes 5 % longer.)
const PLACES: usize = 1 << 13;
/// The key of an empty place, which no colour has.
const EMPTY: u32 = 1 << 24;

/// What was computed last for the colours that share a place; an empty place for each at first.
#[derive(Debug)]
pub(super) struct Perceived(Box<[Cell<(u32, Vec3)>]>);

impl Default for Perceived {
    fn default() -> Self {
        Self(vec![Cell::new((EMPTY, Vec3::ZERO)); PLACES].into())
    }
}

impl Perceived {
    /// Returns `rgb` in `OKLab`, to the bit as [`oklab`] does.
    pub(super) fn color(&self, rgb: [u8; 3]) -> Vec3 {
        let key = rgb.iter().fold(0, |key, &channel| key << 8 | u32::from(channel));
        // Colours of a gradient differ in their lowest bits: multiplied by the golden ratio they spread over the highest.
        let place = key.wrapping_mul(0x9e37_79b9) >> (u32::BITS - PLACES.ilog2());
        let place = &self.0[place as usize];
        let (known, perceived) = place.get();
        if known == key {
            return perceived;
        }
        let perceived = oklab(Srgb(rgb).to_linear());
        place.set((key, perceived));
        perceived
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Many colours for a place, each asked for twice, with others in between.
    #[test]
    fn a_colour_that_is_remembered_is_the_one_that_was_computed() {
        let perceived = Perceived::default();
        let colors = (0..1 << 24).step_by(97).map(|key: u32| {
            let [_, red, green, blue] = key.to_be_bytes();
            [red, green, blue]
        });
        let mut before = [0; 3];
        for color in colors {
            for asked in [color, color, before] {
                assert_eq!(perceived.color(asked), oklab(Srgb(asked).to_linear()), "{asked:?}");
            }
            before = color;
        }
    }
}
