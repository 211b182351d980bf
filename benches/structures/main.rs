//! Scene structures and other programs, scene by scene: tables in Markdown, and a plot of growth.
//!
//! ```sh
//! cargo bench -p spherule-benches --features embree --bench structures -- --write
//! ```
//!
//! `--write` writes `benches/report/structures.md` and `growth.svg`; without it the report is
//! printed. `--scene NAME` runs one scene alone, `--quick` for a few seconds. Embree needs its
//! library: Debian's `libembree-dev`. What is measured, and how, stands in
//! [`spherule_benches::structures`].

mod bvh_tree;
mod obvhs_tree;
mod parry_tree;

use bvh_tree::Binary;
use obvhs_tree::Obvhs;
use parry_tree::Parry;
use spherule_benches::report::machine::Machine;
use spherule_benches::scenes::{Name, Size};
use spherule_benches::structures::contender::{Contender, Tier, Way};
use spherule_benches::structures::growth;
use spherule_benches::structures::measure::{self, Plan};
use spherule_benches::structures::measured::Measured;
use spherule_benches::structures::page::{self, Results};
use spherule_benches::structures::peer::builder;
use spherule_benches::structures::{plot, threads};
use spherule_kernel::dispatch::{Level, LevelName};
use spherule_kernel::{Question, float_environment_is_sound};
use std::path::Path;
use std::time::Duration;

/// Scenes that every level is timed on.
const AT_EVERY_LEVEL: [Name; 3] = [Name::Flake, Name::Uniform10k, Name::Uniform1m];
/// The scene that threads are timed on.
const FOR_THREADS: Name = Name::Uniform10k;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let asked = |option: &str| arguments.iter().any(|argument| argument == option);
    let (test, quick, write) = (asked("--test"), asked("--quick"), asked("--write"));
    let chosen = arguments.iter().position(|argument| argument == "--scene");
    let chosen = chosen.and_then(|index| arguments.get(index + 1));
    let names: Vec<_> = Name::ALL
        .into_iter()
        .filter(|name| chosen.is_none_or(|one| one == name.as_str()))
        .collect();
    if names.is_empty() {
        let all = Name::ALL.map(Name::as_str).join(", ");
        return Err(format!("no such scene; there are: {all}").into());
    }

    // The best first.
    let levels: Vec<_> = LevelName::ALL.into_iter().rev().filter_map(Level::named).collect();
    let builders = [builder::<Obvhs>(), builder::<Binary>(), builder::<Parry>()];
    let (size, time, rounds, builds) = match (test, quick) {
        (true, _) => (Size::SMALL, Duration::ZERO, 1..=1, 1),
        (_, true) => (Size::FULL, Duration::from_secs(2), 3..=9, 1),
        _ => (Size::FULL, Duration::from_secs(14), 5..=31, 5),
    };
    let plan =
        Plan { levels: &levels, tiers: &Tier::ALL, builders: &builders, time, rounds, builds };

    let mut scenes = Vec::new();
    for name in names {
        eprintln!("{}", name.as_str());
        let levels = if test || AT_EVERY_LEVEL.contains(&name) { &levels } else { &levels[..1] };
        let (builds, measured) =
            measure::scene(&name.scene(size), &Plan { levels, ..plan.clone() });
        measured.iter().for_each(progress);
        scenes.push((name.as_str(), builds, measured));
    }
    let two_threads = chosen.is_none().then(|| {
        let rounds = if test { 1 } else { 31 };
        let scene = FOR_THREADS.scene(size);
        (FOR_THREADS.as_str(), threads::two_by_one(&scene, levels[0], rounds))
    });
    let growth = if chosen.is_some() {
        Vec::new()
    } else {
        let plan = Plan {
            levels: &levels[..1],
            tiers: &[Tier::Stable],
            builders: &[],
            time: Duration::from_secs(3).min(time),
            rounds: if test { 1..=1 } else { 3..=15 },
            builds: 1,
        };
        let most = match (test, quick) {
            (true, _) => 4,
            (_, true) => 6,
            _ => 8,
        };
        let counts: Vec<_> = (2..most).map(|power| 10_usize.pow(power)).collect();
        growth::measure(&counts, test.then_some(size.pixels), &plan)
    };
    assert!(float_environment_is_sound(), "something changed the floating-point environment");

    let machine = Machine::this();
    let levels = levels.iter().map(|level| level.name()).collect();
    let results = Results { levels, scenes, two_threads, growth };
    let page = page::page(&machine, &results);
    println!("{page}");
    if results.growth.is_empty() {
        return Ok(());
    }
    let picture = plot::svg(&machine, &results.growth)?;
    if write && !test {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("report");
        std::fs::create_dir_all(&folder)?;
        std::fs::write(folder.join("growth.svg"), picture)?;
        std::fs::write(folder.join("structures.md"), page)?;
    }
    Ok(())
}

/// What is known of a scene before the report is: a million rays a second of `Stable`, and how many
/// times Embree that is.
fn progress(measured: &Measured) {
    let question = Question::Nearest;
    let embree = measured.fastest(question, Contender::is_embree);
    for way in Way::ALL {
        let own = Contender::Ours(way, Tier::Stable, measured.level);
        let Some(rate) = measured.rate(own, question) else { continue };
        let times = embree.map(|embree| measured.times_as_fast(own, embree, question).middle);
        let times = times.map_or_else(String::new, |times| format!(", {times:.2} times Embree"));
        eprintln!("  {}, {}: {rate:.1}{times}", measured.kind.as_str(), way.as_str());
    }
}
