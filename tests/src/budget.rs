//! The one budget table: for each tier and regime, wrong hits, wrong misses and ulp.
//!
//! Seeds are fixed and answers have the same bits everywhere, so figures are exact: a test fails
//! if a tier does worse than the [table] says, and if it does better, so that
//! the table never promises less than is true. After a change of a tier
//!
//! ```text
//! cargo test -p spherule-tests -- --ignored pin_budget
//! ```
//!
//! writes the table again and keeps the reasons; `git diff` then says what the change was worth. A reason says why a
//! figure is what it is, and is part of the review.

use crate::tally::{self, Errors, Summary};
use crate::vectors;
use spherule_kernel::{Intersect, SphereList, Tier};
use spherule_referee::case::Case;
use spherule_referee::families::HARD;
use spherule_referee::measured::MEASURED;
use std::fmt::Write;
use std::fs;

/// Where the cases of a row come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Set {
    /// [`MEASURED`], 50,000 cases a regime.
    Measured,
    /// [`HARD`], 5,000 cases a regime.
    Hard,
    /// The [vectors], if they are present: some 4,500 cases a regime.
    Vectors,
}

/// All sets, in the order of the table.
pub const SETS: [Set; 3] = [Set::Measured, Set::Hard, Set::Vectors];

/// What a tier gets wrong on a regime.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Where the cases come from.
    pub set: Set,
    /// The regime's name.
    pub regime: String,
    /// The tier's name.
    pub tier: String,
    /// The numbers that [`FIGURES`] names.
    pub figures: [u64; FIGURES.len()],
    /// What was measured on 10^6 rays of its own for the form that is the tier's mark: wrong hits / misses in ppm, then
    /// ulp median / p99.9 / max.
    pub mark: String,
    /// Why the figures are what they are.
    pub reason: String,
}

/// The names of a row's figures.
pub const FIGURES: [&str; 9] = [
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

impl Row {
    /// How many hits, misses and roots are wrong.
    #[must_use]
    pub const fn wrong(&self) -> [u64; 3] {
        let [_, _, hits, misses, roots, ..] = self.figures;
        [hits, misses, roots]
    }

    /// The largest error in ulp.
    #[must_use]
    pub const fn max_ulp(&self) -> u64 {
        self.figures[7]
    }

    fn is_of(&self, other: &Self) -> bool {
        (self.set, &self.regime, &self.tier) == (other.set, &other.regime, &other.tier)
    }
}

/// The path of the table.
const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/budget.txt");

/// The table's file.
///
/// # Panics
/// If it cannot be read.
#[must_use]
pub fn read() -> String {
    fs::read_to_string(PATH).expect("tests/cases/budget.txt")
}

/// The pinned table.
///
/// # Panics
/// With the line, if one is not a row of the table.
#[must_use]
pub fn table() -> Vec<Row> {
    let text = read();
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| parse(line).unwrap_or_else(|| panic!("no row: {line}"))).collect()
}

fn parse(line: &str) -> Option<Row> {
    let mut columns = line.split('\t').map(str::to_owned);
    let set = columns.next()?;
    let set = SETS.into_iter().find(|known| format!("{known:?}") == set)?;
    let (regime, tier) = (columns.next()?, columns.next()?);
    let figures = columns.next()?;
    let figures = figures.split(' ').map(str::parse).collect::<Result<Vec<u64>, _>>().ok()?;
    let (mark, reason) = (columns.next()?, columns.next()?);
    Some(Row { set, regime, tier, figures: figures.try_into().ok()?, mark, reason })
}

/// The text of the table's file with these rows. Marks and reasons are kept.
///
/// A set that was not measured keeps its rows.
#[must_use]
pub fn written(fresh: &[Row]) -> String {
    let (old, mut text) = (read(), String::new());
    for line in old.lines().filter(|line| line.starts_with('#')) {
        let _ = writeln!(text, "{line}");
    }
    let table = table();
    for set in SETS {
        let rows = if fresh.iter().any(|row| row.set == set) { fresh } else { &table };
        for row in rows.iter().filter(|row| row.set == set) {
            let Row { regime, tier, mark, reason, .. } = row;
            let figures = row.figures.map(|figure| figure.to_string()).join(" ");
            let _ = writeln!(text, "{set:?}\t{regime}\t{tier}\t{figures}\t{mark}\t{reason}");
        }
    }
    text
}

