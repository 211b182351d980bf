//! Milliseconds of an error map, compared with a frame of `Exact` of as many samples; and of a frame split between
//! `Fast` and `Exact`, compared with the mean of both whole frames. 200 x 60 cells in truecolor, on all threads, in
//! turns:
//! `cargo run --release -p spherule --example compare_time [FRAMES]`.

use spherule::compare::error_map::ErrorMapper;
use spherule::compare::legend::MapPainter;
use spherule::compare::split::Split;
use spherule::draw::{Renderer, Spending, picture_workload};
use spherule::scene::builtin::BUILTINS;
use spherule::structure::scene::SceneStructures;
use spherule::style::{Charset, ColorDepth, Style};
use spherule::threads::Threads;
use spherule_kernel::{Level, Tier};
use std::hint::black_box;
use std::time::Instant;

fn main() {
    let frames = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(51_u32);
    let (size, level) = ((200, 60), Level::best());
    let threads = Threads::new(None).expect("threads");
    for entry in BUILTINS {
        let scene = (entry.scene)();
        let exact = Style {
            accuracy: Tier::Exact,
            charset: Charset::Half,
            depth: ColorDepth::Truecolor,
            samples: Some(4),
            ..Style::PLAIN
        };
        let fast = Style { accuracy: Tier::Fast, ..exact };
        let view = scene.first_view(exact.picture_aspect(size.0, size.1) as f32);
        let workload =
            picture_workload(scene.spheres().len(), &exact, size.0, size.1, f64::INFINITY);
        let mut structures = SceneStructures::new(scene.list(), &threads);
        let search = structures.picture(None, &workload, &view, &scene);
        let search = search.expect("memory for a structure");
        let mut renderer = Renderer::new(level, &threads);
        let mut mapper = ErrorMapper::default();
        let (mut frame, mut map, mut fast_frame, mut split) = (vec![], vec![], vec![], vec![]);
        for _ in 0..frames.max(1) {
            let start = Instant::now();
            black_box(renderer.draw(&scene, &search, &view, &exact, size, Spending::ByNeed));
            frame.push(start.elapsed().as_secs_f64() * 1e3);
            let start = Instant::now();
            let machine = (level, &threads);
            let errors = mapper.map((&scene, &search), &view, &fast, size, machine, |_| {});
            black_box(MapPainter::new(&fast).cells(&errors, 0..size.1));
            map.push(start.elapsed().as_secs_f64() * 1e3);
            let start = Instant::now();
            black_box(renderer.draw(&scene, &search, &view, &fast, size, Spending::ByNeed));
            fast_frame.push(start.elapsed().as_secs_f64() * 1e3);
            let halves = Split { tiers: [Tier::Fast, Tier::Exact], seam: size.0 / 2 };
            let (seen, need) = ((&scene, &search), Spending::ByNeed);
            let start = Instant::now();
            black_box(halves.draw(&mut renderer, seen, &view, &exact, size, need));
            split.push(start.elapsed().as_secs_f64() * 1e3);
        }
        let [frame, map, fast_frame, split] = [frame, map, fast_frame, split].map(|mut times| {
            times.sort_by(f64::total_cmp);
            times[times.len() / 2]
        });
        let mean = (frame + fast_frame) / 2.0;
        println!(
            "{:8} frame {frame:.2} ms, error map {map:.2} ms: {:.2}; mean of halves {mean:.2} ms, split \
             {split:.2} ms: {:.2}",
            entry.name,
            map / frame,
            split / mean
        );
    }
}
