//! Scene structures as Markdown.

use crate::report::machine::Machine;
use crate::report::page::head;
use crate::rounds::Median;
use crate::scenes::Kind;
use crate::structures::build::{Builds, EMBREE, OURS};
use crate::structures::contender::{Contender, QUESTIONS, Tier, question_name};
use crate::structures::growth::{LINES, Step};
use crate::structures::measured::Measured;
use crate::structures::target::{self, verdict};
use spherule_kernel::Question;
use spherule_kernel::dispatch::LevelName;
use std::fmt::Write;

/// A scene's name, its builds, and the times of its rays.
pub type SceneResult = (&'static str, Builds, Vec<Measured>);

/// All that was measured.
#[derive(Debug)]
pub struct Results {
    /// The levels that took part, the best first.
    pub levels: Vec<LevelName>,
    /// Scene by scene.
    pub scenes: Vec<SceneResult>,
    /// Two threads by one, where it was measured, and the scene.
    pub two_threads: Option<(&'static str, Median)>,
    /// More and more spheres; may be empty.
    pub growth: Vec<Step>,
}

impl Results {
    fn measured(&self) -> impl Iterator<Item = &Measured> {
        self.scenes.iter().flat_map(|(_, _, measured)| measured)
    }

    fn of_kind(&self, kind: Kind) -> Vec<&Measured> {
        self.measured().filter(|measured| measured.kind == kind).collect()
    }
}

/// The report.
#[must_use]
pub fn page(machine: &Machine, results: &Results) -> String {
    let levels: Vec<_> = results.levels.iter().map(|level| level.as_str()).collect();
    let rounds = || results.measured().map(Measured::rounds);
    let (least, most) = (rounds().min().unwrap_or(0), rounds().max().unwrap_or(0));
    let mut text = format!(
        "## Scene structures, {} build\n\n{}\nLevels timed: {}. One thread; medians of {least} to \
         {most} interleaved rounds [quartiles] of the thread's own time; ratios round by round. \
         Before anything is timed, every way answers as brute force does, bit for bit, on a \
         sample of the rays (`stable`, `exact`), and the answers of others are held against \
         `exact`. The scenes: [scenes.rs](../src/scenes.rs).\n\n",
        machine.build(),
        head(machine),
        levels.join(", ")
    );
    headline(&mut text, results);
    further(&mut text, results);
    builds(&mut text, results);
    by_level(&mut text, results);
    everyone(&mut text, results);
    agreements(&mut text, results);
    growth(&mut text, &results.growth);
    text
}

/// The kernel's quickest way against Embree's quickest call.
fn headline(text: &mut String, results: &Results) {
    *text += "`stable` in the kernel's quickest way at the best level, against Embree's quickest \
        call (1, 8 or 16 rays; 3.13, calls alone); a million rays a second, nearest hit.\n\n\
        | scene | spheres | rays | Embree | `stable` | way | times Embree | asked | | any hit, \
        times Embree | time of `exact` by `stable` | asked | |\n\
        |---|--:|---|--:|--:|---|--:|--:|---|--:|--:|--:|---|\n";
    for measured in results.measured() {
        let Measured { scene, kind, spheres, level, .. } = *measured;
        let Some(way) = measured.fastest_way(Question::Nearest, Tier::Stable) else { continue };
        let [stable, exact] =
            [Tier::Stable, Tier::Exact].map(|tier| Contender::Ours(way, tier, level));
        let rate = |contender| measured.rate(contender, Question::Nearest);
        let embree = measured.fastest(Question::Nearest, Contender::is_embree);
        let ratio = embree.map(|e| measured.times_as_fast(stable, e, Question::Nearest));
        let asked = target::times_embree(scene, kind);
        let met = ratio.zip(asked).map_or("", |(ratio, asked)| verdict(ratio.middle >= asked));
        let by_stable = measured.times_as_fast(stable, exact, Question::Nearest);
        let most = target::exact_by_stable(kind);
        let _ = writeln!(
            text,
            "| {scene} | {spheres} | {} | {} | {} | {} | {} | {} | {met} | {} | {} | ≤ {most} | {} |",
            kind.as_str(),
            number(embree.and_then(rate)),
            number(rate(stable)),
            way.as_str(),
            ratio.map_or_else(String::new, three),
            asked.map_or_else(String::new, |asked| format!("≥ {asked}")),
            any_hit(measured).map_or_else(String::new, three),
            three(by_stable),
            verdict(by_stable.middle <= most),
        );
    }
}

fn any_hit(measured: &Measured) -> Option<Median> {
    let way = measured.fastest_way(Question::Any, Tier::Stable)?;
    let embree = measured.fastest(Question::Any, Contender::is_embree)?;
    let stable = Contender::Ours(way, Tier::Stable, measured.level);
    Some(measured.times_as_fast(stable, embree, Question::Any))
}

/// What was asked for besides.
fn further(text: &mut String, results: &Results) {
    *text += "\n| asked for besides | limit | measured | |\n|---|--:|--:|---|\n";
    let mut row = |what: &str, limit: String, measured: String, met: bool| {
        let _ = writeln!(text, "| {what} | {limit} | {measured} | {} |", verdict(met));
    };
    let primary = |scene: &str| {
        let of_kind = results.of_kind(Kind::Primary);
        let measured = of_kind.into_iter().find(|measured| measured.scene == scene)?;
        let way = measured.fastest_way(Question::Nearest, Tier::Stable)?;
        let stable = Contender::Ours(way, Tier::Stable, measured.level);
        measured.rate(stable, Question::Nearest)
    };
    if let (Some(few), Some(many)) = (primary("u10k"), primary("u1m")) {
        let (slower, most) = (few / many, target::SLOWDOWN);
        let limit = format!("≤ {most}");
        row("u10k to u1m, primary: slower by", limit, format!("{slower:.2}"), slower <= most);
    }
    let u1m = results.scenes.iter().find(|(name, ..)| *name == "u1m");
    if let Some(ratio) = u1m.and_then(|(_, builds, _)| builds.by_embree()) {
        let most = target::BUILD;
        let what = "build of u1m: time by Embree's, one thread";
        row(what, format!("≤ {most}"), three(ratio), ratio.middle <= most);
    }
    let bytes = results.scenes.iter().filter(|(_, builds, _)| builds.spheres > 1_000);
    if let Some(bytes) = bytes.map(|(_, builds, _)| builds.bytes).max_by(f64::total_cmp) {
        let most = target::BYTES;
        let what = "bytes a sphere in any scene of more than 1,000";
        row(what, format!("≤ {most}"), format!("{bytes:.1}"), bytes <= most);
    }
    if let Some((scene, ratio)) = results.two_threads {
        let least = target::TWO_THREADS;
        let what = format!("two threads by one, {scene}, primary, by the wall's clock");
        row(&what, format!("≥ {least}"), three(ratio), ratio.middle >= least);
    }
}

fn builds(text: &mut String, results: &Results) {
    let Some((_, first, _)) = results.scenes.first() else { return };
    let names = &first.names;
    let _ = write!(
        text,
        "\nBuilds, milliseconds, one thread each, memory included:\n\n\
         | scene | spheres | {} | ours by Embree's | bytes a sphere | depth |\n|---|--:{}|--:|--:|--:|\n",
        names.join(" | "),
        "|--:".repeat(names.len())
    );
    for (name, builds, _) in &results.scenes {
        let times = names.iter().map(|name| number(builds.milliseconds(name)));
        let _ = writeln!(
            text,
            "| {name} | {} | {} | {} | {:.1} | {} |",
            builds.spheres,
            times.collect::<Vec<_>>().join(" | "),
            builds.by_embree().map_or_else(String::new, three),
            builds.bytes,
            builds.depth
        );
    }
}

/// What a level of instructions is worth, in one build.
fn by_level(text: &mut String, results: &Results) {
    let [best, others @ ..] = &results.levels[..] else { return };
    if others.is_empty() {
        return;
    }
    let names: Vec<_> = others.iter().map(|level| level.as_str()).collect();
    let _ = write!(
        text,
        "\nLevels in this build: `stable`, nearest hit, a million rays a second (part of `{}`):\n\n\
         | scene | rays | way | {} | {} |\n|---|---|---|--:{}|\n",
        best.as_str(),
        best.as_str(),
        names.join(" | "),
        "|--:".repeat(names.len())
    );
    for measured in results.measured() {
        let question = Question::Nearest;
        let Some(way) = measured.fastest_way(question, Tier::Stable) else { continue };
        let at = |level: &LevelName| Contender::Ours(way, Tier::Stable, *level);
        if !measured.contenders.contains(&at(&others[0])) {
            continue;
        }
        let cell = |level: &LevelName| {
            let part = measured.times_as_fast(at(level), at(best), question).middle;
            format!("{} ({part:.2})", number(measured.rate(at(level), question)))
        };
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} |",
            measured.scene,
            measured.kind.as_str(),
            way.as_str(),
            number(measured.rate(at(best), question)),
            others.iter().map(cell).collect::<Vec<_>>().join(" | ")
        );
    }
}

