//! The surface at a hit: by `Exact` every coordinate is correctly rounded, by the others within the stated error.

use spherule_kernel::{Exact, Ray, Sphere, SphereList, Stable, Tier, Vec3, roots, surface};
use spherule_referee::aim::line_distance;
use spherule_referee::case::Case;
use spherule_referee::families::FAMILIES;
use spherule_referee::random::{Random, power_of_two};
use spherule_referee::ulp::step;
use spherule_tests::oracle;
use spherule_tests::variants::{Layer, surface_layers, surfaces_of};

/// Checks both roots of a line against integers; returns how many roots there were.
fn check(ray: &Ray, sphere: &Sphere) -> usize {
    let line = Ray { t_min: f32::NEG_INFINITY, t_max: f32::INFINITY, ..*ray };
    let Some(roots) = oracle::roots(&line, sphere) else { return 0 };
    let mut checked = 0;
    for (t, leaves) in roots.into_iter().zip([false, true]) {
        // By rule 4 the far root is not the answer if it rounds to the same t as the near one.
        if !t.is_finite() || leaves && t == roots[0] {
            continue;
        }
        let Some([normal, point]) = oracle::surface(&line, sphere, leaves) else { continue };
        let found = surface(Exact, &line, t, sphere);
        let bits = |v: [f32; 3]| v.map(|x| (x + 0.0).to_bits());
        let (n, p) = (found.normal.to_array(), found.point.to_array());
        assert_eq!(bits(n), bits(normal), "normal, {leaves}: {ray:?} {sphere:?}");
        assert_eq!(bits(p), bits(point), "point, {leaves}: {ray:?} {sphere:?}");
        checked += 1;
    }
    checked
}

#[test]
fn exact_surfaces_are_correctly_rounded_in_every_family() {
    let mut checked = 0;
    for family in FAMILIES {
        for case in family.cases(300) {
            checked += check(&case.ray, &case.sphere);
        }
    }
    assert!(checked > 2000, "{checked}");
}

#[test]
fn exact_surfaces_are_correctly_rounded_from_afar_and_for_any_bits() {
    let mut random = Random::seeded(6);
    let mut checked = 0;
    for index in 0..12_000 {
        let (ray, sphere) = match index % 5 {
            0 => {
                let far = 10_f32.powf(random.between(-1.0, 1.0) * 4.0 + 4.0);
                let sphere =
                    Sphere { center: random.in_cube(3.0), radius: random.between(0.1, 2.0) };
                let origin = sphere.center + far * random.direction();
                let target = sphere.center + sphere.radius * random.in_cube(0.9);
                (Ray::new(origin, target - origin), sphere)
            }
            // Small integers: tangents, coordinates of zero, ties.
            1 => {
                let [a, b, c, d, e, f, g, h, i] = [(); 9].map(|()| random.integer(-3, 3) as f32);
                let radius = random.integer(1, 4) as f32;
                let sphere = Sphere { center: Vec3::new(a, b, c), radius };
                (Ray::new(Vec3::new(d, e, f), Vec3::new(g, h, i)), sphere)
            }
            // Half-way between numbers: the ray runs along an axis, and o - c has 25 bits.
            2 => {
                let tie =
                    |random: &mut Random| random.pick(&[-1.0, 1.0]) * power_of_two(-24) as f32;
                let center = Vec3::new(tie(&mut random), tie(&mut random), 0.0);
                let sphere = Sphere { center, radius: random.pick(&[4.0, 8.0, 5.0]) };
                let origin = Vec3::new(random.between(1.0, 2.0), -random.between(1.0, 2.0), -9.0);
                (Ray::new(origin, Vec3::Z), sphere)
            }
            // A ground, seen from slightly above it or below.
            3 => {
                let radius = 10_f32.powf(random.between(2.0, 7.0));
                let sphere = Sphere { center: Vec3::new(0.0, -radius, 0.0), radius };
                let near = 10_f32.powf(random.between(-3.0, 3.0));
                let origin = random.in_cube(near);
                (Ray::new(origin, random.direction()), sphere)
            }
            _ => {
                let [a, b, c, d, e, f] = [(); 6].map(|()| random.any_f32());
                let sphere = Sphere { center: Vec3::new(a, b, c), radius: random.any_f32().abs() };
                let origin = Vec3::new(d, e, f);
                (Ray::new(origin, (sphere.center - origin) * 0.5), sphere)
            }
        };
        checked += check(&ray, &sphere);
    }
    assert!(checked > 11_000, "{checked}");
}

