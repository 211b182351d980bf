//! Tells the linker the memory of the boards, and what a module exports.

fn main() {
    let of_cargo = |name: &str| std::env::var(name).expect("cargo sets it");
    println!("cargo:rerun-if-changed=memory.x");
    let target = of_cargo("TARGET");
    if target.starts_with("thumb") {
        println!("cargo:rustc-link-search={}", of_cargo("CARGO_MANIFEST_DIR"));
        println!("cargo:rustc-link-arg-bins=-Tlink.x");
    }
    if target.starts_with("wasm32") {
        for symbol in ["run", "text", "length"] {
            println!("cargo:rustc-link-arg-bins=--export={symbol}");
        }
    }
}
