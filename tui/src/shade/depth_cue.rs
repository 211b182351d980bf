//! What is far away fades into the background, evenly as it is seen. Lightness is about the cube root of light: if a share of the lightness
//! is left, the third power of that share is left of the light.

use crate::view::View;
use spherule_kernel::{Sphere, Vec3};

/// How much of its lightness what is farthest loses.
const MOST: f32 = 0.85;

/// The depths between which a picture fades.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthCue {
    near: f32,
    /// One over the way from there to the farthest; 0 if nothing fades.
    inverse: f32,
}

impl DepthCue {
    /// The depth cue of `subject` as `view` sees it. It goes from where the sphere begins, or from the eye if that is inside, to where the
    /// sphere ends. Nothing fades if the sphere is behind the eye, has no size, or no number says where it is.
    #[must_use]
    pub fn new(view: &View, subject: Sphere) -> Self {
        let [forward, ..] = view.axes();
        let middle = (subject.center.as_dvec3() - view.eye.as_dvec3()).dot(forward);
        let radius = f64::from(subject.radius);
        let (near, far) = ((middle - radius).max(0.0), middle + radius);
        let inverse = 1.0 / (far - near);
        let is_usable = far > near && inverse.is_finite() && near.is_finite();
        if is_usable {
            Self { near: near as f32, inverse: inverse as f32 }
        } else {
            Self { near: 0.0, inverse: 0.0 }
        }
    }

    /// The share of the background in what is seen at `depth`, along the line of sight: 0 to 0.997; 0 if that is NaN.
    #[must_use]
    #[inline]
    pub fn veil(&self, depth: f32) -> f32 {
        let share = (depth - self.near) * self.inverse;
        // NaN is not above zero.
        let left = if share > 0.0 { 1.0 - MOST * share.min(1.0) } else { 1.0 };
        1.0 - left * left * left
    }

    /// What is seen of `light` at `depth` before `background`.
    #[must_use]
    #[inline]
    pub fn seen(&self, light: Vec3, depth: f32, background: Vec3) -> Vec3 {
        light + self.veil(depth) * (background - light)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::{LensKind, with_projection};

    /// At the far end: 0.85 of the lightness is lost, and 0.15^3 of the light is left.
    const FARTHEST: f32 = 0.996_625;
    /// Half way: 0.575^3 is left.
    const HALF_WAY: f32 = 0.809_890_6;

    fn subject(place: Vec3, radius: f32) -> Sphere {
        Sphere { center: place, radius }
    }

    #[test]
    fn it_fades_from_one_end_of_the_scene_to_the_other_at_every_scale() {
        for scale in [1e-15, 1e-3, 1.0, 1e6, 1e15] {
            let view = View { eye: scale * Vec3::new(0.0, 0.0, 5.0), ..View::FRONT };
            for view in [view, with_projection(&view, LensKind::Parallel)] {
                let eye = view.eye.z;
                let cue = DepthCue::new(&view, subject(Vec3::ZERO, scale));
                let veils =
                    [eye - scale, eye, eye + scale, 2.0 * eye + scale].map(|depth| cue.veil(depth));
                for (veil, expected) in veils.into_iter().zip([0.0, HALF_WAY, FARTHEST, FARTHEST]) {
                    assert!((veil - expected).abs() < 1e-5, "{scale}: {veils:?}");
                }
            }
        }
    }

    #[test]
    fn far_away_it_fades_as_near() {
        let place = Vec3::new(0.0, 0.0, -1e6);
        let cue = DepthCue::new(&View::FRONT, subject(place, 10.0));
        assert!(cue.veil(1e6 - 5.0) < 0.05 && cue.veil(1e6 + 15.0) > 0.996);
    }

    #[test]
    fn from_inside_it_begins_at_the_eye() {
        let view = View { eye: Vec3::new(0.0, 0.0, 0.5), ..View::FRONT };
        let cue = DepthCue::new(&view, subject(Vec3::ZERO, 1.0));
        assert_eq!(cue.veil(0.0), 0.0);
        assert!((cue.veil(1.5) - FARTHEST).abs() < 1e-6);
    }

    #[test]
    fn without_depths_nothing_fades() {
        for (place, radius) in [
            (Vec3::ZERO, 0.0),
            (Vec3::ZERO, f32::NAN),
            (Vec3::splat(f32::NAN), 1.0),
            (Vec3::new(0.0, 0.0, 50.0), 1.0),
            (Vec3::splat(f32::INFINITY), 1.0),
            (Vec3::ZERO, f32::INFINITY),
        ] {
            let cue = DepthCue::new(&View::FRONT, subject(place, radius));
            for depth in [0.0, 1.0, 5.0, f32::INFINITY, f32::NAN] {
                assert_eq!(cue.veil(depth), 0.0, "{place} {radius} {depth}");
            }
        }
        let cue = DepthCue::new(&View::FRONT, subject(Vec3::ZERO, 1.0));
        assert_eq!(cue.veil(f32::NAN), 0.0);
        let seen = cue.seen(Vec3::X, 6.0, Vec3::Y);
        assert!(seen.abs_diff_eq(Vec3::new(1.0 - FARTHEST, FARTHEST, 0.0), 1e-6), "{seen}");
    }
}
