//! Scenes that are measured: spheres, and the rays that meet them. Their random draws never change.
//!
//! | large scene | spheres | camera | diffuse rays |
//! |---|---|---|---|
//! | `one` | the unit sphere | 40 degrees, 3 away | in the cube |
//! | `u64`, `u10k`, `u1m` | uniform in the cube from -1 to 1, radii uniform, by the cube root of their number | 40 degrees, 4 away | in the cube |
//! | `flake4` | Eric Haines' sphereflake, four generations, 7,381 | 40 degrees, near | in the cube |
//! | `ground` | a ground of radius 1000, a million of log-normal radii above it | from the side, low | in the layer |
//! | `cloud` | 200,000, so large that most meet a neighbour | 60 degrees, from the middle | in the cube |
//! | `parallel` | 100,000 uniform | parallel, aslant | in the cube |
//! | `long lens` | 10,000 uniform | 10^4 scene sizes away, the scene fills the picture | from as far, all around, towards points in the scene |
//! | `shell` | 100,000 small ones on the unit sphere | 40 degrees, 3 away | in the cube: half of them within |
//! | `nested` | 4,000 around the origin, radii from 1/4000 to 1 | 40 degrees, 3 away | in the cube: half of them within |
//! | `duplicates` | 1,000 uniform, each at ten indices | 40 degrees, 4 away | in the cube |
//! | `inside` | 10,000, radii 0.1 to 0.3 in the cube | 60 degrees, from the middle | in the cube: each within some forty |
//! | `huge and tiny` | one of radius 0.9 at the origin, a million tiny ones in the cube | 40 degrees, 4 away | in the cube |
//! | `chains` | 100 straight rows of 1,000 that touch, 3 long | 40 degrees, 4 away | in the cube |
//!
//! [`Scene::spread`], whose radii span more than a millionfold, is not in the table: no other scene spans as much.
//!
//! A picture has 1024 x 1024 primary rays in tiles of 4 x 4, tiles row by row, so that sixteen consecutive rays are a coherent packet.
//! Directions have no unit length. There are a quarter as many diffuse rays, which have nothing in common; "in the cube" means origins
//! uniform in it, directions uniform. The [small] scenes are lists.

mod hard;
mod rays;
pub mod small;
mod spheres;

use spherule_kernel::{Ray, Sphere, SphereList, SphereTree, Vec3, Viewpoint};
use spherule_referee::aim::{double, single};
use spherule_referee::random::power_of_two;
use std::f64::consts::PI;
use std::rc::Rc;

/// The large scenes, in the order of the tables.
pub const LARGE: [&str; 15] = [
    "one",
    "u64",
    "flake4",
    "u10k",
    "u1m",
    "ground",
    "cloud",
    "parallel",
    "long lens",
    "shell",
    "nested",
    "duplicates",
    "inside",
    "huge and tiny",
    "chains",
];

/// The name of [`Scene::spread`].
pub const SPREAD: &str = "spread";

/// Spheres and rays.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The name in tables.
    pub name: &'static str,
    /// The spheres.
    pub spheres: Rc<SphereList>,
    /// Whether it is one of the [small] ones.
    pub is_small: bool,
    primary: Vec<Ray>,
    diffuse: Vec<Ray>,
}

/// Which of a scene's rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The rays of the camera.
    Primary,
    /// Rays that have nothing in common.
    Diffuse,
}

impl Kind {
    /// Both kinds.
    pub const ALL: [Self; 2] = [Self::Primary, Self::Diffuse];

    /// The name in tables.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Primary => "primary",
            Self::Diffuse => "diffuse",
        }
    }
}

/// How large scenes may be: the side of the picture in pixels, a multiple of 4, and the most spheres of a scene whose shape does not fix
/// their number.
#[derive(Clone, Copy, Debug)]
pub struct Size(pub usize, pub usize);

