//! Speed against error of the tiers.

use super::{Table, cell};
use crate::engine::probes::{FILTER, FUSED, MIX, TEXTBOOK};
use crate::engine::{Label, Query};
use crate::errors::{Errors, NAMES, ulp, wrong_in_a_million};
use crate::measure::Measured;
use spherule_kernel::Tier;
use spherule_tests::tally::Summary;

const QUERY: Query = Query::ClosestHit;

/// One row for each tier and mark: what it costs, and what it gets wrong.
pub(crate) fn trade(origin: &str, errors: &[Errors], lists: &[Measured]) -> String {
    let mut table = Table::new(
        1,
        " | ns a ray-sphere test | wrong decisions in a million: ordinary rays | grazing ones | \
         ulp of t: ordinary rays | grazing ones",
    );
    let of = |regime, index: usize| {
        let errors = errors.iter().find(|errors| errors.regime == regime).expect("a regime");
        let wrong = wrong_in_a_million(&errors.of[index]).iter().sum::<f64>();
        (format!("{wrong:.0}"), cell(errors.of[index].ulp.map(ulp)))
    };
    for (index, name) in NAMES.into_iter().enumerate() {
        let time = quickest(&lists[0], name).and_then(|label| lists[0].time_a_test(label));
        let time = cell(time.map(|time| format!("{:.3}", time.middle)));
        let [ordinary, grazing] = ["ordinary", "grazing 2^-20"].map(|regime| of(regime, index));
        table.row([format!("`{name}`"), time, ordinary.0, grazing.0, ordinary.1, grazing.1]);
    }
    format!(
        "{}\n{origin}. Brute force, {}, one thread, the quickest lanes. Grazing: 2^-20 of the radius. ulp: median / p99.9 / \
         max where the decision is right. `plain geometric` and `plain f64` are no tiers but marks.\n",
        table.0,
        name(&lists[0])
    )
}

/// The rays and the list.
fn name(list: &Measured) -> String {
    format!("{} {}", list.kind.as_str(), list.scene)
}

/// In the quickest lanes, or at the quickest level.
fn quickest<'a>(list: &'a Measured, name: &str) -> Option<&'a Label> {
    list.fastest(QUERY, |label| label.name == name)
}

/// Decisions and ulp, regime by regime.
pub(crate) fn errors(origin: &str, errors: &[Errors]) -> String {
    let decisions = |summary: &Summary| match wrong_in_a_million(summary) {
        [0.0, 0.0, 0.0] => "0".to_owned(),
        wrong => wrong.map(|x| format!("{x:.0}")).join(" / "),
    };
    let of_t = |summary: &Summary| {
        let Some(own) = summary.ulp else { return "none found".to_owned() };
        let percent = 100.0 * summary.rounded as f64 / summary.hits as f64;
        // Only when all are rounded correctly is 100 % written.
        let percent = if percent < 100.0 { percent.min(99.99) } else { percent };
        let digits = if percent > 99.0 && percent < 100.0 { 2 } else { 0 };
        format!("{} ({percent:.digits$} %)", ulp(own))
    };
    format!(
        "# Error of the tiers\n\n{origin}\n\nOne ray, one sphere, {} cases a regime, held against an oracle of big integers; \
         the same in all lanes and at all levels. `plain geometric` and `plain f64` are no tiers but marks.\n\n\
         Wrong decisions in a million rays: hits that are misses / misses that are hits / the other root.\n\n{}\n\
         Error of t in ulp where the decision is right: median / p99.9 / max (true hits whose t is correctly rounded).\n\n{}",
        errors[0].of[0].rays,
        by_regime(errors, decisions),
        by_regime(errors, of_t)
    )
}

fn by_regime(errors: &[Errors], cell: impl Fn(&Summary) -> String) -> String {
    let mut table = Table::new(1, &format!("regime | {}", NAMES.join(" | ")));
    for Errors { regime, of } in errors {
        table.row([(*regime).to_owned()].into_iter().chain(of.iter().map(&cell)));
    }
    table.0
}

/// Times of one build.
pub(crate) fn speed((origin, build): (&str, &str), lists: &[Measured]) -> String {
    let names = lists.iter().map(name).collect::<Vec<_>>().join(" | ");
    let mut table = Table::new(2, &format!(" | lanes | {names}"));
    for label in lists[0].labels() {
        let fast = Label { name: Tier::Fast.as_str(), ..label.clone() };
        let is_other_tier =
            label.name != fast.name && Tier::ALL.map(Tier::as_str).contains(&label.name);
        let time = |list: &Measured| {
            let time = list.time_a_test(label).map(|time| format!("{:.3}", time.middle));
            let ratio = list.ratio(label, &fast, QUERY).filter(|_| is_other_tier);
            cell(time) + &cell(ratio.map(|ratio| format!(" ({:.2})", ratio.middle)))
        };
        let names = [label.name, label.lanes].map(str::to_owned);
        table.row(names.into_iter().chain(lists.iter().map(time)));
    }
    format!(
        "# Speed of the tiers, {build} build\n\n{origin}\n\nNanoseconds a ray-sphere test of brute force, one thread, medians of \
         {} interleaved rounds; in brackets the time by that of `fast` in the same lanes and rounds. Levels have sixteen \
         lanes.\n\n{}{}",
        lists[0].rounds(),
        table.0,
        // In any other build the levels have wider lanes than the probes.
        if build == "native" { limit(lists) } else { String::new() }
    )
}

/// The share of the machine's arithmetic that brute force reaches.
fn limit(lists: &[Measured]) -> String {
    let mut table = Table::new(
        3,
        "tier | rays, spheres | lanes | share of the FMA limit | of the filter's floor | \
         of the operations of a test",
    );
    // Only scenes without ground, in which not every line hits.
    for list in lists.iter().filter(|list| list.scene.parse::<usize>().is_ok()) {
        for label in Tier::ALL.into_iter().filter_map(|tier| quickest(list, tier.as_str())) {
            let share = |(probe, operations)| {
                let ratio = list.ratio(quickest(list, probe)?, label, QUERY)?;
                Some(ratio.times(operations))
            };
            let shares = [(FUSED, TEXTBOOK), (FUSED, FILTER), (MIX, 1.0)].map(share).map(cell);
            let names = [label.name, &name(list), label.lanes].map(str::to_owned);
            table.row(names.into_iter().chain(shares));
        }
    }
    format!(
        "\nThe FMA limit of a textbook test is {TEXTBOOK} fused operations, the floor of the kernel's own filter \
         {FILTER}.\n\n{}",
        table.0
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::kernel::Kernel;
    use crate::measure::Plan;
    use spherule_tests::scenes::{Kind, small};
    use std::time::Duration;

    #[test]
    fn the_share_of_the_limit_is_a_native_build_s() {
        let scene = small::cube("64", 64);
        let (time, rounds, sample) = (Duration::ZERO, 1..=1, Duration::ZERO);
        let plan = Plan { queries: &[QUERY], time, rounds, rays: usize::MAX, sample };
        let truth = Kernel::new(&scene, &scene.tree()).truth();
        let lists = [Measured::take((&scene, Kind::Primary), &[], &truth, &plan)];
        for (build, has_limit) in [("plain", false), ("native", true)] {
            let page = speed(("", build), &lists);
            assert!(page.starts_with(&format!("# Speed of the tiers, {build} build\n")), "{page}");
            assert_eq!(page.contains("FMA limit"), has_limit, "{page}");
        }
    }
}
