//! The two forms of the lecture beside each other: where both are right they agree, where `f32` ends they do not.

use super::{Numbers, cross, line, numbers, square, wide};
use crate::accuracy::TierFormula;
use crate::proofs::climb::{Random, assert_published, climb_twice};
use crate::{Exact, Fast, Geometric, Ray, Sphere, Tier, Vec3, pairs, roots};
use std::println;

/// Ulp of t between the two, stated in the documentation of the tier.
const ULPS: f64 = 256.0;

/// |p| / r and l / r, in double precision.
fn away_and_aside(ray: &Ray, sphere: &Sphere) -> [f64; 2] {
    let (d, p, r) = wide(ray, sphere);
    [libm::sqrt(square(p)) / r, libm::sqrt(square(cross(d, p)) / square(d)) / r]
}

/// How many ulp apart the roots are, the larger of both, if the sphere is 2 to 10 radii away and not grazed.
fn apart(numbers: &Numbers) -> f64 {
    let (ray, sphere) = line(numbers);
    let [away, aside] = away_and_aside(&ray, &sphere);
    if !(ray.is_live() && sphere.is_valid() && (2.0..=10.0).contains(&away) && aside <= 0.9) {
        return -1.0;
    }
    let tiers = [Fast::line_roots(&ray, &sphere), Geometric::line_roots(&ray, &sphere)];
    let [Some(fast), Some(geometric)] = tiers else { panic!("{tiers:?}: {numbers:?}") };
    let ulp = |t: f32| f64::from(t.abs().next_up()) - f64::from(t.abs());
    let off = |index: usize| {
        let [one, other] = [fast[index], geometric[index]];
        (f64::from(one) - f64::from(other)).abs() / ulp(one)
    };
    off(0).max(off(1))
}

/// A sphere ahead, as far away as that at most.
fn start(random: &mut Random, farthest: i32) -> Numbers {
    let (o, mut d) = (random.point(2), random.point(0));
    d[0] += 1.5;
    let ahead = random.wide(1, farthest).abs();
    let aside = random.wide(-8, -1);
    let length = libm::sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    let c = [0, 1, 2].map(|i| o[i] + d[i] / length * ahead + aside * random.about(-1));
    numbers(o, d, c, random.about(-1).abs())
}

#[test]
fn where_both_are_right_they_agree() {
    let (worst, numbers) =
        climb_twice(51, [3000, 500], [-20, 20], |random| start(random, 3), apart);
    println!("{worst} ulp apart at most: {numbers:?}");
    assert_published("of the ulp", worst / ULPS, 0.426);
}

/// At 10^4 radii: what `Fast` alone, `Geometric` alone, both and neither decide right.
#[test]
fn where_f32_ends_each_fails_in_its_own_way() {
    let mut random = Random(52);
    let mut counts = [0_u32; 4];
    for _ in 0..20_000 {
        let (ray, sphere) = line(&start(&mut random, 14));
        let truth = Exact::line_roots(&ray, &sphere).is_some();
        let [fast, geometric] =
            [Tier::Fast, Tier::Geometric].map(|tier| roots(tier, &ray, &sphere).is_some() == truth);
        counts[usize::from(fast) + 2 * usize::from(geometric)] += 1;
    }
    println!("neither, Fast, Geometric, both: {counts:?}");
    assert!(counts.iter().all(|count| *count > 500), "{counts:?}");
}

/// Whole numbers, which lose nothing before they are squared.
#[test]
fn a_sphere_that_one_form_misses_and_one_that_the_other_does() {
    let meet = |p: [f32; 3], d: [f32; 3]| {
        let ray = Ray::new(Vec3::ZERO, Vec3::from_array(d));
        let sphere = Sphere { center: Vec3::from_array(p), radius: 7.0 };
        [Tier::Fast, Tier::Geometric, Tier::Exact].map(|tier| roots(tier, &ray, &sphere).is_some())
    };
    // Straight through the centre: r^2 is below the last bit of p.p, from which `Fast` takes it; p.p - s^2 is zero.
    assert_eq!(meet([47_138.0, 0.0, 0.0], [12.0, 0.0, 0.0]), [false, true, true]);
    // A third of the radius beside it: s is off by its last bit, and s^2 by more than r^2.
    assert_eq!(meet([39_938.0, 12_291.0, 0.0], [26.0, 8.0, 0.0]), [true, false, true]);
}

/// |d| is infinite, so v and every t would be zero; or |d| is zero.
#[test]
fn a_direction_whose_square_is_out_of_range_meets_nothing() {
    let around = Sphere { center: Vec3::ZERO, radius: 1.0 };
    for direction in
        [Vec3::X * 2.0_f32.powi(64), Vec3::splat(f32::MAX), Vec3::Y * 2.0_f32.powi(-80)]
    {
        let ray = Ray { t_min: f32::NEG_INFINITY, ..Ray::new(Vec3::ZERO, direction) };
        assert!(roots(Exact, &ray, &around).is_some());
        let mut hits = [None];
        pairs(Geometric, &[ray], &[around], &mut hits);
        assert_eq!(hits, [None], "{direction:?}");
    }
}
