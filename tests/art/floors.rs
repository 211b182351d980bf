//! What the program's pictures reach at least: a loss of half a decibel fails, and so does a gain that
//! is not noted here.

use spherule::cells::{Cell, Color};
use spherule::scene::Scene;
use spherule::scene::builtin::builtin;
use spherule::style::{Charset, ColorDepth, Style};
use spherule::{draw, encode};
use spherule_tests::art::cell::{HEIGHT, WIDTH};
use spherule_tests::art::figures::{Figures, Truth};
use spherule_tests::art::font::Font;
use spherule_tests::art::light::Light;
use spherule_tests::art::palette::{Rgb, sixteen};
use spherule_tests::art::score;
use std::sync::LazyLock;

const COLUMNS: u16 = 40;
const ROWS: u16 = 20;
/// How much better than its floor a mode may be.
const SLACK: f64 = 0.5;

/// What a charset reaches at so many colours and in a font.
struct Mode {
    charset: Charset,
    depth: ColorDepth,
    font: Font,
    /// In dB, a little below what is reached.
    far: f64,
    correlation: f64,
}

const MODES: [Mode; 4] = [
    Mode {
        charset: Charset::Half,
        depth: ColorDepth::Truecolor,
        font: Font::Unifont,
        far: 35.7,
        correlation: 0.99,
    },
    Mode {
        charset: Charset::Half,
        depth: ColorDepth::Ansi256,
        font: Font::Unifont,
        far: 29.6,
        correlation: 0.98,
    },
    Mode {
        charset: Charset::Ascii,
        depth: ColorDepth::Never,
        font: Font::Unifont,
        far: 10.4,
        correlation: 0.76,
    },
    Mode {
        charset: Charset::Ascii,
        depth: ColorDepth::Never,
        font: Font::DejaVuSansMono,
        far: 10.4,
        correlation: 0.8,
    },
];

/// Glyphs and colours, and glyphs and colours that have all of these.
const CONTAINED: [[(Charset, ColorDepth); 2]; 3] = [
    [(Charset::Half, ColorDepth::Ansi16), (Charset::Half, ColorDepth::Ansi256)],
    [(Charset::Half, ColorDepth::Ansi256), (Charset::Half, ColorDepth::Truecolor)],
    [(Charset::Ascii, ColorDepth::Never), (Charset::Ascii, ColorDepth::Truecolor)],
];

fn marbles() -> Scene {
    builtin("marbles").expect("a built-in scene")
}

/// `marbles` at 8x16 pixels a cell: half blocks of so many samples that each half is the mean of its pixel.
static TRUTH: LazyLock<Truth> = LazyLock::new(|| {
    let (columns, halves) = (COLUMNS * WIDTH as u16, ROWS * HEIGHT as u16);
    let style = Style {
        charset: Charset::Half,
        depth: ColorDepth::Truecolor,
        samples: Some(32),
        ..Style::PLAIN
    };
    let scene = marbles();
    let view = scene.first_view(style.picture_aspect(columns, halves / 2) as f32);
    let cells = draw::draw(&scene, &view, &style, columns, halves / 2).cells;
    let rows = (0..cells.rows()).flat_map(|row| {
        let cells = cells.row(row);
        cells
            .iter()
            .map(|cell| halves_of(cell)[0])
            .chain(cells.iter().map(|cell| halves_of(cell)[1]))
    });
    Truth::new(&Light::of_colors(usize::from(columns), rows)).expect("whole cells")
});

fn halves_of(cell: &Cell) -> [Rgb; 2] {
    match (cell.glyph, cell.foreground, cell.background) {
        ('▀', Color::Rgb(upper), Color::Rgb(lower)) => [upper, lower],
        (' ', _, Color::Rgb(both)) => [both; 2],
        _ => panic!("no half block: {cell:?}"),
    }
}

/// What `marbles` reaches.
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
        let Figures { far, correlation, .. } = reached(mode.charset, mode.depth, mode.font);
        let holds = (mode.far..mode.far + SLACK).contains(&far) && correlation >= mode.correlation;
        if !holds {
            wrong += &format!(
                "{:?} {:?} {:?}: {far:.2} dB of {}, correlation {correlation:.3} of {}\n",
                mode.charset, mode.depth, mode.font, mode.far, mode.correlation
            );
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

#[test]
fn more_is_no_worse() {
    for pair in CONTAINED {
        let [fewer, more] = pair.map(|(charset, depth)| reached(charset, depth, Font::Unifont).far);
        assert!(fewer <= more, "{pair:?}: {fewer:.2}, {more:.2}");
    }
}
