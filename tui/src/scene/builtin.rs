//! The scenes that come with the program.

use super::{Light, Scene, Source, xyz};
use crate::color::Srgb;
use crate::view::{Lens, View};
use spherule_kernel::{Sphere, Vec3};

/// A scene with a name.
#[derive(Clone, Copy, Debug)]
pub struct Builtin {
    /// What it is called on the command line.
    pub name: &'static str,
    /// What it shows, in a few words.
    pub description: &'static str,
    /// Makes it.
    pub scene: fn() -> Scene,
}

/// The scene that is shown where none is named.
pub const DEFAULT: &str = "marbles";

/// All of them.
pub const BUILTINS: [Builtin; 5] = [
    Builtin {
        name: "marbles",
        description: "lit spheres with shadows on a huge ground sphere",
        scene: marbles,
    },
    Builtin {
        name: "unit",
        description: "the unit sphere without a light: white where a ray hits",
        scene: unit,
    },
    Builtin {
        name: "flake",
        description: "a sphereflake of depth 4: nine children of a third the radius",
        scene: flake,
    },
    Builtin {
        name: "edge",
        description: "far, tiny, huge and grazing spheres, where single precision ends",
        scene: edge,
    },
    Builtin {
        name: "caffeine",
        description: "a molecule, read from the .xyz file that comes with the program",
        scene: caffeine,
    },
];

/// The scene called `name`.
#[must_use]
pub fn builtin(name: &str) -> Option<Scene> {
    BUILTINS.iter().find(|builtin| builtin.name == name).map(|builtin| (builtin.scene)())
}

/// The scene of a file that comes with the program, for those who have the program alone.
#[must_use]
pub fn shipped_file(name: &str) -> Option<Scene> {
    (name == "caffeine.xyz").then(caffeine)
}

fn caffeine() -> Scene {
    let text = include_str!("../../scenes/caffeine.xyz");
    match xyz::read(text.as_bytes(), "caffeine.xyz") {
        Ok(scene) => scene,
        Err(error) => unreachable!("{error}"),
    }
}

fn sphere(x: f32, y: f32, z: f32, radius: f32) -> Sphere {
    Sphere { center: Vec3::new(x, y, z), radius }
}

fn unit() -> Scene {
    let mut scene = Scene::new();
    scene.push(sphere(0.0, 0.0, 0.0, 1.0), Srgb::WHITE, None);
    scene.view = Some(View {
        eye: Vec3::new(0.0, 0.0, 3.5),
        target: Vec3::ZERO,
        up: Vec3::Y,
        lens: Lens::Perspective { fov: 40.0 },
    });
    scene
}

/// The radius of the ground of `marbles`: a plane to the eye, a test to the numbers.
const GROUND: f32 = 10_000.0;

fn marbles() -> Scene {
    let mut scene = Scene::new();
    scene.background = Srgb([0x86, 0xac, 0xd4]);
    scene.shadows = true;
    scene.lights = vec![
        Light {
            source: Source::Direction(Vec3::new(-0.55, 0.9, 0.6)),
            color: Srgb([0xff, 0xf4, 0xe0]),
        },
        Light {
            source: Source::Direction(Vec3::new(0.8, 0.5, 0.5)),
            color: Srgb([0x58, 0x68, 0x88]),
        },
    ];
    scene.push(sphere(0.0, -GROUND, 0.0, GROUND), Srgb([0xc9, 0xbf, 0xa8]), Some("ground"));
    // Each stands on the ground: x, z, radius, colour.
    for (x, z, radius, color) in [
        (-1.45, -0.2, 1.0, Srgb([0xd8, 0x3a, 0x2e])),
        (0.75, -0.9, 1.25, Srgb([0x2d, 0x7d, 0xc8])),
        (0.1, 1.15, 0.55, Srgb([0xf2, 0xb1, 0x34])),
        (2.35, 0.75, 0.75, Srgb([0x3f, 0xa0, 0x56])),
        (-2.75, 1.25, 0.45, Srgb([0x8e, 0x5b, 0xb8])),
        (1.3, 1.75, 0.3, Srgb([0xf5, 0xf1, 0xe8])),
        (-1.05, 1.75, 0.28, Srgb([0x2c, 0xb3, 0xa8])),
        (-3.3, -2.3, 0.9, Srgb([0xe8, 0x7a, 0x3d])),
        (3.7, -2.2, 1.05, Srgb([0xb8, 0x3f, 0x7a])),
    ] {
        scene.push(sphere(x, height_on_ground(x, z, radius), z, radius), color, None);
    }
    scene.view = Some(View {
        eye: Vec3::new(0.4, 2.6, 8.2),
        target: Vec3::new(0.1, 0.85, 0.0),
        up: Vec3::Y,
        lens: Lens::Perspective { fov: 30.0 },
    });
    scene
}

/// The height of the centre of a sphere that touches the ground at `(x, z)` from above.
fn height_on_ground(x: f32, z: f32, radius: f32) -> f32 {
    let (x, z, radius, ground) = (f64::from(x), f64::from(z), f64::from(radius), f64::from(GROUND));
    (((ground + radius).powi(2) - x * x - z * z).sqrt() - ground) as f32
}

/// How often the children of `flake` have children.
const FLAKE_DEPTH: u32 = 4;

