//! The floors of the program's pictures, from across the room and from the chair. A loss of half a decibel or of a hundredth of FLIP fails,
//! and so does a gain that is not noted here.

use spherule::draw::pixels::PixelGrid;
use spherule::draw::{self, Renderer};
use spherule::encode;
use spherule::scene::Scene;
use spherule::scene::builtin::builtin;
use spherule::style::{Charset, ColorDepth, Style};
use spherule::threads::Threads;
use spherule_kernel::{Level, Tier};
use spherule_tests::art::cell::WIDTH;
use spherule_tests::art::figures::{Figures, Truth};
use spherule_tests::art::font::Font;
use spherule_tests::art::light::Light;
use spherule_tests::art::palette::{Rgb, sixteen};
use spherule_tests::art::score;
use std::convert::Infallible;
use std::sync::LazyLock;

const COLUMNS: u16 = 40;
const ROWS: u16 = 20;
/// How much better than its floor a mode may be, in dB.
const SLACK: f64 = 0.5;
/// The same for FLIP.
const SLACK_OF_FLIP: f64 = 0.008;

/// The floors of a charset with a number of colours, in a font.
struct Mode {
    charset: Charset,
    depth: ColorDepth,
    font: Font,
    /// In dB, a little below the measured figure.
    far: f64,
    correlation: f64,
    /// The mean of FLIP, a little above the measured figure.
    flip: f64,
}

/// Makes a [`Mode`].
const fn mode(
    charset: Charset,
    depth: ColorDepth,
    font: Font,
    [far, correlation, flip]: [f64; 3],
) -> Mode {
    Mode { charset, depth, font, far, correlation, flip }
}

const MODES: [Mode; 11] = [
    mode(Charset::Half, ColorDepth::Truecolor, Font::Unifont, [39.8, 0.99, 0.093]),
    mode(Charset::Quadrant, ColorDepth::Truecolor, Font::Unifont, [40.5, 0.99, 0.09]),
    mode(Charset::Sextant, ColorDepth::Truecolor, Font::Unifont, [43.6, 0.99, 0.07]),
    mode(Charset::Octant, ColorDepth::Truecolor, Font::Unifont, [43.2, 0.99, 0.07]),
    mode(Charset::Block, ColorDepth::Truecolor, Font::Unifont, [44.3, 0.99, 0.067]),
    mode(Charset::Braille, ColorDepth::Truecolor, Font::Unifont, [32.9, 0.98, 0.148]),
    mode(Charset::Ascii, ColorDepth::Truecolor, Font::Unifont, [32.9, 0.98, 0.13]),
    mode(Charset::Half, ColorDepth::Ansi256, Font::Unifont, [30.9, 0.99, 0.262]),
    mode(Charset::Half, ColorDepth::Ansi16, Font::Unifont, [26.2, 0.97, 0.352]),
    mode(Charset::Ascii, ColorDepth::Never, Font::Unifont, [14.9, 0.9, 0.818]),
    mode(Charset::Ascii, ColorDepth::Never, Font::DejaVuSansMono, [15.6, 0.92, 0.797]),
];

/// Pairs of glyphs and colours. The second of each pair has all that the first has.
const CONTAINED: [[(Charset, ColorDepth); 2]; 9] = [
    [(Charset::Half, ColorDepth::Ansi16), (Charset::Half, ColorDepth::Ansi256)],
    [(Charset::Half, ColorDepth::Ansi256), (Charset::Half, ColorDepth::Truecolor)],
    [(Charset::Ascii, ColorDepth::Never), (Charset::Ascii, ColorDepth::Truecolor)],
    [(Charset::Half, ColorDepth::Truecolor), (Charset::Quadrant, ColorDepth::Truecolor)],
    [(Charset::Quadrant, ColorDepth::Truecolor), (Charset::Sextant, ColorDepth::Truecolor)],
    [(Charset::Quadrant, ColorDepth::Truecolor), (Charset::Octant, ColorDepth::Truecolor)],
    [(Charset::Sextant, ColorDepth::Truecolor), (Charset::Block, ColorDepth::Truecolor)],
    [(Charset::Octant, ColorDepth::Truecolor), (Charset::Block, ColorDepth::Truecolor)],
    [(Charset::Half, ColorDepth::Ansi256), (Charset::Block, ColorDepth::Ansi256)],
];

fn marbles() -> Scene {
    builtin("marbles").expect("a built-in scene")
}

/// `marbles` in the pixels that `--png` writes.
static TRUTH: LazyLock<Truth> = LazyLock::new(|| {
    let scene = marbles();
    let view = scene.first_view(Style::PLAIN.picture_aspect(COLUMNS, ROWS) as f32);
    let threads = Threads::default();
    let grid = PixelGrid::new(&view, &Style::PLAIN, COLUMNS, ROWS);
    let search = draw::brute_force(&scene, &view);
    let mut pixels: Vec<Rgb> = Vec::new();
    let take = |row: &[u8]| {
        pixels.extend(row.as_chunks().0);
        Ok::<_, Infallible>(())
    };
    let renderer = Renderer::new(Level::best(), &threads);
    let Ok(()) = renderer.draw_pixels(&scene, &search, Tier::Exact, &grid, take);
    let (width, _) = grid.size();
    assert_eq!(width as usize, usize::from(COLUMNS) * WIDTH);
    Truth::new(&Light::of_colors(width as usize, pixels)).expect("whole cells")
});

/// Differences in dB that rounding decides: in 256 colours, half blocks and all blocks end within a hundredth of each other.
const AS_GOOD: f64 = 0.02;

/// The figures that `marbles` reaches.
fn reached(charset: Charset, depth: ColorDepth, font: Font) -> Figures {
    let style = Style { charset, depth, ..Style::PLAIN };
    let scene = marbles();
    let view = scene.first_view(style.picture_aspect(COLUMNS, ROWS) as f32);
    let mut bytes = Vec::new();
    encode::full(&draw::draw(&scene, &view, &style, COLUMNS, ROWS).cells, &mut bytes);
    let xterm = sixteen("xterm").expect("a known theme");
    score(&bytes, &TRUTH, &xterm, font).expect("a picture")
}

#[test]
fn every_mode_reaches_its_floor() {
    let mut wrong = String::new();
    for mode in MODES {
        let Figures { far, correlation, flip, .. } = reached(mode.charset, mode.depth, mode.font);
        let holds = (mode.far..mode.far + SLACK).contains(&far)
            && correlation >= mode.correlation
            && (mode.flip - SLACK_OF_FLIP..=mode.flip).contains(&flip);
        if !holds {
            wrong += &format!(
                "{:?} {:?} {:?}: {far:.2} dB of {}, correlation {correlation:.3} of {}, FLIP {flip:.4} of {}\n",
                mode.charset, mode.depth, mode.font, mode.far, mode.correlation, mode.flip
            );
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

#[test]
fn more_is_no_worse() {
    for pair in CONTAINED {
        let [fewer, more] = pair.map(|(charset, depth)| reached(charset, depth, Font::Unifont).far);
        assert!(fewer <= more + AS_GOOD, "{pair:?}: {fewer:.2}, {more:.2}");
    }
}
