//! The cases in files: our kept cases, and the vectors of another hand.
//!
//! `tests/cases/regimes.txt` holds one case a line: the regime's number, the bits of the twelve numbers of a case, and
//! the bits of the hit's t, or `miss`, in hexadecimal. Lines that start with `#` say where the cases come from. The
//! file is compared as text, so a change of generator or oracle is noticed.

use spherule_referee::families::HARD;
use spherule_tests::{oracle, vectors};
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/regimes.txt");

/// The text that generator and oracle would write.
fn write() -> String {
    let mut text = String::from(
        "# Cases of the 22 hard families: the generator of tests/referee/src/families.rs, answered by the\n\
         # integer oracle of tests/src/oracle.rs. Made again by:\n\
         #   cargo test -p spherule-tests -- --ignored keep_cases\n\
         # A line: regime; origin x y z, direction x y z, t_min, t_max, centre x y z, radius; t\n\
         # of the hit or miss. Numbers are the bits of single-precision floats, hexadecimal.\n",
    );
    for regime in HARD {
        let _ = writeln!(text, "# {} {}", regime.number, regime.name);
        for case in regime.cases(30) {
            let _ = write!(text, "{}", regime.number);
            for bits in case.bits() {
                let _ = write!(text, " {bits:08x}");
            }
            let _ = match oracle::intersect(&case.ray, &case.sphere) {
                Some(t) => writeln!(text, " {:08x}", t.to_bits()),
                None => writeln!(text, " miss"),
            };
        }
    }
    text
}

#[test]
fn the_file_is_what_generator_and_oracle_say() {
    // No `assert_eq!` of the texts, whose difference would fill the screen.
    let (kept, fresh) = (fs::read_to_string(PATH).expect(PATH), write());
    let differing = kept.lines().zip(fresh.lines()).position(|(kept, fresh)| kept != fresh);
    assert_eq!(differing, None, "the first line (from 0) that differs");
    assert!(kept == fresh, "one is longer than the other");
}

/// Run after a change of a generator: `cargo test -p spherule-tests -- --ignored keep_cases`.
#[test]
#[ignore = "writes tests/cases/regimes.txt"]
fn keep_cases() {
    fs::write(PATH, write()).expect("a writable folder");
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
