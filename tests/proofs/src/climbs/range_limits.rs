//! Searches for how much of the margin a root at the limit uses.
//!
//! A sphere may be told to lie beyond only where both roots do. So with the nearer root as the
//! limit - correctly rounded, or as `Stable` computes it - b - sqrt D must exceed
//! limit a by less than the margin.

use super::{Numbers, cross, lane, numbers, scaled, square, wide};
use crate::accuracy::TierFormula;
use crate::accuracy::range_limits::{LEAST_A, MARGIN, RAISE, RangeLimits};
use crate::numeric::axes;
use crate::proofs::climb::{Random, assert_published, climb_twice};
use crate::{Exact, Ray, Sphere, Stable, roots};
use std::println;

/// The part of the margin that is used with the nearer root as the limit.
fn used<A: TierFormula>(numbers: &Numbers) -> f64 {
    let (line, sphere) = super::line(numbers);
    let Some([limit, _]) = A::line_roots(&line, &sphere) else { return f64::NEG_INFINITY };
    let rays = lane(&line);
    let range_limits = RangeLimits::new(&rays);
    let told = range_limits.limit(&rays, sphere.center.to_array(), sphere.radius, limit);
    assert!(!told, "{} at {limit:e} is dropped: {numbers:?}", A::TIER.as_str());
    let (p, size) = range_limits.size(&rays, sphere.center.to_array(), sphere.radius);
    let [end, b, _] = range_limits.terms(p, sphere.radius, limit).map(f64::from);
    let size = f64::from(size);
    let entry = b - discriminant(&line, &sphere).max(0.0).sqrt() / per_t(&range_limits);
    let used = (entry - end - f64::from(LEAST_A)) / ((size + end.abs()) * f64::from(MARGIN));
    if used.is_nan() { f64::NEG_INFINITY } else { used }
}

/// D in double precision.
fn discriminant(line: &Ray, sphere: &Sphere) -> f64 {
    let (d, p, r) = wide(line, sphere);
    square(d) * r * r - square(cross(d, p))
}

/// How many multiples of the scaled direction a t of 1 is.
fn per_t(range_limits: &RangeLimits<f32>) -> f64 {
    f64::from(range_limits.per_limit) / f64::from(range_limits.a)
}

/// The part of what D is raised by that its error uses.
fn raised(numbers: &Numbers) -> f64 {
    let (line, sphere) = super::line(numbers);
    let rays = lane(&line);
    let range_limits = RangeLimits::new(&rays);
    let (p, size) = range_limits.size(&rays, sphere.center.to_array(), sphere.radius);
    let [_, _, computed] = range_limits.terms(p, sphere.radius, 0.0).map(f64::from);
    let size = f64::from(size);
    let truth = discriminant(&line, &sphere) / (per_t(&range_limits) * per_t(&range_limits));
    let error = truth - computed - f64::from(LEAST_A);
    let used = error / (size * size * f64::from(RAISE));
    if used.is_nan() { f64::NEG_INFINITY } else { used }
}

/// Through the centre, or nearly: there b - r |d| is limit a except for rounding.
fn start(random: &mut Random) -> Numbers {
    let (o, d) = (random.point(0), random.point(0));
    let scale = random.wide(-2, 8);
    let jitter = random.wide(-24, -8);
    let c = [0, 1, 2].map(|i| o[i] + scale * d[i] + jitter * random.about(0));
    let r = random.wide(-20, 6).abs();
    numbers(o, d, c, r)
}

/// The slack of what D is raised by: the errors of its terms are counted at their largest, in
/// step and for one direction of |d|_1 |p|_1 against |d| |p|, then doubled.
#[test]
fn the_raise_covers_the_error_of_the_discriminant() {
    let worst = climb_twice(10, [1500, 300], [-28, 28], start, raised).0;
    assert_published("the raise", worst, 0.114);
}

