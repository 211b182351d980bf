//! The stack of `Exact`'s fallbacks: less than 1 KiB for a hit, 2.5 KiB for a surface, as their documentation says.

use crate::painted_stack::used;
use spherule_kernel::{
    Exact, Lanes, Ray, RayPacket, Sphere, SpherePacket, Vec3, f32x4, f32x8, f32x16, pair_lanes,
    roots, surface,
};
use std::hint::black_box;
use std::sync::LazyLock;

/// The most stack that the fallback may use.
const LIMIT: usize = 1024;

extern "C" fn nothing() {}

/// The control: uses more than the limit.
extern "C" fn too_much() {
    black_box([1_u8; LIMIT]);
}

/// A tangent, a tie, and the most expensive case of the kernel's `flops` test: together they take every path of the
/// fallback.
fn hard() -> [(Ray, Sphere); 3] {
    let case = |o: [f32; 3], d: [f32; 3], c: [f32; 3], radius| {
        let ray = Ray::new(Vec3::from_array(o), Vec3::from_array(d));
        (ray, Sphere { center: Vec3::from_array(c), radius })
    };
    [
        case([-3.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3], 1.0),
        case([0.0; 3], [1.0, 0.0, 0.0], [16_777_220.0, 0.0, 0.0], 1.0),
        case(
            [4.304_508_3e17, 8.930_645_5e-30, 8_205.748],
            [594.441_3, -6.914_829e26, 7.052_379e-36],
            [-6_261.860_4, 2_136.177, -3.241_990_3e-26],
            1.324_018_2e38,
        ),
    ]
}

/// In static memory, so that the cases are not on the painted stack.
static HARD: LazyLock<[(Ray, Sphere); 3]> = LazyLock::new(hard);

extern "C" fn both_roots() {
    for (ray, sphere) in black_box(&*HARD) {
        black_box(roots(Exact, ray, sphere));
    }
}

/// Tangents, and a point half-way between numbers: every coordinate is compared exactly.
extern "C" fn surfaces() {
    for (ray, sphere) in black_box(&*HARD) {
        let t = roots(Exact, ray, sphere).map_or(0.0, |[near, _]| near);
        black_box(surface(Exact, ray, t, sphere));
    }
}

fn all_pairs<L: Lanes<Token = ()>>(cases: &[(Ray, Sphere)]) {
    for (ray, sphere) in black_box(cases) {
        let (rays, spheres) = (RayPacket::new(&[*ray]), SpherePacket::new(&[*sphere]));
        black_box(pair_lanes::<L>(Exact, (), &rays, &spheres));
    }
}

/// A case that double precision decides.
fn easy() -> (Ray, Sphere) {
    let ray = Ray::new(Vec3::new(0.1, 0.2, -3.0), Vec3::new(0.01, 0.02, 0.9));
    (ray, Sphere { center: Vec3::new(0.05, 0.02, 0.3), radius: 1.1 })
}

extern "C" fn decided<L: Lanes<Token = ()>>() {
    all_pairs::<L>(&[easy(); 3]);
}

extern "C" fn undecided<L: Lanes<Token = ()>>() {
    all_pairs::<L>(&*HARD);
}

fn report<L: Lanes<Token = ()>>() {
    let [easy, hard] = [used(decided::<L>), used(undecided::<L>)];
    println!(
        "machine: stack of pairs, {} lanes: {easy} bytes decided in double precision, {hard} by \
         the fallback",
        L::COUNT
    );
    assert!(hard < easy + LIMIT, "the fallback added {} bytes", hard - easy);
}

/// Prints the figures.
///
/// # Panics
/// If the fallback uses more than its documentation says, or the control is not seen to.
pub(crate) fn measure() {
    LazyLock::force(&HARD);
    let call = used(nothing);
    let (fallback, control) = (used(both_roots) - call, used(too_much) - call);
    println!("machine: stack of the fallback: {fallback} bytes; of the control: {control}");
    assert!(control >= LIMIT, "the control was not seen");
    assert!(fallback < LIMIT, "{fallback} bytes");
    let of_surfaces = used(surfaces) - call;
    println!("machine: stack of a surface by the fallback: {of_surfaces} bytes");
    assert!(of_surfaces < LIMIT * 5 / 2, "{of_surfaces} bytes");
    report::<f32>();
    report::<f32x4>();
    report::<f32x8>();
    report::<f32x16>();
}
