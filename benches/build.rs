//! Tells the report what it was compiled with: a program cannot ask that of itself.

use std::env;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=CARGO_ENCODED_RUSTFLAGS");
    println!("cargo::rerun-if-env-changed=RUSTC");

    // Of the flags only those that choose instructions: others may hold paths of this machine.
    let flags = env::var("CARGO_ENCODED_RUSTFLAGS").unwrap_or_default();
    let about_target: Vec<_> = flags
        .split('\u{1f}')
        .map(|flag| flag.trim_start_matches("-C"))
        .filter(|flag| flag.starts_with("target-cpu=") || flag.starts_with("target-feature="))
        .collect();
    println!("cargo::rustc-env=SPHERULE_TARGET_FLAGS={}", about_target.join(" "));

    let rustc = env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let version = Command::new(rustc).arg("--version").output();
    let version = version.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    println!(
        "cargo::rustc-env=SPHERULE_RUSTC={}",
        version.unwrap_or_else(|_| "unknown".to_owned())
    );
}
