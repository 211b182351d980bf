//! The large scenes.

use super::{Table, build, cell, number};
use crate::builds::{EMBREE, OURS};
use crate::engine::{Label, Query};
use crate::measure::Measured;
use crate::structures::{FOR_THREADS, OfScene, Structures};
use spherule_kernel::Tier;
use spherule_tests::scenes::Kind;

/// The report.
pub(crate) fn page(origin: &str, results: &Structures) -> String {
    let Structures { scenes, two_threads, growth } = results;
    let rounds = || scenes.iter().flat_map(|scene| &scene.measured).map(Measured::rounds);
    let mut text = format!(
        "# Many spheres, {} build\n\n{origin}\n\nOne thread; medians of {} to {} interleaved rounds [quartiles] of the \
         thread's own time; ratios round by round. Before anything is timed, every way answers as brute force does, bit for \
         bit, on a sample of the rays (`stable`, `exact`), and others answer as `exact` but for close calls. The scenes: \
         [scenes.rs](../../tests/src/scenes.rs).\n\n{}",
        build(),
        rounds().min().unwrap_or(0),
        rounds().max().unwrap_or(0),
        against_embree(scenes)
    );
    if let Some(times) = two_threads {
        text += &format!(
            "\nTwo threads are {times} times as fast as one ({FOR_THREADS}, primary, by the wall's clock).\n"
        );
    }
    text += &builds(scenes);
    for kind in [0, 1] {
        text += &everyone(scenes, kind, (Query::ClosestHit, "closest hit"));
        text += &everyone(scenes, kind, (Query::AnyHit, "any hit"));
    }
    text + &self::growth(growth)
}

/// The kernel's quickest way against Embree's quickest call.
fn against_embree(scenes: &[OfScene]) -> String {
    let query = Query::ClosestHit;
    let mut table = Table::new(
        3,
        "scene | rays | way | spheres | Embree | `stable` | times Embree | any hit, times Embree | \
         time of `exact` by `stable`",
    );
    for measured in scenes.iter().flat_map(|scene| &scene.measured) {
        let Some(stable) = measured.quickest(Tier::Stable, query) else { continue };
        let exact = Label { name: Tier::Exact.as_str(), ..stable.clone() };
        let names = [measured.scene, measured.kind.as_str(), stable.way].map(str::to_owned);
        table.row(names.into_iter().chain([
            measured.spheres.to_string(),
            number(measured.embree(query).and_then(|embree| measured.rate(embree, query))),
            number(measured.rate(stable, query)),
            cell(measured.times_embree(query)),
            cell(measured.times_embree(Query::AnyHit)),
            cell(measured.ratio(&exact, stable, query)),
        ]));
    }
    format!(
        "`stable` in the kernel's quickest way at the best level, against Embree's quickest call (1, 8 or 16 rays; 3.13, \
         calls alone); a million rays a second, closest hit.\n\n{}",
        table.0
    )
}

fn builds(scenes: &[OfScene]) -> String {
    let Some(first) = scenes.first() else { return String::new() };
    let names = &first.builds.times.names;
    let columns = names.join(" | ");
    let columns =
        format!("scene | spheres | {columns} | ours by Embree's | bytes a sphere | depth");
    let mut table = Table::new(1, &columns);
    for OfScene { name, spheres, builds, .. } in scenes {
        let times = names.iter().map(|name| number(builds.milliseconds(name)));
        let size = [format!("{:.1}", builds.bytes), builds.depth.to_string()];
        let size = [cell(builds.times.ratio(&OURS, &EMBREE))].into_iter().chain(size);
        table.row([(*name).to_owned(), spheres.to_string()].into_iter().chain(times).chain(size));
    }
    format!("\nBuilds, milliseconds, one thread each, memory included:\n\n{}", table.0)
}

/// Everyone, on every scene.
fn everyone(scenes: &[OfScene], kind: usize, (query, name): (Query, &str)) -> String {
    let names: Vec<_> = scenes.iter().map(|scene| scene.name).collect();
    let mut table = Table::new(1, &format!(" | {}", names.join(" | ")));
    let all = || scenes.iter().map(|scene| &scene.measured[kind]);
    // The scene that most took part in has them all.
    let most = all().max_by_key(|measured| measured.labels().count());
    for label in most.into_iter().flat_map(Measured::labels) {
        let rates = all().map(|measured| number(measured.rate(label, query)));
        table.row([label.to_string()].into_iter().chain(rates));
    }
    format!("\nA million {} rays a second, {name}:\n\n{}", Kind::ALL[kind].as_str(), table.0)
}

fn growth(steps: &[OfScene]) -> String {
    let Some(first) = steps.first() else { return String::new() };
    let names = first.rates().map(|(name, _)| name).join(" | ");
    let columns = format!("spheres | {names} | build | Embree's build | bytes a sphere | depth");
    let mut table = Table::new(0, &columns);
    for step in steps {
        let builds = [OURS, EMBREE].map(|name| number(step.builds.milliseconds(name)));
        let size = [format!("{:.1}", step.builds.bytes), step.builds.depth.to_string()];
        let rates = step.rates().map(|(_, rate)| number(rate));
        let count = [step.spheres.to_string()].into_iter();
        table.row(count.chain(rates).chain(builds).chain(size));
    }
    format!(
        "\n![Rays a second and time of the build, by the number of spheres](growth.svg)\n\n\
         Growth: uniform spheres, a million rays a second, `stable`, closest hit; milliseconds a build.\n\n{}",
        table.0
    )
}
