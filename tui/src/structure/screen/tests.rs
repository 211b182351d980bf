//! Bounds hold every hit, whatever view and sphere; and they are bounds.

use super::*;
use crate::view::Lens;
use proptest::prelude::*;
use spherule_kernel::{Tier, Vec3, pairs};

const SIDES: (u32, u32) = (12, 8);

const VIEW: View = View { eye: Vec3::ZERO, target: Vec3::NEG_Z, ..View::FRONT };
const PARALLEL: View = View { lens: Lens::Parallel { height: 4.0 }, ..VIEW };

fn sphere(x: f32, y: f32, z: f32, radius: f32) -> Sphere {
    [x, y, z, radius].into()
}

/// All rays of a small screen.
fn rays(view: &View) -> Vec<Ray> {
    let (width, height) = SIDES;
    let camera = view.camera(width, height, 1.5);
    (0..height).flat_map(|y| (0..width).map(move |x| camera.get_ray(x, y))).collect()
}

/// How many rays hit the sphere by a tier, and how many are in its bounds; fails if one is lost.
fn hits_and_bounded(view: &View, sphere: Sphere, tier: Tier) -> (usize, usize) {
    let (screen, rays) = (Screen::new(view), rays(view));
    let area = screen.of_sphere(&sphere);
    let mut hits = vec![None; rays.len()];
    pairs(tier, &rays, &vec![sphere; rays.len()], &mut hits);
    let (mut hit_count, mut bounded) = (0, 0);
    for (ray, hit) in rays.iter().zip(hits) {
        let (place, live) = screen.of_packet(&RayPacket::new(&[*ray]));
        assert_eq!(live, u32::from(ray.is_live()));
        let inside = area.overlaps(&place);
        assert!(
            inside || hit.is_none(),
            "{tier:?}: {hit:?} of {ray:?} is lost: {sphere:?}, {view:?}"
        );
        hit_count += usize::from(hit.is_some());
        bounded += usize::from(inside);
    }
    (hit_count, bounded)
}

/// From `low` to `high` by their powers of two, of either sign.
fn extreme(low: i32, high: i32) -> impl Strategy<Value = f32> {
    let signed = (low..=high, 1.0_f64..2.0, any::<bool>());
    signed.prop_map(|(power, digits, minus)| {
        let size = digits * 2.0_f64.powi(power);
        (if minus { -size } else { size }) as f32
    })
}

fn vector(low: i32, high: i32) -> impl Strategy<Value = Vec3> {
    [extreme(low, high), extreme(low, high), extreme(low, high)].prop_map(Vec3::from_array)
}

fn lens() -> impl Strategy<Value = Lens> {
    prop_oneof![
        (1.0_f32..179.0).prop_map(|fov| Lens::Perspective { fov }),
        prop_oneof![Just(179.9_f32), Just(179.999_98), Just(0.001)]
            .prop_map(|fov| Lens::Perspective { fov }),
        extreme(-20, 20).prop_map(|height| Lens::Parallel { height: height.abs() }),
    ]
}

fn views(low: i32, high: i32) -> impl Strategy<Value = View> {
    (vector(low, high), vector(low, high), vector(-3, 3), lens())
        .prop_map(|(eye, target, up, lens)| View { eye, target, up, lens })
}

/// A sphere beside one of the view's rays: `ratio` of its radius away, so far along.
fn beside(view: &View, ray: usize, along: f32, radius: f32, ratio: f64) -> Sphere {
    let all = rays(view);
    let ray = all[ray % all.len()];
    let direction = ray.direction.as_dvec3().normalize_or_zero();
    let side = direction.any_orthonormal_vector();
    let (along, away) = (f64::from(along), ratio * f64::from(radius.abs()));
    let center = ray.origin.as_dvec3() + along * direction + away * side;
    Sphere { center: center.as_vec3(), radius: radius.abs() }
}

