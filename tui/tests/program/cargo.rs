//! What cargo is told of the program.

use std::process::Command;

/// Without a default, `cargo run`, the README's first command, compiles every crate of the workspace: that takes twice
/// as long.
#[test]
fn cargo_run_compiles_the_program_alone() {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--offline", "--format-version", "1"])
        .args(["--manifest-path", concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml")])
        .output()
        .expect("cargo runs");
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let packages = told["packages"].as_array().expect("packages");
    let defaults: Vec<_> =
        packages.iter().filter_map(|package| package["default_run"].as_str()).collect();
    assert_eq!(defaults, ["spherule"]);
}
