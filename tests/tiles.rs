//! Tile lists answer as brute force does, bit for bit, for rays that share an origin or a direction,
//! and for all others.

mod tiles {
    pub(crate) mod same;
    pub(crate) mod scenes;
    pub(crate) mod ways;
}

use proptest::prelude::*;
use spherule_kernel::{DepthOrder, Ray, Sphere, Vec3, Viewpoint};
use spherule_tests::doors::Columns;
use spherule_tests::inputs::{self, SPECIALS, Scene};
use spherule_tests::random::Random;
use std::time::Instant;
use tiles::same::{assert_same, bits, difference};
use tiles::scenes::{self, camera, diffuse, parallel, point, uniform};
use tiles::ways::{WAYS, brute};

const BOTH: &[&str] = &["exact", "stable"];
const EXACT: &[&str] = &["exact"];

/// Every scene from afar, from its middle and along parallels.
#[test]
fn scenes_from_every_side() {
    for (name, spheres) in scenes::all() {
        let start = Instant::now();
        for eye in [Vec3::new(0.3, 0.4, 4.0), Vec3::new(0.01, 0.02, 0.03), Vec3::new(1.5, 0.0, 0.0)]
        {
            let rays = camera(eye, Vec3::ZERO, 0.364, 96);
            assert_same(BOTH, &rays, &spheres, Viewpoint::Origin(eye));
            let direction = -eye;
            let rays = parallel(eye, direction, 1.2, 64);
            assert_same(BOTH, &rays, &spheres, Viewpoint::Direction(direction));
        }
        println!("{name}: {:?}", start.elapsed());
    }
}

/// Every scene from so far that it is a point; and a camera that sees all but what is behind.
#[test]
fn long_and_wide_lenses() {
    for (_, spheres) in scenes::all() {
        let eye = Vec3::new(3e3, -4e3, 9e3);
        assert_same(BOTH, &camera(eye, Vec3::ZERO, 1e-4, 48), &spheres, Viewpoint::Origin(eye));
        let eye = Vec3::new(0.1, 0.2, 0.9);
        assert_same(BOTH, &camera(eye, Vec3::ZERO, 4.0, 48), &spheres, Viewpoint::Origin(eye));
        let direction = Vec3::new(-3.0, 4.0, -9.0);
        let rays = parallel(-1e4 * direction, direction, 1.2, 48);
        assert_same(BOTH, &rays, &spheres, Viewpoint::Direction(direction));
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
    assert_same(EXACT, &rays, &spheres, Viewpoint::Origin(eye));
    // Ends that are answers, and their neighbours; none negative, so that lists are used.
    let mut rays = camera(eye, Vec3::ZERO, 0.364, 64);
    let hits = (brute("exact").nearest)(&rays, &spheres);
    for (ray, hit) in rays.iter_mut().zip(hits) {
        let Some(hit) = hit else { continue };
        let end = random.pick(&[hit.t, hit.t.next_up(), hit.t.next_down()]);
        if random.one_in(2) { ray.t_max = end } else { ray.t_min = end }
    }
    assert_same(EXACT, &rays, &spheres, Viewpoint::Origin(eye));
    // Shadow rays from a point light: they end where something begins.
    for ray in &mut rays {
        (ray.t_min, ray.t_max) = (0.0, random.uniform(0.3, 0.6) as f32);
    }
    assert_same(BOTH, &rays, &spheres, Viewpoint::Origin(eye));
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
    assert_same(EXACT, &rays, &spheres, Viewpoint::Origin(eye));
    let straight: Vec<Ray> = (0..400)
        .map(|i| Ray::new(Vec3::new(0.0, (i % 5) as f32 / 64.0, 8.0), Vec3::NEG_Z))
        .collect();
    assert_same(EXACT, &straight, &spheres, Viewpoint::Direction(Vec3::NEG_Z));
}

/// Runs in which some rays have another origin, another direction, or numbers that are none.
#[test]
fn rays_that_do_not_fit() {
    let mut random = Random::new(85, 0);
    let eye = Vec3::new(0.3, 0.4, 4.0);
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
        assert_same(EXACT, &rays, &spheres, Viewpoint::Origin(eye));
        assert_same(EXACT, &along, &spheres, Viewpoint::Direction(-eye));
        // Nobody's viewpoint, and another's.
        for odd in [f32::NAN, f32::INFINITY, 3e38, 0.0, 1e-30] {
            assert_same(EXACT, &rays[..600], &spheres, Viewpoint::Origin(Vec3::splat(odd)));
            assert_same(EXACT, &rays[..600], &spheres, Viewpoint::Direction(Vec3::splat(odd)));
        }
    }
    assert_same(EXACT, &diffuse(500), &spheres, Viewpoint::Origin(eye));
}

#[test]
fn invalid_and_immense_spheres() {
    let mut spheres = uniform(300);
    let numbers = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 3e38, 2e12, 1e30];
    let mut random = Random::new(86, 0);
    for (i, sphere) in spheres.iter_mut().enumerate().filter(|(i, _)| i % 3 == 0) {
        let number = random.pick(&numbers);
        if i % 2 == 0 { sphere.radius = number } else { sphere.center[i % 3] = number }
    }
    let eye = Vec3::new(0.3, 0.4, 4.0);
    let rays = camera(eye, Vec3::ZERO, 0.364, 48);
    let none = vec![Sphere { center: Vec3::ZERO, radius: f32::NAN }; 100];
    let immense = vec![Sphere { center: Vec3::new(0.0, 3e12, 0.0), radius: 3e12 }; 100];
    for spheres in [spheres, none, immense, Vec::new()] {
        assert_same(EXACT, &rays, &spheres, Viewpoint::Origin(eye));
        let rays = parallel(eye, -eye, 1.2, 48);
        assert_same(EXACT, &rays, &spheres, Viewpoint::Direction(-eye));
    }
}

