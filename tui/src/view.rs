//! Where a scene is looked at from, in the words of a person: angles and points, not vectors of a
//! plane. A view becomes the kernel's camera when the size of the picture is known.

use crate::length::{direction, length};
use clap::ValueEnum;
use glam::DVec3;
use serde::Deserialize;
use spherule_kernel::{Camera, Projection, Vec3, Viewpoint};

/// Perspective by its vertical angle, parallel by its height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// The vertical field of view in degrees.
    Perspective {
        /// Degrees, above 0 and below 180.
        fov: f32,
    },
    /// The height of the picture in the units of the scene.
    Parallel {
        /// Above 0.
        height: f32,
    },
}

/// A lens without its angle or height.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum LensKind {
    /// Far things look smaller
    #[default]
    Perspective,
    /// They do not
    Parallel,
}

/// An eye, what it looks at, and through which lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the eye is.
    pub eye: Vec3,
    /// The point in the middle of the picture.
    pub target: Vec3,
    /// Which way is up; not parallel to the line of sight.
    pub up: Vec3,
    /// Perspective or parallel.
    pub lens: Lens,
}

/// The least angle between the line of sight and up that an orbit leaves, in radians: 1 degree.
const POLE: f32 = 0.017;
/// The fields of view, in degrees, for which changing the projection leaves the eye in place.
const NATURAL_FOV: std::ops::RangeInclusive<f32> = 10.0..=90.0;
/// The useful distances of the eye and heights of the picture: beyond them, rays to what is seen are no numbers.
const USEFUL: std::ops::Range<f32> = 1e-30..1e30;
/// The largest angle, in radians, by which rounding may turn a view when the eye goes nearer: a twentieth of a degree. (With 1e-2 many steps
/// turn it by several degrees.)
const LARGEST_TURN: f32 = 1e-3;
/// The field of view, in degrees, if changing the projection or the height of a parallel picture moves the eye.
const USUAL_FOV: f32 = 40.0;

impl View {
    /// From in front onto the origin: what tests look from.
    #[cfg(test)]
    pub(crate) const FRONT: Self = Self {
        eye: Vec3::new(0.0, 0.0, 5.0),
        target: Vec3::ZERO,
        up: Vec3::Y,
        lens: Lens::Perspective { fov: 40.0 },
    };

    /// Which kind of lens it is.
    #[must_use]
    pub fn lens_kind(&self) -> LensKind {
        match self.lens {
            Lens::Perspective { .. } => LensKind::Perspective,
            Lens::Parallel { .. } => LensKind::Parallel,
        }
    }

    /// The height of the picture at the target, in the units of the scene.
    #[must_use]
    pub fn height_at_target(&self) -> f32 {
        match self.lens {
            Lens::Perspective { fov } => self.height_under(fov.into()),
            Lens::Parallel { height } => height,
        }
    }

    /// The height at the target of what the eye sees under an angle of `fov` degrees.
    #[must_use]
    pub fn height_under(&self, fov: f64) -> f32 {
        let distance = f64::from(length(self.eye - self.target));
        (2.0 * distance * (fov / 2.0).to_radians().tan()) as f32
    }

    /// The kernel's camera for a picture of `width` x `height` samples that is `aspect` times as
    /// wide as it is high.
    ///
    /// It is computed in double precision and rounded once. Directions have a length of about one at the middle of the picture. A view
    /// without a direction (the eye on the target) looks along -z; if up is parallel to the line of sight, another up is taken.
    #[must_use]
    pub fn camera(&self, width: u32, height: u32, aspect: f64) -> Camera {
        let [forward, right, up] = self.axes();
        let (lift, start) = match self.lens {
            Lens::Perspective { fov } => ((f64::from(fov) / 2.0).to_radians().tan(), forward),
            Lens::Parallel { height } => (f64::from(height) / 2.0, self.eye.as_dvec3()),
        };
        let step_x = 2.0 * lift * aspect / f64::from(width);
        let step_y = 2.0 * lift / f64::from(height);
        let left = (f64::from(width) - 1.0) / 2.0 * step_x;
        let top = (f64::from(height) - 1.0) / 2.0 * step_y;
        Camera {
            projection: match self.lens {
                Lens::Perspective { .. } => Projection::Perspective { eye: self.eye },
                Lens::Parallel { .. } => Projection::Parallel { direction: forward.as_vec3() },
            },
            corner: (start - left * right + top * up).as_vec3(),
            step_x: (right * step_x).as_vec3(),
            step_y: (-up * step_y).as_vec3(),
        }
    }

    /// What all rays of [`View::camera`] have in common.
    #[must_use]
    pub fn viewpoint(&self) -> Viewpoint {
        match self.camera(1, 1, 1.0).projection {
            Projection::Perspective { eye } => Viewpoint::Origin(eye),
            Projection::Parallel { direction } => Viewpoint::Direction(direction),
        }
    }

    /// Unit vectors: the line of sight, to the right, upwards.
    #[must_use]
    pub fn axes(&self) -> [DVec3; 3] {
        let sight = self.target.as_dvec3() - self.eye.as_dvec3();
        let forward = unit(sight).unwrap_or(DVec3::NEG_Z);
        let ups = [self.up.as_dvec3(), DVec3::Y, DVec3::Z].into_iter();
        let right = ups.filter_map(unit).find_map(|up| {
            let across = forward.cross(up);
            // If up is parallel to the line of sight, `across` is rounding noise.
            (across.length() > 1e-12).then_some(across).and_then(unit)
        });
        let right = right.unwrap_or(DVec3::X);
        [forward, right, right.cross(forward)]
    }
}

