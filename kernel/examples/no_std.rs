//! What firmware does: spheres in static memory, a tree in arrays, nothing allocated.
//!
//! Builds without features (`--no-default-features`). `std` is here for `main` alone.

#![no_std]

extern crate std;

use spherule_kernel::{Bvh, BvhNode, Hit, Intersect, Ray, Spheres, Stable, TooSmall, Vec3};

static X: [f32; 4] = [0.0, 2.0, -2.0, 0.0];
static Y: [f32; 4] = [0.0, 0.0, 0.0, 2.0];
static Z: [f32; 4] = [5.0, 6.0, 7.0, 8.0];
static RADIUS: [f32; 4] = [1.0, 1.0, 1.0, 1.0];
/// The memory that a tree over so many spheres needs is known at build time.
const NEEDED: spherule_kernel::BvhSize = Bvh::needed(X.len());

/// The closest hit along z, as firmware may compute it: no heap, no panic.
fn look(from: Vec3) -> Result<Option<Hit>, TooSmall> {
    let Ok(spheres) = Spheres::new(&X, &Y, &Z, &RADIUS) else { return Ok(None) };
    let mut nodes = [BvhNode::EMPTY; NEEDED.nodes];
    let (mut places, mut indices) = ([[0.0; 4]; NEEDED.places], [0; NEEDED.places]);
    let tree = Bvh::build(spheres, &mut nodes, &mut places, &mut indices)?;
    Ok(tree.closest_hit(Stable, &Ray::new(from, Vec3::Z)))
}

fn main() {
    std::println!("{:?}", look(Vec3::new(2.0, 0.0, 0.0)));
}