/// Inside, deep or grazing, just outside, and beyond.
fn ratio() -> impl Strategy<Value = f64> {
    prop_oneof![0.0..1.5, extreme(-40, -3).prop_map(|less| 1.0 - f64::from(less))]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..Default::default() })]

    #[test]
    fn no_hit_is_lost_whatever_the_sphere(
        view in views(-20, 20), ray in 0_usize..96, along in extreme(-60, 60),
        radius in extreme(-60, 60), ratio in ratio(),
    ) {
        hits_and_bounded(&view, beside(&view, ray, along, radius, ratio), Tier::Exact);
    }

    #[test]
    fn no_hit_is_lost_at_the_ends_of_numbers(
        view in views(-149, 127), ray in 0_usize..96, along in extreme(-149, 127),
        radius in extreme(-149, 127), ratio in ratio(),
    ) {
        hits_and_bounded(&view, beside(&view, ray, along, radius, ratio), Tier::Exact);
        hits_and_bounded(&view, Sphere { center: view.target, radius: radius.abs() }, Tier::Exact);
    }

    /// From far too, where tests of `Stable` are off by the most.
    #[test]
    fn stable_loses_none_either(
        view in views(-3, 3), ray in 0_usize..96, along in extreme(-8, 36),
        radius in extreme(-12, 36), ratio in ratio(),
    ) {
        hits_and_bounded(&view, beside(&view, ray, along, radius, ratio), Tier::Stable);
    }

    /// Through a long lens, so that rounding to `f32` is no margin: spheres far smaller than what
    /// `Stable` may be off.
    #[test]
    fn stable_loses_none_through_a_long_lens(
        eye in vector(-8, -3), fov in 0.001_f32..0.1, ray in 0_usize..96, along in 1.0_f32..4.0,
        size in extreme(-40, -20), away in extreme(-26, -20),
    ) {
        let view = View { eye, lens: Lens::Perspective { fov }, ..VIEW };
        let ratio = f64::from(away / size).abs();
        hits_and_bounded(&view, beside(&view, ray, along, size * along, ratio), Tier::Stable);
    }

    /// Nearly touching the eye, on either side of it, and around it.
    #[test]
    fn none_is_lost_near_the_eye(
        view in views(-3, 3), toward in vector(-1, 1), radius in extreme(-10, 10),
        gap in extreme(-40, 0),
    ) {
        let radius = radius.abs();
        let away = toward.as_dvec3().normalize() * f64::from(radius) * (1.0 + f64::from(gap));
        let sphere = Sphere { center: (view.eye.as_dvec3() + away).as_vec3(), radius };
        for tier in [Tier::Exact, Tier::Stable] {
            hits_and_bounded(&view, sphere, tier);
        }
    }
}

/// Slopes of 1 : sqrt(99), and no more than rounding beyond.
#[test]
fn the_bounds_of_a_sphere_ahead() {
    let area = Screen::new(&VIEW).of_sphere(&sphere(0.0, 0.0, -10.0, 1.0));
    let slope = 99.0_f64.sqrt().recip() as f32;
    for (low, high) in area.low.into_iter().zip(area.high) {
        assert!(high > slope && high < slope + 1e-4, "{high}");
        assert_eq!(low, -high);
    }
    for (z, most) in [(-1e6, 3.0), (-10.0, 1e-4)] {
        let area = Screen::new(&PARALLEL).of_sphere(&sphere(3.0, -2.0, z, 1.0));
        for (found, expected) in area.low.into_iter().chain(area.high).zip([2.0, -3.0, 4.0, -1.0]) {
            assert!((found - expected).abs() < most, "{z}: {area:?}");
        }
    }
}

/// A sphere beside the eye reaches from a slope to the end of the screen.
#[test]
fn the_bounds_of_a_sphere_beside_the_eye() {
    let area = Screen::new(&VIEW).of_sphere(&sphere(10.0, 0.0, 0.0, 6.0));
    assert_eq!((area.low[1], area.high), (f32::NEG_INFINITY, [f32::INFINITY; 2]));
    assert!((area.low[0] - 8.0 / 6.0).abs() < 1e-4, "{area:?}");
    assert_eq!(hits_and_bounded(&VIEW, sphere(10.0, 0.0, 0.0, 6.0), Tier::Exact), (0, 0));
}

