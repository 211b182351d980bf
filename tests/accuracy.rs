//! Each tier against the oracle: by the budget table, and on every case that is kept.

use spherule_tests::budget::table::TABLE;
use spherule_tests::budget::{self, Set};
use spherule_tests::kept;
use spherule_tests::oracle;
use spherule_tests::tally::Summary;

fn check(set: Set) {
    let Some(fresh) = budget::measure(set) else { return };
    let complaints = budget::complaints(set, &fresh);
    assert!(
        complaints.is_empty(),
        "{}\n{} complaints; measured now:\n{}\nTo pin these figures:\n\
         cargo run --profile test -p spherule-tests --example pin_budget\n",
        complaints.join("\n"),
        complaints.len(),
        budget::markdown(&fresh),
    );
}

#[test]
fn measured_regimes_are_on_budget() {
    check(Set::Measured);
}

#[test]
fn hard_regimes_are_on_budget() {
    check(Set::Hard);
}

#[test]
fn vectors_are_on_budget() {
    check(Set::Vectors);
}

/// What `Stable` promises in its domain, away from grazing: a table that is pinned anew must
/// still keep it.
#[test]
fn stable_decides_right_in_its_domain() {
    let domain = [
        "ordinary",
        "dist/r 1e2",
        "dist/r 1e4",
        "dist/r 1e6",
        "grazing 2^-8",
        "grazing 2^-12",
        "|d| 2^20",
        "|d| 2^-20",
        "|d| 2^60",
        "|d| 2^-60",
        "translated 1e6",
    ];
    for regime in domain {
        let row = TABLE.iter().find(|row| row.regime == regime && row.tier == "stable");
        let Summary { wrong_hits, wrong_misses, wrong_roots, .. } =
            row.expect("a row of the table").summary;
        assert_eq!([wrong_hits, wrong_misses, wrong_roots], [0; 3], "{regime}");
    }
}

/// What `Exact` promises for every input.
#[test]
fn exact_is_exact_everywhere() {
    let rows: Vec<_> = TABLE.iter().filter(|row| row.tier == "exact").collect();
    assert_eq!(rows.len(), TABLE.len() / 3);
    for row in rows {
        let Summary { wrong_hits, wrong_misses, wrong_roots, max, .. } = row.summary;
        assert_eq!([wrong_hits, wrong_misses, wrong_roots], [0; 3], "{}", row.regime);
        assert_eq!(max, 0, "{}", row.regime);
    }
}

#[test]
fn kept_cases_have_the_oracle_s_answers() {
    for (index, kept) in kept::parse(&kept::read()).iter().enumerate() {
        let answer = oracle::intersect(&kept.case.ray, &kept.case.sphere);
        let (answer, expected) = (answer.map(f32::to_bits), kept.expected.map(f32::to_bits));
        assert_eq!(answer, expected, "case {index}: {:?}", kept.case);
    }
}
