//! `--again`: failures made smaller by the program that was judged.

use super::Files;
use crate::run::{file, printed, run, split, stderr};
use serde_json::Value;

#[test]
fn what_is_asked_again_is_smaller() {
    let files = Files::new("again", "--count 240 --family far-1e4", "fast");
    let program = env!("CARGO_BIN_EXE_spherule");
    let script = format!(
        "'{program}' trace --pairs --accuracy $TIER --spheres \"$1\" --rays \"$2\" --out-t \"$3\""
    );
    let script = file("judge-again.sh", script);
    let judge = files.judge("--pairs --json");
    let again = |command: &str| {
        run(split(&judge).into_iter().chain(["--again", command].map(str::to_owned)))
    };
    // Whatever a shell takes is a command.
    let report = printed(again(&format!("cd / && TIER=fast sh '{script}'")));
    let report: Value = serde_json::from_str(&report).expect("JSON");
    let digits = |failure: &Value| {
        failure["ray_hex"].to_string().len() + failure["spheres_hex"].to_string().len()
    };
    for kind in report["failures"].as_array().expect("a list") {
        let (worst, smallest) = (&kind["worst"], &kind["smallest"]);
        assert_eq!(worst.is_null(), smallest.is_null());
        assert!(worst.is_null() || digits(smallest) < digits(worst), "{smallest}");
    }
    // What is judged is told all the same.
    let fails = again("echo why >&2; false");
    let said = stderr(&fails);
    assert_eq!(fails.status.code(), Some(1), "{said}");
    assert!(said.starts_with("why\nspherule: --again: the command ends with"), "{said}");
    let judged: Value = serde_json::from_slice(&fails.stdout).expect("JSON");
    assert_eq!(judged["all"], report["all"]);
}
