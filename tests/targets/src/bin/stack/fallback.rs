//! The stack of `Exact`'s fallbacks: less than 1 KiB for a hit, 2.5 KiB for a surface, as their documentation says.

use super::painted::used;
use spherule_kernel::{
    Exact, Lanes, Ray, RayPacket, Sphere, SpherePacket, Vec3, f32x4, f32x8, f32x16, pair_lanes,
    roots, surface,
};
use spherule_targets::cases::{Case, HARD};
use std::hint::black_box;

/// The most stack that the fallback may use.
const LIMIT: usize = 1024;

extern "C" fn nothing() {}

/// The control: uses more than the limit.
extern "C" fn too_much() {
    black_box([1_u8; LIMIT]);
}

extern "C" fn both_roots() {
    for Case { ray, sphere } in black_box(&HARD) {
        black_box(roots(Exact, ray, sphere));
    }
}

/// Tangents, and a point half-way between numbers: every coordinate is compared exactly.
extern "C" fn surfaces() {
    for Case { ray, sphere } in black_box(&HARD) {
        let t = roots(Exact, ray, sphere).map_or(0.0, |[near, _]| near);
        black_box(surface(Exact, ray, t, sphere));
    }
}

fn all_pairs<L: Lanes<Token = ()>>(cases: &[Case]) {
    for Case { ray, sphere } in black_box(cases) {
        let (rays, spheres) = (RayPacket::new(&[*ray]), SpherePacket::new(&[*sphere]));
        black_box(pair_lanes::<L>(Exact, (), &rays, &spheres));
    }
}

/// A case that double precision decides.
fn easy() -> Case {
    let ray = Ray::new(Vec3::new(0.1, 0.2, -3.0), Vec3::new(0.01, 0.02, 0.9));
    Case { ray, sphere: Sphere { center: Vec3::new(0.05, 0.02, 0.3), radius: 1.1 } }
}

extern "C" fn decided<L: Lanes<Token = ()>>() {
    all_pairs::<L>(&[easy(); 3]);
}

extern "C" fn undecided<L: Lanes<Token = ()>>() {
    all_pairs::<L>(&HARD);
}

fn report<L: Lanes<Token = ()>>() {
    let [easy, hard] = [used(decided::<L>), used(undecided::<L>)];
    println!(
        "stack of pairs, {} lanes: {easy} bytes decided in double precision, {hard} by \
         the fallback",
        L::COUNT
    );
    assert!(hard < easy + LIMIT, "the fallback added {} bytes", hard - easy);
}

/// Prints the figures.
///
/// # Panics
/// If the fallback uses more than its documentation says, or the control is not seen to.
pub(super) fn measure() {
    let call = used(nothing);
    let (fallback, control) = (used(both_roots) - call, used(too_much) - call);
    println!("stack of the fallback: {fallback} bytes; of the control: {control}");
    assert!(control >= LIMIT, "the control was not seen");
    assert!(fallback < LIMIT, "{fallback} bytes");
    let of_surfaces = used(surfaces) - call;
    println!("stack of a surface by the fallback: {of_surfaces} bytes");
    assert!(of_surfaces < LIMIT * 5 / 2, "{of_surfaces} bytes");
    report::<f32>();
    report::<f32x4>();
    report::<f32x8>();
    report::<f32x16>();
}
