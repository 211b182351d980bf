//! What keys and the mouse lead to.

use super::*;
use clap::ValueEnum;

impl Start {
    /// A plain picture from in front: what tests start from.
    pub(crate) const FRONT: Self = Self {
        view: View::FRONT,
        style: Style::PLAIN,
        structure: None,
        comparison: None,
        table: false,
        legend: false,
    };
}

pub(super) fn state() -> State {
    let style = Style { accuracy: Tier::Stable, charset: Charset::Half, ..Style::PLAIN };
    let mut state = State::new(Start { style, ..Start::FRONT }, (0, 3));
    state.set_size(80, 36);
    state
}

#[test]
fn right_leads_the_eye_right_and_left_back() {
    let mut state = state();
    assert_eq!(state.apply(Input::Orbit(1, 0)), Outcome::Changed);
    assert!(state.shown.view.eye.x > 0.4);
    assert_eq!(state.apply(Input::Orbit(-1, 0)), Outcome::Changed);
    assert!(state.shown.view.eye.distance(state.home.eye) < 1e-5);
    assert_eq!(state.apply(Input::Orbit(0, 1)), Outcome::Changed);
    assert!(state.shown.view.eye.y > 0.4);
}

#[test]
fn the_scene_follows_the_mouse() {
    let mut dragged = state();
    assert_eq!(dragged.apply(Input::Grab(10, 10)), Outcome::Unchanged);
    assert_eq!(dragged.apply(Input::Drag(20, 10)), Outcome::Changed);
    // Ten columns are as wide as five rows are high; a row is 5 degrees here, as a key is.
    let mut led = state();
    for _ in 0..5 {
        led.apply(Input::Orbit(-1, 0));
    }
    assert!(dragged.shown.view.eye.distance(led.shown.view.eye) < 1e-4);
    assert_eq!(dragged.apply(Input::Drag(20, 10)), Outcome::Unchanged);
    dragged.apply(Input::Drag(20, 12));
    assert!(dragged.shown.view.eye.y > 0.5);
}

#[test]
fn a_drag_without_a_grab_only_takes_hold() {
    let mut state = state();
    assert_eq!(state.apply(Input::Drag(5, 5)), Outcome::Unchanged);
    assert_eq!(state.apply(Input::Drag(6, 5)), Outcome::Changed);
}

#[test]
fn what_is_chosen_already_changes_nothing() {
    let mut state = state();
    assert_eq!(state.apply(Input::Accuracy(Tier::Stable)), Outcome::Unchanged);
    for tier in [Tier::Fast, Tier::Geometric, Tier::Exact] {
        assert_eq!(state.apply(Input::Accuracy(tier)), Outcome::Changed);
        assert_eq!(state.shown.style.accuracy, tier);
    }
    assert_eq!(state.apply(Input::Projection), Outcome::Changed);
    assert_eq!(state.shown.view.lens_kind(), LensKind::Parallel);
    assert_eq!(state.apply(Input::Structure), Outcome::Changed);
    assert_eq!(state.shown.structure, Some(Structure::Brute));
}

#[test]
fn the_errors_of_the_tier_are_shown_and_hidden() {
    let mut state = state();
    for shown in [Some(Comparison::Errors), None] {
        assert_eq!(state.apply(Input::Errors), Outcome::Changed);
        assert_eq!(state.shown.comparison, shown);
    }
}

