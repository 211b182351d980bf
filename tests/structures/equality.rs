//! Answers as brute force gives them, where boxes, margins and intervals end.

use super::scenes::{diffuse, end_at_answers, mixed, point, uniform, unit};
use super::{BOTH, EXACT};
use spherule_kernel::{Ray, Sphere, Tier, Vec3};
use spherule_referee::case::Case;
use spherule_referee::families::FAMILIES;
use spherule_referee::random::{Random, power_of_two};
use spherule_referee::strategies::SPECIALS;
use spherule_tests::variants::{assert_same, brute};

#[test]
fn any_number_of_spheres() {
    let rays = mixed(500, 16);
    for count in [0, 1, 2, 15, 16, 17, 31, 33, 255, 257, 272, 273, 4097] {
        assert_same(BOTH, &rays, &uniform(count));
    }
}

#[test]
fn intervals() {
    let mut random = Random::new(72, 0);
    let mut rays = diffuse(2000);
    for ray in &mut rays {
        let ends = [f32::NEG_INFINITY, f32::INFINITY, -0.5, 0.0, -0.0, 0.1, 0.5, 1.0, f32::NAN];
        (ray.t_min, ray.t_max) = (random.pick(&ends), random.pick(&ends));
        ray.direction *= random.uniform(0.5, 2.0) as f32;
    }
    assert_same(BOTH, &rays, &uniform(500));
    // Intervals that end at answers, and at their neighbours.
    let spheres = uniform(500);
    end_at_answers(&mut random, &mut rays, &spheres);
    assert_same(BOTH, &rays, &spheres);
}

/// Rays parallel to an axis and exactly tangent, which therefore run in the face of a box.
#[test]
fn tangents_along_axes() {
    let mut random = Random::new(73, 0);
    let spheres: Vec<Sphere> = (0..600)
        .map(|_| Sphere {
            center: Vec3::from_array([(); 3].map(|()| random.integer(-512, 512) as f32 / 512.0)),
            radius: random.integer(1, 64) as f32 / 512.0,
        })
        .collect();
    for away in [2.0, 1000.0] {
        let mut rays = Vec::new();
        for _ in 0..3000 {
            let sphere = random.pick(&spheres);
            let axis = random.integer(0, 2) as usize;
            let side = (axis + random.integer(1, 2) as usize) % 3;
            let sign = random.sign() as f32;
            let mut origin = sphere.center;
            origin[side] += random.sign() as f32 * sphere.radius;
            origin[axis] = -sign * away;
            let mut direction = Vec3::ZERO;
            direction[axis] = sign * random.integer(1, 3) as f32;
            // Zeros of either sign, and numbers near zero.
            let other = 3 - axis - side;
            direction[side] = random.pick(&[0.0, -0.0]);
            direction[other] = random.pick(&[0.0, -0.0, 1e-38, -1e-38, 1e-45, 1e-25]);
            rays.push(Ray::new(origin, direction));
        }
        assert_same(BOTH, &rays, &spheres);
    }
}

/// From half a step of t behind the origin on, T = 0 counts, and a step is as long as the ray's direction. Directions within one group
/// differ here by up to 2^146.
#[test]
fn directions_of_any_length_from_one_point() {
    let mut random = Random::new(78, 0);
    for round in 0..40 {
        let (exponent, first) = (random.integer(60, 126), random.integer(-20, 126));
        let half_a_step = power_of_two(exponent - 150) as f32;
        let corners = [[5.0, 5.0], [-5.0, 5.0], [5.0, -5.0], [-5.0, -5.0]];
        let mut spheres: Vec<Sphere> = corners
            .map(|[x, y]| Sphere { center: Vec3::new(x, y, 5.0), radius: 1.0 })
            .into_iter()
            .collect();
        let mut rays = Vec::new();
        for ray in 0..64 {
            let mut slope = || random.between(-0.2, 0.2);
            let way = Vec3::new(slope(), slope(), 1.0);
            let exponent = if ray == 0 { first } else { exponent };
            rays.push(Ray::new(Vec3::ZERO, way * power_of_two(exponent) as f32));
            if ray % 4 == round % 4 {
                let center = -random.between(0.2, 1.5) * half_a_step * way;
                spheres.push(Sphere { center, radius: random.between(0.05, 0.4) * half_a_step });
            }
        }
        assert_same(EXACT, &rays, &spheres);
        assert_same(EXACT, &rays[..16], &spheres);
    }
}

/// Tangents of any direction; origins on spheres and inside them.
#[test]
fn tangents_and_origins_on_spheres() {
    let mut random = Random::new(74, 0);
    let spheres = uniform(700);
    let mut rays = Vec::new();
    for round in 0..6000 {
        let sphere = random.pick(&spheres);
        let along = random.unit();
        let across = random.perpendicular(along);
        let [along, across] = [along, across].map(|v| Vec3::from_array(v.map(|x| x as f32)));
        let side = sphere.center + sphere.radius * across;
        let away = random.pick(&[0.0, 0.01, 2.0, 1000.0]);
        let origin = if round % 2 == 0 {
            side - away * along
        } else {
            sphere.center
                + random.pick(&[0.0, 0.5, 0.999_999, 1.0, 1.000_001]) * (side - sphere.center)
        };
        rays.push(Ray::new(origin, along));
    }
    assert_same(BOTH, &rays, &spheres);
}

