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

/// `marbles` in the pixels that `--png` writes.
static TRUTH: LazyLock<Truth> = LazyLock::new(|| {
    let scene = marbles();
    let view = scene.first_view(Style::PLAIN.picture_aspect(COLUMNS, ROWS) as f32);
    let threads = Threads::default();
    let grid = PixelGrid::new(&view, &Style::PLAIN, COLUMNS, ROWS);
    let search = brute_force(&scene, &view);
    let mut pixels: Vec<Rgb> = Vec::new();
    let take = |row: &[u8]| {
        pixels.extend(row.as_chunks().0);
        Ok::<_, Infallible>(())
    };
    let renderer = Renderer::new(Level::best(), &threads);
    let Ok(()) = renderer.draw_pixels(&scene, &search, Tier::Exact, &grid, take);
    let (width, _) = grid.size();
    assert_eq!(width as usize, usize::from(COLUMNS) * WIDTH);
    Truth::new(&Light::of_colors(width as usize, pixels.into_iter())).expect("whole cells")
});

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
