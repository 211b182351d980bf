//! Rule 5: the closest hit is that of the smallest root as a real number, whatever rounding makes of t.

use proptest::prelude::*;
use spherule_kernel::{Exact, Hit, Intersect, Ray, Sphere, SphereTree, Tier, Vec3, compare_hits};
use spherule_referee::random::Random;
use spherule_referee::strategies;
use spherule_tests::campaign::on_all_cores;
use spherule_tests::oracle;
use spherule_tests::variants::{assert_hits, bits};
use std::cmp::Ordering;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Checks every variant of `Exact` against integers. Returns how many rays have several hits at one t among which the
/// closest does not have the lowest index.
fn check(spheres: &[Sphere], rays: &[Ray]) -> usize {
    let expected: Vec<_> = rays.iter().map(|ray| oracle::closest(ray, spheres)).collect();
    assert_hits(&expected, rays, spheres, &|variant| variant.tier == Tier::Exact);
    let lowest = |hit: Hit, ray: &Ray| {
        let at = |sphere| oracle::intersect(ray, sphere) == Some(hit.t);
        spheres.iter().position(at) == Some(hit.sphere as usize)
    };
    expected.iter().zip(rays).filter(|(hit, ray)| hit.is_some_and(|hit| !lowest(hit, ray))).count()
}

/// Rays from a point at `distance` from `center` towards points of a cube around `center`.
fn rays_from(random: &mut Random, distance: f64, count: usize, center: Vec3) -> Vec<Ray> {
    let eye = random.direction() * distance as f32 + center;
    let towards = |_| Ray::new(eye, (center + random.in_cube(0.8)) - eye);
    (0..count).map(towards).collect()
}

fn ball(random: &mut Random, count: usize) -> Vec<Sphere> {
    let sphere = |_| Sphere { center: random.in_cube(0.7), radius: random.between(0.1, 0.4) };
    (0..count).map(sphere).collect()
}

#[test]
fn from_afar_the_closest_sphere_is_seen() {
    let mut random = Random::seeded(91);
    let mut differ = 0;
    for distance in [1e3, 1e4, 1e5, 1e6, 1e7] {
        for count in [3, 40, 90] {
            let spheres = ball(&mut random, count);
            let rays = rays_from(&mut random, distance, 48, Vec3::ZERO);
            differ += check(&spheres, &rays);
        }
    }
    assert!(differ > 30, "{differ} rays on which index and order differ");
}

#[test]
fn translated_doubled_and_nested_spheres_keep_their_order() {
    let mut random = Random::seeded(92);
    let mut differ = 0;
    for power in [0, 10, 16, 20] {
        let offset = Vec3::new(1.0, -1.0, 1.0) * 2.0_f32.powi(power);
        let mut spheres = ball(&mut random, 12);
        for sphere in &mut spheres {
            sphere.center += offset;
        }
        // The same spheres again, spheres an ulp aside, and slightly larger ones: they are behind and in front of those
        // that they repeat.
        for index in 0..12 {
            let Sphere { center, radius } = spheres[index];
            spheres.push(spheres[index]);
            spheres.push(Sphere { center: Vec3 { x: center.x.next_up(), ..center }, radius });
            spheres.push(Sphere { center, radius: radius.next_up() });
        }
        for distance in [3.0, 1e5, 1e7] {
            let rays = rays_from(&mut random, distance, 32, offset);
            differ += check(&spheres, &rays);
        }
    }
    assert!(differ > 30, "{differ} rays on which index and order differ");
}

/// Takes some half an hour: `cargo test --test main ten_million_pixels -- --ignored --nocapture`.
#[test]
#[ignore = "ten million pixels"]
fn ten_million_pixels_show_the_spheres_of_integers() {
    let hits = AtomicU32::new(0);
    on_all_cores(2000, |round| {
        let mut random = Random::new(95, round);
        let mut spheres = ball(&mut random, 12);
        // Doubled, nested, moved, and an ulp aside.
        let power = random.pick(&[0, 10, 16, 20]);
        for index in 0..4 {
            let Sphere { center, radius } = spheres[index];
            spheres.push(spheres[index]);
            spheres.push(Sphere { center, radius: radius.next_down() });
            spheres.push(Sphere { center: Vec3 { y: center.y.next_up(), ..center }, radius });
        }
        let offset = Vec3::new(1.0, -1.0, 1.0) * 2.0_f32.powi(power);
        for sphere in &mut spheres {
            sphere.center += offset;
        }
        let distance = [1e3, 1e4, 1e5, 1e6, 1e7][round as usize % 5];
        let rays = rays_from(&mut random, distance, 5000, offset);
        let mut found = vec![None; rays.len()];
        SphereTree::new(&spheres[..]).closest_hits(Exact, &rays, &mut found);
        for (ray, found) in rays.iter().zip(&found) {
            let truth = oracle::closest(ray, &spheres);
            assert_eq!(bits(*found), bits(truth), "{ray:?} of {spheres:?}");
        }
        hits.fetch_add(found.iter().flatten().count() as u32, Relaxed);
    });
    let hits = hits.into_inner();
    println!("{hits} of 10,000,000 pixels show a sphere");
    assert!(hits > 5_000_000, "{hits}");
}

