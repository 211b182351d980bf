//! The large scenes.

use super::{Table, build, cell, number};
use crate::builds::OURS;
use crate::engine::kernel::STREAM;
use crate::engine::{BLOCK, Label, Query};
use crate::measure::Measured;
use crate::structures::{FOR_THREADS, OfScene, Structures};
use spherule_kernel::Tier;
use spherule_tests::scenes::Kind;

/// The report.
pub(crate) fn page(origin: &str, results: &Structures) -> String {
    let Structures { rays, scenes, two_threads, growth } = results;
    let some =
        |rays| format!(" Of more than {rays} rays some are timed, in runs from all of them.");
    let some = cell(rays.map(some));
    let rounds = || scenes.iter().flat_map(|scene| &scene.measured).map(Measured::rounds);
    let mut text = format!(
        "# Many spheres, {} build\n\n{origin}\n\nOne thread; medians of {} to {} interleaved rounds [quartiles] of the \
         thread's own time; ratios round by round. Before anything is timed, every way answers as brute force does, bit for \
         bit, on a sample of the rays (`stable`, `exact`), and others answer as `exact` except in close calls. Other crates \
         (obvhs, bvh, parry3d) have the build's own instructions, whatever the level. The kernel and Embree get {BLOCK} rays at a time, streams {STREAM}, which are brought into the cache outside the clock.{some} The \
         scenes: [scenes.rs](../../tests/src/scenes.rs).\n\n{}{}",
        build(),
        rounds().min().unwrap_or(0),
        rounds().max().unwrap_or(0),
        against_embree(scenes),
        versions(scenes)
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

/// The kernel's quickest way against Embree's quickest call, level by level.
fn against_embree(scenes: &[OfScene]) -> String {
    let all = || scenes.iter().flat_map(|scene| &scene.measured);
    let levels: Vec<_> = all().next().into_iter().flat_map(Measured::levels).collect();
    let mut text = "`stable` in the kernel's quickest way, against Embree's quickest call with the same instructions (for \
                    the baseline, which has SSE2, SSE4.2), rays said to be coherent or not; a million rays a second.\n"
        .to_owned();
    for (query, name) in [(Query::ClosestHit, "Closest hit"), (Query::AnyHit, "Any hit")] {
        let columns = levels.iter().map(|level| format!("{level} | Embree | times"));
        let columns = columns.collect::<Vec<_>>().join(" | ");
        let columns = format!("scene | rays | way | {columns} | time of `exact` by `stable`");
        let mut table = Table::new(3, &columns);
        for measured in all() {
            let rate =
                |label: Option<&Label>| number(label.and_then(|it| measured.rate(it, query)));
            let best = levels.first().and_then(|best| measured.quickest(Tier::Stable, best, query));
            let Some(best) = best else { continue };
            let exact = Label { name: Tier::Exact.as_str(), ..best.clone() };
            let names = [measured.scene, measured.kind.as_str(), best.way].map(str::to_owned);
            let cells = levels.iter().flat_map(|level| {
                [
                    rate(measured.quickest(Tier::Stable, level, query)),
                    rate(measured.embree(level, query)),
                    cell(measured.times_embree(level, query)),
                ]
            });
            let exact = cell(measured.ratio(&exact, best, query));
            table.row(names.into_iter().chain(cells).chain([exact]));
        }
        text += &format!("\n{name}:\n\n{}", table.0);
    }
    text
}

/// The versions of Embree, if there are several.
fn versions(scenes: &[OfScene]) -> String {
    let all = || scenes.iter().flat_map(|scene| &scene.measured);
    let Some(first) = all().next() else { return String::new() };
    let mut columns = Vec::new();
    for label in first.labels().filter(|label| label.is_embree()) {
        if !columns.contains(&(label.lanes, label.way)) {
            columns.push((label.lanes, label.way));
        }
    }
    columns.sort_by_key(|(level, _)| first.levels().position(|other| other == *level));
    if columns.iter().all(|(_, way)| *way == columns[0].1) {
        return String::new();
    }
    let names: Vec<_> = columns.iter().map(|(level, way)| format!("{way}, {level}")).collect();
    let mut table = Table::new(2, &format!("scene | rays | {}", names.join(" | ")));
    for measured in all() {
        let rate = |&(level, way): &(&str, &str)| {
            let rate = |query| {
                let is_it = |label: &Label| label.way == way && label.lanes == level;
                number(measured.fastest(query, is_it).and_then(|it| measured.rate(it, query)))
            };
            Query::ALL.map(rate).join(" / ")
        };
        let names = [measured.scene, measured.kind.as_str()].map(str::to_owned);
        table.row(names.into_iter().chain(columns.iter().map(rate)));
    }
    format!(
        "\nThe versions of Embree, each in its quickest call; a million rays a second, closest hit / any hit:\n\n{}",
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
        let ratio = builds.embree().and_then(|embree| builds.times.ratio(&OURS, &embree));
        let size = [cell(ratio)].into_iter().chain(size);
        table.row([(*name).to_owned(), spheres.to_string()].into_iter().chain(times).chain(size));
    }
    format!("\nBuilds, milliseconds, one thread each, memory included:\n\n{}", table.0)
}

/// Every engine, on every scene.
fn everyone(scenes: &[OfScene], kind: usize, (query, name): (Query, &str)) -> String {
    let names: Vec<_> = scenes.iter().map(|scene| scene.name).collect();
    let mut table = Table::new(1, &format!(" | {}", names.join(" | ")));
    let all = || scenes.iter().map(|scene| &scene.measured[kind]);
    // The scene in which most engines took part names them all.
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
        let builds = [Some(OURS), step.builds.embree()]
            .map(|name| number(name.and_then(|name| step.builds.milliseconds(name))));
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

#[cfg(test)]
mod tests {
    use super::*;

    /// In a plain build those of the baseline, which is no level of theirs.
    #[test]
    fn the_page_tells_what_instructions_other_crates_have() {
        let results =
            Structures { rays: None, scenes: Vec::new(), two_threads: None, growth: Vec::new() };
        let page = page("", &results);
        assert!(page.contains("Other crates (obvhs, bvh, parry3d) have the build's own"), "{page}");
    }
}
