//! The report as Markdown: a section on error, and a section on speed for every build.
//!
//! Sections stand between markers, so that a run replaces its own and leaves the others alone.

use crate::report::contender::Contender;
use crate::report::dominance::Rivalry;
use crate::report::error::{NamedErrors, RegimeError};
use crate::report::machine::Machine;
use crate::report::speed::{List, Speed, Workload};
use crate::report::target::Target;
use crate::rounds::Median;
use spherule_kernel::{Accuracy, Fast};
use std::fmt::Write;

/// Puts `text` in place of what stands between the markers of `section`, or at the end.
#[must_use]
pub fn replaced(page: &str, section: &str, text: &str) -> String {
    let (open, close) = (format!("<!-- {section} -->"), format!("<!-- end of {section} -->"));
    let fresh = format!("{open}\n{}\n{close}", text.trim());
    match (page.find(&open), page.find(&close)) {
        (Some(start), Some(end)) if start < end => {
            format!("{}{fresh}{}", &page[..start], &page[end + close.len()..])
        }
        _ => format!("{page}{}{fresh}\n", if page.is_empty() { "" } else { "\n" }),
    }
}

/// Where the figures come from.
#[must_use]
pub fn head(machine: &Machine) -> String {
    let flags = if machine.flags.is_empty() { "none" } else { machine.flags };
    format!(
        "CPU: {}. Compiler: {}. Target flags: {flags} (so everywhere: {}). Commit: {}. {}.\n",
        machine.cpu, machine.rustc, machine.features, machine.commit, machine.date
    )
}

/// Decisions and ulp, regime by regime.
#[must_use]
pub fn errors(machine: &Machine, errors: &[NamedErrors]) -> String {
    let cases = errors[0].regimes[0].summary.cases;
    let mut text = format!(
        "### Error\n\n{}\nOne ray, one sphere, {cases} cases a regime, held against an oracle of \
         big integers. Error does not depend on lanes: ",
        head(machine)
    );
    let differing: u64 = errors.iter().map(|entry| entry.differing).sum();
    if differing == 0 {
        text += "measured once, and every lane width and level gave the same bits.";
    } else {
        let _ = write!(text, "yet {differing} ANSWERS DIFFERED between lane widths or levels.");
    }
    text += " `lecture` and `plain f64` are no tiers but marks.\n\n\
        Wrong decisions in a million rays: hits that are misses / misses that are hits / \
        the other root.\n\n";
    table(&mut text, errors, |error| {
        let wrong = error.summary;
        let ppm = [wrong.wrong_hits, wrong.wrong_misses, wrong.wrong_roots];
        let [hits, misses, roots] = ppm.map(|count| error.ppm(count));
        if hits + misses + roots == 0.0 {
            return "0".to_owned();
        }
        format!("{hits:.0} / {misses:.0} / {roots:.0}")
    });
    text += "\nError of t in ulp where the decision is right: median / p99.9 / max \
        (true hits whose t is correctly rounded).\n\n";
    table(&mut text, errors, |error| {
        if error.found() == 0 {
            return "none found".to_owned();
        }
        let found = [error.summary.median, error.summary.p999, error.summary.max];
        let [median, p999, max] = found.map(ulp);
        let percent = error.rounded_percent();
        // 100 % is said of all, and of nothing less.
        let percent = if percent < 100.0 { percent.min(99.99) } else { percent };
        let digits = if percent > 99.0 && percent < 100.0 { 2 } else { 0 };
        format!("{median} / {p999} / {max} ({percent:.digits$} %)")
    });
    text
}

fn table(text: &mut String, errors: &[NamedErrors], cell: impl Fn(&RegimeError) -> String) {
    let names: Vec<_> = errors.iter().map(|entry| entry.name).collect();
    let _ =
        writeln!(text, "| regime | {} |\n|---{}|", names.join(" | "), "|--:".repeat(names.len()));
    for (index, regime) in errors[0].regimes.iter().enumerate() {
        let cells: Vec<_> = errors.iter().map(|entry| cell(&entry.regimes[index])).collect();
        let _ = writeln!(text, "| {} | {} |", escaped(regime.regime), cells.join(" | "));
    }
}

