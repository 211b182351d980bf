//! Spheres in the order of their depth, column by column, as groups of rays go through them.

use super::pencil::Pencil;
use crate::axes::axes;
use crate::{Accuracy, LaneMask, Lanes};

/// x, y, z, reach, depth, index.
pub(super) const COLUMNS: usize = 6;
/// How many spheres are looked at together.
pub(super) const BLOCK: usize = 16;

/// Words of a column of `count` spheres: a block more, so that lanes can be laid down anywhere in it
/// and the end can be marked.
pub(super) const fn column_length(count: usize) -> usize {
    (count / BLOCK).saturating_add(2).saturating_mul(BLOCK)
}

/// The columns of `memory`, each of `length` words; empty where there is no room.
pub(super) fn columns(memory: &mut [u32], length: usize) -> [&mut [u32]; COLUMNS] {
    let mut chunks = memory.chunks_exact_mut(length.max(1));
    [(); COLUMNS].map(
        #[inline(always)]
        |()| chunks.next().unwrap_or_default(),
    )
}

/// Spheres in the order of their depth. All but the index are the bits of numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct List<'a> {
    /// The centre, from where the viewpoint is.
    pub(super) center: [&'a [u32]; 3],
    /// The radius, raised by the margin; `-inf` where there is no sphere.
    pub(super) reach: &'a [u32],
    /// No ray meets the sphere at a lesser depth; `+inf` where there is no sphere.
    pub(super) depth: &'a [u32],
    /// The index in the list of spheres.
    pub(super) index: &'a [u32],
    pub(super) count: usize,
}

/// Spheres `at ..` of a list, one a lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct ListLanes<L> {
    pub(super) center: [L; 3],
    pub(super) reach: L,
    pub(super) depth: L,
}

/// One sphere of a list.
#[derive(Clone, Copy, Debug)]
pub(super) struct Listed {
    pub(super) center: [f32; 3],
    pub(super) reach: f32,
    pub(super) depth: f32,
    pub(super) index: u32,
}

impl Listed {
    /// What nothing meets.
    pub(super) const NONE: Self =
        Self { center: [0.0; 3], reach: f32::NEG_INFINITY, depth: f32::INFINITY, index: 0 };
}

impl<'a> List<'a> {
    pub(super) fn new(columns: [&'a mut [u32]; COLUMNS], count: usize) -> Self {
        let [x, y, z, reach, depth, index] = columns;
        Self { center: [x, y, z], reach, depth, index, count }
    }

    /// Spheres `at ..`, their centres' coordinates in the order of `axes`.
    #[inline(always)]
    pub(super) fn lanes<L: Lanes>(
        &self,
        token: L::Token,
        at: usize,
        axes: [usize; 3],
    ) -> ListLanes<L> {
        ListLanes {
            center: axes!(i => load(token, self.center[axes[i] % 3], at)),
            reach: load(token, self.reach, at),
            depth: load(token, self.depth, at),
        }
    }

    #[inline(always)]
    pub(super) fn get(&self, at: usize) -> Option<Listed> {
        let center = axes!(i => f32::from_bits(*self.center[i].get(at)?));
        let reach = f32::from_bits(*self.reach.get(at)?);
        Some(Listed { center, reach, depth: self.depth(at)?, index: *self.index.get(at)? })
    }

    #[inline(always)]
    pub(super) fn depth(&self, at: usize) -> Option<f32> {
        Some(f32::from_bits(*self.depth.get(at)?))
    }

    /// What of the list may be met by rays in `pencil`, in the same order; nothing where it has no
    /// room in `memory`.
    #[inline(always)]
    pub(super) fn inside<'b, A: Accuracy, L: Lanes>(
        &self,
        token: L::Token,
        pencil: &Pencil,
        memory: &'b mut [u32],
    ) -> Option<List<'b>> {
        let mut columns = columns(memory, memory.len() / COLUMNS);
        let mut count = 0;
        for at in (0..self.count).step_by(L::COUNT) {
            // All that follows begins deeper.
            if self.depth(at)? > pencil.end {
                break;
            }
            let inside = pencil.may_meet::<A, L>(&self.lanes::<L>(token, at, pencil.axes));
            if inside.any() {
                let [x, y, z] = self.center;
                for (column, words) in
                    columns.iter_mut().zip([x, y, z, self.reach, self.depth, self.index])
                {
                    put(column, count, load::<L>(token, words, at).compress(inside))?;
                }
                count += inside.bits().count_ones() as usize;
            }
        }
        let none = [0.0, 0.0, 0.0, f32::NEG_INFINITY, f32::INFINITY, 0.0];
        for (column, value) in columns.iter_mut().zip(none) {
            column.get_mut(count..count + BLOCK)?.fill(value.to_bits());
        }
        Some(List::new(columns, count))
    }
}

/// Lanes from the words from `at` on.
#[inline(always)]
fn load<L: Lanes>(token: L::Token, words: &[u32], at: usize) -> L {
    let mut array = L::Array::default();
    if let Some(words) = words.get(at..at + L::COUNT) {
        for (element, word) in array.as_mut().iter_mut().zip(words) {
            *element = f32::from_bits(*word);
        }
    }
    L::load(token, &array)
}

/// Lanes into the words from `at` on; nothing where there is no room.
#[inline(always)]
fn put<L: Lanes>(words: &mut [u32], at: usize, lanes: L) -> Option<()> {
    let array = lanes.store();
    for (word, element) in words.get_mut(at..at + L::COUNT)?.iter_mut().zip(array.as_ref()) {
        *word = element.to_bits();
    }
    Some(())
}
