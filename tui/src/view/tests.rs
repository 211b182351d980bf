use super::*;

const VIEW: View = View { lens: Lens::Perspective { fov: 90.0 }, ..View::FRONT };

fn near(a: Vec3, b: Vec3) -> bool {
    (a - b).abs().max_element() < 1e-5
}

#[test]
fn the_corners_of_a_perspective_picture() {
    let camera = VIEW.camera(4, 2, 2.0);
    assert!(near(camera.get_ray(0, 0).direction, Vec3::new(-1.5, 0.5, -1.0)));
    assert!(near(camera.get_ray(3, 1).direction, Vec3::new(1.5, -0.5, -1.0)));
    assert_eq!(camera.get_ray(1, 1).origin, VIEW.eye);
}

#[test]
fn the_corners_of_a_parallel_picture() {
    let camera = View { lens: Lens::Parallel { height: 2.0 }, ..VIEW }.camera(2, 2, 1.0);
    let ray = camera.get_ray(0, 1);
    assert!(near(ray.origin, Vec3::new(-0.5, -0.5, 5.0)));
    assert!(near(ray.direction, Vec3::NEG_Z));
}

#[test]
fn degenerate_views_still_make_rays() {
    for view in [
        View { up: Vec3::Z, ..VIEW },
        View { up: Vec3::ZERO, ..VIEW },
        View { eye: Vec3::ZERO, ..VIEW },
        View { eye: Vec3::Y, up: Vec3::Y, ..VIEW },
    ] {
        let ray = view.camera(3, 3, 1.0).get_ray(0, 0);
        assert!(ray.direction.is_finite() && ray.direction.length() > 0.5, "{view:?}");
    }
}

#[test]
fn a_quarter_orbit_leads_the_eye_to_the_right() {
    let view = orbited(&VIEW, std::f32::consts::FRAC_PI_2, 0.0);
    assert!(near(view.eye, Vec3::new(5.0, 0.0, 0.0)), "{view:?}");
}

#[test]
fn an_orbit_stops_before_the_poles_and_keeps_its_distance() {
    let mut view = VIEW;
    for _ in 0..100 {
        view = orbited(&view, 0.3, 0.3);
    }
    assert!((view.eye.length() - 5.0).abs() < 1e-3);
    assert!(view.eye.y < 5.0 && view.eye.y > 4.99);
    assert!(orbited(&view, 0.0, -9.0).eye.y < -4.99);
}

#[test]
fn a_pan_moves_eye_and_target_alike_in_the_plane_of_the_picture() {
    let view = panned(&VIEW, 2.0, -3.0);
    assert_eq!(view.eye, Vec3::new(2.0, -3.0, 5.0));
    assert_eq!(view.target, Vec3::new(2.0, -3.0, 0.0));
    let slanting = orbited(&VIEW, 0.7, 0.4);
    let view = panned(&slanting, 2.0, -3.0);
    assert!(near(view.eye - view.target, slanting.eye - slanting.target));
    let way = (view.target - slanting.target).as_dvec3();
    let along = slanting.axes().map(|axis| axis.dot(way));
    assert!((0..3).all(|i| (along[i] - [0.0, 2.0, -3.0][i]).abs() < 1e-6), "{along:?}");
    assert_eq!(panned(&VIEW, f64::NAN, 0.0), VIEW);
    assert_eq!(panned(&VIEW, 1e39, 0.0), VIEW);
}

#[test]
fn zooming_in_and_out_comes_back() {
    for lens in [Lens::Perspective { fov: 40.0 }, Lens::Parallel { height: 3.0 }] {
        let view = View { lens, ..VIEW };
        let nearer = zoomed(&view, 2.0);
        assert!((nearer.height_at_target() * 2.0 - view.height_at_target()).abs() < 1e-5);
        assert!(near(zoomed(&nearer, 0.5).eye, view.eye));
        for factor in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e-30] {
            let same = zoomed(&view, factor);
            assert_eq!(same, view, "{factor}");
        }
    }
}

