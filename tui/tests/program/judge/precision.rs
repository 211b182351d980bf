//! Answers in double precision, and rules about them.

use super::{Files, KINDS};
use crate::run::file;
use serde_json::Value;

#[test]
fn double_answers_and_rules() {
    let files = Files::new("double", "--count 480 --family tangent,ordinary", "exact");
    let files = files.double();
    let wrong = |report: &Value, by: &str| {
        KINDS.iter().map(|kind| report["all"][by][kind].as_u64().expect("a count")).sum::<u64>()
    };
    assert_eq!(wrong(&files.report("--pairs"), "by_rules"), 0);
    let rules = file("judge-double.toml", "tangents = \"miss\"\ninterval = \"open-start\"\n");
    let report = files.report(&format!("--pairs --rules {rules}"));
    assert!(wrong(&report, "by_rules") > 100 && wrong(&report, "by_contract") == 0, "{report}");
}

/// In double precision a root that is rounded to an end of the interval leaves the answer open.
#[test]
fn precision_is_that_of_the_answers_where_rules_state_none() {
    let files = Files::new("precision", "--count 240 --family interval-at-root", "exact").double();
    let open = |options: &str| {
        let report = files.report(&format!("--pairs {options}"));
        report["all"]["by_rules"]["open"].as_u64().expect("a count")
    };
    let usual = open("");
    assert!(usual > 0);
    for (rules, expected) in
        [("ulp = 1\n", usual), ("precision = \"f64\"\n", usual), ("precision = \"f32\"\n", 0)]
    {
        let path = file("judge-precision.toml", rules);
        assert_eq!(open(&format!("--rules {path}")), expected, "{rules}");
    }
}
