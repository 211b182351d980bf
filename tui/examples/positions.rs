//! What the program reads of a file, and how fast, for comparison with other readers.
//!
//! `positions FILE [FRAME [TOPOLOGY]]` writes x, y, z of every sphere to standard output, as little-endian `float32`.
//! `positions --time FILE` reads all frames and prints bytes, frames, spheres and seconds; the file is read once before.

use spherule::scene::file_name::FileName;
use spherule::scene::open::{Opened, open};
use spherule::scene::reading::Reading;
use std::error::Error;
use std::ffi::OsString;
use std::io::{Write, stdout};
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["--time", file] => time(file),
        [file] => write(file, 0, None),
        [file, frame] => write(file, frame.parse()?, None),
        [file, frame, topology] => {
            write(file, frame.parse()?, Some(FileName::from(OsString::from(*topology))))
        }
        _ => Err("positions FILE [FRAME [TOPOLOGY]], or positions --time FILE".into()),
    }
}

fn write(file: &str, frame: usize, topology: Option<FileName>) -> Result<(), Box<dyn Error>> {
    let reading = Reading { topology, ..Reading::default() };
    let scene = match open(file, &reading)? {
        Opened::Builtin(scene) => scene,
        Opened::File(mut frames) => {
            let scene = frames.read(frame)?.ok_or("no such frame")?;
            frames.report();
            scene
        }
    };
    let mut bytes = Vec::new();
    for sphere in scene.spheres().iter() {
        bytes.extend(sphere.center.to_array().into_iter().flat_map(f32::to_le_bytes));
    }
    Ok(stdout().write_all(&bytes)?)
}

fn time(file: &str) -> Result<(), Box<dyn Error>> {
    let bytes = std::fs::read(file)?.len();
    let start = Instant::now();
    let Opened::File(mut frames) = open(file, &Reading::default())? else {
        return Err("a built-in scene".into());
    };
    let (mut count, mut spheres) = (0, 0);
    while let Some(scene) = frames.read(count)? {
        count += 1;
        spheres += scene.spheres().len();
    }
    let seconds = start.elapsed().as_secs_f64();
    let speed = bytes as f64 / 1e6 / seconds;
    println!(
        "bytes={bytes} frames={count} spheres={spheres} seconds={seconds:.3} mb_per_s={speed:.1}"
    );
    Ok(())
}