/// Everyone at the best level, on every scene.
fn everyone(text: &mut String, results: &Results) {
    for kind in Kind::ALL {
        let all = results.of_kind(kind);
        let Some(first) = all.first() else { continue };
        let scenes: Vec<_> = all.iter().map(|measured| measured.scene).collect();
        for question in QUESTIONS {
            let _ = write!(
                text,
                "\nA million {} rays a second, {}:\n\n| | {} |\n|---{}|\n",
                kind.as_str(),
                question_name(question),
                scenes.join(" | "),
                "|--:".repeat(scenes.len())
            );
            for contender in &first.contenders {
                if matches!(contender, Contender::Ours(_, _, level) if *level != first.level) {
                    continue;
                }
                let cells = all.iter().map(|measured| number(measured.rate(*contender, question)));
                let _ =
                    writeln!(text, "| {contender} | {} |", cells.collect::<Vec<_>>().join(" | "));
            }
        }
    }
}

/// How the answers of others were, all scenes together.
fn agreements(text: &mut String, results: &Results) {
    let Some(first) = results.measured().next() else { return };
    *text += "\nAnswers of others against those of `exact`, all scenes: differing by little (a \
        grazed sphere, a start on the surface, cancelled digits) and otherwise.\n\n\
        | | rays | hits | by little | wrong | any hit otherwise |\n|---|--:|--:|--:|--:|--:|\n";
    for (contender, _) in &first.agreements {
        let all = results.measured().flat_map(|measured| &measured.agreements);
        let own = all.filter(|(other, _)| other == contender).map(|(_, agreement)| agreement);
        let sums = own.fold([0; 5], |sums, agreement| {
            let own = [
                agreement.rays,
                agreement.hits,
                agreement.by_little,
                agreement.wrong,
                agreement.any,
            ];
            std::array::from_fn(|index| sums[index] + own[index])
        });
        let sums = sums.map(|sum| sum.to_string());
        let _ = writeln!(text, "| {contender} | {} |", sums.join(" | "));
    }
}

