//! What is drawn, and what is to be reached.

use spherule_tests::art::font::Font;

/// The scenes, built in.
pub(crate) const SCENES: [&str; 3] = ["marbles", "flake", "caffeine"];

/// Columns and rows of every picture, as both programs read them.
pub(crate) const SIZE: &str = "80x40";

/// One way to draw, by us and by chafa.
pub(crate) struct Mode {
    pub(crate) name: &'static str,
    /// Options of ours.
    pub(crate) ours: &'static str,
    /// Options of chafa, if it has such a mode.
    pub(crate) chafa: Option<&'static str>,
    /// What chafa dithers with, where colours are few.
    pub(crate) dither: Option<&'static str>,
    /// What the 16 colours are.
    pub(crate) palette: &'static str,
    pub(crate) font: Font,
    /// What to reach of the scenes: far in dB; without colour, correlation.
    pub(crate) to_reach: [Option<Aim>; SCENES.len()],
}

/// What to reach.
#[derive(Clone, Copy)]
pub(crate) struct Aim {
    pub(crate) far: f64,
    /// Without colour tones are free, and shape counts.
    pub(crate) correlation: Option<f64>,
}

const fn far(marbles: f64, flake: f64) -> [Option<Aim>; SCENES.len()] {
    [
        Some(Aim { far: marbles, correlation: None }),
        Some(Aim { far: flake, correlation: None }),
        None,
    ]
}

const MONO: [Option<Aim>; SCENES.len()] = [
    Some(Aim { far: 15.0, correlation: Some(0.94) }),
    Some(Aim { far: 16.4, correlation: Some(0.96) }),
    None,
];

const TRUECOLOR: Mode = Mode {
    name: "",
    ours: "",
    chafa: None,
    dither: None,
    palette: "xterm",
    font: Font::Unifont,
    to_reach: [None; SCENES.len()],
};

/// All of them.
pub(crate) const MODES: [Mode; 11] = [
    Mode {
        name: "half",
        ours: "--charset half --color truecolor",
        chafa: Some("--symbols half+space+solid --colors full"),
        to_reach: far(43.5, 38.5),
        ..TRUECOLOR
    },
    Mode {
        name: "quadrant",
        ours: "--charset quadrant --color truecolor",
        chafa: Some("--symbols quad+half+space+solid --colors full"),
        to_reach: far(44.0, 39.0),
        ..TRUECOLOR
    },
    Mode {
        name: "sextant",
        ours: "--charset sextant --color truecolor",
        chafa: Some("--symbols sextant+half+space+solid --colors full"),
        to_reach: far(47.0, 41.0),
        ..TRUECOLOR
    },
    Mode {
        name: "octant",
        ours: "--charset octant --color truecolor",
        to_reach: far(46.5, 40.0),
        ..TRUECOLOR
    },
    Mode {
        name: "braille",
        ours: "--charset braille --color truecolor",
        chafa: Some("--symbols braille --colors full"),
        ..TRUECOLOR
    },
    Mode {
        name: "block",
        ours: "--charset block --color truecolor",
        chafa: Some("--symbols all --colors full"),
        to_reach: far(48.0, 41.0),
        ..TRUECOLOR
    },
    Mode {
        name: "ascii",
        ours: "--charset ascii --color truecolor",
        chafa: Some("--symbols ascii --colors full"),
        to_reach: far(36.5, 33.0),
        ..TRUECOLOR
    },
    Mode {
        name: "half, 256 colours",
        ours: "--charset half --color 256",
        chafa: Some("--symbols half+space+solid --colors 240"),
        dither: Some("diffusion"),
        to_reach: far(33.0, 30.0),
        ..TRUECOLOR
    },
    Mode {
        name: "half, xterm's 16 colours",
        ours: "--charset half --color 16 --palette xterm",
        chafa: Some("--symbols half+space+solid --colors 16 --preprocess off"),
        dither: Some("diffusion"),
        to_reach: far(24.0, 18.5),
        ..TRUECOLOR
    },
    Mode {
        name: "ascii without colour, GNU Unifont",
        ours: "--charset ascii --color never",
        chafa: Some("--symbols ascii --colors none"),
        dither: Some("ordered"),
        to_reach: MONO,
        ..TRUECOLOR
    },
    Mode {
        name: "ascii without colour, DejaVu Sans Mono",
        ours: "--charset ascii --color never",
        chafa: Some("--symbols ascii --colors none"),
        dither: Some("ordered"),
        font: Font::DejaVuSansMono,
        to_reach: MONO,
        ..TRUECOLOR
    },
];
