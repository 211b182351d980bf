//! The one budget table: tier and regime, against wrong hits, wrong misses and ulp.
//!
//! Seeds are fixed and answers have the same bits everywhere, so figures are exact: a test fails
//! where a tier does worse than the [table](table::TABLE) says, and where it does better, so that
//! the table never promises less than is true. After a change of a tier
//!
//! ```text
//! cargo run --profile test -p spherule-tests --example pin_budget
//! ```
//!
//! writes the table again, reasons kept, and prints it as Markdown; `git diff` then says what the
//! change was worth. A reason says why the figure is what it is, and is part of the review.

pub mod table;

use crate::case::Case;
use crate::measured::MEASURED;
use crate::oracle;
use crate::regimes::REGIMES;
use crate::tally::{Summary, Tally};
use crate::vectors;
use spherule_kernel::{Accuracy, Exact, Fast, Spheres, Stable, nearest_hit};
use std::fmt::Write;

/// Where the cases of a row come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Set {
    /// [`MEASURED`], 50,000 cases a regime.
    Measured,
    /// [`REGIMES`], 5,000 cases a regime.
    Hard,
    /// The [vectors], where they are present: some 4,500 a regime.
    Vectors,
}

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Pinned {
    /// Where the cases come from.
    pub set: Set,
    /// The regime's name.
    pub regime: &'static str,
    /// The tier's name.
    pub tier: &'static str,
    /// What it comes to.
    pub summary: Summary,
    /// What `NUMERICS.md` section 6 measured of the form that is the tier's mark, on 10^6 rays
    /// of its own: wrong hits / misses in ppm, then ulp median / p99.9 / max.
    pub mark: &'static str,
    /// Why it is what it is.
    pub reason: &'static str,
}

/// What a tier does on a regime, measured now.
#[derive(Clone, Copy, Debug)]
pub struct Fresh {
    /// Where the cases come from.
    pub set: Set,
    /// The regime's name.
    pub regime: &'static str,
    /// The tier's name.
    pub tier: &'static str,
    /// What it comes to.
    pub summary: Summary,
}

/// A tier that can be asked for the t of a hit.
type Tier = (&'static str, fn(&Case) -> Option<f32>);

/// Every tier that has a budget.
const TIERS: [Tier; 3] = [
    (Fast::NAME, answer::<Fast>),
    (Stable::NAME, answer::<Stable>),
    (Exact::NAME, answer::<Exact>),
];

/// The tier's answer, by the door that users take.
///
/// # Panics
/// Never: one sphere is a list.
#[must_use]
pub fn answer<A: Accuracy>(case: &Case) -> Option<f32> {
    let [x, y, z] = case.sphere.center.to_array().map(|x| [x]);
    let radius = [case.sphere.radius];
    let spheres = Spheres::new(&x, &y, &z, &radius).expect("equal lengths");
    nearest_hit::<A>(&case.ray, spheres).map(|hit| hit.t)
}

/// Every tier on every regime of the set; nothing where the set is absent.
#[must_use]
pub fn measure(set: Set) -> Option<Vec<Fresh>> {
    let rows = match set {
        Set::Measured => {
            let rows = |m: &crate::measured::Measured| measure_cases(set, m.name, m.cases(50_000));
            MEASURED.iter().flat_map(rows).collect()
        }
        Set::Hard => {
            REGIMES.iter().flat_map(|r| measure_cases(set, r.name, r.cases(5_000))).collect()
        }
        Set::Vectors => {
            let vectors = vectors::read()?;
            let rows = |regime: &crate::regimes::Regime| {
                let own = vectors.iter().filter(|vector| vector.regime == regime.number);
                measure_cases(set, regime.name, own.map(|vector| vector.case))
            };
            REGIMES.iter().flat_map(rows).collect()
        }
    };
    Some(rows)
}

fn measure_cases(set: Set, regime: &'static str, cases: impl Iterator<Item = Case>) -> Vec<Fresh> {
    let mut tallies = TIERS.map(|_| Tally::default());
    for case in cases {
        let roots = oracle::roots(&case.ray, &case.sphere);
        for ((_, answer), tally) in TIERS.iter().zip(&mut tallies) {
            tally.record(&case, roots, answer(&case));
        }
    }
    let rows = TIERS.iter().zip(&tallies);
    rows.map(|(&(tier, _), tally)| Fresh { set, regime, tier, summary: tally.summary() }).collect()
}

/// What is wrong with the table, a line each: figures exceeded, figures that promise less than is
/// true, rows without a reason, rows missing or left over.
#[must_use]
pub fn complaints(set: Set, fresh: &[Fresh]) -> Vec<String> {
    let mut complaints = Vec::new();
    for row in fresh {
        let name = format!("{:?}, {}, {}", set, row.regime, row.tier);
        let Some(pinned) = find(row) else {
            complaints.push(format!("{name}: not in the table"));
            continue;
        };
        if pinned.reason.is_empty() {
            complaints.push(format!("{name}: no reason"));
        }
        let (is, was) = (figures(&row.summary), figures(&pinned.summary));
        for ((figure, is), was) in FIGURES.iter().zip(is).zip(was) {
            let word = match is.cmp(&was) {
                std::cmp::Ordering::Greater => "exceeds the table",
                std::cmp::Ordering::Less => "slack in the table",
                std::cmp::Ordering::Equal => continue,
            };
            complaints.push(format!("{name}: {figure}: {word}: {is}, pinned {was}"));
        }
    }
    let rows = table::TABLE.iter().filter(|pinned| pinned.set == set).count();
    if rows != fresh.len() {
        complaints.push(format!("{set:?}: {rows} rows in the table, {} measured", fresh.len()));
    }
    complaints
}

fn find(row: &Fresh) -> Option<&'static Pinned> {
    let same = |pinned: &&Pinned| {
        (pinned.set, pinned.regime, pinned.tier) == (row.set, row.regime, row.tier)
    };
    table::TABLE.iter().find(same)
}

