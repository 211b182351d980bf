//! Nearest hit by other people's code, beside the kernel's, on the same rays and spheres.
//!
//! | name | what |
//! |---|---|
//! | `ultraviolet/readme` | the ray-sphere example of its README: 8 lanes, both roots every time; wants unit directions, which it gets prepared |
//! | `ultraviolet/deferred` | the same, but roots only where a lane may improve; 8 lanes |
//! | `glam/scalar` | one ray and one sphere at a time, the textbook form with a branch, `Vec3` |
//! | `parry3d/ball` | `Ball::cast_ray`, a ball in its place, as its users call it |
//! | `parry3d/details` | `ray_toi_with_ball`, the function behind it |
//!
//! Every peer's answers pass the check that the kernel's pass. None is tuned beyond what is said
//! here; all carry the index of the nearest sphere along.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use parry3d::math::{Pose, Vector};
use parry3d::query::details::ray_toi_with_ball;
use parry3d::query::{Ray as ParryRay, RayCast};
use parry3d::shape::Ball;
use spherule_benches::check::{self, Tolerance};
use spherule_benches::settings::settings;
use spherule_benches::workload::{Cloud, Kind, RAYS, packets};
use spherule_kernel::{
    Accuracy, Exact, Fast, Hit, HitPacket, Lanes, Ray, Sphere, Stable, f32x8, f32x16, nearest,
};
use std::hint::black_box;
use ultraviolet::{Vec3x8, f32x8 as Lanes8};
use ultraviolet_wide::{CmpGt, CmpLt};

const COUNTS: [usize; 2] = [64, 1024];
/// The answer of a ray: t, `f32::MAX` or more where nothing was hit, and the index of the sphere.
type Answer = (f32, u32);

fn groups(criterion: &mut Criterion) {
    for kind in Kind::ALL {
        for count in COUNTS {
            let (rays, cloud) = (kind.rays(), Cloud::new(count));
            let list = cloud.list();
            let truth = check::reference(&rays, &list);

            let mut group = criterion.benchmark_group(format!("peers/{}/{count}", kind.name()));
            group.throughput(Throughput::Elements((RAYS * count) as u64));
            kernel::<Fast, f32x8>(&mut group, &rays, &cloud);
            kernel::<Fast, f32x16>(&mut group, &rays, &cloud);
            kernel::<Stable, f32x8>(&mut group, &rays, &cloud);
            kernel::<Stable, f32x16>(&mut group, &rays, &cloud);
            kernel::<Exact, f32x8>(&mut group, &rays, &cloud);
            kernel::<Exact, f32x16>(&mut group, &rays, &cloud);

            let mut peer = |name: &str, run: &mut dyn FnMut(&mut [Answer])| {
                let mut answers = vec![(0.0, 0); RAYS];
                run(&mut answers);
                let hits: Vec<_> = answers.iter().map(hit).collect();
                check::near_reference(name, &hits, &truth, Tolerance::TEXTBOOK);
                group.bench_function(name, |bencher| {
                    bencher.iter(|| {
                        run(&mut answers);
                        black_box(&answers);
                    });
                });
            };
            ultraviolet_peers(&mut peer, &rays, &list);
            glam_peer(&mut peer, &rays, &list);
            parry_peers(&mut peer, &rays, &list);
            group.finish();
        }
    }
}

fn hit(&(t, sphere): &Answer) -> Option<Hit> {
    (t < f32::MAX).then_some(Hit { t, sphere })
}

fn kernel<A: Accuracy, L: Lanes<Token = ()>>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    rays: &[Ray],
    cloud: &Cloud,
) {
    check::same_bits::<A, L>(rays, cloud.spheres());
    let packets = packets::<L>(rays);
    let mut hits = vec![HitPacket::<L>::none(); packets.len()];
    group.bench_function(format!("spherule/{}/x{}", A::NAME, L::COUNT), |bencher| {
        bencher.iter(|| {
            nearest::<A, L>((), black_box(&packets), black_box(cloud.spheres()), &mut hits);
            black_box(&hits);
        });
    });
}

type Peer<'a> = dyn FnMut(&str, &mut dyn FnMut(&mut [Answer])) + 'a;

/// Eight rays with unit directions, and how long the directions were.
struct RayX8 {
    origin: Vec3x8,
    direction: Vec3x8,
    length: Lanes8,
}

