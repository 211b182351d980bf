//! A view that shows all of a scene, for scenes that name no view, or a view of one sphere.

use crate::length::{direction, length};
use crate::view::{Lens, View};
use spherule_kernel::{Sphere, Spheres, Vec3};

/// The field of view of an automatic camera, in degrees.
const FOV: f32 = 40.0;

/// Where the eye is, seen from the middle of the scene.
const TOWARDS_EYE: Vec3 = Vec3::new(0.25, 0.35, 1.0);

/// The least distance of the eye, over the largest coordinate: many times the spacing of floats there.
const SPACING: f32 = 64.0 * f32::EPSILON;

/// A ground is at least so many times as large as all that stands on it.
const GROUND: f32 = 100.0;

/// At up to so many times the distance of the eye, the origins of parallel rays are rounded by less than a sample.
const FARTHEST: f32 = 1024.0;

/// The radius of the largest scene that can be looked at from far enough.
const LARGEST: f32 = 1e30;

/// What is framed of a scene: a sphere around all spheres, except the ground, if there is one.
///
/// The ground consists of spheres that are each at least 100 times as large as a sphere around all others, and no
/// farther from that sphere than it is wide: the ground that the others stand on, walls around them, a sky. They have
/// no end that could be seen.
#[must_use]
pub fn subject(spheres: Spheres<'_>) -> Sphere {
    let valid = || spheres.iter().filter(Sphere::is_valid);
    let least = valid().map(|sphere| sphere.radius).fold(0.0, f32::max) / GROUND;
    // Points cannot be seen, so nothing is a ground of theirs.
    let others =
        bounding_sphere(|| valid().filter(|sphere| 0.0 < sphere.radius && sphere.radius < least));
    let is_ground = |sphere: Sphere, others: Sphere| {
        let reach = sphere.radius + 3.0 * others.radius;
        sphere.radius >= GROUND * others.radius && length(sphere.center - others.center) <= reach
    };
    let all_ground = |others| {
        valid().filter(|sphere| sphere.radius >= least).all(|sphere| is_ground(sphere, others))
    };
    let all = || bounding_sphere(valid).unwrap_or(Sphere { center: Vec3::ZERO, radius: 1.0 });
    others.filter(|&others| all_ground(others)).unwrap_or_else(all)
}

/// A sphere around `spheres`. Its centre is the middle of their box, so it is not the least one, but at most sqrt 3
/// times as large. `None` if there are no spheres, or the box is not finite.
fn bounding_sphere<S: Iterator<Item = Sphere>>(spheres: impl Fn() -> S) -> Option<Sphere> {
    let (low, high) =
        spheres().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), sphere| {
            (low.min(sphere.center - sphere.radius), high.max(sphere.center + sphere.radius))
        });
    if !(low.is_finite() && high.is_finite()) {
        return None;
    }
    // Each is halved first: the sum may not be a float.
    let center = low * 0.5 + high * 0.5;
    let reach = |sphere: Sphere| length(sphere.center - center) + sphere.radius;
    Some(Sphere { center, radius: spheres().map(reach).fold(0.0, f32::max) })
}

/// A perspective view in which the [`subject`] fills a picture of `aspect`, width over
/// height.
#[must_use]
pub fn framed(spheres: Spheres<'_>, aspect: f32) -> View {
    let lens = Lens::Perspective { fov: FOV };
    around(subject(spheres), TOWARDS_EYE.normalize(), Vec3::Y, lens, aspect)
}

/// As [`framed`], but of `sphere`, and with the direction, the field of view and the kind of projection of `view`.
/// Parallel rays start no nearer than those of `view`, unless those start so far away that rounding would be seen.
#[must_use]
pub fn reframed(view: &View, sphere: Sphere, aspect: f32) -> View {
    let way = view.eye - view.target;
    let outward = direction(way).unwrap_or(Vec3::Z);
    let framed = around(sphere, outward, view.up, view.lens, aspect);
    // A picture does not show where parallel rays start. But the farther away they start, the more their origins are rounded, as in `view`.
    let (near, far) = (length(framed.eye - framed.target), length(way));
    match view.lens {
        Lens::Parallel { .. } if near < far && far < FARTHEST * near => {
            View { eye: framed.target + way, ..framed }
        }
        _ => framed,
    }
}

