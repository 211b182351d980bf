//! The scenes that structures are measured on: many spheres, and the rays that meet them.
//!
//! | scene | spheres | camera | incoherent rays |
//! |---|---|---|---|
//! | `one` | the unit sphere | 40 degrees, 3 away | in the cube |
//! | `u64`, `u10k`, `u1m` | uniform in the cube from -1 to 1, radii uniform, by the cube root of their number | 40 degrees, 4 away | in the cube |
//! | `flake4` | Eric Haines' sphereflake, four generations, 7,381 | 40 degrees, near | in the cube |
//! | `ground` | a ground of radius 1000, a million of log-normal radii above it | from the side, low | in the layer |
//! | `cloud` | 200,000, so large that most meet a neighbour | 60 degrees, from the middle | in the cube |
//! | `parallel` | 100,000 uniform | parallel, aslant | in the cube |
//! | `long lens` | 10,000 uniform | 10^4 scene sizes away, the scene fills the picture | from as far, all around, towards points in the scene |
//!
//! The first five are those that other programs were measured on before: the same cameras, tiles
//! and distributions; the numbers drawn are others, and so are their bits. A picture has 1024 x 1024
//! rays in tiles of 4 x 4, tiles row by row, so that sixteen rays that follow each other are a
//! coherent packet. Directions have no unit length. Of incoherent rays there are a quarter as many;
//! "in the cube" means origins uniform in it, directions uniform.

mod rays;
mod spheres;

use crate::workload::Cloud;
use spherule_kernel::{Ray, Vec3, Viewpoint};
use std::f64::consts::PI;

/// Which scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Name {
    /// The unit sphere.
    One,
    /// 64 uniform spheres.
    Uniform64,
    /// The sphereflake.
    Flake,
    /// 10,000 uniform spheres.
    Uniform10k,
    /// A million uniform spheres.
    Uniform1m,
    /// A million spheres of very different sizes on a huge one.
    Ground,
    /// Seen from the middle of a dense cloud.
    Cloud,
    /// Seen in parallel projection.
    Parallel,
    /// Seen from very far away.
    LongLens,
}

impl Name {
    /// All of them, in the order of the tables.
    pub const ALL: [Self; 9] = [
        Self::One,
        Self::Uniform64,
        Self::Flake,
        Self::Uniform10k,
        Self::Uniform1m,
        Self::Ground,
        Self::Cloud,
        Self::Parallel,
        Self::LongLens,
    ];

    /// As it stands in tables.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::One => "one",
            Self::Uniform64 => "u64",
            Self::Flake => "flake4",
            Self::Uniform10k => "u10k",
            Self::Uniform1m => "u1m",
            Self::Ground => "ground",
            Self::Cloud => "cloud",
            Self::Parallel => "parallel",
            Self::LongLens => "long lens",
        }
    }

    /// The scene of that name, within a size.
    #[must_use]
    pub fn scene(self, size: Size) -> Scene {
        let pixels = size.pixels;
        let incoherent = pixels * pixels / 4;
        let at_most = |count: usize| count.min(size.spheres);
        let from = |z: f64| rays::perspective([0.0, 0.0, z], [0.0; 3], 40.0, pixels);
        let in_cube = || rays::scattered([-1.0; 3], [1.0; 3], incoherent);
        let (list, primary, diffuse) = match self {
            Self::One => (spheres::one(), from(3.0), in_cube()),
            Self::Uniform64 => (spheres::uniform(64, 1), from(4.0), in_cube()),
            Self::Flake => {
                let camera = rays::perspective([2.1, 1.3, 1.7], [0.0; 3], 40.0, pixels);
                (spheres::flake(4), camera, in_cube())
            }
            Self::Uniform10k => (spheres::uniform(at_most(10_000), 2), from(4.0), in_cube()),
            Self::Uniform1m => (spheres::uniform(at_most(1_000_000), 3), from(4.0), in_cube()),
            Self::Ground => {
                let camera = rays::perspective([0.0, 3.0, 14.0], [0.0, 0.3, 0.0], 40.0, pixels);
                let [low, high] = spheres::LAYER;
                let diffuse = rays::scattered(low, high, incoherent);
                (spheres::over_ground(at_most(1_000_000)), camera, diffuse)
            }
            Self::Cloud => {
                let camera = rays::perspective([0.0; 3], [1.0, 0.4, 0.7], 60.0, pixels);
                (spheres::dense(at_most(200_000)), camera, in_cube())
            }
            Self::Parallel => {
                let camera = rays::parallel([2.0, 3.0, 4.0], [0.0; 3], 3.2, pixels);
                (spheres::uniform(at_most(100_000), 4), camera, in_cube())
            }
            Self::LongLens => {
                // The cube's side is 2; the picture is 2.6 high there.
                let distance = 2.0e4;
                let angle = (1.3_f64 / distance).atan() * 2.0 * 180.0 / PI;
                let camera = rays::perspective([0.0, 0.0, distance], [0.0; 3], angle, pixels);
                (
                    spheres::uniform(at_most(10_000), 2),
                    camera,
                    rays::from_afar(distance, incoherent),
                )
            }
        };
        Scene { name: self.as_str(), spheres: Cloud::of(&list), primary, diffuse }
    }
}

