//! What is timed: 1024 rays, few enough to stay in the first cache, against a cube of spheres.

use crate::random::Random;
use spherule_kernel::{Lanes, Ray, RayPacket, Sphere, Spheres, Vec3};

/// How many rays a workload has.
pub const RAYS: usize = 1024;
/// How many spheres the timed lists have.
pub const SPHERES: [usize; 4] = [1, 8, 64, 1024];
/// Half the side of the cube of the centres.
const HALF: f32 = 10.0;
/// How far from the middle of the cube rays start.
const DISTANCE: f32 = 30.0;
/// Pixels to a side of the camera's picture, and of a tile of it.
const PICTURE: u32 = 32;
const TILE: u32 = 4;

/// Which rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A picture of 32 x 32 pixels in tiles of 4 x 4: one origin, neighbours nearly parallel.
    Camera,
    /// Origins all around the cube, every ray towards another point in it.
    Incoherent,
}

impl Kind {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Camera, Self::Incoherent];

    /// The name in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Camera => "camera",
            Self::Incoherent => "incoherent",
        }
    }

    /// The rays, in the order in which they fill packets. Directions are 0.5 to 6 long.
    #[must_use]
    pub fn rays(self) -> Vec<Ray> {
        let mut random = Random::new(0x5eed);
        let mut towards = |origin: Vec3, target: Vec3| {
            let length = random.between(0.5, 6.0);
            Ray::new(origin, (target - origin).normalize() * length)
        };
        match self {
            Self::Camera => {
                let eye = Vec3::new(0.0, 0.0, DISTANCE);
                tiles().map(|pixel| towards(eye, on_plane(pixel))).collect()
            }
            Self::Incoherent => {
                let mut random = Random::new(0xd1f7);
                (0..RAYS)
                    .map(|_| towards(random.direction() * DISTANCE, random.in_cube(HALF)))
                    .collect()
            }
        }
    }
}

/// The pixels of the picture, tile by tile.
fn tiles() -> impl Iterator<Item = (u32, u32)> {
    let tiles = PICTURE / TILE;
    (0..PICTURE * PICTURE).map(move |index| {
        let (tile, within) = (index / (TILE * TILE), index % (TILE * TILE));
        (tile % tiles * TILE + within % TILE, tile / tiles * TILE + within / TILE)
    })
}

/// Where a pixel's ray crosses the plane through the middle of the cube.
fn on_plane((ix, iy): (u32, u32)) -> Vec3 {
    let at = |index: u32| (2.0 * (index as f32 + 0.5) / PICTURE as f32 - 1.0) * HALF;
    Vec3::new(at(ix), at(iy), 0.0)
}

/// The rays in packets of `L`.
#[must_use]
pub fn packets<L: Lanes>(rays: &[Ray]) -> Vec<RayPacket<L>> {
    rays.chunks(L::COUNT).map(RayPacket::<L>::new).collect()
}

/// Spheres in memory of their own, coordinate by coordinate.
#[derive(Clone, Debug, Default)]
pub struct Cloud {
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
    r: Vec<f32>,
}

impl Cloud {
    /// `count` spheres uniform in a cube of side 20, radii 0.2 to 0.7.
    #[must_use]
    pub fn new(count: usize) -> Self {
        let mut random = Random::new(0xba11);
        let mut cloud = Self::default();
        for _ in 0..count {
            let center = random.in_cube(HALF);
            cloud.x.push(center.x);
            cloud.y.push(center.y);
            cloud.z.push(center.z);
            cloud.r.push(random.between(0.2, 0.7));
        }
        cloud
    }

    /// `count` spheres as [`Cloud::new`] has them and, in the middle of the list, a ground: a
    /// sphere of radius 1000 that ends where the cube does. Its surface is a line hit for most
    /// rays, and no bound that holds for it is a good one for the others.
    #[must_use]
    pub fn with_ground(count: usize) -> Self {
        let mut cloud = Self::new(count);
        cloud.x.insert(count / 2, 0.0);
        cloud.y.insert(count / 2, -1000.0 - HALF);
        cloud.z.insert(count / 2, 0.0);
        cloud.r.insert(count / 2, 1000.0);
        cloud
    }

    /// `count` spheres about the middle of the cube, so large that the line of every ray of every
    /// [`Kind`] meets each, and small enough that no ray starts inside.
    #[must_use]
    pub fn on_every_line(count: usize) -> Self {
        let mut random = Random::new(0xa11);
        let mut cloud = Self::default();
        for _ in 0..count {
            let center = random.in_cube(1.0);
            cloud.x.push(center.x);
            cloud.y.push(center.y);
            cloud.z.push(center.z);
            cloud.r.push(random.between(20.0, 26.0));
        }
        cloud
    }

    /// The spheres of a list.
    #[must_use]
    pub fn of(list: &[Sphere]) -> Self {
        let axis = |axis: usize| list.iter().map(|sphere| sphere.center[axis]).collect();
        let r = list.iter().map(|sphere| sphere.radius).collect();
        Self { x: axis(0), y: axis(1), z: axis(2), r }
    }

    /// As the kernel reads them.
    ///
    /// # Panics
    /// Never: the lengths are equal.
    #[must_use]
    pub fn spheres(&self) -> Spheres<'_> {
        Spheres::new(&self.x, &self.y, &self.z, &self.r).expect("equal lengths")
    }

    /// One after the other, as most other code wants them.
    #[must_use]
    pub fn list(&self) -> Vec<Sphere> {
        self.spheres().iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_every_pixel_once_in_tiles() {
        let pixels: Vec<_> = tiles().collect();
        assert_eq!(pixels[..5], [(0, 0), (1, 0), (2, 0), (3, 0), (0, 1)]);
        let mut sorted = pixels;
        sorted.sort_unstable();
        sorted.dedup();
        assert_eq!(sorted.len(), RAYS);
    }

    #[test]
    fn workloads_are_what_they_say() {
        for kind in Kind::ALL {
            let rays = kind.rays();
            assert_eq!(rays.len(), RAYS);
            for ray in &rays {
                assert!((ray.origin.length() - DISTANCE).abs() < 1e-4);
                assert!((0.49..=6.01).contains(&ray.direction.length()));
            }
            assert_eq!(rays[0].origin == rays[1].origin, kind == Kind::Camera);
        }
        for sphere in Cloud::new(1024).list() {
            assert!(sphere.center.abs().max_element() <= HALF);
            assert!((0.2..=0.7).contains(&sphere.radius));
        }
        for kind in Kind::ALL {
            for ray in kind.rays() {
                for sphere in Cloud::on_every_line(64).list() {
                    let p = sphere.center - ray.origin;
                    let off = p.cross(ray.direction).length() / ray.direction.length();
                    assert!(off < sphere.radius && sphere.radius < p.length());
                }
            }
        }
        assert_eq!(Cloud::with_ground(64).list()[32].radius, 1000.0);
        assert_eq!(Cloud::with_ground(64).list().len(), 65);
        // A short list is the start of a long one.
        assert_eq!(Cloud::new(8).list(), Cloud::new(64).list()[..8]);
    }
}
