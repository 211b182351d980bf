//! What the linker is told: the memory of the boards, and what a module exports. And a tree, built here, as data.

use spherule_kernel::{Bvh4, Spheres};
use std::fmt::Write;

fn main() {
    let of_cargo = |name: &str| std::env::var(name).expect("cargo sets it");
    println!("cargo:rerun-if-changed=memory.x");
    bake(&of_cargo("OUT_DIR"));
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

const COUNT: usize = 1000;

/// Writes a scene of many spheres, and its tree, as a source.
fn bake(place: &str) {
    let mut state = 7_u32;
    let mut number = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 24) as f32
    };
    let mut columns = [[0.0; COUNT]; 4];
    for sphere in 0..COUNT {
        let [x, y, z] = [(); 3].map(|()| 2.4 * number() - 1.2);
        let row = [x, y, z - 3.2, 0.03 + 0.06 * number()];
        columns.iter_mut().zip(row).for_each(|(column, number)| column[sphere] = number);
    }
    let [x, y, z, r] = &columns;
    let mut memory = vec![0; Bvh4::needed(COUNT)];
    let spheres = Spheres::new(x, y, z, r).expect("equal lengths");
    let words = Bvh4::build(spheres, &mut memory).expect("enough memory").words();
    let mut source = String::new();
    let count = words.len();
    writeln!(
        source,
        "/// Centres and radii.\npub static BAKED_SPHERES: [[f32; {COUNT}]; 4] = {columns:?};\n\
         /// What `Bvh4::words` said on the host.\npub static BAKED_TREE: [u32; {count}] = {words:?};"
    )
    .expect("a string");
    std::fs::write(format!("{place}/baked.rs"), source).expect("cargo's place");
}