/// Writes [the file](written).
///
/// # Panics
/// If it cannot be written.
pub fn pin(fresh: &[Row]) {
    fs::write(PATH, written(fresh)).expect("a writable folder");
}

/// Measures every tier on every regime of the set; `None` if the set is absent.
#[must_use]
pub fn measure(set: Set) -> Option<Vec<Row>> {
    let rows = match set {
        Set::Measured => {
            MEASURED.iter().flat_map(|r| measure_cases(set, r.name, r.cases(50_000))).collect()
        }
        Set::Hard => HARD.iter().flat_map(|r| measure_cases(set, r.name, r.cases(5_000))).collect(),
        Set::Vectors => {
            let vectors = vectors::read()?;
            let cases = |number: u8| {
                let own = vectors.iter().filter(move |vector| vector.regime == number);
                own.map(|vector| vector.case)
            };
            HARD.iter().flat_map(|r| measure_cases(set, r.name, cases(r.number))).collect()
        }
    };
    Some(rows)
}

/// Asks as users do: a list of one sphere.
fn measure_cases(set: Set, regime: &str, cases: impl Iterator<Item = Case>) -> Vec<Row> {
    let engines = Tier::ALL.map(|tier| {
        move |case: &Case| {
            let list = SphereList::from([case.sphere]);
            list.closest_hit(tier, &case.ray).map(|hit| hit.t)
        }
    });
    let table = table();
    let errors = tally::measure(cases, &engines.each_ref().map(|engine| engine as _));
    let row = |(tier, errors): (Tier, &Errors)| {
        let Summary { rays, hits, wrong_hits, wrong_misses, wrong_places, ulp, .. } =
            errors.summary();
        // Without hits the errors are zero.
        let ulp = ulp.unwrap_or_default();
        let [median, p999, max, place] = [ulp.median, ulp.p999, ulp.max, errors.place()];
        let figures =
            [rays, hits, wrong_hits, wrong_misses, wrong_places, median, p999, max, place];
        let (regime, tier) = (regime.to_owned(), tier.as_str().to_owned());
        let mut row =
            Row { set, regime, tier, figures, mark: String::new(), reason: String::new() };
        if let Some(pinned) = table.iter().find(|pinned| pinned.is_of(&row)) {
            row.mark.clone_from(&pinned.mark);
            row.reason.clone_from(&pinned.reason);
        }
        row
    };
    Tier::ALL.into_iter().zip(&errors).map(row).collect()
}

/// What is wrong with the table, a line each: figures exceeded, figures that promise less than is
/// true, rows without a reason, rows missing or left over.
#[must_use]
pub fn complaints(set: Set, fresh: &[Row]) -> Vec<String> {
    let (mut complaints, table) = (Vec::new(), table());
    for row in fresh {
        let name = format!("{:?}, {}, {}", set, row.regime, row.tier);
        let Some(pinned) = table.iter().find(|pinned| pinned.is_of(row)) else {
            complaints.push(format!("{name}: not in the table"));
            continue;
        };
        if pinned.reason.is_empty() {
            complaints.push(format!("{name}: no reason"));
        }
        for ((figure, is), was) in FIGURES.iter().zip(row.figures).zip(pinned.figures) {
            let word = match is.cmp(&was) {
                std::cmp::Ordering::Greater => "exceeds the table",
                std::cmp::Ordering::Less => "slack in the table",
                std::cmp::Ordering::Equal => continue,
            };
            complaints.push(format!("{name}: {figure}: {word}: {is}, pinned {was}"));
        }
    }
    let rows = table.iter().filter(|pinned| pinned.set == set).count();
    if rows != fresh.len() {
        complaints.push(format!("{set:?}: {rows} rows in the table, {} measured", fresh.len()));
    }
    complaints
}
