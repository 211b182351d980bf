//! What a fit of a glyph comes to, and what fitters share.

use super::layers::Looks;
use super::masks::{Cover, Mask};
use spherule_kernel::Vec3;

/// The glyph of the frame before stays if it misses so much of what it would have to be better than. (Blocks and
/// sextants, by 0.7: the error of changes is 0.05 to 0.14 of chafa's less than by 1; by 0.4 it is as large, and the picture itself loses.)
pub(super) const KEPT: f32 = 0.7;

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
}

impl Fitted {
    /// Black.
    pub const NONE: Self = Self {
        glyph: ' ',
        cover: Mask::SPACE.cover,
        ink: Vec3::ZERO,
        paper: Vec3::ZERO,
        parts: [Vec3::ZERO; 8],
    };

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
    pub(super) roots: Vec<Vec3>,
    pub(super) looks: Looks,
    pub(super) cover: Vec<f32>,
}
