//! What the viewer shows and how it moves. It has no terminal and no clock: input and durations come in.

use super::hand::Hand;
use super::keys::Input;
use super::picking::Cursor;
use super::seam::Seam;
use super::shown::{Outcome, Shown};
use crate::choice::{Auto, next};
use crate::compare::Comparison;
use crate::machine::check_floats;
use crate::scene::framing::reframed;
use crate::structure::Structure;
use crate::style::{Charset, ColorDepth, Style};
use crate::view::{LensKind, View, orbited, panned, with_projection, zoomed};
use spherule_kernel::{Sphere, Tier};
use std::f32::consts::PI;
use std::time::Duration;

/// How far a key turns the eye around the target, in radians: 5 degrees.
pub const ORBIT_STEP: f32 = PI / 36.0;
/// By what factor a key or a notch of the wheel enlarges.
pub const ZOOM_STEP: f32 = 1.1;
/// How far a key moves eye and target along the picture, as a share of the picture's height at the target.
pub const PAN_STEP: f64 = 0.05;
/// Radians a second: around in 12 seconds.
const SPIN: f32 = PI / 6.0;
/// After a suspension or on a slow link the spin goes on; it does not catch up.
const LONGEST_STEP: Duration = Duration::from_millis(100);

/// What the viewer shows first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// From where it is seen.
    pub view: View,
    /// How it is drawn.
    pub style: Style,
    /// Which structure is asked for.
    pub structure: Auto<Structure>,
    /// Which comparison of tiers is shown, if any.
    pub comparison: Option<Comparison>,
    /// Whether there is a table of what every tier takes and gets wrong.
    pub table: bool,
    /// Whether the picture shows what its colours mean.
    pub legend: bool,
}

/// The state between frames.
#[derive(Clone, Debug)]
pub(super) struct State {
    home: View,
    /// The characters at the start.
    pub(super) first_charset: Charset,
    pub(super) shown: Shown,
    hand: Hand,
    /// Whether the mouse drags the seam.
    pulls_seam: bool,
    pub(super) recording: bool,
    /// Columns and rows of the picture: a drag over all rows is half a turn.
    size: (u16, u16),
    /// How many things there are to colour by.
    colorings: usize,
}

impl State {
    /// The state at the start; there are `colorings` things to colour by, and `coloring` is the first.
    pub(super) fn new(start: Start, (coloring, colorings): (usize, usize)) -> Self {
        let Start { view, style, structure, comparison, table, legend } = start;
        let shown = Shown {
            view,
            style,
            structure,
            comparison,
            seam: Seam::default(),
            help: false,
            coloring,
            legend,
            spinning: false,
            table,
            cursor: None,
        };
        Self {
            home: view,
            first_charset: style.charset,
            shown,
            hand: Hand::default(),
            pulls_seam: false,
            recording: false,
            size: (1, 1),
            colorings,
        }
    }

    /// Tells the size of the picture.
    pub(super) fn set_size(&mut self, columns: u16, rows: u16) {
        self.size = (columns.max(1), rows.max(1));
        self.shown.cursor = self.shown.cursor.map(|cursor| cursor.within(self.size));
    }

    /// Tells how many colours there are.
    pub(super) fn set_depth(&mut self, depth: ColorDepth) -> Outcome {
        let before = self.shown;
        self.shown.style.depth = depth;
        self.since(&before)
    }

    /// Tells how many things there are to colour by.
    pub(super) fn set_colorings(&mut self, colorings: usize) {
        self.colorings = colorings;
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
        self.shown.seam.column(self.size.0)
    }

    fn is_split(&self) -> bool {
        matches!(self.shown.comparison, Some(Comparison::Split(_)))
    }

