//! Answers as brute force gives them, for tiles whose rays a camera makes during the traversal, behind planes around their corner pixels.

use super::scenes::{self, point, uniform, unit};
use super::{BOTH, EXACT};
use spherule_kernel::{
    Camera, CameraTiles, Exact, HitPacket, Intersect, Projection, Ray, RayPacket, Sphere,
    SphereList, SphereTree, Trace, Vec3,
};
use spherule_referee::random::Random;
use spherule_referee::strategies::SPECIALS;
use spherule_tests::variants::{Frame, assert_same_tiles};

/// A picture of `pixels` x `pixels` from `eye`, or of rays parallel to the way to the target. From its middle to its edge it measures
/// `half`: a slope, or units of the scene.
fn camera(eye: Vec3, target: Vec3, half: f32, pixels: u32, is_parallel: bool) -> Camera {
    let way = (target - eye).normalize();
    let right = way.any_orthonormal_vector();
    let (right, up) = (half * right, half * right.cross(way));
    let step = 2.0 / pixels as f32;
    let middle = if is_parallel { eye } else { way };
    Camera {
        projection: if is_parallel {
            Projection::Parallel { direction: way }
        } else {
            Projection::Perspective { eye }
        },
        corner: middle - (1.0 - 0.5 * step) * (right + up),
        step_x: step * right,
        step_y: step * up,
    }
}

fn whole(camera: Camera, width: u32, height: u32) -> Frame {
    Frame { camera, from: (0, 0), count: (width, height), size: (width, height) }
}

/// Every scene from several sides, near and far, in pictures that tiles fill exactly and in others.
#[test]
fn scenes_from_every_side() {
    let sides = [
        (scenes::EYE, 0.364, 1.2),
        (Vec3::new(0.01, 0.02, 0.03), 1.5, 0.5),
        (Vec3::new(3e3, -4e3, 9e3), 1.5e-4, 1.2),
    ];
    for (number, (_, spheres)) in scenes::all().into_iter().enumerate() {
        for (side, (eye, half, parallel_half)) in sides.into_iter().enumerate() {
            // Each scene gets both sizes in both projections.
            let sizes = [(24, 24), (17, 13)];
            let [size, other] = [number + side, number + side + 1].map(|size| sizes[size % 2]);
            let perspective = camera(eye, Vec3::ZERO, half, size.0, false);
            assert_same_tiles(BOTH, &whole(perspective, size.0, size.1), &spheres);
            let parallel = camera(eye, Vec3::ZERO, parallel_half, other.0, true);
            assert_same_tiles(BOTH, &whole(parallel, other.0, other.1), &spheres);
        }
    }
}

/// Cameras whose pixels' points are mostly rounding: corners far away, steps of some ulps, pixels far from the first; and scenes of every
/// size.
#[test]
fn rounded_pixels() {
    let mut random = Random::new(121, 0);
    for _ in 0..100 {
        let eye = point(&mut random, 4.0);
        let target = point(&mut random, 0.3);
        let half = random.log_uniform(-24, 1) as f32;
        let pixels = 1 << random.integer(4, 24);
        let mut camera = camera(eye, target, half, pixels, random.one_in(2));
        // The pixel at which the tiles begin, in a picture larger than the tiles cover.
        let mut first = || random.integer(0, i64::from(pixels) - 1) as u32;
        let from = (first(), first());
        if random.one_in(3) {
            // The corner is far from the plane's own origin, and the steps lead back.
            let away = unit(&mut random) * random.log_uniform(0, 20) as f32;
            camera.corner -= away;
            camera.step_x += away / (from.0.max(1) as f32);
        }
        let mut spheres = uniform(100);
        aim(&mut random, &camera, from, &mut spheres);
        let frame = Frame { camera, from, count: (16, 12), size: (pixels, pixels) };
        assert_same_tiles(EXACT, &frame, &spheres);
    }
}

/// Puts small spheres where the rays of these pixels go, so that a plane that is slightly too narrow loses one.
fn aim(random: &mut Random, camera: &Camera, (x, y): (u32, u32), spheres: &mut [Sphere]) {
    for sphere in spheres.iter_mut().step_by(2) {
        let pixel =
            |random: &mut Random, first: u32| first.saturating_add(random.integer(0, 15) as u32);
        let ray = camera.get_ray(pixel(random, x), pixel(random, y));
        let at = ray.origin + random.uniform(0.5, 6.0) as f32 * ray.direction.normalize_or_zero();
        if at.is_finite() && at.length() < 50.0 {
            *sphere = Sphere { center: at, radius: random.log_uniform(-22, -6) as f32 };
        }
    }
}

