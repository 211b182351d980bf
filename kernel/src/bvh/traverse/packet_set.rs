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

    /// The packets from place `from` on, by their places from there.
    #[inline(always)]
    pub(crate) fn after(&self, from: usize) -> Self {
        let mut after = Self::EMPTY;
        for place in 0..RUN / 64 {
            let word = |ahead: usize| self.words.get(place + from / 64 + ahead).copied();
            // Shifted twice, since a shift by all bits is none.
            let [low, high] = [word(0).unwrap_or(0), word(1).unwrap_or(0)];
            after.words[place] = low >> (from % 64) | high << (63 - from % 64) << 1;
        }
        after
    }

    /// How many packets.
    #[cfg(any(feature = "alloc", test))]
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        let mut count = 0;
        for word in self.words {
            count += word.count_ones() as usize;
        }
        count
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

#[cfg(all(test, proofs))]
mod tests {
    use super::{PacketSet, RUN};

    #[test]
    fn packets_after_a_place_keep_their_order() {
        let mut set = PacketSet::EMPTY;
        let is_in = |place: usize| place.is_multiple_of(3) || place > 400;
        (0..RUN).filter(|place| is_in(*place)).for_each(|place| set.insert(place));
        for from in [0, 1, 63, 64, 65, 200, 511, 512, 700] {
            let after = set.after(from);
            let expected = |place: usize| from + place < RUN && is_in(from + place);
            assert_eq!(after.count(), (0..RUN).filter(|place| after.contains(*place)).count());
            assert!((0..RUN + 9).all(|place| after.contains(place) == expected(place)), "{from}");
        }
    }
}
