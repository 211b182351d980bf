//! Cells that are picked, views that are moved along the picture, and what is framed.

use super::tests::state;
use super::*;
use crate::view::Lens;
use spherule_kernel::Vec3;

fn cell(state: &State) -> Option<(u16, u16)> {
    state.shown.cursor.map(|cursor| (cursor.column, cursor.row))
}

#[test]
fn a_click_picks_and_a_drag_does_not() {
    let mut state = state();
    state.apply(Input::Grab(10, 20));
    assert_eq!(state.apply(Input::Drag(10, 20)), Outcome::Unchanged);
    assert_eq!(state.apply(Input::Release(10, 20)), Outcome::Changed);
    assert_eq!((cell(&state), state.shown.view), (Some((10, 20)), state.home));
    // Another click, elsewhere; then none: let go somewhere else, led away and back, never pressed.
    state.apply(Input::Grab(11, 3));
    assert_eq!(state.apply(Input::Release(11, 3)), Outcome::Changed);
    assert_eq!(cell(&state), Some((11, 3)));
    for inputs in [
        [Input::Grab(5, 5), Input::Drag(6, 5), Input::Release(6, 5)],
        [Input::Grab(5, 5), Input::Drag(5, 5), Input::Release(5, 6)],
        [Input::Grab(5, 5), Input::Release(6, 6), Input::Release(6, 6)],
        // The status line's row.
        [Input::Grab(5, 36), Input::Drag(5, 36), Input::Release(5, 36)],
    ] {
        for input in inputs {
            state.apply(input);
        }
        assert_eq!(cell(&state), Some((11, 3)), "{inputs:?}");
    }
    for input in [Input::Grab(5, 5), Input::Drag(6, 5), Input::Drag(5, 5), Input::Release(5, 5)] {
        state.apply(input);
    }
    assert_eq!(cell(&state), Some((11, 3)));
}

#[test]
fn while_a_cell_is_picked_arrows_lead_it_and_escape_ends_that() {
    let mut state = state();
    assert_eq!(state.apply(Input::Pick), Outcome::Changed);
    assert_eq!(cell(&state), Some((40, 18)));
    state.apply(Input::Orbit(1, 0));
    state.apply(Input::Orbit(0, 1));
    assert_eq!((cell(&state), state.shown.view), (Some((41, 17)), state.home));
    for _ in 0..100 {
        state.apply(Input::Orbit(1, 0));
        state.apply(Input::Orbit(0, -1));
    }
    assert_eq!(cell(&state), Some((79, 35)));
    assert_eq!(state.apply(Input::Orbit(1, 0)), Outcome::Unchanged);
    state.set_size(20, 10);
    assert_eq!(cell(&state), Some((19, 9)));
    // The help is over it, and goes first.
    state.apply(Input::Help);
    assert_eq!(state.apply(Input::Escape), Outcome::Changed);
    assert_eq!((cell(&state), state.shown.help), (Some((19, 9)), false));
    assert_eq!(state.apply(Input::Escape), Outcome::Changed);
    assert_eq!(cell(&state), None);
    state.apply(Input::Orbit(1, 0));
    assert_ne!(state.shown.view, state.home);
    state.apply(Input::Pick);
    assert_eq!(state.apply(Input::Pick), Outcome::Changed);
    assert_eq!(state.apply(Input::Escape), Outcome::Quit);
}

/// Where a point is seen, in columns and rows from the middle of a picture of 80 x 36 cells.
fn seen(view: &View, point: Vec3) -> [f64; 2] {
    let [forward, right, up] = view.axes();
    let p = point.as_dvec3() - view.eye.as_dvec3();
    let depth = match view.lens {
        Lens::Perspective { .. } => {
            let at_target = view.eye.as_dvec3().distance(view.target.as_dvec3());
            p.dot(forward) / at_target
        }
        Lens::Parallel { .. } => 1.0,
    };
    let a_row = f64::from(view.height_at_target()) / 36.0 * depth;
    [p.dot(right) / (0.5 * a_row), -p.dot(up) / a_row]
}

#[test]
fn what_the_right_button_holds_follows_it_cell_by_cell() {
    for kind in [LensKind::Perspective, LensKind::Parallel] {
        let mut state = state();
        state.shown.view = with_projection(&orbited(&state.home, 0.5, 0.25), kind);
        let target = state.shown.view.target;
        assert_eq!(state.apply(Input::GrabPlane(10, 10)), Outcome::Unchanged);
        assert_eq!(state.apply(Input::DragPlane(13, 9)), Outcome::Changed);
        assert_eq!(state.apply(Input::DragPlane(23, 5)), Outcome::Changed);
        let [column, row] = seen(&state.shown.view, target);
        assert!((column - 13.0).abs() < 1e-4 && (row + 5.0).abs() < 1e-4, "{column}, {row}");
        let way = state.shown.view.eye - state.shown.view.target;
        assert!((way.length() - 5.0).abs() < 1e-5);
        assert_eq!(cell(&state), None);
    }
}

#[test]
fn shifted_letters_lead_eye_and_target_along() {
    let mut state = state();
    assert_eq!(state.apply(Input::Pan(1, 0)), Outcome::Changed);
    let step = (PAN_STEP as f32) * state.home.height_at_target();
    assert!(state.shown.view.target.distance(Vec3::X * step) < 1e-6);
    state.apply(Input::Pan(-1, 0));
    state.apply(Input::Pan(0, -1));
    assert!(state.shown.view.target.distance(Vec3::NEG_Y * step) < 1e-6);
    assert!(state.shown.view.eye.distance(Vec3::new(0.0, -step, 5.0)) < 1e-6);
}

#[test]
fn what_is_framed_fills_the_picture_with_the_cursor_in_its_middle() {
    let mut state = state();
    let sphere = Sphere { center: Vec3::new(3.0, 1.0, -8.0), radius: 0.5 };
    assert_eq!(state.frame(sphere), Outcome::Changed);
    assert_eq!((state.shown.view.target, cell(&state)), (sphere.center, None));
    assert_eq!(seen(&state.shown.view, sphere.center), [0.0, 0.0]);
    state.apply(Input::Pick);
    state.apply(Input::Orbit(1, 0));
    state.frame(sphere);
    assert_eq!(cell(&state), Some((40, 18)));
    state.apply(Input::Reset);
    assert_eq!(state.shown.view, state.home);
}
