//! What the viewer shows and how it moves. No terminal, no clock: input and durations come in.

use super::keys::Input;
use crate::draw::{AccuracyChoice, Charset, Style};
use crate::structure::StructureChoice;
use crate::view::{LensKind, View, orbited, with_projection, zoomed};
use std::f32::consts::PI;
use std::time::Duration;

/// How far a key leads the eye around, in radians: 5 degrees.
pub const ORBIT_STEP: f32 = PI / 36.0;
/// What a key or a notch of the wheel enlarges by.
pub const ZOOM_STEP: f32 = 1.1;
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

/// The state between frames.
#[derive(Clone, Debug)]
pub(super) struct State {
    home: View,
    pub(super) view: View,
    pub(super) style: Style,
    pub(super) structure: StructureChoice,
    pub(super) help: bool,
    spinning: bool,
    /// Where the mouse took hold, or was led to since.
    held: Option<(u16, u16)>,
    /// Rows of the picture: a drag over all of them is half a turn.
    height: u16,
}

impl State {
    pub(super) fn new(view: View, style: Style, structure: StructureChoice) -> Self {
        Self {
            home: view,
            view,
            style,
            structure,
            help: false,
            spinning: false,
            held: None,
            height: 1,
        }
    }

    pub(super) fn is_spinning(&self) -> bool {
        self.spinning
    }

    pub(super) fn set_height(&mut self, rows: u16) {
        self.height = rows.max(1);
    }

    /// Lets time pass.
    pub(super) fn advance(&mut self, time: Duration) {
        if self.spinning {
            let seconds = time.min(LONGEST_STEP).as_secs_f32();
            self.view = orbited(&self.view, SPIN * seconds, 0.0);
        }
    }

    pub(super) fn apply(&mut self, input: Input) -> Outcome {
        match input {
            Input::Quit => return Outcome::Quit,
            Input::Escape if !self.help => return Outcome::Quit,
            Input::Grab(column, row) => {
                self.held = Some((column, row));
                return Outcome::Unchanged;
            }
            // What concerns the terminal alone.
            Input::Suspend | Input::Resize => return Outcome::Unchanged,
            _ => {}
        }
        let (view, style, help) = (self.view, self.style, self.help);
        let structure = self.structure;
        let was_spinning = self.spinning;
        match input {
            Input::Orbit(right, up) => {
                let step = |count| f32::from(count) * ORBIT_STEP;
                self.view = orbited(&view, step(right), step(up));
            }
            Input::Zoom(steps) => self.view = zoomed(&view, ZOOM_STEP.powi(steps.into())),
            Input::Drag(column, row) => self.drag_to(column, row),
            Input::Fast => self.style.accuracy = AccuracyChoice::Fast,
            Input::Stable => self.style.accuracy = AccuracyChoice::Stable,
            Input::Exact => self.style.accuracy = AccuracyChoice::Exact,
            Input::Projection => {
                let other = match view.lens_kind() {
                    LensKind::Perspective => LensKind::Parallel,
                    LensKind::Parallel => LensKind::Perspective,
                };
                self.view = with_projection(&view, other);
            }
            Input::Charset => {
                self.style.charset = match style.charset {
                    Charset::Ascii => Charset::Half,
                    Charset::Half => Charset::Ascii,
                };
            }
            Input::Structure => self.structure = structure.next(),
            Input::Spin => self.spinning = !self.spinning,
            Input::Reset => {
                self.view = self.home;
                self.spinning = false;
            }
            Input::Help | Input::Escape => self.help = !self.help,
            Input::Quit | Input::Grab(..) | Input::Suspend | Input::Resize => {}
        }
        let same = (view, style, help) == (self.view, self.style, self.help)
            && (structure, was_spinning) == (self.structure, self.spinning);
        if same { Outcome::Unchanged } else { Outcome::Changed }
    }

    /// The scene follows the hand, so the eye goes the other way.
    fn drag_to(&mut self, column: u16, row: u16) {
        if let Some((from_column, from_row)) = self.held {
            let a_row = PI / f32::from(self.height);
            let right = (f32::from(column) - f32::from(from_column)) * self.style.cell_aspect;
            let down = f32::from(row) - f32::from(from_row);
            self.view = orbited(&self.view, -right * a_row, down * a_row);
        }
        self.held = Some((column, row));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::ColorDepth;
    use crate::structure::Structure;
    use crate::view::Lens;
    use spherule_kernel::Vec3;

    fn state() -> State {
        let view = View {
            eye: Vec3::new(0.0, 0.0, 5.0),
            target: Vec3::ZERO,
            up: Vec3::Y,
            lens: Lens::Perspective { fov: 40.0 },
        };
        let style = Style {
            accuracy: AccuracyChoice::Stable,
            charset: Charset::Half,
            depth: ColorDepth::Truecolor,
            samples: 4,
            cell_aspect: 0.5,
        };
        let mut state = State::new(view, style, StructureChoice::Auto);
        state.set_height(36);
        state
    }

    #[test]
    fn right_leads_the_eye_right_and_left_back() {
        let mut state = state();
        assert_eq!(state.apply(Input::Orbit(1, 0)), Outcome::Changed);
        assert!(state.view.eye.x > 0.4);
        assert_eq!(state.apply(Input::Orbit(-1, 0)), Outcome::Changed);
        assert!(state.view.eye.distance(state.home.eye) < 1e-5);
        assert_eq!(state.apply(Input::Orbit(0, 1)), Outcome::Changed);
        assert!(state.view.eye.y > 0.4);
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
        assert!(dragged.view.eye.distance(led.view.eye) < 1e-4);
        assert_eq!(dragged.apply(Input::Drag(20, 10)), Outcome::Unchanged);
        dragged.apply(Input::Drag(20, 12));
        assert!(dragged.view.eye.y > 0.5);
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
        assert_eq!(state.apply(Input::Stable), Outcome::Unchanged);
        assert_eq!(state.apply(Input::Fast), Outcome::Changed);
        assert_eq!(state.style.accuracy, AccuracyChoice::Fast);
        assert_eq!(state.apply(Input::Exact), Outcome::Changed);
        assert_eq!(state.style.accuracy, AccuracyChoice::Exact);
        assert_eq!(state.apply(Input::Charset), Outcome::Changed);
        assert_eq!(state.style.charset, Charset::Ascii);
        assert_eq!(state.apply(Input::Projection), Outcome::Changed);
        assert_eq!(state.view.lens_kind(), LensKind::Parallel);
        assert_eq!(state.apply(Input::Structure), Outcome::Changed);
        assert_eq!(state.structure, StructureChoice::Only(Structure::Brute));
    }

    #[test]
    fn it_spins_only_when_told_and_does_not_catch_up() {
        let mut state = state();
        state.advance(Duration::from_millis(50));
        assert_eq!(state.view, state.home);
        state.apply(Input::Spin);
        state.advance(Duration::from_secs(3600));
        let step = SPIN * LONGEST_STEP.as_secs_f32();
        assert!(state.view.eye.distance(orbited(&state.home, step, 0.0).eye) < 1e-5);
        state.apply(Input::Reset);
        assert_eq!((state.view, state.is_spinning()), (state.home, false));
    }

    #[test]
    fn escape_closes_the_help_first() {
        let mut state = state();
        assert_eq!(state.apply(Input::Help), Outcome::Changed);
        assert_eq!(state.apply(Input::Escape), Outcome::Changed);
        assert!(!state.help);
        assert_eq!(state.apply(Input::Escape), Outcome::Quit);
        assert_eq!(state.apply(Input::Quit), Outcome::Quit);
    }
}
