//! False hits of `Fast` and `Geometric`, and of `Stable` where squares underflow: which of them a tree or depth list loses.

use super::scenes::{point, uniform};
use spherule_kernel::{Hit, Intersect, Ray, Sphere, SphereTree, Tier, Vec3, Viewpoint, roots};
use spherule_referee::case::HexRay;
use spherule_referee::random::{Random, power_of_two};
use spherule_tests::variants::{
    Memory, Structure, Variant, assert_hits, bits, brute, variants, viewpoint_of,
};

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
        assert!(lost > 0, "{tier:?}: no false hits");
    }
}

/// Rays that start beside a small sphere of a large scene, where boxes are larger by much more than the way to it, and where
/// spheres behind it are met later.
#[test]
fn no_hit_is_lost_near_by_in_a_large_scene() {
    for (bunches, count, wide, radius) in [(60, 16, 0.3, 0.05), (10, 100, 0.5, 0.2)] {
        let mut random = Random::new(81, count);
        let bunch = |random: &mut Random| {
            let middle = random.in_cube(900.0);
            let sphere = |_| Sphere { center: middle + random.in_cube(wide), radius };
            (0..count).map(sphere).collect::<Vec<_>>()
        };
        let spheres: Vec<_> = (0..bunches).flat_map(|_| bunch(&mut random)).collect();
        let aim = |sphere: &Sphere| {
            let origin = sphere.center + random.in_cube(2.0 * wide);
            Ray::new(origin, (sphere.center - origin).normalize())
        };
        let rays: Vec<_> = spheres.iter().map(aim).collect();
        for tier in [Tier::Fast, Tier::Geometric] {
            false_hits_lost(tier, &spheres, &rays, viewpoint_of(&rays));
        }
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

/// Which false hits a tree sees is its own affair, but it sees the same ones of a ray by itself and of many, in any order, at every level, by
/// any call.
#[test]
fn a_tree_sees_the_same_false_hits_by_every_call() {
    let mut random = Random::new(82, 0);
    let (mut seen, mut lost) = (0, 0);
    for count in [1, 6, 66, 800] {
        let spheres: Vec<Sphere> = (0..count)
            .map(|_| {
                let [x, y] = [(); 2].map(|()| random.uniform(-200.0, 200.0) as f32);
                Sphere { center: Vec3::new(x, y, 900.0), radius: 0.1 }
            })
            .collect();
        // Most lines pass a sphere near by.
        let aim = |random: &mut Random| {
            let [x, y] = [(); 2].map(|()| random.uniform(-0.4, 0.4) as f32);
            Ray::new(Vec3::ZERO, (random.pick(&spheres).center + Vec3::new(x, y, 0.0)) / 900.0)
        };
        let mut rays: Vec<Ray> = (0..2000).map(|_| aim(&mut random)).collect();
        let tree = SphereTree::new(spheres.as_slice());
        for order in 0..2 {
            if order == 1 {
                rays.sort_by(|a, b| a.direction.x.total_cmp(&b.direction.x));
            }
            for tier in [Tier::Fast, Tier::Geometric] {
                let alone: Vec<_> = rays.iter().map(|ray| tree.closest_hit(tier, ray)).collect();
                assert_hits(&alone, &rays, &spheres, &|variant| {
                    variant.tier == tier && is_tree(variant)
                });
                let hits = alone.iter().flatten().count();
                let all = brute(tier).closest(&spheres, &rays).iter().flatten().count();
                (seen, lost) = (seen + hits, lost + all - hits);
            }
        }
    }
    assert!(seen > 1000 && lost > 1000, "{seen} {lost}");
}

/// A tree of up to four spheres is a list also where squares underflow: there formulas see a sphere everywhere, or nowhere.
#[test]
fn a_tree_of_few_spheres_sees_what_the_list_sees() {
    let of_radius = |radius: f32| Sphere { center: Vec3::new(1e-21, 0.0, 0.0), radius };
    for (start, sphere, is_seen) in [
        // The line passes the sphere at twice its radius.
        ([2e-23, 0.0, 0.0], [0.0, 0.0, 1e-21, 1e-23], true),
        // The line meets it.
        ([0.0; 3], [2.68e-23, 2.68e-23, 1e-21, 4e-23], false),
    ] {
        let (ray, sphere) = (Ray::from([start, [0.0, 0.0, 1.0]]), Sphere::from(sphere));
        assert_eq!(roots(Tier::Stable, &ray, &sphere).is_some(), is_seen);
        let (tiny, large) = (of_radius(1e-23), Sphere::from([0.0, 0.0, -1.0, 0.25]));
        assert_as_list(&[sphere, tiny], ray);
        assert_as_list(&[tiny, sphere, of_radius(2e-23), large], ray);
    }
}

/// Asserts that trees of these spheres answer a ray as the list does, alone and beside others.
fn assert_as_list(spheres: &[Sphere], ray: Ray) {
    for tier in Tier::ALL {
        let expected = brute(tier).closest(spheres, &[ray])[0];
        for count in [1, 9, 64] {
            assert_hits(&vec![expected; count], &vec![ray; count], spheres, &|variant| {
                let is_refitted = matches!(variant.structure, Structure::Refitted(_));
                variant.tier == tier && (is_tree(variant) || is_refitted)
            });
        }
    }
}

/// Lines near the border of a sphere's box, and products that are subnormal.
#[test]
fn a_tree_sees_the_same_hits_at_the_border_of_a_box() {
    let behind = |x: f32, z: f32| (0..4).map(move |i| [x, 1.0, z - 0.1 * i as f32, 0.1]);
    let [step, tiny] = [-149, -109].map(|exponent| power_of_two(exponent) as f32);
    let large = power_of_two(40) as f32;
    let rows = [
        // A line past the sphere that single precision takes to meet it.
        ([0.001_06, 0.0, 1000.0, 0.001], behind(-700.0, -700.0), Vec3::Z, false),
        ([1.5, 0.51, 0.51, 0.73], behind(-1.5, 0.0), Vec3::new(1.0, step, -step), true),
        (
            [1.5, 0.51, 0.51, 0.73],
            behind(-1.5, 0.0),
            Vec3::new(1.5 * large, 2.4 * tiny, -2.4 * tiny),
            true,
        ),
    ];
    for (sphere, behind, direction, is_true) in rows {
        let spheres: Vec<Sphere> = [sphere].into_iter().chain(behind).map(Sphere::from).collect();
        let ray = Ray::new(Vec3::ZERO, direction);
        assert_eq!(roots(Tier::Exact, &ray, &spheres[0]).is_some(), is_true);
        // A ray with a direction of another length changes how those beside it are prepared.
        let other = Ray::new(Vec3::ZERO, -Vec3::Z * power_of_two(60) as f32);
        for count in [1, 8, 9, 16, 64] {
            let mut rays = vec![ray; count];
            for with_other in [false, true] {
                if with_other {
                    rays.push(other);
                }
                for tier in [Tier::Fast, Tier::Geometric] {
                    // Each by itself, without the neighbour.
                    let alone = |ray: &Ray| brute(tier).closest(&spheres, &[*ray])[0];
                    let expected: Vec<_> = rays.iter().map(alone).collect();
                    assert!(expected[0].is_some(), "{sphere:?}: the formula sees no hit");
                    assert_hits(&expected, &rays, &spheres, &|variant| {
                        variant.tier == tier && is_tree(variant)
                    });
                }
            }
        }
    }
}

/// Whether the rays go through the same tree. (A refitted one may have spheres in no box, and loses none of their false hits.)
fn is_tree(variant: &Variant) -> bool {
    matches!(variant.structure, Structure::Tree(_) | Structure::Stream(_))
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