impl Size {
    /// What is measured.
    pub const FULL: Self = Self(1024, usize::MAX);
    /// For a trial run.
    pub const SMALL: Self = Self(32, 3_000);
}

impl Scene {
    /// The large scene of that name; `None` if there is none.
    #[must_use]
    pub fn large(name: &str, Size(pixels, most): Size) -> Option<Self> {
        let name = LARGE.into_iter().find(|other| *other == name)?;
        let count = pixels * pixels / 4;
        let at_most = |count: usize| count.min(most);
        let camera = |eye, target, angle| rays::perspective(eye, target, angle, pixels);
        let from = |z: f64| camera([0.0, 0.0, z], [0.0; 3], 40.0);
        let from_within = || camera([0.0; 3], [1.0, 0.4, 0.7], 60.0);
        let in_cube = || rays::scattered([-1.0; 3], [1.0; 3], count);
        let (spheres, primary, diffuse) = match name {
            "one" => (spheres::one(), from(3.0), in_cube()),
            "u64" => (spheres::uniform(64, 1), from(4.0), in_cube()),
            "flake4" => (spheres::flake(4), camera([2.1, 1.3, 1.7], [0.0; 3], 40.0), in_cube()),
            "u10k" => (spheres::uniform(at_most(10_000), 2), from(4.0), in_cube()),
            "u1m" => (spheres::uniform(at_most(1_000_000), 3), from(4.0), in_cube()),
            "ground" => {
                let [low, high] = spheres::LAYER;
                let primary = camera([0.0, 3.0, 14.0], [0.0, 0.3, 0.0], 40.0);
                let diffuse = rays::scattered(low, high, count);
                (spheres::over_ground(at_most(1_000_000)), primary, diffuse)
            }
            "cloud" => (spheres::dense(at_most(200_000)), from_within(), in_cube()),
            "parallel" => {
                let primary = rays::parallel([2.0, 3.0, 4.0], [0.0; 3], 3.2, pixels);
                (spheres::uniform(at_most(100_000), 4), primary, in_cube())
            }
            "shell" => (hard::shell(at_most(100_000)), from(3.0), in_cube()),
            "nested" => (hard::nested(at_most(4000)), from(3.0), in_cube()),
            "duplicates" => (hard::duplicates(at_most(10_000)), from(4.0), in_cube()),
            "inside" => (hard::overlapping(at_most(10_000)), from_within(), in_cube()),
            "huge and tiny" => (hard::huge_and_tiny(at_most(1_000_000)), from(4.0), in_cube()),
            "chains" => (hard::chains(at_most(100_000)), from(4.0), in_cube()),
            _ => {
                // The cube's side is 2; at the cube the picture is 2.6 high.
                let distance = 2.0e4;
                let angle = (1.3_f64 / distance).atan() * 2.0 * 180.0 / PI;
                let primary = camera([0.0, 0.0, distance], [0.0; 3], angle);
                let diffuse = rays::from_afar(distance, count);
                (spheres::uniform(at_most(10_000), 2), primary, diffuse)
            }
        };
        Some(Self::of(name, spheres, primary, diffuse))
    }

    fn of(name: &'static str, spheres: Vec<Sphere>, primary: Vec<Ray>, diffuse: Vec<Ray>) -> Self {
        Self { name, spheres: Rc::new(spheres.into()), is_small: false, primary, diffuse }
    }

    /// With the rays of the uniform scenes.
    fn in_cube(name: &'static str, spheres: Vec<Sphere>, pixels: usize) -> Self {
        let primary = rays::perspective([0.0, 0.0, 4.0], [0.0; 3], 40.0, pixels);
        let [low, high] = spheres::CUBE;
        Self::of(name, spheres, primary, rays::scattered(low, high, pixels * pixels / 4))
    }

    /// Whether there is a sphere of radius 1000.
    #[must_use]
    pub fn has_ground(&self) -> bool {
        self.spheres.spheres().iter().any(|sphere| sphere.radius == 1000.0)
    }

