//! The linker script of the run-time, and where it finds the board's memory.

fn main() {
    println!("cargo:rerun-if-changed=memory.x");
    println!(
        "cargo:rustc-link-search={}",
        std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets it")
    );
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
}
