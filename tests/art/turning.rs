//! How turning pictures change, beside how the truth changes: the limit of each mode.

use super::drawn::truth;
use spherule::draw::{self, Renderer, Spending};
use spherule::encode;
use spherule::scene::Scene;
use spherule::scene::builtin::builtin;
use spherule::style::{Charset, ColorDepth, Style};
use spherule::threads::Threads;
use spherule::view::{View, orbited};
use spherule_kernel::Level;
use spherule_tests::art::font::Font;
use spherule_tests::art::light::Light;
use spherule_tests::art::motion::Changes;
use spherule_tests::art::palette::xterm;
use spherule_tests::art::screen::Screen;

const COLUMNS: u16 = 30;
const ROWS: u16 = 15;
const FRAMES: u8 = 4;
/// About a degree of the orbit from frame to frame.
const STEP: f32 = 0.017;
/// An error may not be less than this share of its limit.
const SLACK: f64 = 0.9;

/// The limits of the error of changes, as an eye sees it, in thousandths.
const MOST: [(Charset, ColorDepth, f64); 7] = [
    (Charset::Half, ColorDepth::Truecolor, 11.8),
    (Charset::Sextant, ColorDepth::Truecolor, 11.6),
    (Charset::Block, ColorDepth::Truecolor, 12.3),
    (Charset::Braille, ColorDepth::Truecolor, 13.4),
    (Charset::Ascii, ColorDepth::Truecolor, 13.9),
    (Charset::Half, ColorDepth::Ansi256, 17.9),
    (Charset::Ascii, ColorDepth::Never, 27.5),
];

fn views(scene: &Scene) -> Vec<View> {
    let home = scene.first_view(Style::PLAIN.picture_aspect(COLUMNS, ROWS) as f32);
    (0..FRAMES).map(|frame| orbited(&home, f32::from(frame) * STEP, 0.0)).collect()
}

/// What a terminal shows of the viewer's frames.
fn shown(scene: &Scene, style: &Style, views: &[View]) -> Vec<Light> {
    let threads = Threads::default();
    let mut renderer = Renderer::new(Level::best(), &threads);
    let frame = |view: &View| {
        let search = draw::brute_force(scene, view);
        let spending = Spending::AtMost(u64::MAX);
        let drawn = renderer.draw(scene, &search, view, style, (COLUMNS, ROWS), spending);
        let mut bytes = Vec::new();
        encode::full(&drawn.cells, &mut bytes);
        let screen = Screen::read(&bytes, COLUMNS, ROWS, &xterm()).expect("a picture");
        Light::of_screen(&screen, Font::Unifont).expect("known glyphs")
    };
    views.iter().map(frame).collect()
}

#[test]
fn what_turns_changes_as_the_truth_does() {
    let scene = builtin("marbles").expect("a built-in scene");
    let views = views(&scene);
    let truths: Vec<Light> = views.iter().map(|view| truth(&scene, view, COLUMNS, ROWS)).collect();
    let truth = Changes::new(&truths);
    let mut wrong = String::new();
    for (charset, depth, most) in MOST {
        let style = Style { charset, depth, ..Style::PLAIN };
        let error = 1000.0 * Changes::new(&shown(&scene, &style, &views)).unrest(&truth).seen;
        if !(SLACK * most..=most).contains(&error) {
            wrong += &format!("{charset:?} {depth:?}: {error:.2} of {most}\n");
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}
