//! The small scenes, for brute force: 1024 rays, few enough to stay in the first cache, against a cube of spheres.

use super::{Kind, Scene};
use spherule_kernel::{Ray, Sphere, Vec3};
use spherule_referee::random::Random;

/// Half the side of the cube of the centres.
const HALF: f32 = 10.0;
/// How far from the middle of the cube rays start.
const DISTANCE: f32 = 30.0;
/// Pixels to a side of the camera's picture.
const PICTURE: usize = 32;

/// The small scenes, in the order of the tables.
#[must_use]
pub fn scenes() -> [Scene; 5] {
    let ground = |name, count| {
        let mut list = in_the_cube(count);
        let center = Vec3::new(0.0, -1000.0 - HALF, 0.0);
        list.insert(count / 2, Sphere { center, radius: 1000.0 });
        scene(name, list)
    };
    [
        cube("64", 64),
        cube("1024", 1024),
        // And, in the middle of the list, a sphere of radius 1000 that ends where the cube does. Most lines hit its
        // surface, and no bound that holds for it is a good one for the others.
        ground("64 + ground", 64),
        ground("1024 + ground", 1024),
        // Spheres about the middle of the cube. They are so large that the line of every ray meets each, and so small
        // that no ray starts inside.
        scene("64, every line hits", spheres(64, 0xa11, 1.0, [20.0, 26.0])),
    ]
}

/// `count` spheres uniform in a cube of side 20, radii 0.2 to 0.7. A short list is the start of a long one.
#[must_use]
pub fn cube(name: &'static str, count: usize) -> Scene {
    scene(name, in_the_cube(count))
}

fn in_the_cube(count: usize) -> Vec<Sphere> {
    spheres(count, 0xba11, HALF, [0.2, 0.7])
}

fn spheres(count: usize, seed: u64, half: f32, [least, most]: [f32; 2]) -> Vec<Sphere> {
    let mut random = Random::seeded(seed);
    let sphere = |_| Sphere { center: random.in_cube(half), radius: random.between(least, most) };
    (0..count).map(sphere).collect()
}

fn scene(name: &'static str, spheres: Vec<Sphere>) -> Scene {
    let [primary, diffuse] = Kind::ALL.map(rays);
    Scene { is_small: true, ..Scene::of(name, spheres, primary, diffuse) }
}

/// Rays through a picture of 32 x 32 pixels in tiles of 4 x 4; or rays from all around the cube, each towards another
/// point in it. Directions are 0.5 to 6 long.
fn rays(kind: Kind) -> Vec<Ray> {
    let mut lengths = Random::seeded(0x5eed);
    let mut towards = |origin: Vec3, target: Vec3| {
        let length = lengths.between(0.5, 6.0);
        Ray::new(origin, (target - origin).normalize() * length)
    };
    match kind {
        Kind::Primary => {
            // Rows go upwards here.
            let on_plane = |[x, y]: [f64; 2]| Vec3::new(x as f32 * HALF, -y as f32 * HALF, 0.0);
            let eye = Vec3::new(0.0, 0.0, DISTANCE);
            super::rays::tiles(PICTURE).map(|pixel| towards(eye, on_plane(pixel))).collect()
        }
        Kind::Diffuse => {
            let mut random = Random::seeded(0xd1f7);
            let ray = |_| {
                let origin = random.direction() * DISTANCE;
                towards(origin, random.in_cube(HALF))
            };
            (0..PICTURE * PICTURE).map(ray).collect()
        }
    }
}
