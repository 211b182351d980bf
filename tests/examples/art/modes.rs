//! The modes that are drawn, and the aims of each.

use spherule::style::{Charset, ColorDepth, Style};
use spherule_tests::art::font::Font;

/// The scenes: built in, or in a file of `tests/cases`.
pub(crate) const SCENES: [&str; 5] = ["marbles", "flake", "caffeine", "night", "confetti"];

/// Columns and rows of every picture.
pub(crate) const SIZE: (u16, u16) = (80, 40);

/// One way to draw, for this program and for chafa.
#[derive(Clone, Copy)]
pub(crate) struct Mode {
    pub(crate) name: &'static str,
    pub(crate) charset: Charset,
    pub(crate) depth: ColorDepth,
    /// Options of chafa: of its modes the nearest.
    pub(crate) chafa: &'static str,
    /// What chafa dithers with, where colours are few.
    pub(crate) dither: Option<&'static str>,
    /// Whether the mode has letters: only then fonts matter.
    pub(crate) is_text: bool,
    /// The most that FLIP may be, as a share of chafa's.
    pub(crate) most_flip: f64,
    /// The most that the error of changes in motion may be, as a share of chafa's.
    pub(crate) most_unrest: f64,
    /// The floor from across the room, in dB, of each scene in Unifont: what the first version reached, less 1.
    pub(crate) far: [f64; SCENES.len()],
}

impl Mode {
    /// How this program draws the mode.
    pub(crate) fn style(&self) -> Style {
        Style { charset: self.charset, depth: self.depth, ..Style::PLAIN }
    }

    /// Without colour, tones may be chosen freely.
    pub(crate) fn has_colors(&self) -> bool {
        self.depth != ColorDepth::Never
    }

    /// The fonts that the mode is judged in.
    pub(crate) fn fonts(&self) -> &'static [Font] {
        if self.is_text { &Font::ALL } else { &[Font::Unifont] }
    }
}

const BLOCKS: Mode = Mode {
    name: "half",
    charset: Charset::Half,
    depth: ColorDepth::Truecolor,
    chafa: "--symbols half+space+solid --colors full",
    dither: None,
    is_text: false,
    most_flip: 1.0,
    most_unrest: 1.0,
    far: [42.7, 38.1, 38.6, 40.7, 31.9],
};

/// All of them.
pub(crate) const MODES: [Mode; 10] = [
    BLOCKS,
    Mode {
        name: "quadrant",
        charset: Charset::Quadrant,
        chafa: "--symbols quad+half+space+solid --colors full",
        far: [43.5, 38.9, 39.5, 41.7, 32.3],
        ..BLOCKS
    },
    Mode {
        name: "sextant",
        charset: Charset::Sextant,
        chafa: "--symbols sextant+half+space+solid --colors full",
        most_flip: 0.95,
        most_unrest: 0.7,
        far: [47.4, 40.8, 42.7, 44.2, 33.5],
        ..BLOCKS
    },
    // Chafa has no octants: sextants are the nearest.
    Mode {
        name: "octant",
        charset: Charset::Octant,
        chafa: "--symbols sextant+half+space+solid --colors full",
        most_flip: 0.95,
        far: [46.6, 40.0, 43.2, 43.7, 33.2],
        ..BLOCKS
    },
    Mode {
        name: "block",
        charset: Charset::Block,
        // A wide character would push the rest of its line aside.
        chafa: "--symbols all-wide --colors full",
        most_flip: 0.95,
        most_unrest: 0.7,
        far: [48.5, 40.9, 43.8, 44.4, 33.6],
        ..BLOCKS
    },
    Mode {
        name: "braille",
        charset: Charset::Braille,
        chafa: "--symbols braille --colors full",
        most_flip: 0.95,
        far: [34.3, 30.8, 30.9, 32.9, 25.2],
        ..BLOCKS
    },
    Mode {
        name: "half-256",
        depth: ColorDepth::Ansi256,
        chafa: "--symbols half+space+solid --colors 240",
        dither: Some("diffusion"),
        most_flip: 0.93,
        far: [32.0, 29.3, 33.4, 30.6, 28.9],
        ..BLOCKS
    },
    Mode {
        name: "half-16",
        depth: ColorDepth::Ansi16,
        chafa: "--symbols half+space+solid --colors 16 --preprocess off",
        dither: Some("diffusion"),
        far: [25.0, 17.8, 17.1, 17.1, 24.3],
        ..BLOCKS
    },
    Mode {
        name: "ascii",
        charset: Charset::Ascii,
        chafa: "--symbols ascii --colors full",
        is_text: true,
        most_flip: 0.93,
        most_unrest: 0.7,
        far: [37.4, 34.2, 33.1, 36.0, 27.0],
        ..BLOCKS
    },
    Mode {
        name: "ascii-nocolour",
        charset: Charset::Ascii,
        depth: ColorDepth::Never,
        chafa: "--symbols ascii --colors none",
        dither: Some("ordered"),
        is_text: true,
        most_flip: 0.97,
        most_unrest: 0.7,
        far: [14.2, 15.4, 13.6, 16.0, 16.2],
    },
];