const FIGURES: [&str; 9] = [
    "cases",
    "hits",
    "wrong hits",
    "wrong misses",
    "wrong roots",
    "median ulp",
    "p99.9 ulp",
    "max ulp",
    "max place",
];

fn figures(summary: &Summary) -> [u64; 9] {
    let Summary { cases, hits, wrong_hits, wrong_misses, wrong_roots, median, p999, max, place } =
        *summary;
    let [cases, hits, wrong_hits, wrong_misses, wrong_roots] =
        [cases, hits, wrong_hits, wrong_misses, wrong_roots].map(u64::from);
    [cases, hits, wrong_hits, wrong_misses, wrong_roots, median, p999, max, place]
}

/// The file `table.rs` with these figures, marks and reasons kept.
///
/// A set that was not measured keeps its rows.
#[must_use]
pub fn source(fresh: &[Fresh]) -> String {
    let mut text = String::from(
        "//! The figures of the [budget](super), written by its example `pin_budget`: change\n\
         //! reasons here, figures never by hand.\n\
         //!\n\
         //! Figures: cases, hits in truth, wrong hits, wrong misses, wrong roots, ulp of t:\n\
         //! median, p99.9, max, and the largest error of the hit's place in 2^-24 of the scene.\n\
         \n\
         use super::Set::{Hard, Measured, Vectors};\n\
         use super::{Pinned, pin};\n\
         \n\
         /// Tier and regime: what it comes to, the mark, and why.\n\
         #[rustfmt::skip] // a row a line\n\
         pub const TABLE: &[Pinned] = &[\n",
    );
    for set in [Set::Measured, Set::Hard, Set::Vectors] {
        let mut write_row = |row: &Fresh| {
            let (mark, reason) = find(row).map_or(("", ""), |pinned| (pinned.mark, pinned.reason));
            let figures = figures(&row.summary).map(grouped).join(", ");
            let Fresh { regime, tier, .. } = row;
            let _ = writeln!(
                text,
                "    pin({set:?}, {regime:?}, {tier:?}, [{figures}], {mark:?}, {reason:?}),"
            );
        };
        if fresh.iter().any(|row| row.set == set) {
            fresh.iter().filter(|row| row.set == set).for_each(&mut write_row);
        } else {
            let kept = table::TABLE.iter().filter(|pinned| pinned.set == set);
            for &Pinned { set, regime, tier, summary, .. } in kept {
                write_row(&Fresh { set, regime, tier, summary });
            }
        }
    }
    text.push_str("];\n");
    text
}

/// A literal with its digits in threes.
fn grouped(figure: u64) -> String {
    let digits = figure.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('_');
        }
        text.push(digit);
    }
    text
}

/// The table for people: a row a regime, a group of columns a tier.
#[must_use]
pub fn markdown(fresh: &[Fresh]) -> String {
    let mut text = String::from(
        "| regime (true hits of cases) | tier | wrong hits / misses / roots | ulp median / p99.9 / max | \
         place | mark (ppm; ulp) | why |\n|---|---|---|---|---|---|---|\n",
    );
    for row in fresh {
        let Summary {
            cases,
            hits,
            wrong_hits,
            wrong_misses,
            wrong_roots,
            median,
            p999,
            max,
            place,
        } = row.summary;
        let (mark, reason) = find(row).map_or(("", ""), |pinned| (pinned.mark, pinned.reason));
        let _ = writeln!(
            text,
            "| {} ({hits} of {cases}) | {} | {wrong_hits} / {wrong_misses} / {wrong_roots} \
             | {median} / {p999} / {max} | {place} | {mark} | {reason} |",
            row.regime, row.tier
        );
    }
    text
}

/// A row.
const fn pin(
    set: Set,
    regime: &'static str,
    tier: &'static str,
    figures: [u64; 9],
    mark: &'static str,
    reason: &'static str,
) -> Pinned {
    let [cases, hits, wrong_hits, wrong_misses, wrong_roots, median, p999, max, place] = figures;
    let summary = Summary {
        cases: count(cases),
        hits: count(hits),
        wrong_hits: count(wrong_hits),
        wrong_misses: count(wrong_misses),
        wrong_roots: count(wrong_roots),
        median,
        p999,
        max,
        place,
    };
    Pinned { set, regime, tier, summary, mark, reason }
}

const fn count(figure: u64) -> u32 {
    assert!(figure <= u32::MAX as u64);
    figure as u32
}
