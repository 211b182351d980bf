//! How near the program's pictures come to the truth, beside chafa's of the same picture.
//!
//! ```text
//! cargo run --release -p spherule-tests --example art             # prints the page
//! cargo run --release -p spherule-tests --example art -- --write  # and writes docs/benchmarks/art.md
//! cargo run --release -p spherule-tests --example art -- --pictures # writes the README's pictures, tui/pictures
//! ```
#![forbid(unsafe_code)]

mod cells;
mod modes;
mod page;
mod pictures;

use clap::Parser;
use modes::{MODES, SCENES};
use page::Row;
use pictures::Folder;
use spherule_tests::art::figures::Truth;
use spherule_tests::art::light::Light;
use std::error::Error;
use std::fs;

/// Scores pictures in cells.
#[derive(Parser)]
struct Arguments {
    /// Writes docs/benchmarks/art.md.
    #[arg(long)]
    write: bool,
    /// Writes the README's pictures, and no scores.
    #[arg(long, conflicts_with = "write")]
    pictures: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let Arguments { write, pictures } = Arguments::parse();
    if pictures {
        return cells::write();
    }
    let folder = Folder::new()?;
    let chafa = pictures::chafa_version();
    let mut rows: Vec<Row> = MODES.iter().map(|mode| Row { mode, scores: Vec::new() }).collect();
    for scene in SCENES {
        let png = folder.truth(scene)?;
        let truth = Truth::new(&Light::read_png(&png)?)?;
        for row in &mut rows {
            row.scores.push(pictures::scores(scene, &png, &truth, row.mode, chafa.is_some())?);
        }
    }
    let page = page::page(&rows, chafa.as_deref());
    println!("{page}");
    if write {
        fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/benchmarks/art.md"), page)?;
    }
    Ok(())
}