/// Moves the eye around the target: `yaw` to the right around the upward axis, `pitch` upwards, both in radians. The distance is kept; the
/// eye stops just before a pole.
#[must_use]
pub fn orbited(view: &View, yaw: f32, pitch: f32) -> View {
    let distance = length(view.eye - view.target);
    let up = direction(view.up).unwrap_or(Vec3::Y);
    let Some(outward) = direction(view.eye - view.target) else { return *view };
    // Split the way to the eye into height and heading; turn each.
    let elevation = outward.dot(up).clamp(-1.0, 1.0).asin();
    let heading = (outward - outward.dot(up) * up)
        .try_normalize()
        .unwrap_or_else(|| up.any_orthonormal_vector());
    let side = up.cross(heading);
    let limit = std::f32::consts::FRAC_PI_2 - POLE;
    let elevation = (elevation + pitch).clamp(-limit, limit);
    let turned = yaw.cos() * heading + yaw.sin() * side;
    let outward = elevation.cos() * turned + elevation.sin() * up;
    View { eye: view.target + distance * outward, ..*view }
}

/// Moves eye and target alike, to the right and upwards in the plane of the picture, in the units of the scene. A move that would leave the
/// range of numbers changes nothing.
#[must_use]
pub fn panned(view: &View, right: f64, up: f64) -> View {
    let [_, rightwards, upwards] = view.axes();
    let way = right * rightwards + up * upwards;
    let [eye, target] = [view.eye, view.target].map(|point| (point.as_dvec3() + way).as_vec3());
    if eye.is_finite() && target.is_finite() { View { eye, target, ..*view } } else { *view }
}

/// Makes what is at the target appear `factor` times as large: by going nearer in perspective, by a lower picture in parallel. Where
/// a parallel picture becomes higher than what the eye would see under the usual angle, the eye goes farther, too: then no more of the
/// scene is behind it than in perspective.
///
/// A factor that is not finite and above 0, or that would leave the range of useful numbers, changes nothing. Nor does one that leads
/// nearer than a thousand times the distance of floats at the target.
#[must_use]
pub fn zoomed(view: &View, factor: f32) -> View {
    let useful = |size: f32| {
        // A scene may be so large or so small that its first view is out of the range.
        let leads_back = if size < USEFUL.start { factor < 1.0 } else { factor > 1.0 };
        factor > 0.0 && (USEFUL.contains(&size) || leads_back)
    };
    match view.lens {
        Lens::Perspective { .. } => {
            let way = (view.eye - view.target) / factor;
            let eye = eye_at(view.target, way);
            // The way back is open wherever the eye is.
            let eye = if factor > 1.0 { eye } else { Some(view.target + way) };
            eye.filter(|_| useful(length(way))).map_or(*view, |eye| View { eye, ..*view })
        }
        Lens::Parallel { height } => {
            let height = height / factor;
            if !useful(height) {
                return *view;
            }
            let (way, least) = (view.eye - view.target, usual_distance(height));
            let is_too_near = factor < 1.0 && length(way) < least;
            let outward = direction(way).unwrap_or(Vec3::Z);
            let farther = is_too_near.then(|| eye_at(view.target, least * outward)).flatten();
            View { eye: farther.unwrap_or(view.eye), lens: Lens::Parallel { height }, ..*view }
        }
    }
}

/// The same picture at the target, through the other lens.
///
/// Back and forth gives the same view. The exception is a parallel picture so high or low that its angle would be unnatural: then the eye
/// moves, or if floats are too far apart for that, nothing changes.
#[must_use]
pub fn with_projection(view: &View, kind: LensKind) -> View {
    let height = view.height_at_target();
    match kind {
        kind if kind == view.lens_kind() => *view,
        LensKind::Parallel => View { lens: Lens::Parallel { height }, ..*view },
        LensKind::Perspective => {
            let way = view.eye - view.target;
            let fov = 2.0 * (height / 2.0 / length(way)).atan().to_degrees();
            if NATURAL_FOV.contains(&fov) {
                return View { lens: Lens::Perspective { fov }, ..*view };
            }
            let outward = direction(way).unwrap_or(Vec3::Z);
            let lens = Lens::Perspective { fov: USUAL_FOV };
            let eye = eye_at(view.target, usual_distance(height) * outward);
            eye.map_or(*view, |eye| View { eye, lens, ..*view })
        }
    }
}

/// How far away the eye is that sees a picture of this height at the target under the usual angle.
fn usual_distance(height: f32) -> f32 {
    height / 2.0 / (USUAL_FOV / 2.0).to_radians().tan()
}

/// The eye that is `way` from the target; `None` where floats are so far apart that it would look from elsewhere.
fn eye_at(target: Vec3, way: Vec3) -> Option<Vec3> {
    let eye = target + way;
    (length(eye - target - way) <= LARGEST_TURN * length(way)).then_some(eye)
}

/// The vector made one long; `None` if it has no direction. (Squares of single precision are far within the range of double.)
fn unit(vector: DVec3) -> Option<DVec3> {
    let length = vector.length_squared().sqrt();
    (length > 0.0 && length.is_finite()).then(|| vector / length)
}

#[cfg(test)]
mod tests;
