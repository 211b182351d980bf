//! The most expensive cases: those that doubles cannot decide.

use super::memory::Memory;
use super::program_name::{NAME, by_tier, ends_with};
use core::f32::consts::SQRT_2;
use core::hint::black_box;
use spherule_kernel::{
    Accuracy, Bvh4, Exact, Fast, Geometric, Intersect, Ray, Side, Sphere, Spheres, Stable, Vec3,
    surface,
};
use spherule_targets::cases::{Case, HARD};

/// Beside each sphere, another that is hit at the same t: from a million away, f32 tells no smaller differences apart.
static TIED: [[f32; 2]; 4] = [[0.0; 2], [0.0; 2], [1e6; 2], [1.0, 1.015_625]];
/// Whether rays are spawned, too.
const SPAWNS: bool = ends_with("_spawn");
/// From half a step above the tangent's point, 2^-48, this is nearly a tangent again: exact sums tell whether the spawned ray meets the
/// sphere.
const BACK: Vec3 = Vec3::new(1.0, -0.5 * f32::EPSILON * SQRT_2, 0.0);

fn list_of(Sphere { center, radius }: &Sphere) -> Option<Spheres<'_>> {
    let [x, y, z, r] = [&center.x, &center.y, &center.z, radius].map(core::slice::from_ref);
    Spheres::new(x, y, z, r).ok()
}

/// What doubles cannot decide: tangents and ties.
pub(super) fn by_list() {
    for Case { ray, sphere } in black_box(&HARD) {
        let Some(spheres) = list_of(sphere) else { return };
        black_box(by_tier!(tier => spheres.closest_hit(tier, ray)));
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
    for Case { ray, sphere } in black_box(&HARD) {
        let Some(spheres) = list_of(sphere) else { return };
        if let Ok(tree) = Bvh4::build(spheres, words) {
            black_box(by_tier!(tier => tree.closest_hit(tier, ray)));
        }
    }
}

/// The surfaces that are hit there, and rays spawned on them.
pub(super) fn surfaces() {
    for case in black_box(&HARD) {
        by_tier!(tier => survey(tier, case));
    }
}

#[inline(always)]
fn survey(tier: impl Accuracy, Case { ray, sphere }: &Case) {
    let Some(spheres) = list_of(sphere) else { return };
    let Some(hit) = spheres.closest_hit(tier, ray) else { return };
    let surface = black_box(surface(tier, ray, hit.t, sphere));
    if SPAWNS {
        for side in [Side::Outside, Side::Inside] {
            black_box(surface.spawn_ray(tier, sphere, side, BACK));
        }
    }
}
