//! The scenes that come with the program.

use super::reading::read;
use super::{Light, Lighting, ReadError, Scene, Source, toml};
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

/// The scene that is shown if none is named.
pub const DEFAULT: &str = "marbles";

/// All of them.
pub const BUILTINS: [Builtin; 6] = [
    Builtin {
        name: "marbles",
        description: "lit spheres with shadows on a huge ground sphere",
        scene: || of_toml(include_str!("../../scenes/marbles.toml")),
    },
    Builtin {
        name: "unit",
        description: "the unit sphere without a light: white where a ray hits",
        scene: || of_toml(include_str!("../../scenes/unit.toml")),
    },
    Builtin {
        name: "flake",
        description: "a sphereflake of depth 4: nine children of a third the radius",
        scene: flake,
    },
    Builtin {
        name: "edge",
        description: "far, tiny, huge and grazing spheres, where single precision ends",
        scene: || of_toml(include_str!("../../scenes/edge.toml")),
    },
    Builtin {
        name: "far",
        description: "spheres and their shadows from 10^6 and 10^7 diameters, where t is as coarse as the smallest",
        scene: || of_toml(include_str!("../../scenes/far.toml")),
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
    let text = include_bytes!("../../scenes/caffeine.xyz").as_slice();
    expect(read(Box::new(text), "caffeine.xyz", None))
}

fn of_toml(text: &str) -> Scene {
    expect(toml::read(text, "a built-in scene"))
}

/// A test reads all files that come with the program.
fn expect(scene: Result<Scene, ReadError>) -> Scene {
    scene.unwrap_or_else(|error| unreachable!("{error}"))
}

/// How often the children of `flake` have children.
const FLAKE_DEPTH: u32 = 4;

/// Eric Haines' sphereflake, from "A Proposal for Standard Graphics Environments", IEEE Computer
/// Graphics and Applications 7(11), 1987.
fn flake() -> Scene {
    let mut scene = Scene::new();
    (scene.background, scene.names_background) = (Srgb([0x0c, 0x10, 0x1c]), true);
    scene.shadows = true;
    scene.lighting = Lighting::World(vec![
        Light { source: Source::Direction(Vec3::new(1.0, 0.5, 1.6)), color: Srgb([255, 240, 214]) },
        Light { source: Source::Direction(Vec3::new(-0.4, 1.0, 0.7)), color: Srgb([70, 96, 150]) },
    ]);
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
    fn marbles_touch_the_ground() {
        let spheres: Vec<_> = builtin("marbles").expect("a scene").spheres().iter().collect();
        let (ground, marbles) = spheres.split_first().expect("the ground");
        assert_eq!(marbles.len(), 9);
        for marble in marbles {
            let distance = marble.center.as_dvec3().distance(ground.center.as_dvec3());
            let height = distance - f64::from(ground.radius) - f64::from(marble.radius);
            assert!(height.abs() < 1e-6, "{marble:?}: {height}");
        }
    }

    #[test]
    fn the_flake_has_as_many_spheres_as_its_series() {
        assert_eq!(flake().spheres().len(), 1 + 9 + 81 + 729 + 6561);
    }
}
