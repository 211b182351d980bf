//! Copies of spheres for which no lane is free, while leaves are laid down.
//!
//! A copy waits with its own index and that of the sphere it is the same as. The copies lie where the last spheres were
//! read, right in front of the next. As reading goes on, they move along; at the end they are the last of the memory. So
//! the leaves in front of them have all the other room.

use crate::bvh::unplaced::Unplaced;

/// How many wait, in front of what is read next.
pub(super) struct Dropped {
    pub(super) count: usize,
    /// The end of what was read.
    read: usize,
    /// The lowest index of the leaf that was read last.
    last: u32,
}

impl Dropped {
    /// No copies, before anything is read; the spheres begin at `first`.
    pub(super) const fn none(first: usize) -> Self {
        Self { count: 0, read: first, last: 0 }
    }

    /// Reading goes on at `begin`: the spheres left out before it are copies of the first of the leaf that was read last.
    pub(super) fn leave_out(&mut self, places: &mut [[f32; 4]], indices: &[u32], begin: usize) {
        let run = self.read..begin.max(self.read);
        let places = places.get_mut(run.clone()).unwrap_or_default();
        let indices = indices.get(run.clone()).unwrap_or_default();
        for (place, index) in places.iter_mut().zip(indices) {
            *place = waiting(*index, self.last);
        }
        (self.count, self.read) = (self.count + run.len(), run.end);
    }

    /// Takes the `copies` of a leaf that was read up to `end`; `first` is the lowest index of the leaf. Copies that waited
    /// before, the first of them, move to where the leaf was read, as many as must.
    pub(super) fn read_leaf(
        &mut self,
        places: &mut [[f32; 4]],
        (end, first): (usize, u32),
        copies: &[Unplaced],
    ) {
        let to = end.saturating_sub(copies.len());
        let moved = self.count.min(to.saturating_sub(self.read));
        let from = self.read.saturating_sub(self.count);
        for number in 0..moved {
            if let Some(place) = places.get(from + number).copied()
                && let Some(to) = places.get_mut((to + number).saturating_sub(moved))
            {
                *to = place;
            }
        }
        for (place, copy) in places.iter_mut().skip(to).zip(copies) {
            *place = waiting(copy.index, copy.same);
        }
        (self.count, self.read, self.last) = (self.count + copies.len(), end, first);
    }

    /// Writes the copies, which wait in the last of `all` places, to a table that begins before them, at `table`.
    pub(super) fn collect(&self, numbers: &mut [f32], all: usize, table: usize) {
        let from = 4 * all.saturating_sub(self.count);
        for number in 0..self.count {
            for part in 0..2 {
                if let Some(bits) = numbers.get(from + 4 * number + part).copied()
                    && let Some(to) = numbers.get_mut(table + 2 * number + part)
                {
                    *to = bits;
                }
            }
        }
    }
}

/// A copy, as it waits where a sphere was.
const fn waiting(index: u32, same: u32) -> [f32; 4] {
    let [index, same] = Unplaced { index, same }.bits();
    [index, same, 0.0, 0.0]
}