/// The margin's slack: the search finds at most 0.18 of it, so a quarter holds and an eighth fails.
/// The error of b, 4u |d| |p|, and the few u of r |d| and limit a are counted at their largest and
/// together, then doubled, against a sum in which |p|_1 stands for |p|.
#[test]
fn the_margin_covers_roots_at_the_limit() {
    let worst = |seed, score: fn(&Numbers) -> f64| {
        climb_twice(seed, [1500, 300], [-28, 28], start, score).0
    };
    assert_published("exact", worst(7, used::<Exact>), 0.184);
    assert_published("stable", worst(8, used::<Stable>), 0.176);
}

/// Whatever the bits: a correctly rounded root that is no larger than the limit stays.
#[test]
fn no_root_up_to_the_limit_is_dropped() {
    let mut random = Random(9);
    let mut met = 0;
    for round in 0..200_000_u32 {
        let (size, length) = match round % 2 {
            0 => (1.0, 1.0),
            _ => (random.wide(-126, 60), random.wide(-126, 60)),
        };
        let numbers = scaled(start(&mut random), size, length);
        let (line, sphere) = super::line(&numbers);
        if !line.is_live() || !sphere.is_valid() {
            continue;
        }
        let Some(roots) = roots(Exact, &line, &sphere) else { continue };
        met += 1;
        let rays = lane(&line);
        let range_limits = RangeLimits::new(&rays);
        for limit in [roots[0], roots[0].next_up(), roots[1], f32::MAX, f32::INFINITY] {
            let told = range_limits.limit(&rays, sphere.center.to_array(), sphere.radius, limit);
            assert!(!told || limit < roots[0], "{numbers:?} at {limit:e}");
        }
    }
    println!("{met} lines that meet their sphere");
    assert!(met > 50_000, "{met}");
}

/// In one lane, lines that pass a sphere's centre at about its radius: a line that a tier sees hit is not told to miss,
/// and most lines that pass the sphere by more than the raise are told to miss.
#[test]
fn no_graze_is_told_to_miss() {
    let mut random = Random(10);
    let [mut met, mut told, mut missed] = [0; 3];
    for round in 0..300_000 {
        let numbers = grazing(&mut random, if round % 2 == 0 { -22 } else { -5 });
        let (line, sphere) = super::line(&numbers);
        if !line.is_live() || !sphere.is_valid() {
            continue;
        }
        let rays = lane(&line);
        let center = sphere.center.to_array();
        let misses = RangeLimits::new(&rays).limit(&rays, center, sphere.radius, f32::INFINITY);
        let stable =
            RangeLimits::of_scaled(rays.direction, axes::dot(rays.direction, rays.direction), 1.0);
        let stable_misses = stable.limit(&rays, center, sphere.radius, f32::INFINITY);
        let seen = [Exact::line_roots(&line, &sphere), Stable::line_roots(&line, &sphere)];
        assert!(seen[0].is_none() || !misses, "exact: {numbers:?}");
        assert!(seen[1].is_none() || !(misses || stable_misses), "stable: {numbers:?}");
        met += u32::from(seen[0].is_some());
        missed += u32::from(seen[0].is_none());
        told += u32::from(misses);
    }
    println!("{met} meet their sphere, {missed} miss it, of which {told} are told");
    assert!(met > 100_000 && told * 3 > missed && told < missed);
}

/// A line that is r (1 +- 2^closeness) away from the centre, as far as rounding lets it.
fn grazing(random: &mut Random, closeness: i32) -> Numbers {
    let (o, d) = (random.point(0), random.point(0));
    let other = random.point(0);
    let [x, y, z] = [
        d[1] * other[2] - d[2] * other[1],
        d[2] * other[0] - d[0] * other[2],
        d[0] * other[1] - d[1] * other[0],
    ];
    let (along, length) = (random.wide(-2, 4), (x * x + y * y + z * z).sqrt());
    let r = random.wide(-6, 6).abs();
    let away = r * (1.0 + random.wide(closeness - 6, closeness)) / length;
    let c = [0, 1, 2].map(|i| o[i] + along * d[i] + away * [x, y, z][i]);
    numbers(o, d, c, r)
}