fn escaped(text: &str) -> String {
    text.replace('|', "\\|")
}

fn ulp(distance: u64) -> String {
    if distance < 100_000 { distance.to_string() } else { format!("{:.0e}", distance as f64) }
}

/// Times, targets and verdicts of one build.
#[must_use]
pub fn speed(
    machine: &Machine,
    contenders: &[Contender],
    speed: &Speed,
    targets: &[Target],
    rivalries: &[Rivalry],
    errors: &[NamedErrors],
) -> String {
    let build = machine.build();
    let mut text = format!(
        "### Speed against error, {build} build\n\n{}\n\
         ![Speed against error, {build} build]({build}.svg)\n\n\
         Nanoseconds a ray-sphere test of brute force, one thread, medians of {} interleaved \
         rounds; in brackets the time by that of `fast` in the same lanes and rounds; spread: \
         the distance of the quartiles by the median, on the median workload.\n\n",
        head(machine),
        speed.rounds
    );
    times(&mut text, contenders, speed);
    text += "\nThe largest relative error of t on these rays (2^-24 is 6.0e-8), small spheres / \
        with the ground / where every line hits: ";
    let worst = errors.iter().map(|entry| {
        let on = |list| speed.worst(entry.name, list);
        let [cube, ground, every] = [List::Cube, List::Ground, List::EveryLine].map(on);
        format!("{} {cube:.1e} / {ground:.1e} / {every:.1e}", entry.name)
    });
    text += &worst.collect::<Vec<_>>().join("; ");
    text += ".\n";

    text += "\nAsked for, by the median [quartiles]:\n\n\
        | ratio of times | rays, spheres | asked | measured | |\n|---|---|--:|--:|---|\n";
    for target in targets {
        let sign = if target.at_least { "≥" } else { "≤" };
        let verdict = if target.is_met() { "met" } else { "**missed**" };
        let (what, workload, limit) = (&target.what, target.workload, target.limit);
        let measured = three(target.measured);
        let _ = writeln!(text, "| {what} | {workload} | {sign} {limit} | {measured} | {verdict} |");
    }

    text += "\nWho is not needed? A contender is *dominated* by a tier that is faster on every \
        workload in every lane width and level, and no less right in any figure of any regime. \
        Marks are held against tiers in the quickest lanes of each.\n\n\
        | contender | rival | regimes where the rival is no less right | timings where it is \
        faster | clearly slower | its time by the contender's | |\n|---|---|--:|--:|--:|--:|---|\n";
    for rivalry in rivalries {
        let (low, high) = rivalry.range();
        let _ = writeln!(
            text,
            "| {} | {} | {} of {} | {} of {} | {} | {low:.2} to {high:.2} | {} |",
            rivalry.name,
            rivalry.by,
            rivalry.no_less_right,
            rivalry.regimes,
            rivalry.faster(),
            rivalry.ratios.len(),
            rivalry.clearly_slower(),
            if rivalry.dominates() { "**dominated**" } else { "" },
        );
    }
    let _ = writeln!(text, "\n{}", verdict(contenders, rivalries));
    text += &what_is_left(contenders, rivalries);
    let digests = errors.iter().filter(|entry| {
        contenders.iter().any(|contender| contender.is_tier && contender.name == entry.name)
    });
    let digests: Vec<_> =
        digests.map(|entry| format!("{} {:016x}", entry.name, entry.digest)).collect();
    let _ = writeln!(text, "\nDigest of all answers of a tier: {}.", digests.join(", "));
    text
}

