//! What a turning picture costs on the line, in bytes a frame: over a slow link they decide the speed.

use spherule::draw::{self, Renderer, Spending};
use spherule::encode::{Economy, Encoder};
use spherule::scene::builtin::builtin;
use spherule::style::{Charset, ColorDepth, Style};
use spherule::threads::Threads;
use spherule::view;
use spherule_kernel::Level;
use std::f32::consts::{PI, TAU};

/// Places around the scene, and how many consecutive frames are drawn at each.
const PLACES: u16 = 6;
const FRAMES: usize = 4;
/// 30 degrees a second at 60 frames: the viewer's pace.
const STEP: f32 = PI / 360.0;

/// Bytes of the changes from one frame of `marbles` to the next, on average, in 200 x 60 cells.
fn bytes_a_frame(depth: ColorDepth, tolerance: f32) -> usize {
    let economy = Economy { tolerance, ..Economy::NONE };
    let style = Style { depth, charset: Charset::Half, ..Style::PLAIN };
    let scene = builtin("marbles").expect("a built-in scene");
    let home = scene.first_view(style.picture_aspect(200, 60) as f32);
    let threads = Threads::default();
    let mut renderer = Renderer::new(Level::best(), &threads);
    let (mut all, mut bytes) = (0, Vec::new());
    for place in 0..PLACES {
        let mut encoder = Encoder::new();
        let start = TAU * f32::from(place) / f32::from(PLACES);
        for frame in 0..=FRAMES {
            let view = view::orbited(&home, start + STEP * frame as f32, 0.0);
            let search = draw::brute_force(&scene, &view);
            // As the viewer draws while something moves.
            let spending = Spending::AtMost(u64::MAX);
            let drawn = renderer.draw(&scene, &search, &view, &style, (200, 60), spending);
            bytes.clear();
            encoder.encode_part(&drawn.cells, economy, &mut bytes);
            all += if frame == 0 { 0 } else { bytes.len() };
        }
    }
    all / (usize::from(PLACES) * FRAMES)
}

#[test]
fn a_turning_picture_costs_no_more_bytes() {
    for (depth, tolerance, most) in [
        (ColorDepth::Ansi256, 0.0, 10_800),
        (ColorDepth::Truecolor, 0.0, 125_000),
        (ColorDepth::Truecolor, 0.01, 31_500),
    ] {
        let bytes = bytes_a_frame(depth, tolerance);
        let is_tight = bytes <= most && bytes > most * 9 / 10;
        assert!(is_tight, "{depth:?}, {tolerance}: {bytes} bytes of {most}");
    }
}