fn ultraviolet_peers(peer: &mut Peer<'_>, rays: &[Ray], list: &[Sphere]) {
    let lanes = |chunk: &[Ray], of: &dyn Fn(&Ray) -> f32| {
        Lanes8::from(std::array::from_fn::<f32, 8, _>(|lane| of(&chunk[lane])))
    };
    let vector = |chunk: &[Ray], of: &dyn Fn(&Ray) -> glam::Vec3| {
        let axis = |axis: usize| lanes(chunk, &|ray| of(ray)[axis]);
        Vec3x8::new(axis(0), axis(1), axis(2))
    };
    let packets: Vec<_> = rays
        .chunks_exact(8)
        .map(|chunk| RayX8 {
            origin: vector(chunk, &|ray| ray.origin),
            direction: vector(chunk, &|ray| ray.direction.normalize()),
            length: lanes(chunk, &|ray| ray.direction.length()),
        })
        .collect();
    let spheres: Vec<_> = list
        .iter()
        .map(|sphere| {
            let [x, y, z] = sphere.center.to_array();
            (Vec3x8::splat(ultraviolet::Vec3::new(x, y, z)), sphere.radius * sphere.radius)
        })
        .collect();

    let mut every_root = |answers: &mut [Answer]| {
        for (ray, answers) in packets.iter().zip(answers.chunks_exact_mut(8)) {
            let (mut best, mut id) = (Lanes8::splat(f32::MAX), Lanes8::splat(0.0));
            for (index, (center, square)) in spheres.iter().enumerate() {
                let t = readme(ray.origin, ray.direction, *center, Lanes8::splat(*square));
                let nearer = t.cmp_lt(best);
                best = nearer.blend(t, best);
                id = nearer.blend(Lanes8::splat(index as f32), id);
            }
            store(ray, best, id, answers);
        }
    };
    peer("ultraviolet/readme", &mut every_root);

    let mut deferred = |answers: &mut [Answer]| {
        for (ray, answers) in packets.iter().zip(answers.chunks_exact_mut(8)) {
            let (mut best, mut id) = (Lanes8::splat(f32::MAX), Lanes8::splat(0.0));
            for (index, (center, square)) in spheres.iter().enumerate() {
                let square = Lanes8::splat(*square);
                let oc = ray.origin - *center;
                let b = oc.dot(ray.direction);
                let descrim = b * b - (oc.mag_sq() - square);
                if descrim.cmp_gt(Lanes8::splat(0.0)).move_mask() == 0 {
                    continue;
                }
                let t = readme(ray.origin, ray.direction, *center, square);
                let nearer = t.cmp_lt(best);
                best = nearer.blend(t, best);
                id = nearer.blend(Lanes8::splat(index as f32), id);
            }
            store(ray, best, id, answers);
        }
    };
    peer("ultraviolet/deferred", &mut deferred);
}

/// `ray_sphere_intersect_x8` of ultraviolet's README.
#[inline(always)]
fn readme(ray_o: Vec3x8, ray_d: Vec3x8, sphere_o: Vec3x8, sphere_r_sq: Lanes8) -> Lanes8 {
    let oc = ray_o - sphere_o;
    let b = oc.dot(ray_d);
    let c = oc.mag_sq() - sphere_r_sq;
    let descrim = b * b - c;
    let desc_pos = descrim.cmp_gt(Lanes8::splat(0.0));
    let desc_sqrt = descrim.sqrt();
    let t1 = -b - desc_sqrt;
    let t1_valid = t1.cmp_gt(Lanes8::splat(0.0)) & desc_pos;
    let t2 = -b + desc_sqrt;
    let t2_valid = t2.cmp_gt(Lanes8::splat(0.0)) & desc_pos;
    let t = t2_valid.blend(t2, Lanes8::splat(f32::MAX));
    t1_valid.blend(t1, t)
}

/// Distances become multiples of the direction that was given.
fn store(ray: &RayX8, best: Lanes8, id: Lanes8, answers: &mut [Answer]) {
    let hit = best.cmp_lt(Lanes8::splat(f32::MAX));
    let t = hit.blend(best / ray.length, best).to_array();
    for (answer, (t, id)) in answers.iter_mut().zip(t.into_iter().zip(id.to_array())) {
        *answer = (t, id as u32);
    }
}

fn glam_peer(peer: &mut Peer<'_>, rays: &[Ray], list: &[Sphere]) {
    peer("glam/scalar", &mut |answers| {
        for (ray, answer) in rays.iter().zip(answers) {
            let a = ray.direction.dot(ray.direction);
            let mut best = (f32::INFINITY, 0);
            for (index, sphere) in list.iter().enumerate() {
                let p = sphere.center - ray.origin;
                let b = p.dot(ray.direction);
                let discriminant = b * b - a * (p.dot(p) - sphere.radius * sphere.radius);
                if discriminant < 0.0 {
                    continue;
                }
                let root = discriminant.sqrt();
                let near = (b - root) / a;
                let t = if near >= 0.0 { near } else { (b + root) / a };
                if t >= 0.0 && t < best.0 {
                    best = (t, index as u32);
                }
            }
            *answer = best;
        }
    });
}

fn parry_peers(peer: &mut Peer<'_>, rays: &[Ray], list: &[Sphere]) {
    let vector = |v: glam::Vec3| Vector::new(v.x, v.y, v.z);
    let rays: Vec<_> =
        rays.iter().map(|ray| ParryRay::new(vector(ray.origin), vector(ray.direction))).collect();
    let balls: Vec<_> = list
        .iter()
        .map(|sphere| (Pose::from_translation(vector(sphere.center)), Ball::new(sphere.radius)))
        .collect();
    let nearest = |answers: &mut [Answer], cast: &dyn Fn(&ParryRay, &mut Answer)| {
        for (ray, answer) in rays.iter().zip(answers) {
            *answer = (f32::MAX, 0);
            cast(ray, answer);
        }
    };
    peer("parry3d/ball", &mut |answers| {
        nearest(answers, &|ray, best| {
            for (index, (pose, ball)) in balls.iter().enumerate() {
                if let Some(t) = ball.cast_ray(pose, ray, best.0, false)
                    && t < best.0
                {
                    *best = (t, index as u32);
                }
            }
        });
    });
    peer("parry3d/details", &mut |answers| {
        nearest(answers, &|ray, best| {
            for (index, (pose, ball)) in balls.iter().enumerate() {
                if let (_, Some(t)) = ray_toi_with_ball(pose.translation, ball.radius, ray, false)
                    && t < best.0
                {
                    *best = (t, index as u32);
                }
            }
        });
    });
}

criterion_group! {
    name = benches;
    config = settings();
    targets = groups
}
criterion_main!(benches);
