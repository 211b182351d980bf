//! The most expensive cases: those that doubles cannot decide.

use super::memory::Memory;
use super::program_name::{NAME, by_tier};
use core::hint::black_box;
use spherule_kernel::{
    Bvh4, Exact, Fast, Geometric, Intersect, Ray, Sphere, Spheres, Stable, Vec3, roots,
};

/// A tangent, a tie, and the most expensive case of the kernel's cost test: o, d, c and r.
static HARD: [[f32; 10]; 3] = [
    [-3.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 16_777_220.0, 0.0, 0.0, 1.0],
    [
        4.304_508_3e17,
        8.930_645_5e-30,
        8_205.748,
        594.441_3,
        -6.914_829e26,
        7.052_379e-36,
        -6_261.860_4,
        2_136.177,
        -3.241_990_3e-26,
        1.324_018_2e38,
    ],
];
/// Beside each sphere, another that is hit at the same t: from a million away, f32 tells no smaller differences apart.
static TIED: [[f32; 2]; 4] = [[0.0; 2], [0.0; 2], [1e6; 2], [1.0, 1.015_625]];

/// What doubles cannot decide: tangents and ties.
pub(super) fn by_list() {
    for [ox, oy, oz, dx, dy, dz, x, y, z, r] in black_box(&HARD) {
        let ray = Ray::new(Vec3::new(*ox, *oy, *oz), Vec3::new(*dx, *dy, *dz));
        let columns = [x, y, z, r].map(core::slice::from_ref);
        let Ok(spheres) = Spheres::new(columns[0], columns[1], columns[2], columns[3]) else {
            return;
        };
        black_box(by_tier!(tier => spheres.closest_hit(tier, &ray)));
    }
    let [x, y, z, r] = black_box(&TIED);
    let Ok(spheres) = Spheres::new(x, y, z, r) else { return };
    let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    black_box(by_tier!(tier => spheres.closest_hit(tier, &ray)));
}

/// The same by trees.
pub(super) fn by_tree() {
    static WORDS: Memory<[u32; Bvh4::needed(1)]> = Memory::new([0; Bvh4::needed(1)]);
    let words = WORDS.lend();
    for [ox, oy, oz, dx, dy, dz, x, y, z, r] in black_box(&HARD) {
        let ray = Ray::new(Vec3::new(*ox, *oy, *oz), Vec3::new(*dx, *dy, *dz));
        let columns = [x, y, z, r].map(core::slice::from_ref);
        let Ok(spheres) = Spheres::new(columns[0], columns[1], columns[2], columns[3]) else {
            return;
        };
        if let Ok(tree) = Bvh4::build(spheres, words) {
            black_box(by_tier!(tier => tree.closest_hit(tier, &ray)));
        }
    }
}

/// The same for both roots.
pub(super) fn both_roots() {
    for [ox, oy, oz, dx, dy, dz, x, y, z, r] in black_box(&HARD) {
        let ray = Ray::new(Vec3::new(*ox, *oy, *oz), Vec3::new(*dx, *dy, *dz));
        let sphere = Sphere { center: Vec3::new(*x, *y, *z), radius: *r };
        black_box(by_tier!(tier => roots(tier, &ray, &sphere)));
    }
}
