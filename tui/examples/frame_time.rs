//! Milliseconds a frame of the built-in scenes, 200 x 60 cells, 4 samples a cell, drawn and
//! encoded in full: `cargo run --release -p spherule-tui --example frame_time [FRAMES [SCENE]]`.
//! Wall-clock times, so on a busy machine look at the least.

use spherule_tui::draw::{AccuracyChoice, Charset, ColorDepth, Renderer, Style, picture_aspect};
use spherule_tui::scene::builtin::BUILTINS;
use spherule_tui::{encode, view};
use std::hint::black_box;
use std::time::Instant;

fn main() {
    let frames = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(50_u32);
    let only = std::env::args().nth(2);
    for accuracy in [AccuracyChoice::Fast, AccuracyChoice::Stable] {
        for entry in BUILTINS {
            if only.as_ref().is_some_and(|name| name != entry.name) {
                continue;
            }
            let frames = if entry.name == "flake" { frames.div_ceil(10) } else { frames };
            time(entry.name, &(entry.scene)(), accuracy, frames);
        }
    }
}

fn time(name: &str, scene: &spherule_tui::scene::Scene, accuracy: AccuracyChoice, frames: u32) {
    let style = Style {
        accuracy,
        charset: Charset::Half,
        depth: ColorDepth::Truecolor,
        samples: 4,
        cell_aspect: 0.5,
    };
    let mut view = scene.first_view(picture_aspect(&style, 200, 60) as f32);
    let (mut renderer, mut bytes) = (Renderer::new(), Vec::new());
    let (mut draw, mut encoding, mut rays) = (Vec::new(), Vec::new(), 0);
    for _ in 0..frames.max(1) {
        view = view::orbited(&view, 0.02, 0.0);
        let start = Instant::now();
        let drawn = black_box(renderer.draw(scene, &view, &style, 200, 60));
        let middle = Instant::now();
        bytes.clear();
        encode::full(&drawn.cells, &mut bytes);
        black_box(&bytes);
        draw.push((middle - start).as_secs_f64() * 1e3);
        encoding.push(middle.elapsed().as_secs_f64() * 1e3);
        rays = drawn.rays;
    }
    // The least is what a quiet core takes, the median what this one took.
    let least_and_median = |list: &mut Vec<f64>| {
        list.sort_by(f64::total_cmp);
        format!("{:.2} ({:.2})", list[0], list[list.len() / 2])
    };
    println!(
        "{name:8} {accuracy:?}: least (median) ms: draw {}, encode {}; {rays} rays, {} bytes",
        least_and_median(&mut draw),
        least_and_median(&mut encoding),
        bytes.len()
    );
}
