//! Frames per second in pixels of the built-in scenes in motion, drawn and encoded by each protocol:
//! `cargo run --release -p spherule --example pixel_rate [FRAMES [WIDTHxHEIGHT]]`.
//! Pictures have 960x640 pixels unless said otherwise, in cells of 8x16.

use spherule::draw::pixels::PixelGrid;
use spherule::draw::{Renderer, picture_workload};
use spherule::pixels::Protocol;
use spherule::scene::builtin::BUILTINS;
use spherule::structure::scene::SceneStructures;
use spherule::style::Style;
use spherule::threads::Threads;
use spherule::view;
use spherule_kernel::{Level, Tier};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let frames = words.next().map_or(Ok(30), |word| word.parse::<u32>())?;
    let size = words.next().unwrap_or_else(|| "960x640".to_owned());
    let (width, height) = size.split_once('x').ok_or("WIDTHxHEIGHT")?;
    let cells = (width.parse::<u16>()? / 8, height.parse::<u16>()? / 16);
    let threads = Threads::new(None).map_err(|error| format!("{error:?}"))?;
    println!("{} threads, medians of {frames} frames", threads.count());
    println!(
        "scene     rays a pixel  draw ms   kitty ms (MB)   sixel ms (MB)  iterm2 ms (MB)  frames a second by kitty"
    );
    let style = Style { accuracy: Tier::Exact, ..Style::PLAIN };
    for entry in BUILTINS {
        let scene = (entry.scene)();
        for across in [1, 2, 4] {
            let home = scene.first_view(style.picture_aspect(cells.0, cells.1) as f32);
            let mut structures = SceneStructures::new(scene.list(), &threads);
            let workload =
                picture_workload(scene.list().len(), &style, cells.0, cells.1, f64::INFINITY);
            let renderer = Renderer::new(Level::best(), &threads);
            let protocols = [
                Protocol::Kitty { through_tmux: false },
                Protocol::Sixel { colors: 256 },
                Protocol::Iterm2,
            ];
            let (mut drawing, mut encoding, mut bytes) = (vec![], [vec![], vec![], vec![]], [0; 3]);
            for frame in 0..frames {
                let view = view::orbited(&home, 0.02 * frame as f32, 0.0);
                let search = structures.picture(None, &workload, &view, &scene);
                let search = search.map_err(|error| format!("{error:?}"))?;
                let start = Instant::now();
                let grid = PixelGrid::in_cells(&view, &style, cells, (8, 16), across);
                let image = renderer.draw_image(&scene, &search, style.accuracy, &grid);
                drawing.push(start.elapsed().as_secs_f64() * 1e3);
                for (index, protocol) in protocols.into_iter().enumerate() {
                    let (start, mut out) = (Instant::now(), Vec::new());
                    protocol.write(&image, cells, frame, &mut out);
                    encoding[index].push(start.elapsed().as_secs_f64() * 1e3);
                    bytes[index] = out.len();
                }
            }
            let median = |times: &mut Vec<f64>| {
                times.sort_by(f64::total_cmp);
                times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
            };
            let drawing = median(&mut drawing);
            print!("{:9} {:12} {drawing:8.1}", entry.name, across * across);
            let kitty = median(&mut encoding[0]);
            for (times, bytes) in encoding.iter_mut().zip(bytes) {
                print!(" {:8.1} ({:.2})", median(times), bytes as f64 / 1e6);
            }
            println!("  {:6.1}", 1e3 / (drawing + kitty));
        }
    }
    Ok(())
}
