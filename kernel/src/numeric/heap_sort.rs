//! Sorts whole numbers in place, without a reachable panic.
//!
//! The standard library's sorts panic where an order contradicts itself, and not every compiler sees that the order of
//! numbers never does. Source: Williams, Algorithm 232: Heapsort (1964).

/// Sorts `numbers`. Cost: n log n steps, whatever their order.
pub(crate) fn heap_sort(numbers: &mut [u32]) {
    for root in (0..numbers.len() / 2).rev() {
        sink(numbers, root);
    }
    let mut heap = numbers;
    while let [first, .., last] = heap {
        core::mem::swap(first, last);
        let Some((_, rest)) = heap.split_last_mut() else { break };
        heap = rest;
        sink(heap, 0);
    }
}

/// Moves a number down a heap, the largest on top, until none below it is larger.
fn sink(heap: &mut [u32], mut at: usize) {
    while let Some(&left) = heap.get(2 * at + 1) {
        let right = heap.get(2 * at + 2).copied();
        let is_right = right.is_some_and(|right| left < right);
        let (child, larger) = (2 * at + 1 + usize::from(is_right), right.unwrap_or(left).max(left));
        let Some(&number) = heap.get(at) else { return };
        if larger <= number {
            return;
        }
        for (place, number) in [(at, larger), (child, number)] {
            if let Some(place) = heap.get_mut(place) {
                *place = number;
            }
        }
        at = child;
    }
}

#[cfg(all(test, proofs))]
mod tests {
    extern crate std;

    use super::heap_sort;
    use crate::proofs::climb::Random;
    use std::vec::Vec;

    #[test]
    fn numbers_are_in_their_order() {
        let mut random = Random(71);
        for most in [1, 3, u64::from(u32::MAX)] {
            for count in (0..40).chain([255, 1000]) {
                let mut numbers: Vec<_> = (0..count).map(|_| random.below(most) as u32).collect();
                let mut expected = numbers.clone();
                expected.sort_unstable();
                heap_sort(&mut numbers);
                assert_eq!(numbers, expected);
            }
        }
    }
}
