//! Moving the spheres of a run, in the leaves that they lie in.

use super::sah_split::Run;
use crate::bvh::node::{BvhLeaf, WIDTH};

/// How many slices the keys of a run are sorted into.
const SLICES: usize = 16;

impl Run<'_> {
    /// Moves spheres so that the first `at` have keys no larger than the others; only those of
    /// places `from..to` move.
    ///
    /// The keys, as integers in the order of the numbers, are sorted into sixteen slices, of which
    /// only the one with place `at` is looked at again: four bits a round, eight rounds at most.
    pub(super) fn order_about(&mut self, at: usize, mut from: usize, mut to: usize, axis: usize) {
        while from < at && at < to {
            let (mut low, mut high) = (u32::MAX, 0);
            for place in from..to {
                let key = self.key(place, axis);
                low = low.min(key);
                high = high.max(key);
            }
            let bits = u32::BITS - (high - low).leading_zeros();
            if bits == 0 {
                return;
            }
            let shift = bits.saturating_sub(4);
            let mut counts = [0; SLICES];
            for place in from..to {
                counts[((self.key(place, axis) - low) >> shift) as usize & (SLICES - 1)] += 1;
            }
            let (mut bin, mut before) = (0, from);
            for count in counts {
                if at < before + count {
                    break;
                }
                before += count;
                bin += 1;
            }
            let slice = |leaf: &BvhLeaf, lane: usize| (key_of(leaf, lane, axis) - low) >> shift;
            from = self.gather(from, to, |leaf, lane| slice(leaf, lane) < bin);
            to = self.gather(from, to, |leaf, lane| slice(leaf, lane) == bin);
        }
    }

    fn key(&self, place: usize, axis: usize) -> u32 {
        self.leaves.get(place / WIDTH).map_or(0, |leaf| key_of(leaf, place % WIDTH, axis))
    }

    /// Moves the spheres for which `wanted` holds to the front of places `from..to`; returns
    /// where they end.
    #[inline(always)]
    pub(super) fn gather(
        &mut self,
        mut from: usize,
        mut to: usize,
        wanted: impl Fn(&BvhLeaf, usize) -> bool,
    ) -> usize {
        let holds = |leaves: &[BvhLeaf], place: usize| {
            leaves.get(place / WIDTH).is_some_and(|leaf| wanted(leaf, place % WIDTH))
        };
        loop {
            while from < to && holds(self.leaves, from) {
                from += 1;
            }
            while from < to && !holds(self.leaves, to - 1) {
                to -= 1;
            }
            if from >= to {
                return from;
            }
            self.swap(from, to - 1);
        }
    }

    fn swap(&mut self, one: usize, other: usize) {
        let places = [one / WIDTH, other / WIDTH];
        let [a, b] = [one % WIDTH, other % WIDTH];
        if let Ok([first, second]) = self.leaves.get_disjoint_mut(places) {
            for axis in 0..3 {
                core::mem::swap(&mut first.center[axis][a], &mut second.center[axis][b]);
            }
            core::mem::swap(&mut first.radius[a], &mut second.radius[b]);
            core::mem::swap(&mut first.index[a], &mut second.index[b]);
        } else if let Some(leaf) = self.leaves.get_mut(places[0]) {
            for axis in 0..3 {
                leaf.center[axis].swap(a, b);
            }
            leaf.radius.swap(a, b);
            leaf.index.swap(a, b);
        }
    }
}

/// A centre, or for axis 3 the radius, as an integer in the order of the numbers.
#[inline(always)]
fn key_of(leaf: &BvhLeaf, lane: usize, axis: usize) -> u32 {
    let bits = leaf.center.get(axis).unwrap_or(&leaf.radius)[lane % WIDTH].to_bits();
    if bits >> 31 == 1 { !bits } else { bits | 1 << 31 }
}