/// Far from zero, floats around the target are too far apart for an eye that is very near.
#[test]
fn however_far_it_zooms_in_it_looks_from_the_same_side() {
    let target = Vec3::new(1.25, -2.5, 3.1);
    let start = View { eye: target + Vec3::new(0.3, 1.7, 9.0), target, ..VIEW };
    let (mut view, mut steps) = (start, 0);
    for _ in 0..200 {
        let nearer = zoomed(&view, 1.1);
        steps += i32::from(nearer != view);
        view = nearer;
    }
    assert!((80..150).contains(&steps), "{steps}");
    for _ in 0..steps {
        let farther = zoomed(&view, 1.0 / 1.1);
        assert_ne!(farther, view, "the way back is open");
        view = farther;
    }
    let [before, after] = [start, view].map(|view| view.axes()[0]);
    assert!(before.dot(after) > 0.9998, "{}", before.dot(after));
    assert!((view.height_at_target() / start.height_at_target() - 1.0).abs() < 0.02);
    // Through the other lens there is no end, and no eye for what is seen then.
    let parallel = with_projection(&start, LensKind::Parallel);
    let low = (0..700).fold(parallel, |view, _| zoomed(&view, 1.1));
    assert!(low.height_at_target() < 1e-25);
    assert_eq!(with_projection(&low, LensKind::Perspective), low);
}

/// Else the picture would stay without what is in front of the eye when the scene was near.
#[test]
fn the_rays_of_a_parallel_picture_that_becomes_higher_start_farther_away() {
    let lens = Lens::Parallel { height: 0.3 };
    let low = View { eye: Vec3::new(0.0, 0.0, 0.4), lens, ..VIEW };
    let high = (0..28).fold(low, |view, _| zoomed(&view, 1.0 / 1.1));
    let height = high.height_at_target();
    assert!((4.3..4.4).contains(&height), "{height}");
    let distance = height / 2.0 / 20_f32.to_radians().tan();
    assert!(near(high.eye, Vec3::Z * distance), "{high:?}");
    assert_eq!(zoomed(&high, 100.0).eye, high.eye);
    // An eye that is far enough stays.
    let far = View { lens: Lens::Parallel { height: 3.0 }, ..VIEW };
    assert_eq!(zoomed(&far, 0.9).eye, VIEW.eye);
}

/// Very large and very small scenes are first seen from there.
#[test]
fn from_outside_the_useful_numbers_the_way_back_is_open() {
    for (size, back) in [(2e30, 1.1), (5e-31, 1.0 / 1.1)] {
        for lens in [Lens::Perspective { fov: 40.0 }, Lens::Parallel { height: size }] {
            let view = View { eye: Vec3::Z * size, lens, ..VIEW };
            let ratio = zoomed(&view, back).height_at_target() / view.height_at_target();
            assert!((ratio * back - 1.0).abs() < 1e-5, "{lens:?}: {ratio}");
            assert_eq!(zoomed(&view, 1.0 / back), view, "farther out");
        }
    }
}

/// As high as the picture that the camera makes, also where the angle is nearly flat.
#[test]
fn the_height_at_the_target_is_the_cameras() {
    for fov in [1e-3, 40.0, 179.0, 179.999_98] {
        let view = View { lens: Lens::Perspective { fov }, ..VIEW };
        let height = 5.0 * f64::from(view.camera(1, 1, 1.0).step_y.length());
        let error = f64::from(view.height_at_target()) / height - 1.0;
        assert!(error.abs() < 1e-6, "{fov}: {error}");
    }
}

#[test]
fn the_other_projection_keeps_the_size_at_the_target() {
    let parallel = with_projection(&VIEW, LensKind::Parallel);
    assert!(matches!(parallel.lens, Lens::Parallel { height } if (height - 10.0).abs() < 1e-5));
    assert_eq!(parallel.eye, VIEW.eye);
    let back = with_projection(&parallel, LensKind::Perspective);
    assert!((back.height_at_target() - VIEW.height_at_target()).abs() < 1e-4);
    assert_eq!(back.eye, VIEW.eye);
    let low = zoomed(&parallel, 100.0);
    let moved = with_projection(&low, LensKind::Perspective);
    assert_eq!(moved.lens, Lens::Perspective { fov: 40.0 });
    assert!((moved.height_at_target() - low.height_at_target()).abs() < 1e-6);
}
