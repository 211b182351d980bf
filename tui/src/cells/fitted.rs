//! The result of fitting a glyph, and what fitters share.

use super::columns::Columns;
use super::layers::Layers;
use super::masks::{Cover, Mask};
use spherule_kernel::Vec3;

/// A glyph, and linear light for what it fills, for what it leaves, and for the 2 x 4 parts of the cell as they were
/// sampled.
#[derive(Clone, Copy, Debug)]
pub struct Fitted {
    /// The character.
    pub glyph: char,
    /// What it fills of each part.
    pub cover: Cover,
    /// The light of what it fills.
    pub ink: Vec3,
    /// The light of what it leaves.
    pub paper: Vec3,
    /// The light of the parts.
    pub parts: [Vec3; 8],
    /// In motion: what is shown of the parts less what was sampled, as it [looks](super::change).
    pub excess: [Vec3; 8],
}

impl Fitted {
    /// A black space.
    pub const NONE: Self = Self {
        glyph: ' ',
        cover: Mask::SPACE.cover,
        ink: Vec3::ZERO,
        paper: Vec3::ZERO,
        parts: [Vec3::ZERO; 8],
        excess: [Vec3::ZERO; 8],
    };

    /// An upper half, as tests have it.
    #[cfg(test)]
    pub(super) const UPPER: Self =
        Self { glyph: '▀', cover: [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0], ..Self::NONE };

    /// How much of the cell the glyph covers.
    #[must_use]
    pub fn share(&self) -> f32 {
        self.cover.iter().sum::<f32>() / 8.0
    }
}

/// Puts `next` where it belongs among the `best`, the greatest first; the least drops out.
pub(super) fn rank<T>(best: &mut [(f32, T)], mut next: (f32, T)) {
    for place in best {
        if next.0 > place.0 {
            std::mem::swap(place, &mut next);
        }
    }
}

/// The memory of fits: contents do not matter.
#[derive(Clone, Debug, Default)]
pub struct FitMemory {
    pub(super) light: Columns,
    pub(super) looks: Columns,
    pub(super) layers: Layers,
}
