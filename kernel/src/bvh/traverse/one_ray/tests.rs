use crate::proofs::climb::Random;
use crate::{
    Accuracy, Exact, Fast, Geometric, HitPacket, Intersect, Level, LevelName, Ray, RayPacket,
    Sphere, SphereTree, Stable, Trace, Vec3,
};
use alloc::vec::Vec;

/// Compares every ray by itself at every level with the list in one lane; returns how many hit.
fn check(tier: impl Accuracy, spheres: &[Sphere], rays: &[Ray]) -> usize {
    let tree = SphereTree::new(spheres);
    let list = tree.list().spheres();
    let mut count = 0;
    for (place, ray) in rays.iter().enumerate() {
        let packet = [RayPacket::<[f32; 1]>::new(&[*ray])];
        let mut truth = [HitPacket::<[f32; 1]>::none()];
        list.closest_hit_lanes::<f32>(tier, (), &mut Trace::new(), &packet, &mut truth);
        let truth = truth[0].hit(0);
        count += usize::from(truth.is_some());
        for level in LevelName::ALL.into_iter().filter_map(Level::named) {
            let mut trace = Trace::new().at(level);
            let hit = tree.closest_hit_with(tier, &mut trace, ray);
            let bits = |hit: crate::Hit| (hit.t.to_bits(), hit.sphere);
            assert_eq!(hit.map(bits), truth.map(bits), "{tier:?} {level:?} {place}: {ray:?}");
            assert_eq!(tree.any_hit_with(tier, &mut trace, ray), truth.is_some(), "{place}");
        }
    }
    count
}

fn spheres(random: &mut Random, count: usize, size: f32, radius: f32) -> Vec<Sphere> {
    let mut coordinate = || (random.below(1 << 24) as f32 - 8_388_608.0) / 8_388_608.0;
    let sphere = |_| {
        let center = Vec3::new(coordinate(), coordinate(), coordinate()) * size;
        Sphere { center, radius: radius * coordinate().abs() }
    };
    (0..count).map(sphere).collect()
}

fn rays(random: &mut Random, count: usize, size: f32) -> Vec<Ray> {
    let mut vector = || {
        let mut coordinate = || (random.below(1 << 24) as f32 - 8_388_608.0) / 8_388_608.0;
        Vec3::new(coordinate(), coordinate(), coordinate())
    };
    let ray = |number| {
        let (origin, to) = (vector() * size, vector() * size);
        let ray = Ray::new(origin, to - origin);
        match number % 24 {
            0 => Ray { direction: vector() * 1.0e-30, ..ray },
            1 => Ray { direction: (to - origin) * (1.0e30 / size), ..ray },
            2 => Ray { direction: vector() * 1.0e-42, ..ray },
            3 => Ray::new(to - (to - origin) * 1.0e6, to - origin),
            4 => Ray::new(to - (to - origin) * 1.0e20, to - origin),
            5 => Ray { origin: Vec3::splat(f32::NAN), ..ray },
            6 => Ray { direction: Vec3::INFINITY, ..ray },
            7 => Ray { direction: Vec3::ZERO, ..ray },
            8 => Ray { t_min: 0.5, t_max: 0.25, ..ray },
            9 => Ray { t_min: f32::NEG_INFINITY, ..ray },
            10 => Ray { t_min: -2.0, t_max: -0.5, ..ray },
            11 => Ray { t_min: 0.5, t_max: 0.5, ..ray },
            12 => Ray { t_max: 0.9, ..ray },
            13 => Ray { direction: Vec3::X * to.x, ..ray },
            14 => Ray { direction: -Vec3::Z, ..ray },
            15 => Ray { t_min: f32::NAN, ..ray },
            16 => Ray { t_max: f32::NAN, ..ray },
            17 => Ray { direction: Vec3::ONE * 3.0e38, ..ray },
            _ => ray,
        }
    };
    (0..count).map(ray).collect()
}

