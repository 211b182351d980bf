//! Runs one recipe in Rust: SPHERES RAYS T. Prints the seconds that it took, the fewest of nine runs.

use npyz::{NpyFile, WriterBuilder};
use std::error::Error;
use std::fs::File;
use std::hint::black_box;
use std::io::{BufReader, BufWriter};
use std::time::{Duration, Instant};

const TIMES: usize = 9;

/// Writes `answer` for every sphere (centre, radius) and its ray (origin, direction, t_min, t_max); +inf for `None`.
pub fn answers_of(
    answer: impl Fn([f32; 4], [f32; 8]) -> Option<f32>,
) -> Result<(), Box<dyn Error>> {
    let paths: Vec<String> = std::env::args().skip(1).collect();
    let [spheres, rays, t] = &paths[..] else { return Err("SPHERES RAYS T".into()) };
    let (spheres, rays) = (rows(spheres)?, rows(rays)?);
    let mut answers = vec![f32::INFINITY; rays.len()];
    let mut fewest = Duration::MAX;
    for _ in 0..TIMES {
        let start = Instant::now();
        for ((t, sphere), ray) in answers.iter_mut().zip(&spheres).zip(&rays) {
            *t = answer(*sphere, *ray).unwrap_or(f32::INFINITY);
        }
        fewest = fewest.min(start.elapsed());
        black_box(&mut answers);
    }
    let options = npyz::WriteOptions::new().default_dtype().shape(&[answers.len() as u64]);
    let mut file = options.writer(BufWriter::new(File::create(t)?)).begin_nd()?;
    file.extend(answers)?;
    file.finish()?;
    println!("{}", fewest.as_secs_f64());
    Ok(())
}

fn rows<const WIDTH: usize>(path: &str) -> Result<Vec<[f32; WIDTH]>, Box<dyn Error>> {
    let numbers: Vec<f32> = NpyFile::new(BufReader::new(File::open(path)?))?.into_vec()?;
    Ok(numbers.as_chunks().0.to_vec())
}