fn times(text: &mut String, contenders: &[Contender], speed: &Speed) {
    let workloads = Workload::ALL.map(|workload| workload.to_string());
    let columns = "|--:".repeat(workloads.len() + 1);
    let _ = writeln!(text, "| | lanes | {} | spread |\n|---|---{columns}|", workloads.join(" | "));
    for Contender { name, is_tier, engine, .. } in contenders {
        let _ = write!(text, "| {name} | {engine} |");
        let mut spreads = Vec::new();
        for workload in Workload::ALL {
            let time = speed.time(name, *engine, workload);
            spreads.push((time.high - time.low) / time.middle);
            let _ = write!(text, " {:.3}", time.middle);
            if *is_tier && *name != Fast::NAME {
                let ratio = speed.ratio((name, *engine), (Fast::NAME, *engine), workload);
                let _ = write!(text, " ({:.2})", ratio.middle);
            }
            *text += " |";
        }
        spreads.sort_by(f64::total_cmp);
        let _ = writeln!(text, " {:.0} % |", 100.0 * spreads[spreads.len() / 2]);
    }
}

/// Who is dominated, in words.
fn verdict(contenders: &[Contender], rivalries: &[Rivalry]) -> String {
    let is_tier = |name| contenders.iter().any(|other| other.name == name && other.is_tier);
    let words = |rivalry: &Rivalry| format!("`{}` is dominated by `{}`", rivalry.name, rivalry.by);
    let of = |tiers: bool| -> Vec<_> {
        let dominated = rivalries.iter().filter(|rivalry| rivalry.dominates());
        dominated.filter(|rivalry| is_tier(rivalry.name) == tiers).map(words).collect()
    };
    let (tiers, marks) = (of(true), of(false));
    let mut text = if tiers.is_empty() {
        "No tier is dominated in this run.".to_owned()
    } else {
        format!("**Dominated: {}.**", tiers.join("; "))
    };
    if !marks.is_empty() {
        let _ = write!(text, " Of the marks, {}.", marks.join("; "));
    }
    text
}

/// For tiers with a rival that is no less right: what they are still good for.
fn what_is_left(contenders: &[Contender], rivalries: &[Rivalry]) -> String {
    let is_tier = |name| contenders.iter().any(|other| other.name == name && other.is_tier);
    let mut text = String::new();
    for rivalry in rivalries {
        if !is_tier(rivalry.name) || rivalry.dominates() || rivalry.no_less_right < rivalry.regimes
        {
            continue;
        }
        let _ = write!(text, "\n`{}` is no less right than `{}`", rivalry.by, rivalry.name);
        let clearly_slower = Workload::ALL.iter().filter_map(|workload| {
            let own = rivalry.ratios.iter().filter(|(_, on, _)| on == workload);
            let slower = own.clone().filter(|(_, _, ratio)| ratio.low > 1.0).count();
            (slower > 0).then(|| format!("{workload} ({slower} of {})", own.count()))
        });
        let places: Vec<_> = clearly_slower.collect();
        let places = if places.is_empty() { "nowhere".to_owned() } else { places.join("; ") };
        let _ = writeln!(text, ", and clearly slower on (in how many lanes): {places}.");
    }
    text
}

fn three(Median { low, middle, high }: Median) -> String {
    format!("{middle:.2} [{low:.2}, {high:.2}]")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_is_replaced_and_its_neighbours_stay() {
        let page = replaced("# Report\n", "error", "one");
        let page = replaced(&page, "native", "two\n");
        let again = replaced(&page, "error", "three");
        assert_eq!(again, page.replace("one", "three"));
        assert!(again.starts_with("# Report\n\n<!-- error -->\nthree\n<!-- end of error -->\n"));
        assert!(again.ends_with("<!-- native -->\ntwo\n<!-- end of native -->\n"));
    }

    #[test]
    fn bars_in_names_do_not_end_cells() {
        assert_eq!(escaped("|d| 2^60"), "\\|d\\| 2^60");
        assert_eq!((ulp(7), ulp(888_586_229)), ("7".to_owned(), "9e8".to_owned()));
    }
}
