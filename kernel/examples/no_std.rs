//! What firmware does: spheres and their tree are data in flash, each ray is a call, and nothing is allocated.
//!
//! A host builds the tree, and writes its words as a source; the firmware loads them once, at its start. Here `main` is both. Without a
//! host the firmware builds the tree itself, once, in memory of its own.
//!
//! Builds without features (`--no-default-features`). `std` is here for `main` alone.

#![no_std]

extern crate std;

use spherule_kernel::{Bvh4, Hit, Intersect, Ray, Spheres, SpheresError, Stable, Vec3};
use std::boxed::Box;
use std::error::Error;
use std::println;

static X: [f32; 4] = [0.0, 2.0, -2.0, 0.0];
static Y: [f32; 4] = [0.0, 0.0, 0.0, 2.0];
static Z: [f32; 4] = [5.0, 6.0, 7.0, 8.0];
static RADIUS: [f32; 4] = [1.0, 1.0, 1.0, 1.0];
/// The words of a tree over so many spheres are known at build time.
const NEEDED: usize = Bvh4::needed(X.len());

fn spheres() -> Result<Spheres<'static>, SpheresError> {
    Spheres::new(&X, &Y, &Z, &RADIUS)
}

/// The closest hit along z, as firmware may compute it: no heap, no panic.
fn look(tree: &Bvh4<'_>, from: Vec3) -> Option<Hit> {
    tree.closest_hit(Stable, &Ray::new(from, Vec3::Z))
}

fn main() -> Result<(), Box<dyn Error>> {
    // On the host.
    let mut memory = [0; NEEDED];
    let words = Bvh4::build(spheres()?, &mut memory)?.words();
    println!("pub static TREE: [u32; {}] = {words:?};", words.len());

    // In the firmware: `load` refuses words that are no tree over these spheres.
    let tree = Bvh4::load(spheres()?, words)?;
    println!("{:?}", look(&tree, Vec3::new(2.0, 0.0, 0.0)));
    Ok(())
}
