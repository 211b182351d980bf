//! Answers as brute force gives them, for rays that share an origin or a direction, or nearly do.

use super::scenes::{self, EYE, camera, diffuse, end_at_answers, parallel, point, uniform};
use super::{BOTH, EXACT};
use spherule_kernel::{
    DepthList, Intersect, Ray, Sphere, SphereList, Tier, Trace, Vec3, Viewpoint,
};
use spherule_referee::random::Random;
use spherule_referee::strategies::SPECIALS;
use spherule_tests::variants::{assert_same, assert_same_from, levels};

/// Every scene from afar, from its middle and along parallels.
#[test]
fn scenes_from_every_side() {
    for (_, spheres) in scenes::all() {
        for eye in [EYE, Vec3::new(0.01, 0.02, 0.03), Vec3::new(1.5, 0.0, 0.0)] {
            assert_same(BOTH, &camera(eye, Vec3::ZERO, 0.364, 64), &spheres);
            let direction = -eye;
            let rays = parallel(eye, direction, 1.2, 64);
            assert_same_from(Viewpoint::Direction(direction), BOTH, &rays, &spheres);
        }
    }
}

/// Every scene from so far that it is a point; and a camera that sees all but what is behind.
#[test]
fn long_and_wide_lenses() {
    for (_, spheres) in scenes::all() {
        let eye = Vec3::new(3e3, -4e3, 9e3);
        assert_same(BOTH, &camera(eye, Vec3::ZERO, 1e-4, 48), &spheres);
        let eye = Vec3::new(0.1, 0.2, 0.9);
        assert_same(BOTH, &camera(eye, Vec3::ZERO, 4.0, 48), &spheres);
        let direction = Vec3::new(-3.0, 4.0, -9.0);
        let rays = parallel(-1e4 * direction, direction, 1.2, 48);
        assert_same_from(Viewpoint::Direction(direction), BOTH, &rays, &spheres);
    }
}

/// Rays of one point that run in all directions, in no order, so that no frustum holds a packet of them; among them some of other points,
/// dead ones, and ends.
#[test]
fn all_around_a_point() {
    let mut random = Random::new(88, 0);
    for (_, spheres) in scenes::all() {
        for eye in
            [Vec3::new(0.01, 0.02, 0.03), Vec3::new(0.3, -0.4, 0.2), Vec3::new(1.5, 0.0, 0.0)]
        {
            let ray = |random: &mut Random| Ray::new(eye, scenes::unit(random));
            let mut rays: Vec<_> = (0..600).map(|_| ray(&mut random)).collect();
            assert_same(BOTH, &rays, &spheres);
            end_at_answers(&mut random, &mut rays, &spheres);
            for ray in rays.iter_mut().skip(100) {
                match random.integer(0, 60) {
                    0 => ray.origin += point(&mut random, 0.1),
                    1 => ray.direction = Vec3::ZERO,
                    2 => ray.t_min = -1.0,
                    3 => ray.direction *= 1e30,
                    _ => {}
                }
            }
            assert_same_from(Viewpoint::Origin(eye), BOTH, &rays, &spheres);
        }
    }
}

/// Rays beside each other that are steep along one axis alone, and spheres that touch the outermost of them.
#[test]
fn steep_along_one_axis() {
    let mut random = Random::new(87, 0);
    let mut uniform = |low: f64, high: f64| random.uniform(low, high) as f32;
    for _ in 0..400 {
        let (eye, slope) = (Vec3::new(uniform(-1e-3, 1e-3), 0.0, 0.0), uniform(0.05, 0.65));
        let steps = (0..64).map(|number| number as f32 / 63.0);
        let direction = |step: f32| Vec3::new(slope + 1e-3 * step, 0.0, 1.0);
        let rays: Vec<_> = steps.map(|step| Ray::new(eye, direction(step))).collect();
        let far = 10.0_f32.powf(uniform(0.0, 4.0));
        let mut sphere = |number: usize| {
            let (ray, side) =
                if number.is_multiple_of(2) { (&rays[0], -1.0) } else { (&rays[63], 1.0) };
            let (depth, along) = (1.0 + far * uniform(0.0, 1.0), ray.direction.normalize());
            let radius = depth * 0.5_f32.powi(24 - number as i32 % 16);
            let across = side * radius * Vec3::new(along.z, 0.0, -along.x);
            Sphere { center: ray.origin + depth * ray.direction + across, radius }
        };
        let spheres: Vec<_> = (0..80).map(&mut sphere).collect();
        assert_same(EXACT, &rays, &spheres);
    }
}

#[test]
fn lengths_and_intervals() {
    let mut random = Random::new(83, 0);
    let eye = Vec3::new(0.1, 0.2, 2.0);
    let spheres = uniform(500);
    let mut rays = camera(eye, Vec3::ZERO, 0.364, 64);
    let ends = [f32::NEG_INFINITY, f32::INFINITY, -0.5, 0.0, -0.0, 0.5, 1.0, 1.9, 2.5, f32::NAN];
    for ray in &mut rays {
        let length = 2.0_f32.powi(random.integer(-60, 60) as i32);
        ray.direction *= length;
        if random.one_in(8) {
            (ray.t_min, ray.t_max) = (random.pick(&ends) / length, random.pick(&ends) / length);
        } else if random.one_in(2) {
            ray.t_max = random.pick(&ends).max(0.0) / length;
        }
    }
    assert_same_from(Viewpoint::Origin(eye), EXACT, &rays, &spheres);
    // No interval has a negative end, so that depth lists are used.
    let mut rays = camera(eye, Vec3::ZERO, 0.364, 64);
    end_at_answers(&mut random, &mut rays, &spheres);
    assert_same_from(Viewpoint::Origin(eye), EXACT, &rays, &spheres);
    // Shadow rays from a point light: they end where something begins.
    for ray in &mut rays {
        (ray.t_min, ray.t_max) = (0.0, random.uniform(0.3, 0.6) as f32);
    }
    assert_same_from(Viewpoint::Origin(eye), BOTH, &rays, &spheres);
}

