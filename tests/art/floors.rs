//! The floors of the program's pictures, from across the room and from the chair. A loss of half a decibel or of a hundredth of FLIP fails,
//! and so does a gain that is not noted here.

use super::drawn::truth;
use spherule::scene::Scene;
use spherule::scene::builtin::builtin;
use spherule::style::{Charset, ColorDepth, Style};
use spherule::{draw, encode};
use spherule_tests::art::cell::WIDTH;
use spherule_tests::art::figures::{Figures, Truth};
use spherule_tests::art::font::Font;
use spherule_tests::art::palette::xterm;
use spherule_tests::art::score;
use std::sync::LazyLock;

const COLUMNS: u16 = 40;
const ROWS: u16 = 20;
/// How much better than its floor a mode may be, in dB.
const SLACK: f64 = 0.5;
/// The same for FLIP.
const SLACK_OF_FLIP: f64 = 0.008;

/// The floors of a charset with a number of colours, in a font: from afar, in dB, a little below the measured figure; the correlation; the
/// mean of FLIP, a little above the measured figure.
type Mode = (Charset, ColorDepth, Font, [f64; 3]);

const MODES: [Mode; 11] = [
    (Charset::Half, ColorDepth::Truecolor, Font::Unifont, [39.8, 0.99, 0.093]),
    (Charset::Quadrant, ColorDepth::Truecolor, Font::Unifont, [40.5, 0.99, 0.09]),
    (Charset::Sextant, ColorDepth::Truecolor, Font::Unifont, [43.6, 0.99, 0.07]),
    (Charset::Octant, ColorDepth::Truecolor, Font::Unifont, [43.2, 0.99, 0.07]),
    (Charset::Block, ColorDepth::Truecolor, Font::Unifont, [44.3, 0.99, 0.067]),
    (Charset::Braille, ColorDepth::Truecolor, Font::Unifont, [32.9, 0.98, 0.148]),
    (Charset::Ascii, ColorDepth::Truecolor, Font::Unifont, [32.9, 0.98, 0.13]),
    (Charset::Half, ColorDepth::Ansi256, Font::Unifont, [30.9, 0.99, 0.262]),
    (Charset::Half, ColorDepth::Ansi16, Font::Unifont, [26.2, 0.97, 0.352]),
    (Charset::Ascii, ColorDepth::Never, Font::Unifont, [14.9, 0.9, 0.818]),
    (Charset::Ascii, ColorDepth::Never, Font::DejaVuSansMono, [15.6, 0.92, 0.797]),
];

fn marbles() -> Scene {
    builtin("marbles").expect("a built-in scene")
}

/// `marbles` in the pixels that `--png` writes.
static TRUTH: LazyLock<Truth> = LazyLock::new(|| {
    let scene = marbles();
    let view = scene.first_view(Style::PLAIN.picture_aspect(COLUMNS, ROWS) as f32);
    let light = truth(&scene, &view, COLUMNS, ROWS);
    assert_eq!(light.width, usize::from(COLUMNS) * WIDTH);
    Truth::new(&light).expect("whole cells")
});

/// The figures that `marbles` reaches.
fn reached(charset: Charset, depth: ColorDepth, font: Font) -> Figures {
    let style = Style { charset, depth, ..Style::PLAIN };
    let scene = marbles();
    let view = scene.first_view(style.picture_aspect(COLUMNS, ROWS) as f32);
    let mut bytes = Vec::new();
    encode::full(&draw::draw(&scene, &view, &style, COLUMNS, ROWS).cells, &mut bytes);
    score(&bytes, &TRUTH, &xterm(), font).expect("a picture")
}

#[test]
fn every_mode_reaches_its_floor() {
    let mut wrong = String::new();
    for (charset, depth, font, [least_far, least_correlation, most_flip]) in MODES {
        let Figures { far, correlation, flip, .. } = reached(charset, depth, font);
        let holds = (least_far..least_far + SLACK).contains(&far)
            && correlation >= least_correlation
            && (most_flip - SLACK_OF_FLIP..=most_flip).contains(&flip);
        if !holds {
            wrong += &format!(
                "{charset:?} {depth:?} {font:?}: {far:.2} dB of {least_far}, correlation {correlation:.3} of \
                 {least_correlation}, FLIP {flip:.4} of {most_flip}\n"
            );
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

/// All blocks have half blocks among them. In 256 colours both end within a hundredth of a dB of each other, which rounding
/// decides. Other modes have floors that are further apart.
#[test]
fn more_is_no_worse() {
    let [fewer, more] = [Charset::Half, Charset::Block]
        .map(|charset| reached(charset, ColorDepth::Ansi256, Font::Unifont).far);
    assert!(fewer <= more + 0.02, "{fewer:.2}, {more:.2}");
}
