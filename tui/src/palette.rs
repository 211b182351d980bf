//! From linear light to the colours that a terminal has.
//!
//! In the palettes the nearest colour is the one that looks nearest: by distance in `OKLab`.

use crate::cells::Color;
use crate::color::{Srgb, oklab};
use crate::style::ColorDepth;
use spherule_kernel::Vec3;

/// The 16 colours as xterm shows them; a user's theme may differ.
pub const XTERM_16: [Srgb; 16] = [
    Srgb([0, 0, 0]),
    Srgb([205, 0, 0]),
    Srgb([0, 205, 0]),
    Srgb([205, 205, 0]),
    Srgb([0, 0, 238]),
    Srgb([205, 0, 205]),
    Srgb([0, 205, 205]),
    Srgb([229, 229, 229]),
    Srgb([127, 127, 127]),
    Srgb([255, 0, 0]),
    Srgb([0, 255, 0]),
    Srgb([255, 255, 0]),
    Srgb([92, 92, 255]),
    Srgb([255, 0, 255]),
    Srgb([0, 255, 255]),
    Srgb([255, 255, 255]),
];

/// The colour of the xterm palette of 256 at `index`: 16 of the theme, a cube of 6 x 6 x 6, and
/// 24 greys.
#[must_use]
pub fn xterm_256(index: u8) -> Srgb {
    let level = |step: u8| if step == 0 { 0 } else { 55 + 40 * step };
    match index {
        0..16 => XTERM_16[usize::from(index)],
        16..232 => Srgb([(index - 16) / 36, (index - 16) / 6 % 6, (index - 16) % 6].map(level)),
        232.. => Srgb([8 + 10 * (index - 232); 3]),
    }
}

/// Finds colours, and remembers what it found.
#[derive(Clone, Debug)]
pub struct Palette {
    depth: ColorDepth,
    /// The colours to choose from, with the index that names them, in `OKLab`.
    choices: Vec<(u8, Vec3)>,
    /// The choice for each colour of 6 bits a channel; `u8::MAX` if it is not known yet.
    found: Vec<u8>,
}

impl Palette {
    /// The colours of `depth`.
    #[must_use]
    pub fn new(depth: ColorDepth) -> Self {
        let indices = match depth {
            ColorDepth::Never | ColorDepth::Truecolor => 0..0,
            ColorDepth::Ansi16 => 0..16,
            // The first 16 are the theme's: no one knows what they look like.
            ColorDepth::Ansi256 => 16..256,
        };
        let choices: Vec<_> =
            indices.map(|index| (index as u8, oklab(xterm_256(index as u8).to_linear()))).collect();
        let found = if choices.is_empty() { Vec::new() } else { vec![u8::MAX; 1 << 18] };
        Self { depth, choices, found }
    }

    /// Which colours these are.
    #[must_use]
    pub fn depth(&self) -> ColorDepth {
        self.depth
    }

    /// The colour nearest to linear light; [`Color::Default`] if there are none.
    ///
    /// The palettes are searched for the encoded colour rounded to 6 bits a channel.
    #[must_use]
    #[inline]
    pub fn nearest(&mut self, light: Vec3) -> Color {
        match self.depth {
            ColorDepth::Never => Color::Default,
            ColorDepth::Truecolor => Color::Rgb(Srgb::from_linear(light).0),
            ColorDepth::Ansi16 => Color::Ansi16(self.choice(Srgb::from_linear(light))),
            ColorDepth::Ansi256 => Color::Ansi256(self.choice(Srgb::from_linear(light))),
        }
    }

    fn choice(&mut self, color: Srgb) -> u8 {
        let [red, green, blue] = color.0.map(|channel| usize::from(channel >> 2));
        let slot = red << 12 | green << 6 | blue;
        if self.found[slot] == u8::MAX {
            // Replicate the upper bits, so that black and white stay what they are.
            let rounded = Srgb(color.0.map(|channel| channel & !3 | channel >> 6));
            let wanted = oklab(rounded.to_linear());
            let distance = |choice: &Vec3| (*choice - wanted).length_squared();
            let nearest = self
                .choices
                .iter()
                .enumerate()
                .min_by(|(_, a), (_, b)| distance(&a.1).total_cmp(&distance(&b.1)));
            self.found[slot] = nearest.map_or(0, |(position, _)| position as u8);
        }
        self.choices[usize::from(self.found[slot])].0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corners_of_the_xterm_palette() {
        assert_eq!(xterm_256(16), Srgb::BLACK);
        assert_eq!(xterm_256(21), Srgb([0, 0, 255]));
        assert_eq!(xterm_256(67), Srgb([95, 135, 175]));
        assert_eq!(xterm_256(231), Srgb::WHITE);
        assert_eq!(xterm_256(232), Srgb([8, 8, 8]));
        assert_eq!(xterm_256(255), Srgb([238, 238, 238]));
    }

    #[test]
    fn palette_colours_are_their_own_nearest() {
        let mut palette = Palette::new(ColorDepth::Ansi256);
        for index in 16..=255 {
            let Color::Ansi256(found) = palette.nearest(xterm_256(index).to_linear()) else {
                panic!("not of the palette");
            };
            assert_eq!(xterm_256(found), xterm_256(index));
        }
        let mut palette = Palette::new(ColorDepth::Ansi16);
        for (index, color) in XTERM_16.iter().enumerate() {
            assert_eq!(palette.nearest(color.to_linear()), Color::Ansi16(index as u8));
        }
    }

    #[test]
    fn the_nearest_looks_nearest() {
        let mut palette = Palette::new(ColorDepth::Ansi16);
        // A dark red is red, not the grey of its brightness.
        let dark_red = Srgb([150, 10, 10]).to_linear();
        assert_eq!(palette.nearest(dark_red), Color::Ansi16(1));
    }

    #[test]
    fn without_a_palette() {
        let light = Srgb([1, 2, 3]).to_linear();
        assert_eq!(Palette::new(ColorDepth::Truecolor).nearest(light), Color::Rgb([1, 2, 3]));
        assert_eq!(Palette::new(ColorDepth::Never).nearest(light), Color::Default);
    }
}