    /// Radii that span more than a millionfold: at most 20,000 spheres in the cube, a third of which lies in some sphere.
    #[must_use]
    pub fn spread(Size(pixels, most): Size) -> Self {
        Self::in_cube(SPREAD, hard::spread(most.min(20_000)), pixels)
    }

    /// `count` uniform spheres, to measure growth, with the rays of the uniform scenes.
    #[must_use]
    pub fn uniform(count: usize, pixels: usize) -> Self {
        Self::in_cube("uniform", spheres::uniform(count, 5), pixels)
    }

    /// The same scene multiplied by a power of two, with directions multiplied by another.
    #[must_use]
    pub fn scaled(&self, [scene, length]: [i64; 2]) -> Self {
        let ray = |ray: &Ray| scaled_ray(ray, scene, length);
        let spheres = self.spheres.spheres().iter().map(|sphere| scaled_sphere(&sphere, scene));
        Self {
            spheres: Rc::new(spheres.collect()),
            primary: self.primary.iter().map(ray).collect(),
            diffuse: self.diffuse.iter().map(ray).collect(),
            ..self.clone()
        }
    }

    /// The kernel's tree over the spheres.
    #[must_use]
    pub fn tree(&self) -> Rc<SphereTree> {
        Rc::new(SphereTree::new((*self.spheres).clone()))
    }

    /// One sphere, and no rays.
    #[must_use]
    pub fn of_case(sphere: Sphere) -> Self {
        Self { is_small: true, ..Self::of("", vec![sphere], Vec::new(), Vec::new()) }
    }

    /// Its rays, in the order in which they fill packets.
    #[must_use]
    pub fn rays(&self, kind: Kind) -> &[Ray] {
        match kind {
            Kind::Primary => &self.primary,
            Kind::Diffuse => &self.diffuse,
        }
    }
}

/// A sphere multiplied by a power of two.
#[must_use]
pub fn scaled_sphere(sphere: &Sphere, exponent: i64) -> Sphere {
    let radius = (f64::from(sphere.radius) * power_of_two(exponent)) as f32;
    Sphere { center: times(sphere.center, exponent), radius }
}

/// A ray without an end, its origin multiplied by one power of two, its direction by another.
#[must_use]
pub fn scaled_ray(ray: &Ray, exponent: i64, length: i64) -> Ray {
    Ray::new(times(ray.origin, exponent), times(ray.direction, length))
}

fn times(vector: Vec3, exponent: i64) -> Vec3 {
    single(double(vector).map(|x| x * power_of_two(exponent)))
}

/// What all of the rays share, which a depth list needs; `None` for diffuse rays.
#[must_use]
pub fn viewpoint(rays: &[Ray]) -> Option<Viewpoint> {
    let first = rays.first()?;
    if rays.iter().all(|ray| ray.origin == first.origin) {
        return Some(Viewpoint::Origin(first.origin));
    }
    let parallel = rays.iter().all(|ray| ray.direction == first.direction);
    parallel.then_some(Viewpoint::Direction(first.direction))
}

/// About `count` of the rays, in runs spread over all of them, so that packets stay whole.
#[must_use]
pub fn sample(rays: &[Ray], count: usize) -> Vec<Ray> {
    /// More rays than the packets that go together through the tree have.
    const RUN: usize = 256;
    if rays.len() <= count.max(RUN) {
        return rays.to_vec();
    }
    let runs = (count / RUN).max(1);
    let stride = rays.len() / runs;
    // A run starts anywhere in its stretch, by the golden ratio. At the same place in each, all runs would be of one column of a picture.
    let within = |run: usize| ((run + 1) as f64 * 0.618_034).fract() * (stride - RUN) as f64;
    let start = |run: usize| run * stride + within(run) as usize / RUN * RUN;
    (0..runs).flat_map(|run| rays[start(run)..].iter().take(RUN)).copied().collect()
}
