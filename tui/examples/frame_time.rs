//! Milliseconds of one core a frame of the built-in scenes, 200 x 60 cells in half blocks and
//! truecolor, 4 samples a cell, drawn and encoded in full, and their ratio to work that is known:
//! `cargo run --release -p spherule-tui --example frame_time [FRAMES [SCENE [LEVEL]]]`.
//!
//! A shared machine is slower than its CPU. The probe, timed in turns with the frames, is as many
//! dependent multiply-adds as take [`PROBE_MS`] on a quiet core of 2.9 GHz; so what a quiet core
//! takes for a frame is the ratio times that.

use spherule_kernel::dispatch::{Level, LevelName};
use spherule_tui::draw::{AccuracyChoice, Charset, ColorDepth, Renderer, Style, picture_aspect};
use spherule_tui::scene::{Scene, builtin::BUILTINS};
use spherule_tui::{encode, view};
use std::hint::black_box;
use std::time::Instant;

/// Multiplications and additions, each waiting for the last: 4 cycles of latency each.
const PROBE_STEPS: u32 = 362_500;
/// 2 x 4 cycles a step at 2.9 GHz.
const PROBE_MS: f64 = 1.0;

fn main() {
    let mut words = std::env::args().skip(1);
    let frames = words.next().and_then(|n| n.parse().ok()).unwrap_or(50_u32);
    let only = words.next();
    let named = |word: String| LevelName::ALL.into_iter().find(|name| name.as_str() == word);
    let level = words.next().and_then(named).and_then(Level::named).unwrap_or_else(Level::best);
    println!("{}: medians of {frames} rounds in turns", level.name().as_str());
    for accuracy in AccuracyChoice::ALL {
        for entry in BUILTINS {
            if only.as_ref().is_some_and(|name| name != entry.name) {
                continue;
            }
            let frames = if entry.name == "flake" { frames.div_ceil(10) } else { frames };
            time(entry.name, &(entry.scene)(), accuracy, level, frames);
        }
    }
}

/// The work that is known.
fn probe() -> f32 {
    let (factor, addend) = (black_box(0.999_f32), black_box(0.5_f32));
    let mut x = black_box(1.0_f32);
    for _ in 0..PROBE_STEPS {
        x = x * factor + addend;
    }
    x
}

fn time(name: &str, scene: &Scene, accuracy: AccuracyChoice, level: Level, frames: u32) {
    let style = Style {
        accuracy,
        charset: Charset::Half,
        depth: ColorDepth::Truecolor,
        samples: 4,
        cell_aspect: 0.5,
    };
    let mut view = scene.first_view(picture_aspect(&style, 200, 60) as f32);
    let (mut renderer, mut bytes) = (Renderer::new(level), Vec::new());
    let (mut draw, mut encoding, mut probes) = (Vec::new(), Vec::new(), Vec::new());
    let (mut sums, mut ratios, mut rays) = (Vec::new(), Vec::new(), 0);
    for _ in 0..frames.max(1) {
        view = view::orbited(&view, 0.02, 0.0);
        let start = Instant::now();
        black_box(probe());
        let known = start.elapsed().as_secs_f64() * 1e3;
        let start = Instant::now();
        let drawn = black_box(renderer.draw(scene, &view, &style, 200, 60));
        let drawing = start.elapsed().as_secs_f64() * 1e3;
        bytes.clear();
        encode::full(&drawn.cells, &mut bytes);
        black_box(&bytes);
        let both = start.elapsed().as_secs_f64() * 1e3;
        probes.push(known);
        draw.push(drawing);
        encoding.push(both - drawing);
        sums.push(both);
        ratios.push(both / known);
        rays = drawn.rays;
    }
    let median = |list: &mut Vec<f64>| {
        list.sort_by(f64::total_cmp);
        list[list.len() / 2]
    };
    let (draw, encoding, known) = (median(&mut draw), median(&mut encoding), median(&mut probes));
    let (both, ratio) = (median(&mut sums), median(&mut ratios));
    println!(
        "{name:8} {:6}: {both:6.2} ms (least {:5.2}; draw {draw:.2}, encode {encoding:.2}), probe \
         {known:.2} ms, ratio {ratio:.2}: {:.2} ms on a quiet core; {rays} rays, {} bytes",
        accuracy.as_str(),
        sums[0],
        ratio * PROBE_MS,
        bytes.len()
    );
}
