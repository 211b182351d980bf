//! Answers as brute force gives them, for rays that start far away or meet large spheres beside small ones. The margins
//! of boxes are narrow there, and everything is close to them.

use super::scenes::{end_at_answers, point, uniform, unit};
use super::{BOTH, EXACT};
use spherule_kernel::{Ray, Sphere, Vec3};
use spherule_referee::aim::{double, single};
use spherule_referee::random::{Random, dot, power_of_two};
use spherule_tests::point::{plus, unit as direction_of};
use spherule_tests::variants::assert_same;

/// How many rays a bundle has.
const BUNDLE: usize = 64;

/// Bundles of rays that look from `distance` at spheres around `middle`: from one point, or parallel beside each other.
/// In some bundles the intervals begin before and end after everything, and half of the rays look away.
fn looks(random: &mut Random, middle: Vec3, distance: f64, bundles: usize) -> Vec<Ray> {
    let mut rays = Vec::new();
    for _ in 0..bundles {
        let eye = single(random.unit().map(|x| x * distance)) + middle;
        let target = middle + point(random, 1.0);
        let (parallel, endless) = (random.one_in(2), random.one_in(4));
        for _ in 0..BUNDLE {
            let aside = point(random, 0.2);
            let origin = if parallel { eye + aside } else { eye };
            let direction = (target + aside - origin) * random.uniform(0.1, 10.0) as f32;
            let mut ray = Ray::new(origin, direction);
            if endless {
                (ray.t_min, ray.t_max) = (f32::NEG_INFINITY, f32::INFINITY);
                ray.direction *= random.sign() as f32;
            }
            rays.push(ray);
        }
    }
    rays
}

/// For the line of the rounded ray: its point closest to `middle`, and its direction of length one.
fn line(ray: &Ray, middle: Vec3) -> ([f64; 3], [f64; 3]) {
    let (o, d, m) = (double(ray.origin), double(ray.direction), double(middle));
    let n = direction_of(d);
    let s = dot([m[0] - o[0], m[1] - o[1], m[2] - o[2]], n);
    (plus(o, s, n), n)
}

/// Spheres that a ray passes at the distance of their radius, give or take some roundings. Half of them touch the
/// outermost ray of a packet, or bundle, from outside.
fn beside(random: &mut Random, rays: &[Ray], middle: Vec3, count: usize) -> Vec<Sphere> {
    let sphere = |_| {
        let (ray, across) = if random.one_in(2) {
            outermost(random, rays)
        } else {
            let ray = random.pick(rays);
            (ray, random.perpendicular(line(&ray, middle).1))
        };
        let (near, n) = line(&ray, middle);
        let radius = random.log_uniform(-14, -3) as f32;
        let off = f64::from(radius) + random.uniform(-1.0, 1.0) * power_of_two(-22);
        let center = plus(plus(near, random.uniform(-1.0, 1.0), n), off, across);
        Sphere { center: single(center), radius }
    };
    (0..count).map(sphere).collect()
}

/// Of some rays that go together, the ray of the greatest or the least slope; and the outward vector across it in the
/// plane of that slope.
fn outermost(random: &mut Random, rays: &[Ray]) -> (Ray, [f64; 3]) {
    let together = random.pick(&[8, 16, BUNDLE]);
    let first = random.integer(0, (rays.len() / together - 1) as i64) as usize * together;
    let d = rays[first].direction.abs();
    let k = if d.x >= d.y && d.x >= d.z { 0 } else { 1 + usize::from(d.z > d.y) };
    let i = (k + random.integer(1, 2) as usize) % 3;
    let side = random.sign();
    let slope = |ray: &Ray| side * f64::from(ray.direction[i]) / f64::from(ray.direction[k]);
    let some = rays[first..first + together].iter();
    let ray = *some.max_by(|a, b| slope(a).total_cmp(&slope(b))).expect("rays");
    let mut across = [0.0; 3];
    (across[i], across[k]) = (side, -slope(&ray));
    let length = dot(across, across).sqrt();
    // Along k the rays may run either way. Outward is where the slope grows along their way.
    let outward = f64::from(ray.direction[k].signum()) / length;
    (ray, across.map(|x| x * outward))
}

/// Spheres that a ray enters at one point, give or take some roundings: any of them may be the nearest.
fn through_one_point(random: &mut Random, rays: &[Ray], middle: Vec3, count: usize) -> Vec<Sphere> {
    let mut spheres = Vec::new();
    while spheres.len() < count {
        let (near, n) = line(&random.pick(rays), middle);
        let entry = plus(near, random.uniform(-1.0, 1.0), n);
        for _ in 0..8 {
            let radius = random.log_uniform(-8, -2);
            let normal = random.unit();
            let outward = if dot(normal, n) < 0.0 { -radius } else { radius };
            let center = single(plus(entry, outward, normal));
            spheres.push(Sphere { center, radius: radius as f32 });
        }
    }
    spheres
}

/// Asserts the above at `middle`, seen from `distance`.
fn assert_same_there(seed: u64, middle: Vec3, distance: f64) {
    let mut random = Random::new(seed, distance.to_bits());
    let mut rays = looks(&mut random, middle, distance, 12);
    let mut spheres = beside(&mut random, &rays, middle, 400);
    spheres.extend(through_one_point(&mut random, &rays, middle, 160));
    assert_same(BOTH, &rays, &spheres);
    end_at_answers(&mut random, &mut rays, &spheres);
    assert_same(BOTH, &rays, &spheres);
}

#[test]
fn from_any_distance() {
    for distance in [0.3, 4.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e8, 1e10, 1e12] {
        assert_same_there(90, Vec3::ZERO, distance);
    }
}

