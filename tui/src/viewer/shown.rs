//! What is shown, and what an input led to.

use super::picking::Cursor;
use super::seam::Seam;
use crate::choice::Auto;
use crate::compare::Comparison;
use crate::structure::Structure;
use crate::style::Style;
use crate::view::View;

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
    /// The greater of two outcomes.
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
    /// The seam between two tiers.
    pub(super) seam: Seam,
    pub(super) help: bool,
    /// Which of the things to colour by, and whether it is said what colours mean.
    pub(super) coloring: usize,
    pub(super) legend: bool,
    pub(super) spinning: bool,
    /// Whether there is a table of what every tier takes and gets wrong; then no cell is picked.
    pub(super) table: bool,
    /// The cell that is picked.
    pub(super) cursor: Option<Cursor>,
}

impl Shown {
    /// What the picture itself depends on.
    pub(super) fn pictured(&self) -> Self {
        Self { help: false, legend: false, spinning: false, table: false, cursor: None, ..*self }
    }

    /// The same, where keys that are held down and drags have moved `other`.
    pub(super) fn moved_as(&self, other: &Self) -> Self {
        Self { view: other.view, seam: other.seam, ..*self }
    }
}
