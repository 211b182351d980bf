//! What the viewer shows and how it moves. No terminal, no clock: input and durations come in.

use super::Start;
use super::hand::Hand;
use super::keys::Input;
use super::picking::Cursor;
use crate::choice::{Auto, next};
use crate::compare::Comparison;
use crate::machine::check_floats;
use crate::scene::framing::reframed;
use crate::structure::Structure;
use crate::style::{Charset, Style};
use crate::view::{LensKind, View, orbited, panned, with_projection, zoomed};
use spherule_kernel::{Sphere, Tier};
use std::f32::consts::PI;
use std::time::Duration;

/// How far a key leads the eye around, in radians: 5 degrees.
pub const ORBIT_STEP: f32 = PI / 36.0;
/// What a key or a notch of the wheel enlarges by.
pub const ZOOM_STEP: f32 = 1.1;
/// How far a key leads eye and target along the picture, over the picture's height at the target.
pub const PAN_STEP: f64 = 0.05;
/// Radians a second: around in 12 seconds.
const SPIN: f32 = PI / 6.0;
/// After a suspension or on a slow link the spin goes on; it does not catch up.
const LONGEST_STEP: Duration = Duration::from_millis(100);

/// What an input led to, from the least to the most.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Outcome {
    /// The screen is as it should be.
    Unchanged,
    /// There is something to draw.
    Changed,
    /// The user has seen enough.
    Quit,
}

impl Outcome {
    /// What both led to.
    pub(super) fn and(self, other: Self) -> Self {
        self.max(other)
    }
}

/// What is shown: a frame is drawn when it changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shown {
    pub(super) view: View,
    pub(super) style: Style,
    pub(super) structure: Auto<Structure>,
    pub(super) comparison: Option<Comparison>,
    /// How far the seam between two tiers is to the right of the middle.
    pub(super) seam: i16,
    pub(super) help: bool,
    pub(super) spinning: bool,
    /// Whether there is a table of what every tier takes and gets wrong; then no cell is picked.
    pub(super) table: bool,
    /// The cell that is picked.
    pub(super) cursor: Option<Cursor>,
}

impl Shown {
    /// What the picture itself depends on.
    pub(super) fn pictured(&self) -> Self {
        Self { help: false, spinning: false, table: false, cursor: None, ..*self }
    }
}

/// The state between frames.
#[derive(Clone, Debug)]
pub(super) struct State {
    home: View,
    pub(super) shown: Shown,
    hand: Hand,
    /// Whether it holds the seam.
    pulls_seam: bool,
    /// Columns and rows of the picture: a drag over all rows is half a turn.
    size: (u16, u16),
}

impl State {
    pub(super) fn new(Start { view, style, structure, comparison, table }: Start) -> Self {
        let shown = Shown {
            view,
            style,
            structure,
            comparison,
            seam: 0,
            help: false,
            spinning: false,
            table,
            cursor: None,
        };
        Self { home: view, shown, hand: Hand::default(), pulls_seam: false, size: (1, 1) }
    }

    /// Tells the size of the picture.
    pub(super) fn set_size(&mut self, columns: u16, rows: u16) {
        self.size = (columns.max(1), rows.max(1));
        self.shown.cursor = self.shown.cursor.map(|cursor| cursor.within(self.size));
    }

    /// Columns and rows of the picture.
    pub(super) fn size(&self) -> (u16, u16) {
        self.size
    }

    /// Lets `sphere` fill the picture, from the present direction; a cell that is picked follows it to the middle.
    pub(super) fn frame(&mut self, sphere: Sphere) -> Outcome {
        let before = self.shown;
        let aspect = before.style.picture_aspect(self.size.0, self.size.1);
        self.shown.view = reframed(&before.view, sphere, aspect as f32);
        self.shown.cursor = before.cursor.map(|_| Cursor::middle(self.size));
        self.since(&before)
    }

    /// The column between two tiers.
    pub(super) fn seam(&self) -> u16 {
        let column = i32::from(self.size.0 / 2) + i32::from(self.shown.seam);
        column.clamp(0, i32::from(self.size.0) - 1) as u16
    }

    fn is_split(&self) -> bool {
        matches!(self.shown.comparison, Some(Comparison::Split(_)))
    }

    fn step_seam(&mut self, right: i8) {
        if self.is_split() {
            self.lead_seam_to(i32::from(self.seam()) + i32::from(right));
        }
    }

    fn lead_seam_to(&mut self, column: i32) {
        let column = column.clamp(0, i32::from(self.size.0) - 1);
        self.shown.seam = (column - i32::from(self.size.0 / 2)) as i16;
    }

    /// Lets time pass.
    pub(super) fn advance(&mut self, time: Duration) {
        if self.shown.spinning {
            let seconds = time.min(LONGEST_STEP).as_secs_f32();
            self.shown.view = orbited(&self.shown.view, SPIN * seconds, 0.0);
        }
    }

