//! Spheres of a list that have no lane in a leaf of its tree, written down so that a refit finds them.
//!
//! They are not valid, or no bound sees them, or they are copies of a sphere in the tree for which no lane was free. Each
//! takes two numbers, as bits, behind the leaves: its index, and the index of the sphere that it is a copy of, or its own
//! if it is no copy. Numbers with these bits are small, since indices are below 2^27: nothing changes them on their way.

use crate::geometry::sphere::Spheres;
use crate::scale::scene::SceneScale;

/// A sphere that has no lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unplaced {
    pub(crate) index: u32,
    /// The index of the sphere that it was the same as when the tree was built: a lower one, or its own.
    pub(crate) same: u32,
}

impl Unplaced {
    /// As it lies in memory.
    pub(crate) const fn bits(self) -> [f32; 2] {
        [f32::from_bits(self.index), f32::from_bits(self.same)]
    }

    pub(crate) const fn from_bits([index, same]: [f32; 2]) -> Self {
        Self { index: index.to_bits(), same: same.to_bits() }
    }

    /// Whether rays must be tested against it by itself, as it is in this list: it is valid, and no copy now.
    pub(crate) fn is_met(self, spheres: &Spheres<'_>) -> bool {
        let Some(sphere) = spheres.get(self.index as usize) else { return false };
        let is_copy = self.same != self.index && spheres.get(self.same as usize) == Some(sphere);
        sphere.is_valid() && !is_copy
    }

    /// Whether it is valid and no bound sees it, as may be so of spheres in leaves, too.
    pub(crate) fn is_beyond(self, spheres: &Spheres<'_>, scale: &SceneScale) -> bool {
        spheres
            .get(self.index as usize)
            .is_some_and(|sphere| sphere.is_valid() && scale.scaled(&sphere).is_none())
    }
}
