//! What is shown over a picture, or in its place.

use crate::compare::Comparison;

/// What `--show` asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlay {
    /// Tiers held against each other, in place of the picture.
    Tiers(Comparison),
    /// What every tier takes and gets wrong, over it.
    Table,
}

impl Overlay {
    /// The comparison of tiers, if it is one.
    #[must_use]
    pub fn comparison(self) -> Option<Comparison> {
        match self {
            Self::Tiers(comparison) => Some(comparison),
            Self::Table => None,
        }
    }
}