proptest! {
    #![proptest_config(inputs::config(300))]

    /// The first ray's origin and direction are the viewpoint's; most others share one of them.
    #[test]
    fn scenes_of_all_kinds(scene in inputs::scene(inputs::case), alone in any::<bool>()) {
        let Scene { mut rays, spheres } = scene;
        let Some(&first) = rays.first() else { return Ok(()) };
        for sharing in [true, false] {
            for (i, ray) in rays.iter_mut().enumerate() {
                if alone && i % 5 == 4 {
                    continue;
                }
                if sharing { ray.origin = first.origin } else { ray.direction = first.direction }
            }
            let viewpoint = if sharing {
                Viewpoint::Origin(first.origin)
            } else {
                Viewpoint::Direction(first.direction)
            };
            if let Some(difference) = difference(EXACT, &rays, &spheres, viewpoint) {
                return Err(TestCaseError::fail(difference));
            }
        }
    }
}

#[test]
fn too_little_memory() {
    let viewpoint = Viewpoint::Origin(Vec3::ZERO);
    for count in [0, 1, 15, 16, 17, 1000] {
        let columns = Columns::new(&uniform(count));
        let needed = DepthOrder::needed(count);
        let mut memory = vec![0; needed];
        for words in [0, needed / 2, needed - 1] {
            let error = DepthOrder::new(columns.spheres(), viewpoint, &mut memory[..words])
                .expect_err("less than needed");
            assert_eq!(error.needed, needed);
            assert!(error.to_string().contains(&needed.to_string()), "{error}");
        }
        assert!(DepthOrder::new(columns.spheres(), viewpoint, &mut memory).is_ok());
        assert!(needed * 4 <= 24 * count + 768, "{needed} words for {count}");
    }
    assert_eq!(DepthOrder::needed(usize::MAX), usize::MAX);
    assert_eq!(DepthOrder::lists(usize::MAX), usize::MAX);
}

/// With a list of another length the order is not used; with one of the same length whatever is
/// answered is a hit of that list.
#[test]
fn other_spheres_than_sorted() {
    let eye = Vec3::new(0.3, 0.4, 4.0);
    let rays = camera(eye, Vec3::ZERO, 0.364, 32);
    let made_from = Columns::new(&uniform(500));
    let mut memory = vec![0; DepthOrder::needed(500)];
    let order = DepthOrder::new(made_from.spheres(), Viewpoint::Origin(eye), &mut memory)
        .expect("enough memory");
    let mut lists = vec![0; DepthOrder::lists(500)];
    for way in WAYS {
        for count in [0, 3, 499, 501] {
            let given = uniform(count);
            let expected = (brute(way.tier).nearest)(&rays, &given);
            let (hits, met) = (way.go)(&rays, &Columns::new(&given), &order, &mut lists);
            for i in 0..rays.len() {
                assert_eq!(bits(hits[i]), bits(expected[i]), "{}, {count} spheres", way.name);
                assert_eq!(met[i], expected[i].is_some());
            }
        }
        let invalid = Columns::new(&vec![Sphere { center: Vec3::ZERO, radius: f32::NAN }; 500]);
        let (hits, met) = (way.go)(&rays, &invalid, &order, &mut lists);
        assert!(hits.iter().all(Option::is_none) && !met.contains(&true), "{}", way.name);
    }
}

/// So the lists really are used. A picture of this size, on a loaded machine, in the slowest of
/// builds takes a 20th; of a million pixels, an 80th.
#[test]
fn many_times_as_fast_as_brute_force() {
    let eye = Vec3::new(0.3, 0.4, 4.0);
    let (spheres, rays) = (uniform(10_000), camera(eye, Vec3::ZERO, 0.364, 256));
    let columns = Columns::new(&spheres);
    let mut memory = vec![0; DepthOrder::needed(spheres.len())];
    let mut lists = vec![0; DepthOrder::lists(spheres.len())];
    let door = brute("stable");
    let way = WAYS.iter().rfind(|way| way.tier == "stable").expect("that way");
    let fastest = |work: &mut dyn FnMut()| {
        let times = (0..3).map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64()
        });
        times.fold(f64::INFINITY, f64::min)
    };
    let by_lists = fastest(&mut || {
        let order = DepthOrder::new(columns.spheres(), Viewpoint::Origin(eye), &mut memory);
        let order = order.expect("enough memory");
        drop((way.go)(&rays, &columns, &order, &mut lists));
    });
    let by_brute_force = fastest(&mut || {
        drop((door.nearest)(&rays, &spheres));
        drop((door.any)(&rays, &spheres));
    });
    let ratio = by_brute_force / by_lists;
    println!("brute force takes {ratio:.0} times as long");
    assert!(ratio >= 8.0, "{ratio}");
}
