//! What [`Stable`](crate::accuracy::stable::Stable) promises in its domain, against searches that climb.

use super::{Numbers, cross, line, numbers, square, wide};
use crate::accuracy::TierFormula;
use crate::exact::{Quadratic, QuadraticTerms, Root};
use crate::proofs::climb::{Random, assert_published, climb_twice};
use crate::{Ray, Sphere, Stable};
use std::println;

/// Ulp of t, stated in the documentation of the tier.
const ULPS: f64 = 12.0;
/// How far a tangent is decided wrong, as a part of |p| + r: stated too, and proven in `docs/traversal-margins.md`.
const GRAZE: f64 = 1.0 / (1_u64 << 41) as f64;
/// The largest |p| / r of the domain.
const FARTHEST: f64 = 1e6;
/// Exponents of a climb, within the domain.
const SIZES: [i32; 2] = [-36, 36];

/// |p|, the ray and the sphere, if the case is in the domain.
fn in_domain(numbers: &Numbers) -> Option<(f64, Ray, Sphere)> {
    let (ray, sphere) = line(numbers);
    let (_, p, r) = wide(&ray, &sphere);
    let away = libm::hypot(libm::hypot(p[0], p[1]), p[2]);
    (ray.is_live() && sphere.is_valid() && r > 0.0 && away <= FARTHEST * r)
        .then_some((away, ray, sphere))
}

fn terms(ray: &Ray, sphere: &Sphere) -> QuadraticTerms {
    let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
    QuadraticTerms::new(o, d, sphere.center.to_array(), sphere.radius)
}

/// The larger error of both roots, for rays that start a radius or more from the surface.
fn ulps(numbers: &Numbers) -> f64 {
    let Some((away, ray, sphere)) = in_domain(numbers) else { return 0.0 };
    let terms = terms(&ray, &sphere);
    let (Some(stable), Some(exact)) = (Stable::line_roots(&ray, &sphere), Quadratic::new(&terms))
    else {
        return 0.0;
    };
    if away < 2.0 * f64::from(sphere.radius) {
        return 0.0;
    }
    let mut worst = 0.0_f64;
    for (t, root) in stable.into_iter().zip([Root::Near, Root::Far]) {
        let truth = exact.rounded(root);
        let ulp = f64::from(truth.abs().next_up()) - f64::from(truth.abs());
        let off = (f64::from(t) - f64::from(truth)).abs() / ulp;
        worst = worst.max(if truth.is_normal() { off } else { 0.0 });
    }
    worst
}

/// How far a line that is decided wrong is from a tangent, as a part of |p| + r; zero if the line is decided right.
fn graze(numbers: &Numbers) -> f64 {
    let Some((away, ray, sphere)) = in_domain(numbers) else { return 0.0 };
    let meets = Quadratic::new(&terms(&ray, &sphere)).is_some();
    if Stable::line_roots(&ray, &sphere).is_some() == meets {
        return 0.0;
    }
    let r = f64::from(sphere.radius);
    (distance(numbers) - r).abs() / (away + r)
}

/// l, in double precision, of which some 2^-52 |p| is lost.
fn distance(numbers: &Numbers) -> f64 {
    let (ray, sphere) = line(numbers);
    let (d, p, _) = wide(&ray, &sphere);
    libm::sqrt(square(cross(d, p)) / square(d))
}

/// A sphere up to a million radii ahead of a ray that passes its centre by `part` of its radius.
fn start(random: &mut Random, part: f64) -> Numbers {
    let mut d = random.point(0).map(f64::from);
    if d == [0.0; 3] {
        d[0] = 1.0;
    }
    let length = libm::sqrt(square(d));
    let other = [(); 3].map(|()| f64::from(random.about(0)));
    let side = cross(d, other);
    let width = libm::sqrt(square(side));
    let r = random.wide(-8, 8).abs();
    let farthest = 1 + random.below(19) as i32;
    let ahead = f64::from(r) * f64::from(random.wide(0, farthest));
    let (along, aside) = (ahead / length, f64::from(r) * part / width);
    let size = random.below(40) as i32 - 20;
    let o = random.point(size);
    let c = [0, 1, 2].map(|i| (f64::from(o[i]) + d[i] * along + side[i] * aside) as f32);
    numbers(o, d.map(|x| x as f32), c, r)
}

/// Lines a thousandth of their origin from it, half a chord of a quarter of the radius, and t just below a power of two, where an ulp is
/// least: 9 ulp. From anywhere a climb does not come here. (o, c and r in bits, for one direction.)
const LEAST_ULP: [([u32; 3], [u32; 3], u32); 2] = [
    ([0x3feb_6f4e, 0xc4d9_ddae, 0xb8b5_434c], [0x3ef7_7b2a, 0xc4da_0213, 0xbfd7_6a3d], 0x3f9a_17e5),
    ([0x3f03_88d4, 0xc4ab_aeb7, 0xb748_1a61], [0xbf57_9833, 0xc4ab_d31c, 0xbfd7_67cc], 0x3f9a_1ae7),
];
const ITS_DIRECTION: [u32; 3] = [0xbe38_002d, 0xbf64_5ae8, 0xbfce_0b78];

#[test]
fn t_is_within_its_ulps() {
    let anywhere = |random: &mut Random| {
        if random.below(100) == 0 {
            let (o, c, r) = LEAST_ULP[random.below(2) as usize];
            let [o, d, c] = [o, ITS_DIRECTION, c].map(|v| v.map(f32::from_bits));
            return numbers(o, d, c, f32::from_bits(r));
        }
        let part = 1.0 - f64::from(random.wide(-24, -1).abs());
        start(random, part)
    };
    let (worst, numbers) = climb_twice(41, [3000, 500], SIZES, anywhere, ulps);
    println!("Stable is {worst} ulp off at most: {numbers:?}");
    assert_published("of the ulp", worst / ULPS, 0.75);
}

#[test]
fn a_tangent_is_decided_right_from_its_distance_on() {
    let grazing = |random: &mut Random| {
        // The radius that is nearest to l: the best of many beginnings.
        let near = |random: &mut Random| {
            let mut numbers = start(random, 1.0);
            numbers[9] = distance(&numbers) as f32;
            numbers
        };
        let draws = [(); 100].map(|()| near(random));
        draws.into_iter().max_by(|a, b| graze(a).total_cmp(&graze(b))).unwrap_or([1.0; 10])
    };
    let (worst, numbers) = climb_twice(42, [300, 300], SIZES, grazing, graze);
    println!(
        "Stable decides wrong 2^{:.1} (|p| + r) from a tangent: {numbers:?}",
        libm::log2(worst)
    );
    assert_published("of 2^-41", worst / GRAZE, 0.0013);
}
