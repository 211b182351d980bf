//! Some packets of a run: those that a traversal has yet to answer.

/// The most packets of a run.
pub(crate) const RUN: usize = 512;

/// Packets of a run, by their places in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PacketSet {
    words: [u64; RUN / 64],
}

impl PacketSet {
    pub(crate) const EMPTY: Self = Self { words: [0; RUN / 64] };

    /// Adds a packet; places past the longest run are left out.
    #[inline(always)]
    pub(crate) fn insert(&mut self, place: usize) {
        if let Some(word) = self.words.get_mut(place / 64) {
            *word |= 1 << (place % 64);
        }
    }

    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        *self == Self::EMPTY
    }

    #[inline(always)]
    pub(crate) fn contains(&self, place: usize) -> bool {
        match self.words.get(place / 64) {
            Some(word) => word >> (place % 64) & 1 == 1,
            None => false,
        }
    }
}
