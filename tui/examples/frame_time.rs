//! Milliseconds per frame of the built-in scenes: 200 x 60 cells in truecolor, samples by need, drawn and encoded in
//! full. Half blocks are drawn by every tier, and every other charset by the exact one:
//! `cargo run --release -p spherule --example frame_time [FRAMES [SCENE [LEVEL [STRUCTURE [CHARS]]]]]`. With CHARS,
//! only that character set is drawn.
//!
//! The first figure is CPU time by the clock of a single thread, which stands while others run; the least time is that
//! of a quiet core. The second is the time that passes if all threads draw.

use clap::ValueEnum;
use rustix::time::{ClockId, clock_gettime};
use spherule::choice::{self, Auto};
use spherule::draw::{Effort, Renderer, Spending, picture_workload};
use spherule::scene::{Scene, builtin::BUILTINS};
use spherule::structure::Structure;
use spherule::structure::scene::SceneStructures;
use spherule::style::{Charset, ColorDepth, Style};
use spherule::threads::Threads;
use spherule::{encode, view};
use spherule_kernel::{Level, LevelName, Tier};
use std::hint::black_box;
use std::time::Instant;

fn main() {
    let mut words = std::env::args().skip(1);
    let frames = words.next().and_then(|n| n.parse().ok()).unwrap_or(50_u32);
    let only = words.next();
    let named = |word: String| LevelName::ALL.into_iter().find(|name| name.as_str() == word);
    let level = words.next().and_then(named).and_then(Level::named).unwrap_or_else(Level::best);
    let structure = words.next().and_then(|name| Structure::from_str(&name, false).ok());
    let chars = words.next().and_then(|name| Charset::from_str(&name, false).ok());
    println!("{}: medians of {frames} frames", level.name().as_str());
    let tiers = Tier::ALL.map(|tier| (tier, Charset::Half));
    let others = Charset::value_variants().iter().filter(|&&charset| charset != Charset::Half);
    let exact = others.map(|&charset| (Tier::Exact, charset));
    let is_asked = |&(_, charset): &(Tier, Charset)| chars.is_none_or(|chars| chars == charset);
    for (accuracy, charset) in tiers.into_iter().chain(exact).filter(is_asked) {
        for entry in BUILTINS {
            if only.as_ref().is_none_or(|name| name == entry.name) {
                print!("{:8} {:9} {:8} ", entry.name, accuracy.as_str(), choice::name(&charset));
                let depth = ColorDepth::Truecolor;
                let style = Style { accuracy, charset, depth, ..Style::PLAIN };
                time(&(entry.scene)(), &style, level, structure, frames);
            }
        }
    }
}

/// CPU time of this thread in milliseconds.
fn cpu_ms() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 * 1e3 + time.tv_nsec as f64 / 1e6
}

fn time(scene: &Scene, style: &Style, level: Level, structure: Auto<Structure>, frames: u32) {
    let size = (200, 60);
    let mut view = scene.first_view(style.picture_aspect(size.0, size.1) as f32);
    let threads = Threads::default();
    let mut structures = SceneStructures::new(scene.list(), &threads);
    let workload = picture_workload(scene.list().len(), style, size.0, size.1, f64::INFINITY);
    let searched = choice::name(&structures.structure(structure, &workload));
    let all_threads = Threads::new(None).expect("threads");
    let mut renderer = Renderer::new(level, &threads);
    let mut on_all = Renderer::new(level, &all_threads);
    let (mut bytes, mut effort) = (Vec::new(), Effort::NONE);
    let (mut draw, mut encoding, mut sums, mut passed) = (vec![], vec![], vec![], vec![]);
    for _ in 0..frames.max(1) {
        view = view::orbited(&view, 0.02, 0.0);
        let start = cpu_ms();
        let search = structures.picture(structure, &workload, &view, scene);
        let search = search.expect("memory for a structure");
        let drawn = black_box(renderer.draw(scene, &search, &view, style, size, Spending::ByNeed));
        let drawing = cpu_ms() - start;
        bytes.clear();
        encode::full(&drawn.cells, &mut bytes);
        black_box(&bytes);
        let both = cpu_ms() - start;
        draw.push(drawing);
        encoding.push(both - drawing);
        sums.push(both);
        effort = drawn.effort;
        let start = Instant::now();
        black_box(on_all.draw(scene, &search, &view, style, size, Spending::ByNeed));
        passed.push(start.elapsed().as_secs_f64() * 1e3);
    }
    let [draw, encoding, both, passed] =
        [&mut draw, &mut encoding, &mut sums, &mut passed].map(|list| {
            list.sort_by(f64::total_cmp);
            list[list.len() / 2]
        });
    println!(
        "{searched:10}: {both:.2} ms (least {:.2}; draw {draw:.2}, encode {encoding:.2}), drawn by {} \
         threads in {passed:.2} ms, {} samples, {} rays, {} bytes",
        sums[0],
        all_threads.count(),
        effort.samples,
        effort.rays,
        bytes.len()
    );
}
