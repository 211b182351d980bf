//! A tree that is built on the host and linked as data.

use spherule_kernel::{Bvh4, Spheres};
use std::fmt::Write;

const COUNT: usize = 1000;

/// Returns Rust source with a scene of many spheres, and its tree.
///
/// # Panics
///
/// Never: columns have equal lengths, and a string takes everything that is written.
#[must_use]
pub fn source() -> String {
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
    source
}