/// Spheres on a lattice that touch and cross each other in points that rays go through. These are real ties, of which
/// the lowest index is the closest; the same from afar, with another t.
#[test]
fn shared_roots_are_ties() {
    let mut random = Random::seeded(93);
    let mut shared = 0;
    for _ in 0..60 {
        let whole = |random: &mut Random| random.integer(-4, 4) as f32;
        let point = Vec3::new(whole(&mut random), whole(&mut random), whole(&mut random));
        // Pythagorean steps: every centre is as far from the point as its radius.
        let steps = [
            (1.0, 2.0, 2.0, 3.0),
            (2.0, 3.0, 6.0, 7.0),
            (0.0, 3.0, 4.0, 5.0),
            (4.0, 4.0, 7.0, 9.0),
        ];
        let mut spheres = Vec::new();
        for _ in 0..6 {
            let (x, y, z, radius) = random.pick(&steps);
            let mut step = [x, y, z].map(|x: f32| x * random.sign() as f32);
            step.rotate_left(random.integer(0, 2) as usize);
            spheres.push(Sphere { center: point + Vec3::from_array(step), radius });
        }
        let rays: Vec<Ray> = (0..16)
            .map(|_| {
                let d = Vec3::new(whole(&mut random), whole(&mut random), whole(&mut random));
                let far = random.pick(&[1.0, 3.0, 1_048_576.0]);
                Ray { t_min: f32::NEG_INFINITY, ..Ray::new(point - d * far, d) }
            })
            .collect();
        check(&spheres, &rays);
        for ray in &rays {
            let hits = |sphere: &Sphere| oracle::intersect(ray, sphere);
            let Some(Hit { t, sphere }) = oracle::closest(ray, &spheres) else { continue };
            let first = &spheres[sphere as usize];
            let ties = spheres.iter().filter(|other| {
                hits(other) == Some(t) && oracle::compare(ray, t, [first, other]).is_eq()
            });
            shared += usize::from(ties.count() > 1);
        }
    }
    assert!(shared > 100, "{shared} rays on which roots are shared");
}

proptest! {
    #![proptest_config(strategies::config(256))]

    /// Few bits, few exponents: roots that nearly coincide, and both roots of a sphere.
    #[test]
    fn two_hits_compare_as_real_numbers(
        numbers in prop::array::uniform14(-8_i32..8),
        powers in prop::array::uniform14(prop::sample::select(vec![-20, -1, 0, 0, 0, 1, 20])),
        start in prop::sample::select(vec![f32::NEG_INFINITY, 0.0, 1.0]),
    ) {
        let mut x = [0.0_f32; 14];
        for i in 0..14 {
            x[i] = numbers[i] as f32 * 2.0_f32.powi(powers[i]);
        }
        let [ox, oy, oz, dx, dy, dz, x1, y1, z1, r1, x2, y2, z2, r2] = x;
        let ray = Ray { t_min: start, ..Ray::new(Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz)) };
        let first = Sphere { center: Vec3::new(x1, y1, z1), radius: r1.abs() };
        let second = Sphere { center: Vec3::new(x2, y2, z2), radius: r2.abs() };
        if let [Some(t1), Some(t2)] = [&first, &second].map(|s| oracle::intersect(&ray, s)) {
            let expected = match t1.total_cmp(&t2) {
                Ordering::Equal => oracle::compare(&ray, t1, [&first, &second]),
                order => order,
            };
            prop_assert_eq!(compare_hits(Exact, &ray, [(t1, &first), (t2, &second)]), expected);
            prop_assert_eq!(compare_hits(Exact, &ray, [(t2, &second), (t1, &first)]), expected.reverse());
            let by_t = compare_hits(Tier::Stable, &ray, [(t1, &first), (t2, &second)]);
            prop_assert_eq!(by_t, t1.total_cmp(&t2));
        }
    }
}