#[test]
fn a_seam_is_moved_by_keys_and_by_a_drag_that_begins_on_it() {
    let mut state = state();
    assert_eq!(state.apply(Input::Seam(1)), Outcome::Unchanged);
    assert_eq!(state.apply(Input::Split), Outcome::Changed);
    let tiers = [Tier::Stable, Tier::Exact];
    assert_eq!((state.shown.comparison, state.seam()), (Some(Comparison::Split(tiers)), 40));
    for (input, seam) in [
        (Input::Seam(1), 41),
        (Input::Seam(-1), 40),
        (Input::Grab(40, 3), 40),
        (Input::Drag(60, 9), 60),
        (Input::Drag(200, 9), 79),
        (Input::Seam(1), 79),
        (Input::Drag(0, 0), 0),
        (Input::Seam(-1), 0),
    ] {
        state.apply(input);
        assert_eq!((state.seam(), state.shown.view), (seam, state.home), "{input:?}");
    }
    // Elsewhere a drag orbits.
    state.apply(Input::Grab(10, 3));
    state.apply(Input::Drag(20, 3));
    assert_eq!(state.seam(), 0);
    assert_ne!(state.shown.view, state.home);
    state.apply(Input::Accuracy(Tier::Geometric));
    let tiers = [Tier::Geometric, Tier::Exact];
    assert_eq!(state.shown.comparison, Some(Comparison::Split(tiers)));
    // In a smaller window it is still there.
    state.apply(Input::Grab(0, 0));
    state.apply(Input::Drag(79, 0));
    state.set_size(20, 5);
    assert_eq!(state.seam(), 19);
    state.apply(Input::Split);
    assert_eq!(state.shown.comparison, None);
    state.apply(Input::Accuracy(Tier::Exact));
    state.apply(Input::Split);
    let tiers = [Tier::Fast, Tier::Exact];
    assert_eq!(state.shown.comparison, Some(Comparison::Split(tiers)));
    state.apply(Input::Errors);
    assert_eq!(state.shown.comparison, Some(Comparison::Errors));
}

#[test]
fn the_charsets_go_around() {
    let mut state = state();
    let mut seen = Vec::new();
    for _ in Charset::value_variants() {
        assert_eq!(state.apply(Input::Charset), Outcome::Changed);
        assert!(!seen.contains(&state.shown.style.charset), "{seen:?}");
        seen.push(state.shown.style.charset);
    }
    assert_eq!(seen.last(), Some(&Charset::Half));
}

#[test]
fn it_spins_only_when_told_and_does_not_catch_up() {
    let mut state = state();
    state.advance(Duration::from_millis(50));
    assert_eq!(state.shown.view, state.home);
    state.apply(Input::Spin);
    state.advance(Duration::from_secs(3600));
    let step = SPIN * LONGEST_STEP.as_secs_f32();
    assert!(state.shown.view.eye.distance(orbited(&state.home, step, 0.0).eye) < 1e-5);
    state.apply(Input::Reset);
    assert_eq!((state.shown.view, state.shown.spinning), (state.home, false));
}

#[test]
fn there_is_a_table_or_a_pick() {
    let mut state = state();
    let over = |state: &State| (state.shown.table, state.shown.cursor.is_some());
    for (input, shown) in [
        (Input::Table, (true, false)),
        (Input::Orbit(1, 0), (true, false)),
        (Input::Pick, (false, true)),
        (Input::Table, (true, false)),
        (Input::Table, (false, false)),
        (Input::Table, (true, false)),
        (Input::Help, (true, false)),
        (Input::Escape, (true, false)),
        (Input::Escape, (false, false)),
    ] {
        assert_eq!(state.apply(input), Outcome::Changed, "{input:?}");
        assert_eq!(over(&state), shown, "{input:?}");
    }
    assert_ne!(state.shown.view, state.home);
    for input in [Input::Escape, Input::Quit] {
        assert_eq!(state.apply(input), Outcome::Quit, "{input:?}");
    }
}

/// A later frame may have more than the first.
#[test]
fn colourings_come_in_a_circle() {
    let mut state = state();
    let next = |state: &mut State| {
        state.apply(Input::Coloring);
        state.shown.coloring
    };
    assert_eq!([0; 3].map(|_| next(&mut state)), [1, 2, 0]);
    state.set_colorings(5);
    assert_eq!([0; 5].map(|_| next(&mut state)), [1, 2, 3, 4, 0]);
}