#[test]
fn who_is_anywhere_and_who_is_nowhere() {
    let screen = Screen::new(&VIEW);
    for (sphere, area) in [
        (sphere(0.0, 0.0, 0.0, 1.0), Area::ANYWHERE),
        (sphere(0.3, 0.2, -0.4, 1e30), Area::ANYWHERE),
        (sphere(0.0, 0.0, -1.0, 1.0), Area::ANYWHERE),
        (sphere(0.0, 0.0, 1.0, 1.0), Area::ANYWHERE),
        (sphere(0.0, 0.0, 1.001, 1.0), Area::NOWHERE),
        (sphere(5.0, 0.0, 10.0, 1.0), Area::NOWHERE),
        (sphere(0.0, 0.0, -5.0, -1.0), Area::NOWHERE),
        (sphere(0.0, f32::NAN, -5.0, 1.0), Area::NOWHERE),
    ] {
        assert_eq!(screen.of_sphere(&sphere), area, "{sphere:?}");
    }
    // A point is seen as a point.
    assert!(hits_and_bounded(&VIEW, sphere(0.0, 0.0, -5.0, 0.0), Tier::Exact).1 <= 4);
    // From nowhere all is anywhere.
    for view in [View { eye: Vec3::NAN, ..VIEW }, View { eye: Vec3::INFINITY, ..PARALLEL }] {
        let screen = Screen::new(&view);
        assert_eq!(screen.of_sphere(&sphere(0.0, 0.0, -5.0, 1.0)), Area::ANYWHERE);
    }
}

/// A sphere that fills a tenth of the screen is not looked for everywhere: most of its bounds is hit.
#[test]
fn bounds_are_bounds() {
    for view in [VIEW, PARALLEL] {
        let (hits, bounded) = hits_and_bounded(&view, sphere(0.4, 0.3, -5.0, 0.8), Tier::Exact);
        assert!(hits >= 8 && bounded < 2 * hits, "{hits} of {bounded}");
    }
}

/// A root just before the eye is rounded to T = 0, which counts: the sphere is on the other side of the eye.
#[test]
fn a_root_that_is_rounded_to_zero_is_seen() {
    let view = View { lens: Lens::Perspective { fov: 170.0 }, ..VIEW };
    let least = f32::from_bits(1);
    let (hits, _) = hits_and_bounded(&view, sphere(6.0 * least, 0.0, 0.0, least), Tier::Exact);
    assert!(hits > 0);
}

/// Rays that are not the camera's may meet any sphere, one that is nowhere too.
#[test]
fn rays_of_others_may_be_anywhere() {
    for (view, other) in [
        (VIEW, Ray::new(Vec3::X, Vec3::NEG_Z)),
        (VIEW, Ray::new(VIEW.eye, Vec3::Z)),
        (VIEW, Ray::new(VIEW.eye, Vec3::new(300.0, 0.0, -1.0))),
        (VIEW, Ray { t_min: -1.0, ..Ray::new(VIEW.eye, Vec3::NEG_Z) }),
        (PARALLEL, Ray::new(Vec3::ZERO, Vec3::new(0.0, 1e-7, -1.0))),
    ] {
        let screen = Screen::new(&view);
        let place = screen.of_packet(&RayPacket::new(&[rays(&view)[0], other]));
        assert_eq!(place, (Area::ANYWHERE, 2), "{other:?}");
        assert!(place.0.overlaps(&Area::NOWHERE) && Area::NOWHERE.overlaps(&place.0));
        let (of_none, live) = screen.of_packet(&RayPacket::inactive());
        assert_eq!(live, 0);
        assert!(!of_none.overlaps(&screen.of_sphere(&sphere(0.0, 0.0, -5.0, 1.0))));
    }
}
