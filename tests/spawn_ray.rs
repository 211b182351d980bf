//! Spawned rays: where they start, and that they miss their sphere there.

mod inside;
mod limits;
mod shadows;
mod until;

use spherule_kernel::{
    Exact, Intersect, Ray, Side, Sphere, SphereList, Surface, Tier, Vec3, roots, side, surface,
};
use spherule_referee::random::{Random, power_of_two};
use spherule_referee::ulp::step;
use spherule_tests::campaign::on_all_cores;
use spherule_tests::oracle;
use std::cmp::Ordering;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// The side in integers.
fn true_side(point: Vec3, sphere: &Sphere) -> Option<Side> {
    match oracle::side(point, sphere) {
        Ordering::Less => Some(Side::Inside),
        Ordering::Equal => None,
        Ordering::Greater => Some(Side::Outside),
    }
}

#[test]
fn sides_are_decided_as_in_integers() {
    let mut random = Random::seeded(21);
    let mut seen = [0; 3];
    for index in 0..60_000 {
        let (point, sphere) = match index % 3 {
            0 => {
                let [a, b, c, d, e, f, g] = [(); 7].map(|()| random.any_f32());
                (Vec3::new(a, b, c), Sphere { center: Vec3::new(d, e, f), radius: g.abs() })
            }
            // Pythagorean: on the surface, or an ulp beside it.
            1 => {
                let scale = power_of_two(random.integer(-30, 30)) as f32;
                let quadruple = random.pick(&[[1.0, 2.0, 2.0, 3.0], [2.0, 3.0, 6.0, 7.0]]);
                let [x, y, z, radius] = quadruple.map(|x: f32| x * scale);
                let center = scale * Vec3::new(random.integer(-4, 4) as f32, 0.0, 8.0);
                let mut point = center + Vec3::new(x, y, z);
                point.x = step(point.x, random.integer(-1, 1));
                (point, Sphere { center, radius })
            }
            // As near as rounding puts it.
            _ => {
                let radius = random.log_uniform(-10, 10) as f32;
                let center = radius * random.in_cube(3.0);
                (center + radius * random.direction(), Sphere { center, radius })
            }
        };
        if !point.is_finite() || !sphere.is_valid() {
            assert_eq!(side(point, &sphere), None);
            continue;
        }
        let truth = true_side(point, &sphere);
        assert_eq!(side(point, &sphere), truth, "{point:?} {sphere:?}");
        seen[truth.map_or(0, |side| 1 + side as usize)] += 1;
    }
    assert!(seen.iter().all(|&count| count > 3000), "{seen:?}");
}

/// A sphere of at least 2^10 ulp of its coordinates, of radius up to 6.4e6, translated up to 1e7; a ray that hits it
/// from up to 1e7 radii away.
fn view(random: &mut Random) -> (Ray, Sphere) {
    let radius = random.log_uniform(-13, 22) as f32;
    let place = (f64::from(radius) * power_of_two(random.integer(0, 13))).min(1e7) as f32;
    let center = match random.integer(0, 3) {
        0 => Vec3::ZERO,
        // The ground: its surface goes through the coordinates' origin.
        1 => radius * random.direction(),
        _ => place * random.direction(),
    };
    let sphere = Sphere { center, radius };
    let distance = radius * 10_f32.powf(random.between(0.05, 7.0));
    let origin = center + distance * random.direction();
    (Ray::new(origin, center + radius * random.in_cube(1.0) - origin), sphere)
}

/// The spacing of numbers at the largest coordinate of a point.
fn spacing(point: Vec3) -> f64 {
    let largest = point.abs().max_element();
    f64::from(largest.next_up()) - f64::from(largest)
}

fn hit(tier: Tier, ray: &Ray, sphere: &Sphere) -> Option<Surface> {
    let [near, _] = roots(tier, ray, sphere)?;
    (near >= 0.0).then(|| surface(tier, ray, near, sphere))
}

/// The normal on a side.
fn outward(surface: &Surface, to: Side) -> Vec3 {
    if to == Side::Outside { surface.normal } else { -surface.normal }
}

/// The ray that `Exact` spawns.
#[track_caller]
fn spawn(surface: &Surface, sphere: &Sphere, to: Side, direction: Vec3) -> Ray {
    surface.spawn_ray(Exact, sphere, to, direction).expect("an origin")
}

