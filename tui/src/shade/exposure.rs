//! From the light that a surface receives to the light in which its colour is seen.

use crate::scene::Lighting;
use spherule_kernel::Vec3;

/// How received light is seen: times a gain, and above a knee less and less of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exposure {
    /// How much of the lights counts.
    pub(super) lights: f32,
    /// What every surface receives from everywhere.
    pub(super) ambient: f32,
    gain: f32,
    /// Light up to here is seen as it is.
    knee: f32,
}

/// What is left of the light where nothing is open: a hole is to be seen, not missed.
const DARKEST: f32 = 0.5;

/// How much of the difference in openness between the sides of a sphere counts: more is noise where spheres are as
/// small as pixels (AUC of the protein 7CFN 0.845, with half of it 0.854; docs/program.md says of what).
pub(super) const STEEPNESS: f32 = 0.4;

impl Exposure {
    /// A scene that names its lights is seen as it names them.
    const AS_IT_IS: Self = Self { lights: 1.0, ambient: 0.06, gain: 1.0, knee: f32::INFINITY };
    /// Bright enough for dark elements, and the camera's lights together stay below full light: a white atom keeps its
    /// shape.
    const SOFT: Self = Self { lights: 1.0, ambient: 0.04, gain: 1.35, knee: 0.4 };
    /// If the picture shows how open the scene is, most light comes from everywhere, and what is left of the camera's
    /// lights makes spheres round. More of the camera's lights is noise on atoms as small as pixels.
    const OPEN: Self = Self { lights: 0.05, ambient: 1.0, ..Self::SOFT };
    /// Without lights all is seen in its own colour, as far as it is open.
    const PLAIN: Self = Self { ambient: 1.0, ..Self::AS_IT_IS };

    /// The exposure of a scene lit like this.
    pub(super) fn of(lighting: &Lighting) -> Self {
        match lighting {
            Lighting::Plain | Lighting::World(_) => Self::AS_IT_IS,
            Lighting::Camera => Self::SOFT,
        }
    }

    /// The same, if the picture shows how open the scene is.
    pub(super) fn of_open(lighting: &Lighting) -> Self {
        match lighting {
            Lighting::Plain => Self::PLAIN,
            Lighting::World(_) => Self::AS_IT_IS,
            Lighting::Camera => Self::OPEN,
        }
    }

    /// The share of all light that a surface of this openness, 0 to 1, receives.
    pub(super) fn left(openness: f32) -> f32 {
        DARKEST + (1.0 - DARKEST) * openness
    }

    /// The light that is seen: above the knee a parabola that goes on as steeply, and flat where it reaches 1.
    pub(super) fn seen(&self, received: Vec3) -> Vec3 {
        let Self { gain, knee, .. } = *self;
        Vec3::from_array((gain * received).to_array().map(|light| {
            if light <= knee {
                return light;
            }
            let room = 1.0 - knee;
            let below = (1.0 - (light - knee) / (2.0 * room)).max(0.0);
            1.0 - room * below * below
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Srgb;
    use crate::scene::{Scene, Source};

    fn seen(exposure: Exposure, light: f32) -> f32 {
        exposure.seen(Vec3::splat(light)).x
    }

    #[test]
    fn named_lights_are_seen_as_they_are() {
        for light in [0.0, 0.3, 1.0, 7.5] {
            assert_eq!(seen(Exposure::AS_IT_IS, light), light);
        }
    }

    #[test]
    fn the_shoulder_has_no_step_and_no_bend_and_ends_at_full_light() {
        let soft = Exposure::SOFT;
        let values: Vec<_> = (0..=4000).map(|step| seen(soft, step as f32 / 1000.0)).collect();
        let steps: Vec<_> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(steps.iter().all(|&step| (0.0..1.4e-3).contains(&step)));
        assert!(steps.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 3e-6));
        assert_eq!(values.last(), Some(&1.0));
    }

    /// Whichever way a surface faces.
    #[test]
    fn the_camera_s_lights_do_not_burn_out() {
        let view = Scene::new().first_view(1.0);
        let lights = Lighting::Camera.lights(&view);
        let mut brightest: f32 = 0.0;
        for step in 0..100 * 200 {
            let (height, turn) =
                ((step / 200) as f32 / 50.0 - 0.99, (step % 200) as f32 * 0.031_416);
            let across = (1.0 - height * height).sqrt();
            let normal = Vec3::new(across * turn.cos(), across * turn.sin(), height);
            let mut received = Vec3::splat(Exposure::SOFT.ambient);
            for light in &lights {
                let Source::Direction(way) = light.source else { panic!("no direction") };
                received += normal.dot(way.normalize()).max(0.0) * light.color.to_linear();
            }
            brightest = brightest.max(Exposure::SOFT.seen(received).max_element());
        }
        assert!(brightest > 0.97, "too dark: {brightest}");
        assert!(Srgb::from_linear(Vec3::splat(brightest)).0[0] < 255, "{brightest}");
    }
}
