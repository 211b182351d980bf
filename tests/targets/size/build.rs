//! Builds a tree as data, and tells the linker the memory of the boards.

fn main() {
    let of_cargo = |name: &str| std::env::var(name).expect("cargo sets it");
    let source = spherule_baking::source();
    std::fs::write(format!("{}/baked.rs", of_cargo("OUT_DIR")), source).expect("cargo's place");
    println!("cargo:rerun-if-changed=../memory.x");
    if of_cargo("TARGET").starts_with("thumb") {
        println!("cargo:rustc-link-search={}/..", of_cargo("CARGO_MANIFEST_DIR"));
        println!("cargo:rustc-link-arg-bins=-Tlink.x");
    }
}