/// Every layer against one ray at a time, which is checked against integers; every third ray misses.
#[test]
fn surfaces_are_the_same_at_every_layer() {
    let mut random = Random::seeded(7);
    for (far, size) in [(3.0, 1.0), (1e3, 1.0), (1e6, 0.1), (1e7, 1.0)] {
        let sphere = |random: &mut Random| Sphere {
            center: random.in_cube(4.0),
            radius: if random.one_in(20) { 0.0 } else { size * random.between(0.2, 1.0) },
        };
        let spheres: Vec<_> = (0..40).map(|_| sphere(&mut random)).collect();
        let ray = |random: &mut Random| {
            let origin = far * random.direction();
            let target = match random.integer(0, 3) {
                0 => random.in_cube(4.0),
                1 => 3.0 * origin,
                _ => random.pick(&spheres).center + 0.5 * size * random.in_cube(1.0),
            };
            Ray::new(origin, target - origin)
        };
        let rays: Vec<_> = (0..2001).map(|_| ray(&mut random)).collect();
        let list = SphereList::from(&spheres[..]);
        for tier in Tier::ALL {
            let bits = |surfaces: Vec<[Vec3; 2]>| -> Vec<_> {
                let bits = |v: Vec3| v.to_array().map(f32::to_bits);
                surfaces.into_iter().take(2001).map(|surface| surface.map(bits)).collect()
            };
            let expected = bits(surfaces_of(tier, Layer::Ray, &list, &rays));
            assert!(expected.iter().filter(|&&surface| surface != [[0; 3]; 2]).count() > 50);
            for layer in surface_layers() {
                let found = bits(surfaces_of(tier, layer, &list, &rays));
                assert_eq!(found, expected, "{tier:?} {layer:?} {far}");
            }
        }
    }
}

/// The promise of the other tiers: 2^-24, and 2^-50 (|p| + r) / r over the cosine of the normal and the ray, or the
/// root of that.
#[test]
fn other_tiers_are_within_what_is_stated() {
    let mut random = Random::seeded(8);
    let (mut hits, mut used) = (0, 0.0_f64);
    for _ in 0..60_000 {
        let center = random.in_cube(3.0);
        let origin = center + 10_f32.powf(random.between(0.1, 7.0)) * random.direction();
        let ray = Ray::new(origin, center + random.in_cube(1.0) - origin);
        // At the rim, or nearly so: the sphere reaches past the line.
        let to_rim = line_distance(&Case { ray, sphere: Sphere { center, radius: 0.0 } });
        let radius = (to_rim * (1.0 + f64::from(10_f32.powf(random.between(-7.5, 0.0))))) as f32;
        let sphere = Sphere { center, radius };
        let near = roots(Stable, &ray, &sphere).map(|[near, _]| near);
        let (Some(t), Some([truth, _])) = (near, oracle::surface(&ray, &sphere, false)) else {
            continue;
        };
        let found = surface(Stable, &ray, t, &sphere).normal;
        let truth = Vec3::from_array(truth);
        let off = (found - truth).as_dvec3().abs().max_element();
        let far = f64::from((center - origin).length() / radius);
        let lost = 2.0_f64.powi(-50) * (far + 1.0);
        let facing = f64::from(truth.dot(ray.direction.normalize()).abs());
        let rounding = 2.0_f64.powi(-24) * 1.01;
        let stated = lost.sqrt().min(lost / facing.max(1e-30));
        used = used.max((off - rounding) / stated);
        assert!(off <= rounding + stated, "{off} of {stated}: {ray:?} {sphere:?}");
        hits += 1;
    }
    println!("{used:.3} of what is stated used");
    assert!(hits > 30_000 && used > 0.1, "{hits} {used}");
}

/// From far away the roots are so few steps of t apart that `t_min` tells which is hit.
#[test]
fn a_normal_is_that_of_the_root_that_t_min_leaves() {
    for (z, x, t_min, normal, most) in [
        // The roots are ten steps apart: near enough for a tier's near root to be rounded to the far one, but `t_min` excludes
        // the near root.
        (0.0, 0.8, 900_000.0, 0.6, 1e-6),
        // A root counts by what it rounds to: both round to `t_min`, so the near one is hit.
        (0.1, 0.953_939_2, 12_000_000.0, -0.3, 1e-3),
        (0.005, 0.999_687_45, 900_000.0, -0.025, 1e-3),
    ] {
        let list = SphereList::from([[x, 0.0, t_min, 1.0]]);
        let ray = Ray { t_min, ..Ray::new(z * Vec3::Z, Vec3::Z) };
        for (tier, layer) in surface_layers().flat_map(|at| [(Tier::Stable, at), (Tier::Exact, at)])
        {
            let [found, _] = surfaces_of(tier, layer, &list, &[ray])[0];
            let off = (found - Vec3::new(-x, 0.0, normal)).abs().max_element();
            assert!(off < most, "{found} by {tier:?}, {layer:?}");
        }
    }
}

/// As another tier may answer.
#[test]
fn a_t_that_is_no_root_has_the_surface_at_the_nearer_one() {
    let (ray, sphere) = (Ray::new(Vec3::ZERO, Vec3::Z), Sphere::from([0.0, 0.0, 5.0, 1.0]));
    for (root, normal) in [(4.0, Vec3::NEG_Z), (6.0, Vec3::Z)] {
        for t in [-1000, -2, -1, 0, 1, 2, 1000].map(|ulp| step(root, ulp)) {
            assert_eq!(surface(Exact, &ray, t, &sphere).normal, normal, "{t}");
            assert_eq!(surface(Stable, &ray, t, &sphere).normal, normal, "{t}");
        }
    }
}

#[test]
fn a_point_has_a_normal_that_points_back() {
    let sphere = Sphere { center: Vec3::Z, radius: 0.0 };
    let found = surface(Exact, &Ray::new(Vec3::ZERO, 3.0 * Vec3::Z), 1.0 / 3.0, &sphere);
    assert_eq!((found.normal, found.point), (-Vec3::Z, Vec3::ZERO));
}