/// Exactly tangent along an axis, from one eye: among spheres that touch the same lines.
#[test]
fn tangents() {
    let mut random = Random::new(84, 0);
    let eye = Vec3::new(0.0, 0.0, 8.0);
    let mut spheres = Vec::new();
    for _ in 0..400 {
        let radius = random.integer(1, 32) as f32 / 64.0;
        let z = random.integer(-256, 256) as f32 / 64.0;
        let (x, y) = random.pick(&[(radius, 0.0), (0.0, radius), (-radius, 0.0), (0.0, -radius)]);
        spheres.push(Sphere { center: Vec3::new(x, y, z), radius });
    }
    let rays: Vec<Ray> = (0..400)
        .map(|_| {
            let tiny = random.pick(&[0.0, -0.0, 1e-45, -1e-38, 1e-25, 1e-9]);
            let other = random.pick(&[0.0, -0.0, 1e-45, -1e-38, 1e-25, -1e-9]);
            Ray::new(eye, Vec3::new(tiny, other, -(random.integer(1, 3) as f32)))
        })
        .collect();
    assert_same_from(Viewpoint::Origin(eye), EXACT, &rays, &spheres);
    let straight: Vec<Ray> = (0..400)
        .map(|i| Ray::new(Vec3::new(0.0, (i % 5) as f32 / 64.0, 8.0), Vec3::NEG_Z))
        .collect();
    assert_same_from(Viewpoint::Direction(Vec3::NEG_Z), EXACT, &straight, &spheres);
}

/// Runs in which some rays have another origin, another direction, or numbers that are none.
#[test]
fn rays_that_do_not_fit() {
    let mut random = Random::new(85, 0);
    let eye = EYE;
    let spheres = uniform(300);
    for rate in [3, 40, 400] {
        let mut rays = camera(eye, Vec3::ZERO, 0.364, 80);
        let mut along = parallel(eye, -eye, 1.2, 80);
        for ray in rays.iter_mut().chain(&mut along) {
            if !random.one_in(rate) {
                continue;
            }
            let axis = random.integer(0, 2) as usize;
            match random.integer(0, 4) {
                0 => ray.origin[axis] = random.pick(&SPECIALS),
                1 => ray.direction[axis] = random.pick(&SPECIALS),
                2 => ray.direction = Vec3::ZERO,
                3 => ray.direction = -ray.direction,
                _ => *ray = Ray::new(point(&mut random, 1.0), point(&mut random, 1.0)),
            }
        }
        assert_same_from(Viewpoint::Origin(eye), EXACT, &rays, &spheres);
        assert_same_from(Viewpoint::Direction(-eye), EXACT, &along, &spheres);
        // A viewpoint of no ray, and one of others.
        for odd in [f32::NAN, f32::INFINITY, 3e38, 0.0, 1e-30] {
            assert_same_from(Viewpoint::Origin(Vec3::splat(odd)), EXACT, &rays[..600], &spheres);
            assert_same_from(Viewpoint::Direction(Vec3::splat(odd)), EXACT, &rays[..600], &spheres);
        }
    }
    assert_same_from(Viewpoint::Origin(eye), EXACT, &diffuse(500), &spheres);
}

/// One trace serves several depth lists: what its scratch holds of one is no sphere of the next.
#[test]
fn scratch_of_another_list() {
    let mut random = Random::new(88, 0);
    let rays = camera(EYE, Vec3::ZERO, 0.25, 48);
    for level in levels() {
        let mut scratch = vec![f32::NAN; DepthList::scratch(2000)];
        let mut trace = Trace::new().at(level).with_scratch(&mut scratch);
        let mut seen = 0;
        for (behind, radius) in [(0.0, 0.2), (2.0, 0.02)].repeat(6) {
            let sphere = |_| (point(&mut random, 1.0) - behind * EYE.normalize(), radius);
            let list: SphereList = (0..2000).map(sphere).collect();
            let mut memory = vec![0.0; DepthList::needed(2000)];
            let sorted = DepthList::sort(list.spheres(), Viewpoint::Origin(EYE), &mut memory);
            let sorted = sorted.expect("enough memory");
            let mut hits = [(); 2].map(|()| vec![None; rays.len()]);
            let mut occluded = [(); 2].map(|()| vec![false; rays.len()]);
            sorted.closest_hits_with(Tier::Exact, &mut trace, &rays, &mut hits[0]);
            sorted.any_hits_with(Tier::Exact, &mut trace, &rays, &mut occluded[0]);
            list.closest_hits(Tier::Exact, &rays, &mut hits[1]);
            list.any_hits(Tier::Exact, &rays, &mut occluded[1]);
            assert!(hits[0] == hits[1] && occluded[0] == occluded[1], "{level:?}, {behind}");
            seen += hits[1].iter().flatten().count();
        }
        assert!(seen > 1000, "{seen} hits");
    }
}