    fn step_seam(&mut self, right: i8) {
        if self.is_split() {
            let column = i32::from(self.seam()) + i32::from(right);
            self.shown.seam = Seam::at(column, self.size.0);
        }
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
        let shown = &mut self.shown;
        match input {
            Input::Quit => return Outcome::Quit,
            Input::Escape if shown.help => shown.help = false,
            Input::Escape if shown.table => shown.table = false,
            Input::Escape if shown.cursor.is_some() => shown.cursor = None,
            Input::Escape => return Outcome::Quit,
            Input::Grab(column, row) | Input::GrabPlane(column, row) => {
                self.hand.grab((column, row));
                self.pulls_seam =
                    matches!(input, Input::Grab(..)) && self.is_split() && column == self.seam();
            }
            Input::Drag(column, row) if self.pulls_seam => {
                // The hand is led, so that its release is no click.
                self.hand.led_to((column, row));
                self.shown.seam = Seam::at(column.into(), self.size.0);
            }
            Input::Seam(right) => self.step_seam(right),
            Input::Drag(column, row) => self.drag_to(column, row),
            Input::DragPlane(column, row) => self.pull_to(column, row),
            Input::Release(column, row) => self.release(column, row),
            Input::Pick if shown.cursor.is_some() => shown.cursor = None,
            Input::Pick => self.pick(Cursor::middle(self.size)),
            Input::Orbit(right, up) if shown.cursor.is_some() => {
                shown.cursor = shown.cursor.map(|cursor| cursor.moved(right, up, self.size));
            }
            Input::Orbit(right, up) => {
                let step = |count| f32::from(count) * ORBIT_STEP;
                shown.view = orbited(&shown.view, step(right), step(up));
            }
            Input::Pan(right, up) => {
                let step = PAN_STEP * f64::from(shown.view.height_at_target());
                shown.view = panned(&shown.view, f64::from(right) * step, f64::from(up) * step);
            }
            Input::Zoom(steps) => shown.view = zoomed(&shown.view, ZOOM_STEP.powi(steps.into())),
            // A key that asks for what this process cannot compute does nothing.
            Input::Accuracy(tier) if check_floats(tier).is_err() => {}
            Input::Accuracy(tier) => {
                shown.style.accuracy = tier;
                // The left half is the one to choose.
                if let Some(Comparison::Split([left, _])) = &mut shown.comparison {
                    *left = tier;
                }
            }
            // The truth is what exact says.
            Input::Errors | Input::Split | Input::Table if check_floats(Tier::Exact).is_err() => {}
            Input::Errors => {
                shown.comparison = match shown.comparison {
                    Some(Comparison::Errors) => None,
                    _ => Some(Comparison::Errors),
                }
            }
            Input::Split => {
                shown.comparison = match (shown.comparison, shown.style.accuracy) {
                    (Some(Comparison::Split(_)), _) => None,
                    // `Exact` has no visible error: compare `Fast` with it.
                    (_, Tier::Exact) => Some(Comparison::Split([Tier::Fast, Tier::Exact])),
                    (_, tier) => Some(Comparison::Split([tier, Tier::Exact])),
                }
            }
            Input::Table => (shown.table, shown.cursor) = (!shown.table, None),
            Input::Projection => {
                let other = match shown.view.lens_kind() {
                    LensKind::Perspective => LensKind::Parallel,
                    LensKind::Parallel => LensKind::Perspective,
                };
                shown.view = with_projection(&shown.view, other);
            }
            Input::Charset => {
                shown.style.charset = next(Some(shown.style.charset)).unwrap_or(Charset::Ascii);
            }
            Input::Occlusion => shown.style.aids.occlusion = !shown.style.aids.occlusion,
            Input::Edges => shown.style.aids.edges = !shown.style.aids.edges,
            Input::DepthCue => shown.style.aids.depth_cue = !shown.style.aids.depth_cue,
            Input::Coloring => shown.coloring = (shown.coloring + 1) % self.colorings.max(1),
            Input::Legend => shown.legend = !shown.legend,
            Input::Structure => shown.structure = next(shown.structure),
            Input::Spin => shown.spinning = !shown.spinning,
            Input::Reset => (shown.view, shown.spinning) = (self.home, false),
            Input::Help => shown.help = !shown.help,
            // These concern the terminal or need the scene.
            Input::Suspend
            | Input::Resize
            | Input::Step(_)
            | Input::FrameAll
            | Input::FramePicked
            | Input::CommandLine
            | Input::Record => {}
        }
        self.since(&before)
    }

    fn since(&self, before: &Shown) -> Outcome {
        if self.shown == *before { Outcome::Unchanged } else { Outcome::Changed }
    }

    /// A pick asks every tier, so where `Exact` cannot be had there is none. What it tells replaces the table.
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
            // Even a turn by nothing would round the eye.
            return;
        }
        let right = right * self.shown.style.cell_aspect;
        self.shown.view = orbited(&self.shown.view, -right * a_row, down * a_row);
    }

    /// What is under the hand, at the target's distance, stays there.
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
mod tests;
