//! Where light comes from: from places of the scene, or from beside the eye.

use crate::color::Srgb;
use crate::view::View;
use glam::DVec3;
use spherule_kernel::Vec3;

/// Where a light stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// Infinitely far away.
    Direction(
        /// Towards the light; any length but zero.
        Vec3,
    ),
    /// At a point of the scene.
    Position(Vec3),
}

/// A light. Its brightness does not fall with distance: a scene states no brightness except its colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where it stands.
    pub source: Source,
    /// What a surface that faces it receives.
    pub color: Srgb,
}

/// How a scene is lit.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Lighting {
    /// Not at all: the plain colour of the spheres.
    #[default]
    Plain,
    /// By lights that stand in the scene.
    World(Vec<Light>),
    /// By two lights that go with the eye, so that no side of the scene is dark.
    Camera,
}

/// The lights that go with the eye: the direction towards each, by its parts along the line of sight, to the right and
/// upwards; and its colour. The key light is above the left shoulder, far enough to the side that spheres look round;
/// the fill light, cooler and a tenth as bright, shows the side that the key leaves dark.
const CAMERA_LIGHTS: [(DVec3, Srgb); 2] = [
    (DVec3::new(-0.8, -0.8, 0.9), Srgb::WHITE),
    (DVec3::new(-0.6, 0.9, -0.3), Srgb([0x50, 0x5a, 0x6e])),
];

impl Lighting {
    /// Whether the spheres are seen in their plain colour.
    #[must_use]
    #[inline]
    pub fn is_plain(&self) -> bool {
        matches!(self, Self::Plain)
    }

    /// The lights of a picture from `view`.
    #[must_use]
    pub fn lights(&self, view: &View) -> Vec<Light> {
        match self {
            Self::Plain => Vec::new(),
            Self::World(lights) => lights.clone(),
            Self::Camera => {
                let [forward, right, up] = view.axes();
                let in_scene = |way: DVec3| way.x * forward + way.y * right + way.z * up;
                let light = |(way, color)| {
                    let source = Source::Direction(in_scene(way).as_vec3());
                    Light { source, color }
                };
                CAMERA_LIGHTS.map(light).to_vec()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::orbited;

    fn directions(view: &View) -> Vec<Vec3> {
        let lights = Lighting::Camera.lights(view);
        let direction = |light: &Light| match light.source {
            Source::Direction(direction) => direction,
            Source::Position(_) => panic!("no direction"),
        };
        lights.iter().map(direction).collect()
    }

    #[test]
    fn the_key_light_is_above_the_left_shoulder() {
        let [key, fill] = directions(&View::FRONT)[..] else { panic!("not two lights") };
        assert!(key.x < 0.0 && key.y > 0.0 && key.z > 0.0, "{key}");
        assert!(fill.x > 0.0 && fill.z > 0.0, "{fill}");
    }

    #[test]
    fn camera_lights_turn_with_the_view_and_others_do_not() {
        let behind = orbited(&View::FRONT, std::f32::consts::PI, 0.0);
        for (front, back) in directions(&View::FRONT).into_iter().zip(directions(&behind)) {
            let turned = Vec3::new(-front.x, front.y, -front.z);
            assert!(back.distance(turned) < 1e-5, "{front} and {back}");
        }
        let light = Light { source: Source::Direction(Vec3::X), color: Srgb::WHITE };
        let world = Lighting::World(vec![light]);
        assert_eq!(world.lights(&View::FRONT), world.lights(&behind));
        assert!(Lighting::Plain.lights(&View::FRONT).is_empty());
    }
}
