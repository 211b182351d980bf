//! Moving the spheres of a run.

use super::run::Run;

/// How many slices the keys of a run are sorted into.
const SLICES: usize = 16;

impl Run<'_> {
    /// Moves spheres so that the first `at` have keys no larger than the others.
    ///
    /// The keys, as integers in the order of the numbers, are sorted into sixteen slices, of which
    /// only the one with place `at` is looked at again: four bits a round, eight rounds at most.
    pub(super) fn order_about(&mut self, at: usize, axis: usize) {
        let (mut from, mut to) = (0, self.spheres.len());
        while from < at && at < to {
            let (mut low, mut high) = (u32::MAX, 0);
            for sphere in self.spheres.get(from..to).unwrap_or_default() {
                let key = key_of(sphere, axis);
                low = low.min(key);
                high = high.max(key);
            }
            let bits = u32::BITS - high.wrapping_sub(low).leading_zeros();
            if bits == 0 {
                return;
            }
            let shift = bits.saturating_sub(4);
            let slice = |sphere: &[f32; 4]| key_of(sphere, axis).wrapping_sub(low) >> shift;
            let mut counts = [0; SLICES];
            for sphere in self.spheres.get(from..to).unwrap_or_default() {
                counts[slice(sphere) as usize & (SLICES - 1)] += 1;
            }
            let (mut bin, mut before) = (0, from);
            for count in counts {
                if at < before + count {
                    break;
                }
                before += count;
                bin += 1;
            }
            from = self.gather(from, to, |sphere| slice(sphere) < bin);
            to = self.gather(from, to, |sphere| slice(sphere) == bin);
        }
    }

    /// Moves the spheres for which `wanted` holds to the front of `from..to`; returns where they end.
    #[inline(always)]
    pub(super) fn gather(
        &mut self,
        mut from: usize,
        mut to: usize,
        wanted: impl Fn(&[f32; 4]) -> bool,
    ) -> usize {
        loop {
            while from < to && self.spheres.get(from).is_some_and(&wanted) {
                from += 1;
            }
            while from < to && !self.spheres.get(to - 1).is_some_and(&wanted) {
                to -= 1;
            }
            if from >= to {
                return from;
            }
            if let Ok([one, other]) = self.spheres.get_disjoint_mut([from, to - 1]) {
                core::mem::swap(one, other);
            }
            if let Ok([one, other]) = self.indices.get_disjoint_mut([from, to - 1]) {
                core::mem::swap(one, other);
            }
        }
    }
}

/// A coordinate of the centre, or for axis 3 the radius, as an integer in the order of the numbers.
#[inline(always)]
fn key_of(sphere: &[f32; 4], axis: usize) -> u32 {
    let bits = sphere[axis % 4].to_bits();
    if bits >> 31 == 1 { !bits } else { bits | 1 << 31 }
}
