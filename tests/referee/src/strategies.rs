//! What proptest draws and shrinks to a readable case.
//!
//! Cases come in four kinds. Some are on a lattice of small integers, where tangents, ties and
//! equal t are common and a shrunk case has few digits. Some are a few ulp away from such a case.
//! Some are wild: any number in any place. And some are from the [families](crate::families).

use crate::case::Case;
use crate::families::FAMILIES;
use crate::random::power_of_two;
use crate::scene::Scene;
use crate::ulp::step;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::Config;
use spherule_kernel::{Ray, Sphere, Vec3};
use std::env;

/// `cases` cases a test, or as many as the environment variable `PROPTEST_CASES` says. Failures are
/// printed, not written to files: the print can be pasted into a test.
#[must_use]
pub fn config(cases: u32) -> Config {
    let default = Config::default();
    let cases = if env::var_os("PROPTEST_CASES").is_some() { default.cases } else { cases };
    Config { cases, failure_persistence: None, ..default }
}

/// Numbers at which some behaviour changes.
pub const SPECIALS: [f32; 24] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f32::from_bits(0x0000_0001),
    f32::from_bits(0x8000_0001),
    f32::from_bits(0x007f_ffff),
    f32::MIN_POSITIVE,
    -f32::MIN_POSITIVE,
    f32::from_bits(0x3f7f_ffff),
    f32::from_bits(0x3f80_0001),
    // 2^-63 and 2^-75: squares underflow to subnormals, and to zero.
    f32::from_bits((127 - 63) << 23),
    f32::from_bits((127 - 75) << 23),
    // 2^-40 and 2^40: the ends of the domain of `Stable`.
    f32::from_bits((127 - 40) << 23),
    f32::from_bits((127 + 40) << 23),
    // 2^63 and 2^64: the first square that overflows is that of 2^64.
    f32::from_bits((127 + 63) << 23),
    f32::from_bits((127 + 64) << 23),
    16_777_216.0,
    f32::MAX,
    f32::MIN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    f32::from_bits(0xffc0_0001),
];

/// Any number whatever: special ones, common ones, subnormals, any bits.
pub fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        2 => (-20_i8..=20).prop_map(f32::from),
        2 => select(&SPECIALS[..]),
        2 => -20.0_f32..20.0,
        1 => (any::<bool>(), 0..0x0080_0000_u32)
            .prop_map(|(negative, bits)| f32::from_bits(bits | u32::from(negative) << 31)),
        3 => any::<u32>().prop_map(f32::from_bits),
    ]
}

/// Small integers throughout, half of the directions along an axis, and common intervals.
pub fn lattice() -> impl Strategy<Value = Case> {
    let coordinate = || -3_i8..=3;
    let point = move || [coordinate(), coordinate(), coordinate()];
    let along_axis = (0..3_usize, select(&[1_i8, -1, 2, 3][..])).prop_map(|(axis, length)| {
        let mut direction = [0; 3];
        direction[axis] = length;
        direction
    });
    let direction = prop_oneof![along_axis, [-2_i8..=2, -2_i8..=2, -2_i8..=2]];
    let ends = prop_oneof![
        4 => Just((0.0, f32::INFINITY)),
        2 => Just((f32::NEG_INFINITY, f32::INFINITY)),
        1 => (-3_i8..=3, -1_i8..=6)
            .prop_map(|(low, length)| (f32::from(low), f32::from(low) + f32::from(length))),
    ];
    (point(), direction, point(), 0_i8..=5, ends).prop_map(|(o, d, c, r, (t_min, t_max))| {
        let vector = |v: [i8; 3]| Vec3::from_array(v.map(f32::from));
        let ray = Ray { origin: vector(o), direction: vector(d), t_min, t_max };
        Case { ray, sphere: Sphere { center: vector(c), radius: f32::from(r) } }
    })
}

/// A lattice case, each number up to two ulp away; zero stays zero.
pub fn walked() -> impl Strategy<Value = Case> {
    (lattice(), [(); Case::NUMBERS].map(|()| -2_i64..=2)).prop_map(|(case, steps)| {
        let mut numbers = case.numbers();
        for (number, steps) in numbers.iter_mut().zip(steps) {
            if *number != 0.0 && number.is_finite() {
                *number = step(*number, steps);
            }
        }
        Case::from_numbers(numbers)
    })
}

/// Any number in every place.
pub fn wild() -> impl Strategy<Value = Case> {
    [(); Case::NUMBERS].map(|()| number()).prop_map(Case::from_numbers)
}

/// A case of any of the families.
pub fn hard() -> impl Strategy<Value = Case> {
    (select(&FAMILIES[..]), any::<u64>()).prop_map(|(family, index)| family.case(index))
}

/// A case of any kind.
pub fn case() -> impl Strategy<Value = Case> {
    prop_oneof![lattice(), walked(), wild(), hard()]
}

/// Up to 35 rays, so that packets of every width are full and partly full, and 0 to 40 spheres, so
/// that groups of four are too.
///
/// Rays and spheres come from `cases`. A ray and a sphere of one case meet as the case says. Those
/// of the lattice meet each other, often at equal t.
pub fn scene<S: Strategy<Value = Case>>(cases: impl Fn() -> S) -> impl Strategy<Value = Scene> {
    let rays = prop::collection::vec(cases(), 1..=35);
    let spheres = prop::collection::vec(cases(), 0..=40);
    let aimed_and_twins = any::<[bool; 2]>();
    (rays, spheres, aimed_and_twins).prop_map(|(rays, mut spheres, [aimed, twins])| {
        // Half of the scenes also hold the spheres that their rays were aimed at.
        if aimed {
            for (place, case) in spheres.iter_mut().step_by(2).zip(&rays) {
                *place = *case;
            }
        }
        // Half of the scenes hold spheres twice, several groups apart.
        if twins {
            for index in (0..spheres.len()).step_by(3) {
                spheres[index] = spheres[index / 2];
            }
        }
        Scene {
            rays: rays.iter().map(|case| case.ray).collect(),
            spheres: spheres.iter().map(|case| case.sphere).collect(),
        }
    })
}

/// A scene near the lattice, with all lengths multiplied by one power of two and directions by
/// another: beyond both ends of what filters and tiers guard against.
pub fn sized_scene() -> impl Strategy<Value = Scene> {
    let exponents = (-140_i64..=120, -140_i64..=120);
    (scene(walked), exponents).prop_map(|(mut scene, (lengths, directions))| {
        // Computed in double precision, where these powers are normal numbers.
        let scale = |v: Vec3, exponent: i64| {
            Vec3::from_array(v.to_array().map(|x| (f64::from(x) * power_of_two(exponent)) as f32))
        };
        for ray in &mut scene.rays {
            ray.origin = scale(ray.origin, lengths);
            ray.direction = scale(ray.direction, directions);
            let bound = |t| (f64::from(t) * power_of_two(lengths - directions)) as f32;
            (ray.t_min, ray.t_max) = (bound(ray.t_min), bound(ray.t_max));
        }
        for sphere in &mut scene.spheres {
            sphere.center = scale(sphere.center, lengths);
            sphere.radius = (f64::from(sphere.radius) * power_of_two(lengths)) as f32;
        }
        scene
    })
}
