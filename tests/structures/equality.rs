//! Answers as brute force gives them, where boxes, margins and intervals end.

use super::scenes::{diffuse, end_at_answers, mixed, point, uniform, unit};
use super::{BOTH, EXACT};
use spherule_kernel::{Hit, Ray, Sphere, Tier, Vec3, Viewpoint, roots};
use spherule_referee::case::{Case, HexRay};
use spherule_referee::families::FAMILIES;
use spherule_referee::random::{Random, power_of_two};
use spherule_referee::strategies::SPECIALS;
use spherule_tests::variants::{
    Memory, Structure, assert_same, bits, brute, difference, variants, viewpoint_of,
};

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
        let cases: Vec<Case> = family.cases(400).collect();
        let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
        let spheres: Vec<Sphere> = cases.iter().map(|case| case.sphere).collect();
        if let Some(difference) = difference(EXACT, &rays, &spheres, viewpoint_of(&rays)) {
            panic!("{family:?}: {difference}");
        }
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

/// `Fast` and `Geometric` may lose false hits, and nothing else.
#[test]
fn false_hits_alone_are_lost() {
    let mut spheres = uniform(500);
    // Far from the origin, where both forms have false hits.
    spheres.iter_mut().for_each(|sphere| sphere.center.z -= 300.0);
    let mut random = Random::new(79, 0);
    let rays: Vec<Ray> = (0..4000)
        .map(|_| Ray::new(Vec3::ZERO, point(&mut random, 1.3) - Vec3::new(0.0, 0.0, 300.0)))
        .collect();
    for tier in [Tier::Fast, Tier::Geometric] {
        let lost = false_hits_lost(tier, &spheres, &rays, viewpoint_of(&rays));
        println!("{tier:?}: {lost} false hits lost");
    }
}

/// As many rays as one call has of a camera's, from one ray on: a group of packets loses no hit that a ray by itself sees.
#[test]
fn a_false_hit_within_its_box_is_lost_by_no_call() {
    let spheres = [[700.09, 0.0, 699.91, 0.1]].into_iter();
    let behind = (0..4).map(|i| [-700.0, 0.0, -700.0 - 10.0 * i as f32, 0.1]);
    let spheres: Vec<Sphere> = spheres.chain(behind).map(Sphere::from).collect();
    let ray = Ray::new(Vec3::ZERO, Vec3::new(1.0, 0.0, 1.0));
    assert_eq!(roots(Tier::Exact, &ray, &spheres[0]), None);
    assert_eq!(brute(Tier::Fast).closest(&spheres, &[ray]), [Some(Hit { t: 700.0, sphere: 0 })]);
    for count in [1, 8, 9, 16, 17, 64] {
        let viewpoint = Viewpoint::Origin(ray.origin);
        assert_eq!(false_hits_lost(Tier::Fast, &spheres, &vec![ray; count], viewpoint), 0);
    }
}

/// Spread is by the distance from where rays start, which is far from the spheres of a list along a direction.
#[test]
fn depth_lists_of_a_direction_lose_hits_far_from_spheres_alone() {
    let mut random = Random::new(80, 0);
    let mut lost = 0;
    for distance in [10.0, 100.0, 1000.0, 10_000.0] {
        let mut start = |wide: f64| {
            let [x, y] = [(); 2].map(|()| random.uniform(-wide, wide) as f32);
            Vec3::new(x, y, -distance)
        };
        let rays: Vec<_> = (0..600).map(|_| Ray::new(start(0.3), Vec3::Z)).collect();
        let spheres: Vec<_> =
            (0..40).map(|_| Sphere { center: start(0.3).with_z(0.0), radius: 0.1 }).collect();
        for tier in [Tier::Fast, Tier::Geometric] {
            let viewpoint = Viewpoint::Direction(Vec3::Z);
            lost += false_hits_lost(tier, &spheres[..1], &rays, viewpoint);
            lost += false_hits_lost(tier, &spheres, &rays, viewpoint);
        }
    }
    assert!(lost > 0, "no false hits");
}

/// `SPREAD` of both tiers.
const SPREAD: f64 = 1.0 / 512.0;

/// Whether a structure may lose a false hit of this sphere: a tree if the line misses its box, a depth list if D is off by the spread.
fn may_lose(structure: Structure, ray: &Ray, sphere: &Sphere) -> bool {
    let (d, p) = (ray.direction.as_dvec3(), (sphere.center - ray.origin).as_dvec3());
    let radius = f64::from(sphere.radius);
    if let Structure::DepthList(_) = structure {
        let square = d.cross(p).length_squared() / d.length_squared() - radius * radius;
        let least = SPREAD * (p.length() + radius);
        return square > 0.999 * least * least;
    }
    let ends = [p - radius, p + radius].map(|corner| corner / d);
    // Where the line does not cross a slab, it is inside or it misses.
    let outside = |i: usize| d[i] == 0.0 && p[i].abs() > radius;
    let crossed = |i: usize| d[i] != 0.0;
    let all = [0, 1, 2].into_iter();
    let enters = all.clone().filter(|&i| crossed(i)).map(|i| ends[0][i].min(ends[1][i]));
    let leaves = all.clone().filter(|&i| crossed(i)).map(|i| ends[0][i].max(ends[1][i]));
    let (enter, leave) = (enters.fold(f64::MIN, f64::max), leaves.fold(f64::MAX, f64::min));
    structure != Structure::List && (enter > leave || all.clone().any(outside))
}

/// How many false hits all variants of a tier lose.
fn false_hits_lost(tier: Tier, spheres: &[Sphere], rays: &[Ray], viewpoint: Viewpoint) -> u32 {
    let mut lost = 0;
    Memory::new(spheres).sorted(viewpoint, |structures| {
        let expected = brute(tier).closest(spheres, rays);
        for variant in variants().filter(|variant| variant.tier == tier) {
            let hits = variant.ask(structures, rays).hits;
            for ((ray, hit), expected) in rays.iter().zip(hits).zip(&expected) {
                if bits(hit) != bits(*expected) {
                    lost += 1;
                    let sphere = &spheres[expected.expect("a hit was lost").sphere as usize];
                    let exact = roots(Tier::Exact, ray, sphere);
                    let may = exact.is_none() && may_lose(variant.structure, ray, sphere);
                    assert!(may, "{variant:?}: {} {hit:?} {exact:?}", HexRay(ray));
                }
            }
        }
    });
    lost
}
