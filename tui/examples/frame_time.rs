//! Milliseconds of CPU a frame of the built-in scenes, 200 x 60 cells in half blocks and
//! truecolor, 4 samples a cell, drawn and encoded in full, and their ratio to work that is known:
//! `cargo run --release -p spherule --example frame_time [FRAMES [SCENE [LEVEL [STRUCTURE]]]]`.
//!
//! A shared machine is slower than its CPU. So the clock is that of the thread, which stands while
//! others run, and a probe, the same work on every machine, is timed in turns with the frames: what
//! shares the core slows both. A quiet core takes the ratio times the least time of the probe.

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

/// Multiply-adds in chains, as many side by side as keep a core busy without wide registers.
const PROBE_CHAINS: usize = 32;
/// How long the chains are: 0.75 ms of an EPYC at 3.7 GHz.
const PROBE_STEPS: u32 = 400_000;

fn main() {
    let mut words = std::env::args().skip(1);
    let frames = words.next().and_then(|n| n.parse().ok()).unwrap_or(50_u32);
    let only = words.next();
    let named = |word: String| LevelName::ALL.into_iter().find(|name| name.as_str() == word);
    let level = words.next().and_then(named).and_then(Level::named).unwrap_or_else(Level::best);
    let structure = words.next().and_then(|name| Structure::from_str(&name, false).ok());
    println!("{}: medians of {frames} rounds in turns", level.name().as_str());
    for accuracy in Tier::ALL {
        for entry in BUILTINS {
            if only.as_ref().is_some_and(|name| name != entry.name) {
                continue;
            }
            time(entry.name, &(entry.scene)(), accuracy, level, structure, frames);
        }
    }
}

/// The work that is known.
fn probe() -> [f32; PROBE_CHAINS] {
    let (factor, addend) = (black_box(0.999_f32), black_box(0.5_f32));
    let mut chains = black_box([1.0_f32; PROBE_CHAINS]);
    for _ in 0..PROBE_STEPS {
        for x in &mut chains {
            *x = *x * factor + addend;
        }
    }
    chains
}

/// Milliseconds that this thread has had a CPU.
fn cpu_ms() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 * 1e3 + time.tv_nsec as f64 / 1e6
}

fn time(
    name: &str,
    scene: &Scene,
    accuracy: Tier,
    level: Level,
    structure: Auto<Structure>,
    frames: u32,
) {
    let style =
        Style { accuracy, charset: Charset::Half, depth: ColorDepth::Truecolor, ..Style::PLAIN };
    let mut view = scene.first_view(style.picture_aspect(200, 60) as f32);
    let threads = Threads::default();
    let mut structures = SceneStructures::new(scene.list(), &threads);
    let workload = picture_workload(scene.spheres().len(), &style, 200, 60, f64::INFINITY);
    let searched = choice::name(&structures.structure(structure, &workload));
    let (mut renderer, mut bytes) = (Renderer::new(level, &threads), Vec::new());
    let (mut draw, mut encoding, mut probes) = (Vec::new(), Vec::new(), Vec::new());
    let (mut sums, mut ratios, mut rays) = (Vec::new(), Vec::new(), 0);
    for _ in 0..frames.max(1) {
        view = view::orbited(&view, 0.02, 0.0);
        let start = cpu_ms();
        black_box(probe());
        let known = cpu_ms() - start;
        let start = cpu_ms();
        let search = structures.picture(structure, &workload, view.viewpoint(), &scene.lights);
        let search = search.expect("memory for a structure");
        let drawn = black_box(renderer.draw(scene, &search, &view, &style, 200, 60));
        let drawing = cpu_ms() - start;
        bytes.clear();
        encode::full(&drawn.cells, &mut bytes);
        black_box(&bytes);
        let both = cpu_ms() - start;
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
        "{name:8} {:6} {:5}: {both:.2} ms (least {:.2}; draw {draw:.2}, encode {encoding:.2}), probe \
         {known:.2} ms (least {:.2}), ratio {ratio:.2}: {:.2} ms on a quiet core; {rays} rays, {} bytes",
        accuracy.as_str(),
        searched,
        sums[0],
        probes[0],
        ratio * probes[0],
        bytes.len()
    );
}