/// A direction to the side of `normal`, of any angle and length, nearly along the surface often.
fn departing(random: &mut Random, normal: Vec3) -> Vec3 {
    let across = normal.cross(random.direction()).normalize_or(random.direction());
    let rise = if random.one_in(2) {
        10_f32.powf(random.between(-9.0, 0.0))
    } else {
        random.between(0.0, 2.0)
    };
    // So long that a root below zero may round to zero.
    let power = if random.one_in(8) { 120 } else { random.integer(-20, 20) };
    let direction = power_of_two(power) as f32 * (across + rise * normal);
    if along(direction, normal) < 0.0 { -direction } else { direction }
}

#[test]
fn origins_are_within_two_steps_of_the_point() {
    let mut random = Random::seeded(22);
    let (mut count, mut farthest, mut total) = (0, 0.0_f64, 0.0_f64);
    while count < 100_000 {
        let (ray, sphere) = view(&mut random);
        let Some(surface) = hit(Tier::Exact, &ray, &sphere) else { continue };
        for to in [Side::Outside, Side::Inside] {
            let direction = departing(&mut random, outward(&surface, to));
            let left = spawn(&surface, &sphere, to, direction);
            assert_eq!((left.direction, left.t_max), (direction, f32::INFINITY));
            assert_eq!(true_side(left.origin, &sphere), Some(to), "{ray:?} {sphere:?}");
            // The height over the surface, and how far from the point, whose coordinates are half an ulp of r off.
            let q = left.origin.as_dvec3() - sphere.center.as_dvec3();
            let r = f64::from(sphere.radius);
            let height = ((q.length() - r) / spacing(left.origin)).abs();
            let off = (q - surface.point.as_dvec3()).abs().max_element();
            let from_afar = 2.0_f64.powi(-50) * f64::from((ray.origin - sphere.center).length());
            assert!(
                off <= 2.0 * spacing(left.origin) + 2.0_f64.powi(-23) * r + from_afar,
                "{off}: {ray:?} {sphere:?}"
            );
            // Near zero, neighbouring numbers are closer than double precision knows the point.
            if spacing(left.origin) > 2.0_f64.powi(-45) * r {
                (farthest, total) = (farthest.max(height), total + height);
                count += 1;
            }
        }
    }
    println!(
        "{farthest:.2} ulp over the surface at most, {:.2} on average",
        total / f64::from(count)
    );
    assert!(farthest <= 2.0, "{farthest}");
}

/// A ray that goes back by so little passes over the sphere: from cos^2/2 r above it, and steps double.
#[test]
fn a_ray_that_hardly_goes_back_starts_higher() {
    let mut random = Random::seeded(54);
    let (mut count, mut highest) = (0, 0.0_f64);
    while count < 20_000 {
        let radius = random.between(1.005, 1.03);
        let sphere = Sphere { center: -radius * Vec3::Z, radius };
        let at = 4e-7 * random.in_cube(1.0);
        let ray = Ray::new(Vec3::new(at.x, at.y, 2.0), Vec3::NEG_Z);
        let Some(surface) = hit(Tier::Exact, &ray, &sphere) else { continue };
        let back = 2_f32.powf(random.between(-24.0, -20.0));
        let across = surface.normal.cross(random.direction()).normalize_or(Vec3::X);
        let direction = across - back * surface.normal;
        let spawned = spawn(&surface, &sphere, Side::Outside, direction);
        let r = f64::from(radius);
        let height = (spawned.origin.as_dvec3() - sphere.center.as_dvec3()).length() - r;
        let over = (height - 2.0 * spacing(spawned.origin)) / r;
        highest = highest.max(over);
        assert!(!SphereList::from([sphere]).any_hit(Exact, &spawned) || back > 2_f32.powi(-20));
        count += 1;
    }
    let promised = 2.0_f64.powi(-40);
    println!("{:.2} of what is promised", highest / promised);
    assert!(highest > 0.5 * promised && highest <= promised, "{highest:e}");
}

/// The cosine times both lengths.
fn along(direction: Vec3, normal: Vec3) -> f64 {
    direction.as_dvec3().dot(normal.as_dvec3())
}

