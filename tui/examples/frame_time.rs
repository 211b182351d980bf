//! Milliseconds of CPU a frame of the built-in scenes, 200 x 60 cells in half blocks and truecolor, 4
//! samples a cell, drawn and encoded in full:
//! `cargo run --release -p spherule --example frame_time [FRAMES [SCENE [LEVEL [STRUCTURE]]]]`.
//!
//! By the thread's own clock, which stands while others run; the least time is that of a quiet core.

use clap::ValueEnum;
use rustix::time::{ClockId, clock_gettime};
use spherule::choice::{self, Auto};
use spherule::draw::{Renderer, picture_workload};
use spherule::scene::{Scene, builtin::BUILTINS};
use spherule::structure::Structure;
use spherule::structure::scene::SceneStructures;
use spherule::style::{Charset, ColorDepth, Style};
use spherule::threads::Threads;
use spherule::{encode, view};
use spherule_kernel::{Level, LevelName, Tier};
use std::hint::black_box;

fn main() {
    let mut words = std::env::args().skip(1);
    let frames = words.next().and_then(|n| n.parse().ok()).unwrap_or(50_u32);
    let only = words.next();
    let named = |word: String| LevelName::ALL.into_iter().find(|name| name.as_str() == word);
    let level = words.next().and_then(named).and_then(Level::named).unwrap_or_else(Level::best);
    let structure = words.next().and_then(|name| Structure::from_str(&name, false).ok());
    println!("{}: medians of {frames} frames", level.name().as_str());
    for tier in Tier::ALL {
        for entry in BUILTINS {
            if only.as_ref().is_none_or(|name| name == entry.name) {
                print!("{:8} {:6} ", entry.name, tier.as_str());
                time(&(entry.scene)(), tier, level, structure, frames);
            }
        }
    }
}

/// Milliseconds that this thread has had a CPU.
fn cpu_ms() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 * 1e3 + time.tv_nsec as f64 / 1e6
}

fn time(scene: &Scene, accuracy: Tier, level: Level, structure: Auto<Structure>, frames: u32) {
    let depth = ColorDepth::Truecolor;
    let style = Style { accuracy, charset: Charset::Half, depth, ..Style::PLAIN };
    let mut view = scene.first_view(style.picture_aspect(200, 60) as f32);
    let threads = Threads::default();
    let mut structures = SceneStructures::new(scene.list(), &threads);
    let workload = picture_workload(scene.list().len(), &style, 200, 60, f64::INFINITY);
    let searched = choice::name(&structures.structure(structure, &workload));
    let (mut renderer, mut bytes) = (Renderer::new(level, &threads), Vec::new());
    let (mut draw, mut encoding, mut sums, mut rays) = (Vec::new(), Vec::new(), Vec::new(), 0);
    for _ in 0..frames.max(1) {
        view = view::orbited(&view, 0.02, 0.0);
        let start = cpu_ms();
        let search = structures.picture(structure, &workload, &view, &scene.lighting);
        let search = search.expect("memory for a structure");
        let drawn = black_box(renderer.draw(scene, &search, &view, &style, 200, 60));
        let drawing = cpu_ms() - start;
        bytes.clear();
        encode::full(&drawn.cells, &mut bytes);
        black_box(&bytes);
        let both = cpu_ms() - start;
        draw.push(drawing);
        encoding.push(both - drawing);
        sums.push(both);
        rays = drawn.rays;
    }
    let [draw, encoding, both] = [&mut draw, &mut encoding, &mut sums].map(|list| {
        list.sort_by(f64::total_cmp);
        list[list.len() / 2]
    });
    println!(
        "{searched:10}: {both:.2} ms (least {:.2}; draw {draw:.2}, encode {encoding:.2}), {rays} \
         rays, {} bytes",
        sums[0],
        bytes.len()
    );
}