#[test]
fn one_ray_hits_what_the_list_says() {
    let mut random = Random(271);
    let mut hits = 0;
    for (count, size, radius) in [
        (0, 1.0, 1.0),
        (1, 1.0, 0.7),
        (2, 1.0, 0.7),
        (5, 1.0, 0.7),
        (16, 1.0, 0.4),
        (64, 1.0, 0.3),
        (64, 1.0e-12, 0.3e-12),
        (300, 1.0e12, 0.2e12),
        (300, 1.0, 1.0),
        (3_000, 1.0, 0.05),
    ] {
        let spheres = spheres(&mut random, count, size, radius);
        let rays = rays(&mut random, 960, size);
        hits += check(Exact, &spheres, &rays);
        // `Stable` promises the same only in its domain.
        if size == 1.0 {
            let usual: Vec<Ray> = rays.iter().skip(18).step_by(24).copied().collect();
            hits += check(Stable, &spheres, &usual);
        }
    }
    assert!(hits > 2_000, "{hits}");
}

#[test]
fn spheres_that_no_bound_sees_are_hit() {
    let mut random = Random(272);
    let mut some = spheres(&mut random, 200, 1.0, 0.1);
    for (at, (distance, radius)) in
        [(1.0e20, 1.0e19), (0.0, 1.0e-30), (3.0e38, 2.9e38), (0.3, 1.0e25)].into_iter().enumerate()
    {
        some.insert(at * 40, Sphere { center: Vec3::new(0.0, 0.0, distance), radius });
    }
    some.push(Sphere { center: Vec3::splat(f32::NAN), radius: 1.0 });
    some.push(Sphere { center: Vec3::ZERO, radius: -1.0 });
    let mut asked = rays(&mut random, 960, 1.0);
    asked.push(Ray::new(Vec3::ZERO, Vec3::Z));
    assert!(check(Exact, &some, &asked) > 200);
}

#[test]
fn of_equal_spheres_the_first_is_hit() {
    let mut random = Random(273);
    for count in [1, 3, 60] {
        let some = spheres(&mut random, count, 1.0, 0.5);
        let many: Vec<Sphere> = some.iter().cycle().take(count * 12).copied().collect();
        let tree = SphereTree::new(many.as_slice());
        for ray in rays(&mut random, 480, 1.0) {
            if let Some(hit) = tree.closest_hit(Exact, &ray) {
                assert!((hit.sphere as usize) < count, "{hit:?}");
            }
        }
        check(Exact, &many, &rays(&mut random, 240, 1.0));
    }
}

/// `Fast` and `Geometric` lose hits on lines that miss the sphere's box, in every call the same.
#[test]
fn a_sphere_alone_among_bad_ones_is_hit_as_by_many_rays() {
    fn check(tier: impl Accuracy) {
        let mut random = Random(274);
        let bad = [[0.0, 0.0, 5.0, -1.0]; 4];
        let tree = SphereTree::new([[[0.0, 0.0, 1e4, 1.0]].as_slice(), &bad].concat());
        let mut near = || 4.0 * random.below(1 << 20) as f32 / (1 << 19) as f32 - 4.0;
        let rays: [Ray; 512] = core::array::from_fn(|_| {
            let origin = Vec3::new(near(), near(), 0.0);
            Ray::new(origin, Vec3::new(near(), near(), 1e4) - origin)
        });
        let (mut hits, mut occluded) = ([None; 512], [false; 512]);
        tree.closest_hits(tier, &rays, &mut hits);
        tree.any_hits(tier, &rays, &mut occluded);
        assert!(hits.iter().flatten().count() > 5);
        for (number, ray) in rays.iter().enumerate() {
            assert_eq!(tree.closest_hit(tier, ray), hits[number], "{tier:?} {ray:?}");
            assert_eq!(tree.any_hit(tier, ray), occluded[number], "{tier:?} {ray:?}");
        }
    }
    check(Fast);
    check(Geometric);
    check(Exact);
}
