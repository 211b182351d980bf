//! What the reports measure, and where they are written.

use crate::arguments::{Arguments, Part};
use crate::left_out::LeftOut;
use crate::measure::Effort;
use crate::page::{self, build, maker, origin};
use crate::{calls, cameras, errors, lists, orders, plot, scales, structures, surfaces};
use clap::Parser;
use spherule_tests::orders::Order;
use std::path::Path;
use std::{error, fs};

type Outcome = Result<(), Box<dyn error::Error>>;

/// Measures, prints, and writes the pages if `--write` is given. A page that lacks a scene, since an answer was wrong, is not written.
///
/// # Errors
/// If options do not go together, if a file cannot be written, if pages would name no commit, or one at which they were not measured, or if
/// a page lacks a scene.
///
/// # Panics
/// If an answer is wrong, except of a large scene.
pub fn report() -> Outcome {
    let arguments = Arguments::parse();
    if let Some(why) = arguments.refusal(build()) {
        return Err(why.into());
    }
    let writes = arguments.writes();
    if writes && let Some(why) = page::refusal(Path::new(".")) {
        return Err(format!("--write: {why}").into());
    }
    let effort = match (arguments.test, arguments.quick) {
        (true, _) => Effort::Test,
        (_, true) => Effort::Quick,
        _ => Effort::Full,
    };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/benchmarks");
    let mut lacks = Vec::new();
    let mut put = |name: &str, text: &str, left_out: &LeftOut| -> Outcome {
        let line = left_out.line();
        if name.ends_with(".md") {
            println!("{text}");
            if let Some(line) = &line {
                println!("{line}");
                lacks.push(format!("{name}: {line}"));
            }
        }
        if writes && line.is_none() {
            fs::create_dir_all(&folder)?;
            fs::write(folder.join(name), text)?;
        }
        Ok(())
    };
    let (origin, scene) = (origin(), arguments.scene.as_deref());
    if arguments.chooses(Part::Tiers) && scene.is_none() {
        let (errors, lists) = (errors::measure(effort), lists::measure(effort));
        // Only in a native build do the marks have the CPU's instructions: a trade of any other build would flatter the
        // tiers.
        let trade = page::tiers::trade(&origin, &errors, &lists);
        let all = LeftOut::default();
        match build() {
            "native" => put("trade.md", &trade, &all)?,
            _ => println!("{trade}"),
        }
        put("errors.md", &page::tiers::errors(&origin, &errors), &all)?;
        let speed = page::tiers::speed((&origin, build()), &lists);
        put(&format!("speed-{}.md", build()), &speed, &all)?;
    }
    if arguments.chooses(Part::Structures) {
        let left_out = LeftOut::default();
        let results = structures::measure(effort, scene, &left_out);
        let page = page::structures::page(&origin, &results);
        put(&format!("structures-{}.md", maker()), &page, &left_out)?;
        if scene.is_none() && left_out.line().is_none() {
            put("growth.svg", &plot::growth(&origin, &results.growth)?, &left_out)?;
            put("embree.svg", &plot::embree(&origin, &results.scenes)?, &left_out)?;
        }
    }
    if arguments.chooses(Part::Cameras) {
        let left_out = LeftOut::default();
        let page = page::cameras::page(&origin, &cameras::measure(effort, scene, &left_out));
        put(&format!("cameras-{}.md", maker()), &page, &left_out)?;
    }
    if arguments.chooses(Part::Surfaces) {
        let left_out = LeftOut::default();
        let page = page::surfaces::page(&origin, &surfaces::measure(effort, scene, &left_out));
        put("surfaces.md", &page, &left_out)?;
    }
    if arguments.chooses(Part::Orders) {
        let left_out = LeftOut::default();
        let chosen = (scene, arguments.order.as_deref().and_then(Order::named));
        let rows = orders::measure(effort, chosen, arguments.rays, &left_out);
        put(&format!("orders-{}.md", maker()), &page::orders::page(&origin, &rows), &left_out)?;
    }
    if arguments.chooses(Part::Calls) {
        let left_out = LeftOut::default();
        let page = page::calls::page(&origin, &calls::measure(effort, scene, &left_out));
        put("calls.md", &page, &left_out)?;
    }
    if arguments.chooses(Part::Scales) && scene.is_none() {
        let page = page::scales::page(&origin, &scales::measure(effort));
        put("scales.md", &page, &LeftOut::default())?;
    }
    let is_sound = spherule_kernel::float_environment_is_sound();
    assert!(is_sound, "something changed the floating-point environment");
    if lacks.is_empty() { Ok(()) } else { Err(lacks.join(" ").into()) }
}