/// Eric Haines' sphereflake, from "A Proposal for Standard Graphics Environments", IEEE Computer
/// Graphics and Applications 7(11), 1987.
fn flake() -> Scene {
    let mut scene = Scene::new();
    scene.background = Srgb([0x0c, 0x10, 0x1c]);
    scene.shadows = true;
    scene.lights = vec![
        Light { source: Source::Direction(Vec3::new(1.0, 0.5, 1.6)), color: Srgb([255, 240, 214]) },
        Light { source: Source::Direction(Vec3::new(-0.4, 1.0, 0.7)), color: Srgb([70, 96, 150]) },
    ];
    add_flake(&mut scene, Vec3::ZERO, 0.5, Vec3::Z, 0);
    scene.view = Some(View {
        eye: Vec3::new(2.1, 1.3, 1.7),
        target: Vec3::new(0.0, 0.0, 0.12),
        up: Vec3::Z,
        lens: Lens::Perspective { fov: 36.0 },
    });
    scene
}

/// A sphere and, `FLAKE_DEPTH` generations long, its nine children: six around the equator of
/// `axis`, three towards its pole.
fn add_flake(scene: &mut Scene, center: Vec3, radius: f32, axis: Vec3, generation: u32) {
    const COLORS: [Srgb; FLAKE_DEPTH as usize + 1] = [
        Srgb([0xd6, 0xb0, 0x5c]),
        Srgb([0xd8, 0x8c, 0x4a]),
        Srgb([0xc8, 0x5a, 0x4c]),
        Srgb([0x9a, 0x4c, 0x78]),
        Srgb([0x5c, 0x58, 0x9c]),
    ];
    scene.push(Sphere { center, radius }, COLORS[generation as usize], None);
    if generation == FLAKE_DEPTH {
        return;
    }
    let other = if axis.x.abs() < 0.9 { Vec3::X } else { Vec3::Y };
    let x = other.cross(axis).normalize();
    let y = axis.cross(x);
    let equator = (0..6).map(|k| (k as f32 * 60.0, 0.0));
    let polar = (0..3).map(|k| (30.0 + k as f32 * 120.0, 54.7356));
    for (longitude, latitude) in equator.chain(polar) {
        let (sin, cos) = f32::to_radians(longitude).sin_cos();
        let (height, across) = f32::to_radians(latitude).sin_cos();
        let child = (across * (cos * x + sin * y) + height * axis).normalize();
        let distance = radius + radius / 3.0;
        add_flake(scene, center + distance * child, radius / 3.0, child, generation + 1);
    }
}

/// The radius of the horizon of `edge`.
const HORIZON: f32 = 4_000_000.0;

/// Parallel rays that start far away, so that p.p, which the textbook form subtracts r^2 from, is
/// thousands of times as large as r^2. `Fast` frays the large spheres, dissolves the small ones
/// and the far one, and breaks the horizon; the others draw all of them as they are.
fn edge() -> Scene {
    let mut scene = Scene::new();
    scene.background = Srgb([0x0e, 0x12, 0x20]);
    scene.lights = vec![
        Light { source: Source::Direction(Vec3::new(-0.5, 0.7, 0.8)), color: Srgb::WHITE },
        Light { source: Source::Direction(Vec3::new(0.9, 0.2, 0.5)), color: Srgb([70, 84, 110]) },
    ];
    // Slanting, so that no product of coordinates is exact.
    let eye = Vec3::new(120.0, 90.0, 1990.0);
    let sight = eye.normalize();
    let up = sight.cross(Vec3::Y.cross(sight).normalize());

    // The same distance, less and less radius.
    for (x, radius, color) in [
        (-4.4, 1.9, Srgb([0xd8, 0x3a, 0x2e])),
        (-1.1, 1.2, Srgb([0xf2, 0x8c, 0x34])),
        (1.1, 0.75, Srgb([0xf2, 0xc9, 0x4c])),
        (2.6, 0.45, Srgb([0x5c, 0xb8, 0x5c])),
    ] {
        scene.push(sphere(x, 1.8, 0.0, radius), color, None);
    }
    let far = Vec3::new(4.9, 1.8, 0.0) - 3.0 * eye;
    scene.push(Sphere { center: far, radius: 1.4 }, Srgb([0x3d, 0x7f, 0xd4]), Some("far"));
    for bead in -6..=6 {
        let bead = sphere(bead as f32, -1.5, 0.0, 0.2);
        scene.push(bead, Srgb([0xe8, 0xe4, 0xda]), Some("tiny"));
    }
    // Behind the others, and so far that the eye is outside.
    let center = -3.0 * eye - (HORIZON + 2.8) * up;
    let horizon = Sphere { center, radius: HORIZON };
    scene.push(horizon, Srgb([0x6c, 0x9a, 0x5a]), Some("huge, grazing"));
    scene.view =
        Some(View { eye, target: Vec3::ZERO, up: Vec3::Y, lens: Lens::Parallel { height: 9.0 } });
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_has_valid_spheres_and_its_name() {
        for entry in BUILTINS {
            let scene = builtin(entry.name).expect("a scene");
            assert!(!scene.spheres().is_empty(), "{}", entry.name);
            assert!(scene.spheres().iter().all(|sphere| sphere.is_valid()), "{}", entry.name);
            assert_eq!(scene.colors().len(), scene.spheres().len());
        }
        assert!(builtin(DEFAULT).is_some());
        assert!(builtin("nonesuch").is_none());
    }

    #[test]
    fn the_flake_has_as_many_spheres_as_its_series() {
        assert_eq!(flake().spheres().len(), 1 + 9 + 81 + 729 + 6561);
    }
}
