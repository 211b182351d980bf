//! The cases in files: our kept cases, and the vectors of another hand.

use spherule_referee::families::HARD;
use spherule_tests::{kept, oracle, vectors};
use std::path::PathBuf;

#[test]
fn the_file_is_what_generator_and_oracle_say() {
    // No `assert_eq!` of the texts, whose difference would fill the screen.
    let (kept, fresh) = (kept::read(), kept::write());
    let differing = kept.lines().zip(fresh.lines()).position(|(kept, fresh)| kept != fresh);
    assert_eq!(differing, None, "the first line (from 0) that differs");
    assert!(kept == fresh, "one is longer than the other");
}

#[test]
fn cases_go_round_and_have_the_oracle_s_answers() {
    let kept = kept::parse(&kept::read());
    assert_eq!(kept.len() as u64, 22 * kept::CASES_A_REGIME);
    for regime in HARD {
        let number = usize::from(regime.number);
        let cases = kept.iter().filter(|kept| kept.regime == number);
        for (kept, case) in cases.zip(regime.cases(kept::CASES_A_REGIME)) {
            assert_eq!(kept.case.bits(), case.bits());
            let answer = oracle::intersect(&case.ray, &case.sphere);
            assert_eq!(kept.expected.map(f32::to_bits), answer.map(f32::to_bits));
        }
    }
}

/// Run after a change of a generator: `cargo test -p spherule-tests -- --ignored keep_cases`.
#[test]
#[ignore = "writes tests/cases/regimes.txt"]
fn keep_cases() {
    std::fs::write(kept::path(), kept::write()).expect("a writable folder");
}

#[test]
#[should_panic(expected = "SPHERULE_VECTORS: no folder")]
fn what_must_be_there_is_not_skipped() {
    let _ = vectors::folder(Some(PathBuf::from("no/such/folder")));
}

#[test]
fn every_regime_has_its_cases() {
    let Some(vectors) = vectors::read() else { return };
    assert_eq!(vectors.len(), 100_000);
    for regime in HARD {
        let cases = vectors.iter().filter(|vector| vector.regime == regime.number).count();
        assert!(cases > 1000, "{regime:?}: {cases} cases");
    }
}
