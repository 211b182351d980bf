//! Spheres that are tested one after the other.

use super::sphere::{Sphere, Spheres};

/// Spheres of a list that are tested one after the other, by rising index: all, or some of them.
pub(crate) trait SphereRun {
    /// The list that the spheres are of.
    fn list(&self) -> Spheres<'_>;
    /// How many spheres.
    fn count(&self) -> usize;
    /// The index of sphere `number`; the index that stands for no sphere if there is none.
    fn index(&self, number: usize) -> u32;

    /// Sphere `number`; `None` where there is none.
    #[inline(always)]
    fn sphere(&self, number: usize) -> Option<Sphere> {
        self.list().get(self.index(number) as usize)
    }
}

impl SphereRun for Spheres<'_> {
    #[inline(always)]
    fn list(&self) -> Spheres<'_> {
        *self
    }

    #[inline(always)]
    fn count(&self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn index(&self, number: usize) -> u32 {
        number as u32
    }
}
