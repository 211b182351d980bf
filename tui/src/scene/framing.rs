//! A view that shows all of a scene, for scenes that name none.

use crate::view::{Lens, View};
use spherule_kernel::{Sphere, Spheres, Vec3};

/// The field of view of an automatic camera, in degrees.
const FOV: f32 = 40.0;

/// Where the eye is, seen from the middle of the scene.
const TOWARDS_EYE: Vec3 = Vec3::new(0.25, 0.35, 1.0);

/// A sphere around all spheres: around the middle of their box, so not the least one, but at most
/// sqrt 3 times as large. Around nothing: the unit sphere.
#[must_use]
pub fn bounding_sphere(spheres: Spheres<'_>) -> Sphere {
    let valid = || spheres.iter().filter(Sphere::is_valid);
    let (low, high) = valid().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), sphere| {
        (low.min(sphere.center - sphere.radius), high.max(sphere.center + sphere.radius))
    });
    if !(low.is_finite() && high.is_finite()) {
        return Sphere { center: Vec3::ZERO, radius: 1.0 };
    }
    // Half of each first: the sum may not be a float.
    let center = low * 0.5 + high * 0.5;
    let reach = |sphere: Sphere| (sphere.center - center).length() + sphere.radius;
    Sphere { center, radius: valid().map(reach).fold(0.0, f32::max) }
}

/// A perspective view in which the bounding sphere fills a picture of `aspect`, width over
/// height.
#[must_use]
pub fn framed(spheres: Spheres<'_>, aspect: f32) -> View {
    let Sphere { center, radius } = bounding_sphere(spheres);
    let vertical = (FOV / 2.0).to_radians();
    let horizontal = (vertical.tan() * aspect).atan();
    let half_angle = vertical.min(horizontal).max(0.001);
    // A scene of points alone has no size; neither has one that overflows a usable one.
    let radius = if radius > 0.0 && radius < 1e18 { radius } else { 1.0 };
    let distance = radius / half_angle.sin();
    View {
        eye: center + TOWARDS_EYE.normalize() * distance,
        target: center,
        up: Vec3::Y,
        lens: Lens::Perspective { fov: FOV },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::SphereList;

    fn of(list: &[[f32; 4]]) -> Sphere {
        bounding_sphere(SphereList::from(list).spheres())
    }

    #[test]
    fn the_bounding_sphere_holds_every_sphere() {
        let one = of(&[[1.0, 2.0, 3.0, 4.0]]);
        assert_eq!(one, Sphere { center: Vec3::new(1.0, 2.0, 3.0), radius: 4.0 });
        let two = of(&[[-5.0, 0.0, 0.0, 1.0], [5.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, -9.0]]);
        assert_eq!(two, Sphere { center: Vec3::ZERO, radius: 6.0 });
    }

    #[test]
    fn nothing_and_points_are_framed_too() {
        assert_eq!(of(&[]), Sphere { center: Vec3::ZERO, radius: 1.0 });
        let view = framed(SphereList::from([[7.0, 7.0, 7.0, 0.0]]).spheres(), 1.0);
        assert!(view.eye.is_finite() && view.eye != view.target);
    }

    #[test]
    fn a_narrow_picture_is_framed_from_further_away() {
        let unit = SphereList::from([[0.0, 0.0, 0.0, 1.0]]);
        let distance = |aspect| framed(unit.spheres(), aspect).eye.length();
        assert!((distance(1.0) - 1.0 / 20_f32.to_radians().sin()).abs() < 1e-5);
        assert_eq!(distance(3.0), distance(1.0));
        assert!(distance(0.5) > 1.9 * distance(1.0));
    }
}
