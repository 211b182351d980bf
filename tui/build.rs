//! Tells the program which compiler built it: `spherule tradeoff` reports it.

use std::env;
use std::process::Command;

fn main() {
    let compiler = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = Command::new(compiler).arg("-V").output().ok();
    let version = version.and_then(|output| String::from_utf8(output.stdout).ok());
    let version = version.as_deref().map_or("unknown", str::trim);
    println!("cargo::rustc-env=SPHERULE_RUSTC={version}");
    println!("cargo::rerun-if-changed=build.rs");
}