#[test]
fn far_from_the_coordinates_origin() {
    for away in [30.0, 1e3, 1e5] {
        for distance in [4.0, 1e3, 1e6] {
            assert_same_there(91, Vec3::new(away, -0.5 * away, 0.7 * away), distance);
        }
    }
}

/// Lines through the coordinates' origin, at integer distances from spheres of integer radius. From however far, a
/// tangent is exactly a tangent, and it is none if the radius is an ulp off.
#[test]
fn exact_tangents_from_any_distance() {
    // Two integer vectors at right angles, and the length of both.
    let frames = [
        ([1, 2, 2], [2, 1, -2], 3),
        ([2, 3, 6], [3, -6, 2], 7),
        ([1, 4, 8], [4, 7, -4], 9),
        ([4, 4, 7], [1, -8, 4], 9),
        ([2, 6, 9], [6, 7, -6], 11),
    ];
    let mut random = Random::new(92, 0);
    let mut lines = Vec::new();
    let mut spheres = Vec::new();
    for (along, across, length) in frames {
        for turn in 0..3 {
            let sign = [random.sign() as f32, random.sign() as f32, random.sign() as f32];
            let turned = |v: [i32; 3]| {
                Vec3::from_array([0, 1, 2].map(|i| sign[i] * v[(i + turn) % 3] as f32))
            };
            let (along, across) = (turned(along), turned(across));
            lines.push(along);
            for _ in 0..30 {
                let (steps, times) = (random.integer(-40, 40), random.integer(1, 30));
                let (steps, times) = (steps as f32, times as f32);
                let radius = times * length as f32;
                let radius = random.pick(&[radius, radius, radius.next_up(), radius.next_down()]);
                let center = steps * along + random.sign() as f32 * times * across;
                spheres.push(Sphere { center, radius });
            }
        }
    }
    for exponent in 4..=33 {
        let mut rays = Vec::new();
        for along in &lines {
            for _ in 0..8 {
                let distance = power_of_two(exponent) as f32 * random.integer(1, 7) as f32;
                let direction = *along * random.sign() as f32 * random.log_uniform(-8, 8) as f32;
                let mut ray = Ray::new(-distance * *along, *along);
                if random.one_in(2) {
                    // Scaling by a power of two keeps the line.
                    ray.direction = *along * power_of_two(random.integer(-30, 30)) as f32;
                } else if random.one_in(4) {
                    ray.direction = direction;
                    ray.t_min = f32::NEG_INFINITY;
                }
                rays.push(ray);
            }
        }
        assert_same(BOTH, &rays, &spheres);
    }
}

/// Rays in a face of a box, or nearly, that all of its spheres touch: small boxes far from a ray's origin, and far from
/// the coordinates' origin.
#[test]
fn in_the_faces_of_boxes() {
    let mut random = Random::new(94, 0);
    for (place, away) in [(0.0, 1.0), (0.0, 900.0), (100.0, 100.0), (1000.0, 1.0)] {
        let mut spheres = vec![Sphere { center: Vec3::splat(-1e3), radius: 1.0 }];
        let mut rays = Vec::new();
        for _ in 0..40 {
            let offset = [(); 3].map(|()| random.integer(-512, 512) as f32 / 512.0);
            let center = Vec3::splat(place) + Vec3::from_array(offset);
            let radius = random.integer(1, 64) as f32 / 512.0;
            spheres.extend([Sphere { center, radius }; 16]);
            for _ in 0..100 {
                let axis = random.integer(0, 2) as usize;
                let mut touched = center;
                touched[axis] += random.sign() as f32 * radius;
                let mut direction = unit(&mut random);
                direction[axis] = random.pick(&[0.0, -0.0, 1e-30, -1e-8, 1e-6]);
                // Along an axis the line is exactly the tangent.
                if random.one_in(2) {
                    direction[(axis + 1) % 3] = random.pick(&[0.0, 1e-20, -1e-12]);
                }
                let mut origin = touched - away * direction;
                origin[axis] = touched[axis] - away * direction[axis];
                rays.push(Ray::new(origin, direction));
            }
        }
        assert_same(BOTH, &rays, &spheres);
    }
}

/// A ground, and small spheres on it, in it and touching it.
#[test]
fn a_ground_and_tiny_spheres() {
    let mut random = Random::new(93, 0);
    for radius in [30.0_f32, 1e3, 1e5] {
        for distance in [0.5, 14.0, 1e4] {
            let mut rays = looks(&mut random, Vec3::ZERO, distance, 16);
            let mut spheres = beside(&mut random, &rays, Vec3::ZERO, 300);
            spheres.extend(through_one_point(&mut random, &rays, Vec3::ZERO, 100));
            for sphere in uniform(200) {
                let size = sphere.radius * random.pick(&[1e-3, 0.1, 1.0]);
                let center = Vec3::new(sphere.center.x, size, sphere.center.z);
                spheres.push(Sphere { center, radius: size });
            }
            spheres.insert(77, Sphere { center: Vec3::new(0.0, -radius, 0.0), radius });
            // Rays along the ground.
            for _ in 0..8 * BUNDLE {
                let origin = Vec3::new(0.0, 0.01, 0.0) + 0.01 * point(&mut random, 1.0);
                let mut direction = unit(&mut random);
                direction.y *= random.pick(&[0.0, 1e-4, 1e-2]);
                rays.push(Ray::new(origin - distance as f32 * direction, direction));
            }
            assert_same(BOTH, &rays, &spheres);
            end_at_answers(&mut random, &mut rays, &spheres);
            assert_same(EXACT, &rays, &spheres);
        }
    }
}