/// Any numbers: an invalid camera hits nothing, and nothing panics.
#[test]
fn any_camera() {
    let mut random = Random::new(122, 0);
    let spheres = uniform(40);
    for _ in 0..300 {
        let mut number = || match random.integer(0, 3) {
            0 => random.pick(&SPECIALS),
            1 => random.any_f32(),
            _ => random.uniform(-2.0, 2.0) as f32,
        };
        let mut vector = || Vec3::new(number(), number(), number());
        let (eye, corner, step_x, step_y) = (vector(), vector(), vector(), vector());
        let projection = if number() > 0.0 {
            Projection::Parallel { direction: eye }
        } else {
            Projection::Perspective { eye }
        };
        let camera = Camera { projection, corner, step_x, step_y };
        let pixels = [0, 1, 4, 1 << 24, (1 << 24) + 1, u32::MAX - 2, u32::MAX];
        let mut pixel = || random.pick(&pixels);
        let (from, size) = ((pixel(), pixel()), (pixel(), pixel()));
        let frame = Frame { camera, from, count: (8, 8), size };
        assert_same_tiles(EXACT, &frame, &spheres);
    }
}

/// A sphere that no box covers, no spheres at all, and fewer tiles than a group has.
#[test]
fn few_of_everything() {
    let camera = camera(scenes::EYE, Vec3::ZERO, 0.364, 16, false);
    let mut spheres = uniform(60);
    spheres[7] = Sphere { center: Vec3::new(1e15, 0.0, -1e20), radius: 1e20 };
    for spheres in [&spheres[..], &[], &spheres[..1]] {
        for (width, height) in [(16, 16), (4, 4), (8, 4), (12, 4), (1, 1), (0, 5)] {
            assert_same_tiles(BOTH, &whole(camera, width, height), spheres);
        }
    }
}

/// Half of the pixels have no finite point: their tiles must not spoil the planes of neighbouring tiles. Found by the fuzz target.
#[test]
fn points_beyond_all_numbers() {
    let far = -f32::MAX;
    for direction in [Vec3::new(0.5625, 0.0, 0.0), Vec3::new(0.5, 0.1, 0.0)] {
        let camera = Camera {
            projection: Projection::Parallel { direction },
            corner: Vec3::new(4.6, -0.0625, far),
            step_x: Vec3::new(0.01, 0.0, 0.0),
            step_y: Vec3::new(0.07, -0.001, -5e36),
        };
        let sphere = Sphere { center: Vec3::new(4.0625, -0.0625, far), radius: 5.125 };
        let other = Sphere { center: Vec3::splat(5.125), radius: 5.125 };
        assert_same_tiles(EXACT, &whole(camera, 11, 8), &[sphere, other]);
    }
}

/// A slope is the quotient of two components, and the inverse of a subnormal one may be infinite.
#[test]
fn directions_without_an_inverse() {
    let sphere = |x| Sphere { center: Vec3::new(x, 0.0, 0.0), radius: 0.0 };
    for step in
        [f32::from_bits(1), f32::from_bits(483), f32::MIN_POSITIVE / 16.0, f32::MIN_POSITIVE]
    {
        for x in [1.8e-34, 1.0] {
            let eye = Vec3::new(x, 0.0, 0.0);
            let mut spheres = vec![sphere(0.0); 40];
            spheres.extend([sphere(x), sphere(2.0 * x)]);
            for step_y in [Vec3::X * step, Vec3::new(step, step, -step)] {
                let projection = Projection::Perspective { eye };
                let camera = Camera { projection, corner: Vec3::ZERO, step_x: Vec3::ZERO, step_y };
                assert_same_tiles(EXACT, &whole(camera, 21, 8), &spheres);
            }
        }
    }
}

/// As far as there are hits, too: rays without room for theirs are left as they are.
#[test]
fn rays_without_room_for_their_hits_are_left_alone() {
    fn check(structure: &impl Intersect) {
        let camera = camera(scenes::EYE, Vec3::ZERO, 0.364, 8, false);
        let tiles = CameraTiles { camera, size: (8, 8), corners: &[(0, 0), (4, 0)] };
        let before = RayPacket::new(&[Ray::new(Vec3::ONE, Vec3::X); 16]);
        let (mut rays, mut hits) = ([before; 2], [HitPacket::none()]);
        structure.closest_hit_tiles(Exact, &mut Trace::new(), tiles, &mut rays, &mut hits);
        assert_ne!(rays[0].ray(0), before.ray(0));
        assert_eq!((rays[1].ray(0), rays[1].ray(15)), (before.ray(0), before.ray(15)));
    }
    let spheres = uniform(40);
    check(&SphereList::from(spheres.as_slice()));
    check(&SphereTree::new(spheres.as_slice()));
}
