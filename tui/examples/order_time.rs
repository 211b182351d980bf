//! How long object order takes beside image order by a depth list, for built-in scenes in 200 x 60 cells, samples by
//! need, one thread: `cargo run --release -p spherule --example order_time [ROUNDS [SCENE]]`.
//!
//! It prints medians of the ratios of frames drawn in turns: of whole pictures, and of the same scenes without lights,
//! where the search for spheres takes nearly all of the time.

use rustix::time::{ClockId, clock_gettime};
use spherule::draw::{Renderer, Spending, picture_workload};
use spherule::scene::{Lighting, Scene, builtin::BUILTINS};
use spherule::structure::scene::SceneStructures;
use spherule::structure::{Order, Structure};
use spherule::style::{Charset, ColorDepth, Style};
use spherule::threads::Threads;
use spherule::view::orbited;
use spherule_kernel::{Level, Tier};

fn main() {
    let mut words = std::env::args().skip(1);
    let rounds = words.next().and_then(|n| n.parse().ok()).unwrap_or(11_u32);
    let only = words.next();
    for entry in BUILTINS {
        if only.as_ref().is_some_and(|name| name != entry.name) {
            continue;
        }
        for accuracy in Tier::ALL {
            let mut scene = (entry.scene)();
            let lit = ratio(&scene, accuracy, rounds);
            scene.lighting = Lighting::default();
            let plain = ratio(&scene, accuracy, rounds);
            let [lit, plain] = [lit, plain].map(|(ms, ratio)| format!("{ms:7.2} ms, {ratio:5.2}"));
            println!("{:8} {:6}: {lit}; without lights {plain}", entry.name, accuracy.as_str());
        }
    }
}

/// CPU time of this thread in milliseconds.
fn cpu_ms() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 * 1e3 + time.tv_nsec as f64 / 1e6
}

/// The milliseconds of a picture in object order, and their ratio to those of a picture with a depth list.
fn ratio(scene: &Scene, accuracy: Tier, rounds: u32) -> (f64, f64) {
    let (columns, rows) = (200, 60);
    let (charset, depth) = (Charset::Half, ColorDepth::Truecolor);
    let style = Style { accuracy, charset, depth, ..Style::PLAIN };
    let mut view = scene.first_view(style.picture_aspect(columns, rows) as f32);
    let threads = Threads::default();
    let workload = picture_workload(scene.list().len(), &style, columns, rows, f64::INFINITY);
    let mut renderer = Renderer::new(Level::best(), &threads);
    let mut structures = [Order::Image, Order::Object]
        .map(|order| SceneStructures::new(scene.list(), &threads).in_order(order));
    let (mut times, mut ratios) = (Vec::new(), Vec::new());
    for _ in 0..rounds.max(1) {
        view = orbited(&view, 0.02, 0.0);
        let [image, object] = structures.each_mut().map(|structures| {
            let start = cpu_ms();
            let choice = Some(Structure::DepthList);
            let search = structures.picture(choice, &workload, &view, scene);
            let search = search.expect("memory for a structure");
            let size = (columns, rows);
            let drawn = renderer.draw(scene, &search, &view, &style, size, Spending::ByNeed);
            (cpu_ms() - start, drawn.cells)
        });
        assert!(
            matches!(accuracy, Tier::Fast | Tier::Geometric) || image.1 == object.1,
            "the same picture"
        );
        times.push(object.0);
        ratios.push(object.0 / image.0);
    }
    for list in [&mut times, &mut ratios] {
        list.sort_by(f64::total_cmp);
    }
    (times[times.len() / 2], ratios[ratios.len() / 2])
}
