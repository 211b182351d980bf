//! Sorts whole numbers in place, by any order of theirs, without a reachable panic.
//!
//! The standard library's sorts panic where an order contradicts itself, and not every compiler sees that an order
//! never does. Source: Williams, Algorithm 232: Heapsort (1964).

/// Sorts `numbers`, of which one `is_before` another. Cost: n log n steps, whatever their order; no memory.
pub(crate) fn heap_sort(numbers: &mut [u32], is_before: impl Fn(u32, u32) -> bool) {
    for root in (0..numbers.len() / 2).rev() {
        let Some(&number) = numbers.get(root) else { return };
        sink(numbers, root, number, &is_before);
    }
    let mut rest = numbers;
    while let Some((last, others)) = rest.split_last_mut() {
        if let Some(first) = others.first_mut() {
            core::mem::swap(first, last);
            let number = *first;
            sink(others, 0, number, &is_before);
        }
        rest = others;
    }
}

/// Puts `number` at `root` of a heap, or below what comes after it.
fn sink(heap: &mut [u32], mut root: usize, number: u32, is_before: &impl Fn(u32, u32) -> bool) {
    loop {
        let (left, right) = (heap.get(2 * root + 1), heap.get(2 * root + 2));
        let (below, child) = match (left, right) {
            (Some(&left), Some(&right)) if is_before(left, right) => (2 * root + 2, right),
            (Some(&left), _) => (2 * root + 1, left),
            (None, _) => break,
        };
        if !is_before(number, child) {
            break;
        }
        if let Some(place) = heap.get_mut(root) {
            *place = child;
        }
        root = below;
    }
    if let Some(place) = heap.get_mut(root) {
        *place = number;
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
                heap_sort(&mut numbers, |a, b| a < b);
                assert_eq!(numbers, expected);
            }
        }
    }
}
