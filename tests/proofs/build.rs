//! Tells the kernel's source that its proofs are there.

fn main() {
    println!("cargo::rustc-cfg=proofs");
    println!("cargo::rerun-if-changed=build.rs");
}
