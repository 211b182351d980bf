//! The command line of the reports, and where they are written.

use crate::measure::Effort;
use crate::page::{self, build, origin};
use crate::{calls, cameras, errors, lists, orders, plot, scales, structures, surfaces};
use clap::builder::PossibleValuesParser;
use clap::{Parser, ValueEnum};
use spherule_tests::orders::Order;
use spherule_tests::scenes::{LARGE, SPREAD};
use std::path::Path;
use std::{error, fs};

#[derive(Parser)]
struct Arguments {
    /// What is measured; all unless said.
    part: Option<Part>,
    /// One large scene alone; nothing is written.
    #[arg(long, value_parser = PossibleValuesParser::new(LARGE.into_iter().chain([SPREAD])))]
    scene: Option<String>,
    /// One order of rays alone, in every scene that is chosen; nothing is written.
    #[arg(long, value_parser = Order::ALL.map(Order::as_str))]
    order: Option<String>,
    /// Rays of a call, in rays in every order; nothing is written.
    #[arg(long)]
    rays: Option<usize>,
    /// Writes docs/benchmarks.
    #[arg(long)]
    write: bool,
    /// A first impression.
    #[arg(long)]
    quick: bool,
    /// That everything runs; nothing is written.
    #[arg(long)]
    test: bool,
    /// What cargo says to every benchmark.
    #[arg(long, hide = true)]
    bench: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    Tiers,
    Structures,
    Cameras,
    Surfaces,
    Orders,
    Calls,
    Scales,
}

/// Measures, prints, and writes the pages if `--write` is given.
///
/// # Errors
/// If a file cannot be written, or if pages would name no commit, or one at which they were not measured.
///
/// # Panics
/// If an answer is wrong.
pub fn report() -> Result<(), Box<dyn error::Error>> {
    let Arguments { part, scene, order, rays, write, quick, test, .. } = Arguments::parse();
    let effort = match (test, quick) {
        (true, _) => Effort::Test,
        (_, true) => Effort::Quick,
        _ => Effort::Full,
    };
    let writes = write && !test && scene.is_none() && order.is_none() && rays.is_none();
    if writes && let Some(why) = page::refusal(Path::new(".")) {
        return Err(format!("--write: {why}").into());
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/benchmarks");
    let put = |name: &str, text: &str| -> Result<(), Box<dyn error::Error>> {
        if name.ends_with(".md") {
            println!("{text}");
        }
        if writes {
            fs::create_dir_all(&folder)?;
            fs::write(folder.join(name), text)?;
        }
        Ok(())
    };
    let origin = origin();
    let chosen = |own| part.is_none_or(|part| part == own);
    if chosen(Part::Tiers) && scene.is_none() {
        let (errors, lists) = (errors::measure(effort), lists::measure(effort));
        // Only in a native build do the marks have the CPU's instructions: a trade of any other build would flatter the
        // tiers.
        let trade = page::tiers::trade(&origin, &errors, &lists);
        match build() {
            "native" => put("trade.md", &trade)?,
            _ => println!("{trade}"),
        }
        put("errors.md", &page::tiers::errors(&origin, &errors))?;
        put(&format!("speed-{}.md", build()), &page::tiers::speed(&origin, &lists))?;
    }
    if chosen(Part::Structures) {
        let results = structures::measure(effort, scene.as_deref());
        put(
            &format!("structures-{}.md", page::maker()),
            &page::structures::page(&origin, &results),
        )?;
        if scene.is_none() {
            put("growth.svg", &plot::growth(&origin, &results.growth)?)?;
            put("embree.svg", &plot::embree(&origin, &results.scenes)?)?;
        }
    }
    if chosen(Part::Cameras) {
        let results = cameras::measure(effort, scene.as_deref());
        put(&format!("cameras-{}.md", page::maker()), &page::cameras::page(&origin, &results))?;
    }
    if chosen(Part::Surfaces) {
        let results = surfaces::measure(effort, scene.as_deref());
        put("surfaces.md", &page::surfaces::page(&origin, &results))?;
    }
    if chosen(Part::Orders) {
        let order = order.as_deref().and_then(Order::named);
        let rows = orders::measure(effort, (scene.as_deref(), order), rays);
        put(&format!("orders-{}.md", page::maker()), &page::orders::page(&origin, &rows))?;
    }
    if chosen(Part::Calls) {
        let results = calls::measure(effort, scene.as_deref());
        put("calls.md", &page::calls::page(&origin, &results))?;
    }
    if chosen(Part::Scales) && scene.is_none() {
        put("scales.md", &page::scales::page(&origin, &scales::measure(effort)))?;
    }
    let is_sound = spherule_kernel::float_environment_is_sound();
    assert!(is_sound, "something changed the floating-point environment");
    Ok(())
}