/// How large scenes may be: less for a trial run.
#[derive(Clone, Copy, Debug)]
pub struct Size {
    /// The side of the picture, a multiple of 4.
    pub pixels: usize,
    /// The most spheres that a scene may have whose number is not part of its shape.
    pub spheres: usize,
}

impl Size {
    /// What is measured.
    pub const FULL: Self = Self { pixels: 1024, spheres: usize::MAX };
    /// What shows that everything runs.
    pub const SMALL: Self = Self { pixels: 32, spheres: 3_000 };
}

/// Which of a scene's rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Of the camera.
    Primary,
    /// That have nothing in common.
    Diffuse,
}

impl Kind {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Primary, Self::Diffuse];

    /// As it stands in tables.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Primary => "primary",
            Self::Diffuse => "diffuse",
        }
    }
}

/// Spheres and rays.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What it is called.
    pub name: &'static str,
    /// The spheres.
    pub spheres: Cloud,
    primary: Vec<Ray>,
    diffuse: Vec<Ray>,
}

impl Scene {
    /// `count` uniform spheres, for growth: camera and incoherent rays of the uniform scenes.
    #[must_use]
    pub fn uniform(count: usize, pixels: usize) -> Self {
        Self {
            name: "uniform",
            spheres: Cloud::of(&spheres::uniform(count, 5)),
            primary: rays::perspective([0.0, 0.0, 4.0], [0.0; 3], 40.0, pixels),
            diffuse: rays::scattered([-1.0; 3], [1.0; 3], pixels * pixels / 4),
        }
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

/// What all of the rays have in common, if anything: tile lists need it.
#[must_use]
pub fn viewpoint(rays: &[Ray]) -> Option<Viewpoint> {
    let first = rays.first()?;
    if rays.iter().all(|ray| ray.origin == first.origin) {
        return Some(Viewpoint::Origin(first.origin));
    }
    let parallel = rays.iter().all(|ray| ray.direction == first.direction);
    parallel.then_some(Viewpoint::Direction(first.direction))
}

/// A point in double precision: scenes are made so, and rounded once.
type Point = [f64; 3];

fn rounded(point: Point) -> Vec3 {
    Vec3::from_array(point.map(|coordinate| coordinate as f32))
}

fn plus(a: Point, factor: f64, b: Point) -> Point {
    [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Point) -> Point {
    let length = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    a.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cameras_have_a_viewpoint_and_incoherent_rays_have_none() {
        for name in Name::ALL {
            let scene = name.scene(Size::SMALL);
            let primary = viewpoint(scene.rays(Kind::Primary));
            let is_direction = matches!(primary, Some(Viewpoint::Direction(_)));
            assert!(primary.is_some() && is_direction == (name == Name::Parallel));
            assert_eq!(viewpoint(scene.rays(Kind::Diffuse)), None);
            let pixels = Size::SMALL.pixels * Size::SMALL.pixels;
            let counts = Kind::ALL.map(|kind| scene.rays(kind).len());
            assert_eq!(counts, [pixels, pixels / 4], "{}", name.as_str());
        }
    }
}
