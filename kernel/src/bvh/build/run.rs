//! Spheres of a list while they are put into order: centre and radius, and the index of each.

/// A run of spheres, scaled, with their indices.
#[derive(Default)]
pub(super) struct Run<'a> {
    pub(super) spheres: &'a mut [[f32; 4]],
    pub(super) indices: &'a mut [u32],
}

impl<'a> Run<'a> {
    /// The first `at` spheres, and the others.
    pub(super) fn split_off(self, at: usize) -> (Self, Self) {
        let (first, others) = self.spheres.split_at_mut(at.min(self.spheres.len()));
        let (one, other) = self.indices.split_at_mut(at.min(self.indices.len()));
        (Self { spheres: first, indices: one }, Self { spheres: others, indices: other })
    }

    /// `count` spheres from `first` on.
    pub(super) fn part(&mut self, first: usize, count: usize) -> Run<'_> {
        let spheres = self.spheres.get_mut(first..first + count).unwrap_or_default();
        let indices = self.indices.get_mut(first..first + count).unwrap_or_default();
        Run { spheres, indices }
    }
}