/// Returns how many rays were spawned.
fn spawned_rays_miss(tier: Tier, seed: u64, count: u32) -> u32 {
    let mut random = Random::seeded(seed);
    let (mut left, mut lost) = (0, 0);
    while left < count {
        let (ray, sphere) = view(&mut random);
        let Some(surface) = hit(tier, &ray, &sphere) else { continue };
        let list = SphereList::from([sphere]);
        for to in [Side::Outside, Side::Inside] {
            let outward = outward(&surface, to);
            let direction = departing(&mut random, outward);
            let spawned = if random.one_in(4) {
                let target = surface.point + sphere.center + direction;
                surface.spawn_ray_to(tier, &sphere, to, target)
            } else {
                surface.spawn_ray(tier, &sphere, to, direction)
            };
            let Some(spawned) = spawned else {
                lost += 1;
                continue;
            };
            let found = list.closest_hit(tier, &spawned);
            match to {
                Side::Outside if along(spawned.direction, outward) >= 0.0 => {
                    assert_eq!(found, None, "{tier:?} {spawned:?} {sphere:?}");
                }
                Side::Outside => {}
                Side::Inside => {
                    let far = roots(tier, &spawned, &sphere).map(|[_, far]| far);
                    let met = far.filter(|far| spawned.t_min <= *far && *far <= spawned.t_max);
                    assert_eq!(found.map(|hit| hit.t), met, "{tier:?} {spawned:?} {sphere:?}");
                    let real = roots(Exact, &spawned, &sphere).map(|[_, far]| far);
                    let rounded = real.is_some_and(|far| far == 0.0 || far == f32::INFINITY);
                    let squares_hold = !matches!(tier, Tier::Fast | Tier::Geometric)
                        || spawned.direction.length_squared().is_finite();
                    let is_lost = met.is_none() && spawned.t_max > 1.0 && !rounded && squares_hold;
                    assert!(!is_lost, "{tier:?} {spawned:?} {sphere:?}");
                }
            }
            left += 1;
        }
    }
    assert!(lost * 1000 <= left, "{lost} of {left} found no origin");
    left
}

#[test]
fn no_tier_meets_the_sphere_where_a_ray_is_spawned() {
    for (tier, seed) in [(Tier::Fast, 31), (Tier::Stable, 32), (Tier::Geometric, 34)] {
        spawned_rays_miss(tier, seed, 200_000);
    }
    spawned_rays_miss(Tier::Exact, 33, 600_000);
}

/// Takes some half an hour: `cargo test --test main a_billion -- --ignored --nocapture`.
#[test]
#[ignore = "a billion rays"]
fn a_billion_rays_are_spawned() {
    let left = AtomicU64::new(0);
    on_all_cores(2000, |seed| {
        left.fetch_add(spawned_rays_miss(Tier::Exact, 1000 + seed, 500_000).into(), Relaxed);
    });
    assert!(left.into_inner() >= 1_000_000_000);
}

/// The surface that a ray hits, and its sphere.
fn hit_of(
    tier: Tier,
    origin: [f32; 3],
    direction: [f32; 3],
    sphere: [f32; 4],
) -> (Surface, Sphere) {
    let sphere = Sphere::from(sphere);
    let ray = Ray::new(origin.into(), direction.into());
    let hit = SphereList::from([sphere]).closest_hit(tier, &ray).expect("a hit");
    (surface(tier, &ray, hit.t, &sphere), sphere)
}

/// A path tracer turns normals towards the ray that came.
#[test]
fn a_turned_normal_changes_no_ray() {
    let (surface, sphere) =
        hit_of(Tier::Exact, [0.1, 0.2, 5.0], [0.3, 0.5, 1.0], [0.0, 0.0, 5.0, 1.0]);
    let mut turned = surface;
    turned.normal = -turned.normal;
    let out = Vec3::new(0.3, 0.5, 1.0);
    assert_eq!(turned.incident_side(out), surface.incident_side(out));
    for (to, direction) in [(Side::Outside, out), (Side::Inside, -out)] {
        let [spawned, of_turned] =
            [surface, turned].map(|surface| surface.spawn_ray(Exact, &sphere, to, direction));
        assert!(spawned.is_some());
        assert_eq!(spawned, of_turned);
    }
}