fn growth(text: &mut String, steps: &[Step]) {
    if steps.is_empty() {
        return;
    }
    let names = LINES.map(|(_, _, name)| name);
    let _ = write!(
        text,
        "\n![Rays a second and time of the build, by the number of spheres](growth.svg)\n\n\
         Growth: uniform spheres, a million rays a second, `stable`, nearest hit; milliseconds a \
         build.\n\n| spheres | {} | build | Embree's build | bytes a sphere | depth |\n\
         |--:{}|--:|--:|--:|--:|\n",
        names.join(" | "),
        "|--:".repeat(names.len())
    );
    for step in steps {
        let rates = LINES.map(|(kind, line, _)| number(step.rate(kind, line)));
        let [ours, embree] = [OURS, EMBREE].map(|name| number(step.builds.milliseconds(name)));
        let _ = writeln!(
            text,
            "| {} | {} | {ours} | {embree} | {:.1} | {} |",
            step.spheres,
            rates.join(" | "),
            step.builds.bytes,
            step.builds.depth
        );
    }
}

/// Three digits.
fn number(value: Option<f64>) -> String {
    let Some(value) = value else { return String::new() };
    let digits = if value >= 100.0 {
        0
    } else if value >= 10.0 {
        1
    } else if value >= 1.0 {
        2
    } else {
        3
    };
    format!("{value:.digits$}")
}

fn three(Median { low, middle, high }: Median) -> String {
    format!("{middle:.2} [{low:.2}, {high:.2}]")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let of = |value: f64| number(Some(value));
        assert_eq!(
            [of(187.4), of(18.74), of(1.874), of(0.018_74)],
            ["187", "18.7", "1.87", "0.019"]
        );
        assert_eq!(number(None), "");
    }
}
