//! How near the program's pictures come to the truth, beside chafa's of the same picture.
//!
//! ```text
//! cargo run --release -p spherule-tests --example art                # prints a summary of pictures at rest
//! ... -- --only block --scene caffeine                               # of some modes and scenes
//! ... -- --only ascii --font unifont --sheets FOLDER                 # and writes truth, ours and chafa's side by side
//! ... -- --motion                                                    # and in motion
//! ... -- --write                                                     # all, and writes docs/benchmarks/art.md
//! ... -- --pictures                                                  # writes the README's pictures, tui/pictures
//! ```
//!
//! Earlier results are kept under `target/art`; nothing there is needed.
#![forbid(unsafe_code)]

mod cache;
mod cells;
mod chafa;
mod image;
mod modes;
mod motion;
mod page;
mod row;
mod still;
mod subject;
mod summary;

use cache::Cache;
use chafa::Chafa;
use clap::Parser;
use modes::{MODES, Mode, SCENES};
use motion::Orbit;
use row::Row;
use spherule_tests::art::figures::READING;
use spherule_tests::art::font::Font;
use std::error::Error;
use std::fs;
use std::path::PathBuf;
use still::Judge;
use subject::Subject;

/// Scores pictures in cells.
#[derive(Parser)]
struct Arguments {
    /// These modes alone, by their names
    #[arg(long, num_args = 1.., value_delimiter = ',', value_parser = MODES.map(|mode| mode.name))]
    only: Vec<String>,
    /// These scenes alone
    #[arg(long, num_args = 1.., value_delimiter = ',', value_parser = SCENES)]
    scene: Vec<String>,
    /// These fonts alone, of modes that have letters
    #[arg(long, num_args = 1.., value_delimiter = ',', value_parser = Font::ALL.map(Font::word))]
    font: Vec<String>,
    /// Pixels a degree of the eye's field, for FLIP: 38 from 60 cm
    #[arg(long, default_value_t = READING)]
    pixels_a_degree: f32,
    /// Also in motion: it takes longer
    #[arg(long)]
    motion: bool,
    /// Writes truth, ours and chafa's side by side into this folder, a PNG for every mode, scene and font
    #[arg(long)]
    sheets: Option<PathBuf>,
    /// Judges everything, and writes docs/benchmarks/art.md
    #[arg(long, conflicts_with_all = ["only", "scene", "font", "pixels_a_degree"])]
    write: bool,
    /// Writes the README's pictures, and no scores
    #[arg(long, conflicts_with = "write")]
    pictures: bool,
}

/// Whether `name` is among those asked for. If none is asked for, all are.
fn is_asked(asked: &[String], name: &str) -> bool {
    asked.is_empty() || asked.iter().any(|asked| asked == name)
}

impl Arguments {
    fn fonts(&self, mode: &Mode) -> Vec<Font> {
        let is_asked = |font: &Font| !mode.is_text || is_asked(&self.font, font.word());
        mode.fonts().iter().copied().filter(is_asked).collect()
    }

    /// One line for each mode and font, without scores.
    fn rows(&self) -> Vec<Row> {
        let modes = MODES.iter().filter(|mode| is_asked(&self.only, mode.name));
        let rows = modes.flat_map(|&mode| {
            let row = move |font| Row { mode, font, scores: Vec::new(), unrest: Vec::new() };
            self.fonts(&mode).into_iter().map(row)
        });
        rows.collect()
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    if arguments.pictures {
        return cells::write();
    }
    let (cache, chafa) = (Cache::new()?, Chafa::find());
    let sheets = arguments.sheets.as_deref();
    sheets.map_or(Ok(()), fs::create_dir_all)?;
    let scenes: Vec<_> =
        SCENES.into_iter().filter(|name| is_asked(&arguments.scene, name)).collect();
    let mut rows = arguments.rows();
    for (place, name) in SCENES.into_iter().enumerate() {
        if !scenes.contains(&name) {
            continue;
        }
        let subject = Subject::open(name)?;
        let judge = Judge::new(&subject, arguments.pixels_a_degree, &cache, chafa.as_ref())?;
        let mut orbit = (arguments.motion || arguments.write)
            .then(|| Orbit::new(&subject, &cache, chafa.as_ref()))
            .transpose()?;
        // The fonts of a mode share its pictures.
        for rows in rows.chunk_by_mut(|a, b| a.mode.name == b.mode.name) {
            let (mode, fonts) = (rows[0].mode, rows.iter().map(|row| row.font).collect::<Vec<_>>());
            let named = |error| format!("{} of {name}: {error}", mode.name);
            let scores = judge.scores(&mode, &fonts, sheets).map_err(named)?;
            let unrest = match &mut orbit {
                Some(orbit) => orbit.unrest(&mode, &fonts).map_err(named)?,
                None => Vec::new(),
            };
            for (row, score) in rows.iter_mut().zip(scores) {
                row.scores.push((place, score));
            }
            for (row, unrest) in rows.iter_mut().zip(unrest) {
                row.unrest.push((place, unrest));
            }
        }
    }
    println!("{}", summary::summary(&rows, &scenes));
    if arguments.write {
        let version = chafa.as_ref().map(|chafa| chafa.version.as_str());
        let page = page::page(&rows, version);
        fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/benchmarks/art.md"), page)?;
    }
    Ok(())
}