/// Rays with numbers at which something overflows, vanishes or becomes NaN.
#[test]
fn rays_of_any_components() {
    let mut random = Random::new(75, 0);
    let numbers: Vec<f32> = SPECIALS.into_iter().chain([1e-38, 3e38, -3e38, 1e-20, 1e20]).collect();
    let mut rays = Vec::new();
    for _ in 0..8000 {
        let mut ray = Ray::new(point(&mut random, 1.0), unit(&mut random));
        for axis in 0..3 {
            if random.one_in(3) {
                ray.direction[axis] = random.pick(&numbers);
            }
            if random.one_in(8) {
                ray.origin[axis] = random.pick(&numbers);
            }
        }
        if random.one_in(4) {
            ray.direction *= random.pick(&[1e-38, 1e-30, 1e-20, 1e-15, 1e15, 1e18, 1e30]);
        }
        rays.push(ray);
    }
    assert_same(EXACT, &rays, &uniform(300));
}

/// The rays of hard cases against the spheres of hard cases, of one family and of all.
#[test]
fn families() {
    let mut all: Vec<Case> = Vec::new();
    for family in FAMILIES {
        println!("{family:?}");
        let cases: Vec<Case> = family.cases(400).collect();
        let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
        let spheres: Vec<Sphere> = cases.iter().map(|case| case.sphere).collect();
        assert_same(EXACT, &rays, &spheres);
        // Beside a scene that is moved to their place.
        let mut beside = uniform(400);
        for (place, sphere) in beside.iter_mut().step_by(40).zip(&spheres) {
            *place = *sphere;
        }
        assert_same(EXACT, &rays, &beside);
        all.extend(&cases[..60]);
    }
    let rays: Vec<Ray> = all.iter().map(|case| case.ray).collect();
    let spheres: Vec<Sphere> = all.iter().map(|case| case.sphere).collect();
    assert_same(EXACT, &rays, &spheres);
}

#[test]
fn stable_in_its_domain() {
    // Distances up to 1e6 radii, sizes from 2^-30 to 2^30.
    let mut random = Random::new(76, 0);
    for exponent in [-30, -10, 0, 10, 30] {
        let scale = 2.0_f32.powi(exponent);
        let mut spheres = uniform(400);
        for sphere in &mut spheres {
            sphere.center *= scale;
            sphere.radius *= scale;
        }
        let rays: Vec<Ray> = (0..3000)
            .map(|_| {
                let target = random.pick(&spheres);
                let away = 10.0_f64.powf(random.uniform(-1.0, 4.0)) as f32 * scale;
                let along = unit(&mut random);
                let from = target.center - away * along;
                let aside = target.radius * random.uniform(0.0, 1.1) as f32 * unit(&mut random);
                Ray::new(from + aside, along * random.uniform(0.1, 10.0) as f32)
            })
            .collect();
        assert_same(BOTH, &rays, &spheres);
    }
}

/// Where a tier's squares overflow it sees no hit, and so does each structure, for one ray and for many: bounds see the spheres, and leave
/// them to the tier.
#[test]
fn squares_that_overflow() {
    let mut random = Random::new(81, 0);
    let (mut seen, mut unseen) = (0, 0);
    for size in [0, 20, 31, 40, 56, 58, 60, 61, 62, 63, 64, 66, 100] {
        for length in [-20, 0, 3, 31, 55, 62, 64, 100] {
            let [s, l] = [size, length].map(|exponent| power_of_two(exponent) as f32);
            let spheres: Vec<Sphere> = (0..40)
                .map(|_| {
                    let [x, y] = [(); 2].map(|()| random.uniform(-5.0, 5.0) as f32);
                    let center = s * Vec3::new(x, y, random.uniform(20.0, 30.0) as f32);
                    Sphere { center, radius: s }
                })
                .collect();
            let towards = |sphere: &Sphere| Ray::new(Vec3::ZERO, sphere.center / s * l / 25.0);
            let rays: Vec<Ray> = spheres.iter().map(towards).collect();
            for tier in [Tier::Fast, Tier::Geometric, Tier::Stable] {
                let hits = brute(tier).closest(&spheres, &rays).into_iter().flatten().count();
                (seen, unseen) = (seen + hits, unseen + rays.len() - hits);
            }
            // Few spheres are tested without a bound in some calls.
            for count in [2, 5, 40] {
                assert_same(&Tier::ALL, &rays, &spheres[..count]);
                assert_same(&Tier::ALL, &rays[..1], &spheres[..count]);
            }
        }
    }
    assert!(seen > 4000 && unseen > 4000, "{seen} {unseen}");
    // The largest directions, from within a sphere that is as large as all of the scene: twice the size would overflow unseen.
    let size = power_of_two(61) as f32;
    let inside = (0..5).map(|i| [0.1 * i as f32, 0.5, 0.5, 0.01].map(|number| number * size));
    let spheres: Vec<Sphere> =
        [[0.0, 0.0, 0.0, 1.5 * size]].into_iter().chain(inside).map(Sphere::from).collect();
    let rays = vec![Ray::new(Vec3::ZERO, -Vec3::ONE * f32::MAX); 40];
    assert_eq!(brute(Tier::Stable).closest(&spheres, &rays[..1]), [None]);
    assert_same(BOTH, &rays, &spheres);
    assert_same(BOTH, &rays[..1], &spheres);
}
