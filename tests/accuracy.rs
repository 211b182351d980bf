//! Each tier against the oracle: by the budget table.

use spherule_kernel::Tier;
use spherule_referee::case::Case;
use spherule_referee::ulp::step;
use spherule_tests::budget::{self, Row, SETS, Set};
use spherule_tests::tally::{Errors, Summary, Ulp};

fn check(set: Set) {
    let Some(fresh) = budget::measure(set) else { return };
    let complaints = budget::complaints(set, &fresh);
    assert!(
        complaints.is_empty(),
        "{}\n{} complaints; to pin what is measured now:\n\
         cargo test -p spherule-tests -- --ignored pin_budget\n",
        complaints.join("\n"),
        complaints.len(),
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

/// Measures every tier on every regime. Rows of the vectors are kept if the vectors are
/// absent.
#[test]
#[ignore = "writes tests/cases/budget.txt"]
fn pin_budget() {
    let fresh: Vec<_> = SETS.into_iter().filter_map(budget::measure).flatten().collect();
    budget::pin(&fresh);
}

/// `Stable`'s promise in its domain, away from grazing. A table that is pinned anew must still keep
/// it.
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
    let table = budget::table();
    for regime in domain {
        let is = |row: &&Row| row.regime == regime && row.tier == "stable";
        let row = table.iter().find(is).expect("a row of the table");
        assert_eq!(row.wrong(), [0; 3], "{regime}");
    }
}

/// `Exact`'s promise for every input.
#[test]
fn exact_is_exact_everywhere() {
    let table = budget::table();
    let rows: Vec<&Row> = table.iter().filter(|row| row.tier == "exact").collect();
    assert_eq!(rows.len(), table.len() / Tier::ALL.len());
    for row in rows {
        assert_eq!((row.wrong(), row.max_ulp()), ([0; 3], 0), "{}", row.regime);
    }
}

#[test]
fn what_is_not_measured_again_is_kept() {
    assert!(budget::written(&[]) == budget::read());
}

/// The half-line from (0, 0, -2) along (0, 0, 4).
fn case() -> Case {
    let numbers = [0.0, 0.0, -2.0, 0.0, 0.0, 4.0, 0.0, 9.0, 0.0, 0.0, 0.0, 1.0];
    Case::from_numbers(numbers)
}

#[test]
fn wrong_decisions_are_counted_by_their_kind() {
    let (mut errors, case) = (Errors::default(), case());
    errors.record(&case, None, None);
    errors.record(&case, None, Some(1.0));
    errors.record(&case, Some([-2.0, -1.0]), Some(1.0));
    errors.record(&case, Some([1.0, 2.0]), None);
    errors.record(&case, Some([1.0, 2.0]), Some(1.0));
    errors.record(&case, Some([0.25, 0.75]), Some(0.625));
    errors.record(&case, Some([-1.0, 2.0]), Some(2.0));
    errors.record(&case, Some([2.0, 2.0]), Some(2.0));
    let expected = Summary {
        rays: 8,
        hits: 5,
        wrong_hits: 2,
        wrong_misses: 1,
        wrong_places: 1,
        rounded: 3,
        ulp: Some(Ulp::default()),
    };
    assert_eq!(errors.summary(), expected);
}

#[test]
fn places_are_measured_in_the_scene() {
    // |p| = 2, |d| = 4: 2^-24 of the scene is 2^-25 of t.
    let (mut errors, case) = (Errors::default(), case());
    errors.record(&case, Some([0.25, 0.75]), Some(step(0.25, 1)));
    assert_eq!(errors.place(), 1);
    errors.record(&case, Some([0.25, 0.75]), Some(step(0.25, -12)));
    assert_eq!(errors.place(), 6);
    // The other root is another place; a tangent has none.
    errors.record(&case, Some([0.25, 0.75]), Some(f32::MAX));
    assert_eq!(errors.place(), 6);
    let tangent = Case::from_numbers([1.0, 0.0, -2.0, 0.0, 0.0, 4.0, 0.0, 9.0, 0.0, 0.0, 0.0, 1.0]);
    errors.record(&tangent, Some([0.5, 0.5]), Some(f32::MAX));
    assert_eq!(errors.place(), u64::MAX);
}