    pub(super) fn apply(&mut self, input: Input) -> Outcome {
        let before = self.shown;
        let Shown { view, style, structure, comparison, help, spinning, table, cursor, .. } =
            &mut self.shown;
        match input {
            Input::Quit => return Outcome::Quit,
            Input::Escape if *help => *help = false,
            Input::Escape if *table => *table = false,
            Input::Escape if cursor.is_some() => *cursor = None,
            Input::Escape => return Outcome::Quit,
            Input::Grab(column, row) | Input::GrabPlane(column, row) => {
                self.hand.grab((column, row));
                self.pulls_seam =
                    matches!(input, Input::Grab(..)) && self.is_split() && column == self.seam();
            }
            Input::Drag(column, row) if self.pulls_seam => {
                // So that it is no click.
                self.hand.led_to((column, row));
                self.lead_seam_to(column.into());
            }
            Input::Seam(right) => self.step_seam(right),
            Input::Drag(column, row) => self.drag_to(column, row),
            Input::DragPlane(column, row) => self.pull_to(column, row),
            Input::Release(column, row) => self.release(column, row),
            Input::Pick if cursor.is_some() => *cursor = None,
            Input::Pick => self.pick(Cursor::middle(self.size)),
            Input::Orbit(right, up) if cursor.is_some() => {
                *cursor = cursor.map(|cursor| cursor.moved(right, up, self.size));
            }
            Input::Orbit(right, up) => {
                let step = |count| f32::from(count) * ORBIT_STEP;
                *view = orbited(view, step(right), step(up));
            }
            Input::Pan(right, up) => {
                let step = PAN_STEP * f64::from(view.height_at_target());
                *view = panned(view, f64::from(right) * step, f64::from(up) * step);
            }
            Input::Zoom(steps) => *view = zoomed(view, ZOOM_STEP.powi(steps.into())),
            // A key that asks for what this process cannot compute does nothing.
            Input::Accuracy(tier) if check_floats(tier).is_err() => {}
            Input::Accuracy(tier) => {
                style.accuracy = tier;
                // The left half is the one to choose.
                if let Some(Comparison::Split([left, _])) = comparison {
                    *left = tier;
                }
            }
            // The truth is what exact says.
            Input::Errors | Input::Split | Input::Table if check_floats(Tier::Exact).is_err() => {}
            Input::Errors => {
                *comparison = match comparison {
                    Some(Comparison::Errors) => None,
                    _ => Some(Comparison::Errors),
                }
            }
            Input::Split => {
                *comparison = match (*comparison, style.accuracy) {
                    (Some(Comparison::Split(_)), _) => None,
                    // What is wrong with exact nobody sees.
                    (_, Tier::Exact) => Some(Comparison::Split([Tier::Fast, Tier::Exact])),
                    (_, tier) => Some(Comparison::Split([tier, Tier::Exact])),
                }
            }
            Input::Table => (*table, *cursor) = (!*table, None),
            Input::Projection => {
                let other = match view.lens_kind() {
                    LensKind::Perspective => LensKind::Parallel,
                    LensKind::Parallel => LensKind::Perspective,
                };
                *view = with_projection(view, other);
            }
            Input::Charset => {
                style.charset = next(Some(style.charset)).unwrap_or(Charset::Ascii);
            }
            Input::Structure => *structure = next(*structure),
            Input::Spin => *spinning = !*spinning,
            Input::Reset => (*view, *spinning) = (self.home, false),
            Input::Help => *help = !*help,
            // What concerns the terminal or asks for the scene.
            Input::Suspend | Input::Resize | Input::FrameAll | Input::FramePicked => {}
        }
        self.since(&before)
    }

    fn since(&self, before: &Shown) -> Outcome {
        if self.shown == *before { Outcome::Unchanged } else { Outcome::Changed }
    }

    /// A pick asks every tier, so where `Exact` cannot be had there is none. It is told where the table is.
    fn pick(&mut self, cursor: Cursor) {
        if check_floats(Tier::Exact).is_ok() {
            (self.shown.cursor, self.shown.table) = (Some(cursor), false);
        }
    }

    /// The scene follows the hand, so the eye goes the other way.
    fn drag_to(&mut self, column: u16, row: u16) {
        let a_row = PI / f32::from(self.size.1);
        let [right, down] = self.hand.led_to((column, row));
        if [right, down] == [0.0; 2] {
            // Turned by nothing, the eye would be rounded all the same.
            return;
        }
        let right = right * self.shown.style.cell_aspect;
        self.shown.view = orbited(&self.shown.view, -right * a_row, down * a_row);
    }

    /// What is under the hand, as far away as the target, stays there.
    fn pull_to(&mut self, column: u16, row: u16) {
        let view = self.shown.view;
        let a_row = f64::from(view.height_at_target()) / f64::from(self.size.1);
        let a_column = a_row * f64::from(self.shown.style.cell_aspect);
        let [right, down] = self.hand.led_to((column, row)).map(f64::from);
        self.shown.view = panned(&view, -right * a_column, down * a_row);
    }

    /// A press and a release without a movement in between is a click.
    fn release(&mut self, column: u16, row: u16) {
        let is_click = self.hand.release((column, row));
        if is_click && column < self.size.0 && row < self.size.1 {
            self.pick(Cursor { column, row });
        }
    }
}

#[cfg(test)]
mod moves;
#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::Lens;
    use clap::ValueEnum;
    use spherule_kernel::Vec3;

    pub(super) fn state() -> State {
        let view = View {
            eye: Vec3::new(0.0, 0.0, 5.0),
            target: Vec3::ZERO,
            up: Vec3::Y,
            lens: Lens::Perspective { fov: 40.0 },
        };
        let style = Style { accuracy: Tier::Stable, charset: Charset::Half, ..Style::PLAIN };
        let mut state =
            State::new(Start { view, style, structure: None, comparison: None, table: false });
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
        assert_eq!(state.apply(Input::Escape), Outcome::Quit);
    }

    #[test]
    fn escape_closes_the_help_first() {
        let mut state = state();
        assert_eq!(state.apply(Input::Help), Outcome::Changed);
        assert_eq!(state.apply(Input::Escape), Outcome::Changed);
        assert!(!state.shown.help);
        assert_eq!(state.apply(Input::Escape), Outcome::Quit);
        assert_eq!(state.apply(Input::Quit), Outcome::Quit);
    }
}