fn around(sphere: Sphere, outward: Vec3, up: Vec3, lens: Lens, aspect: f32) -> View {
    let Sphere { center, radius } = sphere;
    let fov = match lens {
        Lens::Perspective { fov } => fov,
        Lens::Parallel { .. } => FOV,
    };
    let vertical = (fov / 2.0).to_radians();
    let horizontal = (vertical.tan() * aspect).atan();
    let half_angle = vertical.min(horizontal).max(0.001);
    // A scene of points alone has no size; neither has one that overflows a usable one.
    let radius = if radius > 0.0 && radius < LARGEST { radius } else { 1.0 };
    // If the eye is nearer than this to a small sphere far from zero, there is no direction any more.
    let least = center.abs().max_element() * SPACING;
    let distance = (radius / half_angle.sin()).max(least);
    let lens = match lens {
        Lens::Perspective { .. } => lens,
        Lens::Parallel { .. } => Lens::Parallel { height: 2.0 * radius / aspect.clamp(0.001, 1.0) },
    };
    View { eye: center + outward * distance, target: center, up, lens }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::SphereList;

    fn of(list: &[[f32; 4]]) -> Sphere {
        subject(SphereList::from(list).spheres())
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
    fn a_ground_is_left_out() {
        let marbles = [[0.0, 1.0, 0.0, 1.0], [3.0, 0.5, 0.0, 0.5]];
        let alone = of(&marbles);
        let with = |others: &[[f32; 4]]| of(&[&marbles, others].concat());
        for ground in [[0.0, -1e4, 0.0, 1e4], [5e3, -1e4, 0.0, 1.12e4], [0.0, 0.0, 0.0, 500.0]] {
            assert_eq!(with(&[ground]), alone, "{ground:?}");
        }
        let walls = [[0.0, -1e4, 0.0, 1e4], [-1e5, 0.0, 0.0, 9.9998e4], [0.0, 1e5, 0.0, 9.9995e4]];
        assert_eq!(with(&walls), alone);
        // Not large enough, elsewhere, and one of two that is no ground.
        for none in [
            &[[0.0, -200.0, 0.0, 200.0]][..],
            &[[0.0, -2e4, 0.0, 1e4]],
            &[[0.0, -1e4, 0.0, 1e4], [0.0, -150.0, 0.0, 150.0]],
        ] {
            let large = with(none);
            let [x, y, z, radius] = none[0];
            let reach = large.center.distance(Vec3::new(x, y, z)) + radius;
            assert!(
                large.radius >= 0.999 * reach && large.radius > 20.0 * alone.radius,
                "{none:?}"
            );
        }
        // What stands on it cannot be seen.
        assert_eq!(of(&[[0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.0]]).radius, 1.0);
    }

    /// How far the sphere reaches in the picture, over half of its width and of its height.
    fn reach(view: &View, sphere: Sphere, aspect: f64) -> f64 {
        let [forward, right, up] = view.axes();
        let p = sphere.center.as_dvec3() - view.eye.as_dvec3();
        let r = f64::from(sphere.radius);
        let along = |axis: glam::DVec3, half: f64| match view.lens {
            Lens::Parallel { height } => (p.dot(axis).abs() + r) / (f64::from(height) / 2.0 * half),
            Lens::Perspective { fov } => {
                // The plane through the eye and the edge of the picture, as far from the centre as r at most.
                let slope = (f64::from(fov) / 2.0).to_radians().tan() * half;
                (r * slope.hypot(1.0) + p.dot(axis).abs()) / (p.dot(forward) * slope)
            }
        };
        along(right, aspect).max(along(up, 1.0))
    }

    #[test]
    fn all_spheres_are_seen_from_any_direction_through_any_lens() {
        let list = SphereList::from([
            [1.0, 2.0, 3.0, 0.5],
            [-7.0, 0.0, 1.0, 2.0],
            [0.0, 40.0, 0.0, 1.0],
            [3.0, 2.0, -9.0, 0.0],
        ]);
        let spheres = list.spheres();
        let all = subject(spheres);
        for aspect in [0.2_f32, 1.0, 3.0] {
            for lens in [
                Lens::Perspective { fov: 15.0 },
                Lens::Perspective { fov: 120.0 },
                Lens::Parallel { height: 1e-3 },
            ] {
                for turn in 0..8_u8 {
                    let view = View { lens, ..framed(spheres, aspect) };
                    let view = crate::view::orbited(&view, f32::from(turn), 0.3);
                    let view = crate::view::panned(&view, 100.0, -5.0);
                    let reframed = reframed(&view, all, aspect);
                    let turned = reframed.axes()[0].dot(view.axes()[0]);
                    assert!(turned > 1.0 - 1e-6, "from another direction: {turned}");
                    for sphere in spheres.iter() {
                        let reach = reach(&reframed, sphere, aspect.into());
                        assert!(reach < 1.0 + 1e-5, "{reach} {sphere:?} {reframed:?}");
                    }
                    let reach = reach(&reframed, all, aspect.into());
                    assert!(reach > 0.999, "{reach}: smaller than need be");
                }
            }
        }
    }

    #[test]
    fn a_small_sphere_far_away_is_seen_from_the_same_direction() {
        let view = framed(SphereList::from([[0.0, 0.0, 0.0, 1.0]]).spheres(), 1.0);
        let small = Sphere { center: Vec3::splat(1e7), radius: 1e-3 };
        let reframed = reframed(&view, small, 1.0);
        assert_eq!(reframed.target, small.center);
        assert!(reframed.axes()[0].dot(view.axes()[0]) > 0.999, "{reframed:?}");
    }

    #[test]
    fn parallel_rays_start_no_nearer() {
        let lens = Lens::Parallel { height: 9.0 };
        let far = View { eye: Vec3::new(0.0, 0.0, 2000.0), target: Vec3::ZERO, up: Vec3::Y, lens };
        let one = Sphere { center: Vec3::X, radius: 1.0 };
        let from_far = reframed(&far, one, 1.0);
        assert_eq!(from_far.eye, Vec3::new(1.0, 0.0, 2000.0));
        assert_eq!(from_far.lens, Lens::Parallel { height: 2.0 });
        // Beside the target; and where floats are half of the radius apart.
        let [near, too_far] = [0.125, 4_194_304.0].map(|z| {
            let view = View { eye: Vec3::new(0.0, 0.0, z), ..far };
            reframed(&view, one, 1.0)
        });
        assert!(near.eye.z > 2.0);
        assert_eq!(too_far, near);
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
