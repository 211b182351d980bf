//! What a turning picture costs on the line, and how near it comes to the picture without economies:
//! `cargo run --release -p spherule-tests --example wire [FRAMES [SCENE]]`.
//!
//! 200 x 60 cells, a degree a frame, drawn as the viewer draws while something moves. Decibels measure distances in `OKLab`, pixel by pixel
//! of the two pictures, with the judge's own glyphs and colours. A PSNR is usually the mean over the three axes; that figure is 4.8 dB
//! more. The encoder's time is the median.

use spherule::cells::CellGrid;
use spherule::draw::{Renderer, Spending, brute_force};
use spherule::encode::{self, Economy, Encoder};
use spherule::scene::Scene;
use spherule::scene::builtin::builtin;
use spherule::style::{Charset, ColorDepth, Style};
use spherule::threads::Threads;
use spherule::view::orbited;
use spherule_kernel::Level;
use spherule_tests::art::figures::oklab;
use spherule_tests::art::font::Font;
use spherule_tests::art::light::Light;
use spherule_tests::art::palette::xterm;
use spherule_tests::art::screen::Screen;
use std::error::Error;
use std::time::Instant;

const SIZE: (u16, u16) = (200, 60);
const STEP: f32 = 1.0;

/// What a mode costs a frame, and how near its picture comes.
struct Cost {
    bytes: f64,
    milliseconds: f64,
    /// `None` if the pictures are equal.
    decibels: Option<f64>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let frames = words.next().map_or(Ok(72), |word| word.parse::<u16>())?;
    let scene = words.next().unwrap_or_else(|| "marbles".to_owned());
    let scene = builtin(&scene).ok_or("no such scene")?;
    println!("colours    tolerance  kB a frame      dB  encoder ms");
    for depth in [ColorDepth::Truecolor, ColorDepth::Ansi256, ColorDepth::Ansi16, ColorDepth::Never]
    {
        let charset = if depth == ColorDepth::Never { Charset::Ascii } else { Charset::Half };
        let grids = grids(&scene, &Style { depth, charset, ..Style::PLAIN }, frames);
        let tolerances: &[f32] = if depth == ColorDepth::Truecolor {
            &[0.0, 0.01, 0.015, 0.02, 0.03]
        } else {
            &[0.0, 0.01]
        };
        for &tolerance in tolerances {
            let Cost { bytes, milliseconds, decibels } = cost(&grids, tolerance)?;
            let decibels = decibels.map_or_else(|| "exact".to_owned(), |db| format!("{db:.1}"));
            let name = format!("{depth:?}");
            println!(
                "{name:10} {tolerance:9} {:11.1} {decibels:>7} {milliseconds:11.2}",
                bytes / 1e3
            );
        }
    }
    Ok(())
}

fn grids(scene: &Scene, style: &Style, frames: u16) -> Vec<CellGrid> {
    let threads = Threads::default();
    let mut renderer = Renderer::new(Level::best(), &threads);
    let home = scene.first_view(style.picture_aspect(SIZE.0, SIZE.1) as f32);
    let draw = |frame: u16| {
        let view = orbited(&home, f32::from(frame) * STEP.to_radians(), 0.0);
        let search = brute_force(scene, &view);
        let spending = Spending::AtMost(u64::MAX);
        renderer.draw(scene, &search, &view, style, SIZE, spending).cells
    };
    (0..=frames).map(draw).collect()
}

fn cost(grids: &[CellGrid], tolerance: f32) -> Result<Cost, Box<dyn Error>> {
    let economy = Economy { tolerance, ..Economy::NONE };
    let (mut encoder, mut out) = (Encoder::new(), Vec::new());
    let (mut bytes, mut times, mut squares, mut is_exact) = (0, Vec::new(), Vec::new(), true);
    for (frame, grid) in grids.iter().enumerate() {
        out.clear();
        let start = Instant::now();
        encoder.encode_part(grid, economy, &mut out);
        let time = start.elapsed().as_secs_f64() * 1e3;
        if frame == 0 {
            continue;
        }
        bytes += out.len();
        times.push(time);
        is_exact &= encoder.is_exact();
        // Only some frames are judged, since judging a picture takes longer than drawing it.
        if frame.is_multiple_of(8) {
            let shown = encoder.shown().ok_or("nothing is shown")?;
            squares.push(mean_square(&pixels(shown)?, &pixels(grid)?));
        }
    }
    times.sort_by(f64::total_cmp);
    let mean = squares.iter().sum::<f64>() / squares.len().max(1) as f64;
    Ok(Cost {
        bytes: bytes as f64 / times.len().max(1) as f64,
        milliseconds: times.get(times.len() / 2).copied().unwrap_or(0.0),
        decibels: (!is_exact).then(|| -10.0 * mean.max(1e-12).log10()),
    })
}

/// What a terminal shows of them, in `OKLab`.
fn pixels(grid: &CellGrid) -> Result<Vec<[f32; 3]>, Box<dyn Error>> {
    let mut bytes = Vec::new();
    encode::full(grid, &mut bytes);
    let screen = Screen::read(&bytes, SIZE.0, SIZE.1, &xterm())?;
    Ok(oklab(&Light::of_screen(&screen, Font::Unifont)?))
}

fn mean_square(a: &[[f32; 3]], b: &[[f32; 3]]) -> f64 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(&a, &b)| f64::from(a - b).powi(2)).sum::<f64>() / a.len() as f64
}
