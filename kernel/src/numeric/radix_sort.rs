//! Sorts by whole numbers, in the caller's memory.

/// Bits of a key that a round looks at.
const DIGIT: u32 = 8;

/// Sorts `elements` by the lowest `8 * rounds` bits of their keys; equal ones stay in their order. The result is in
/// `elements` after an even number of rounds, in `others` after an odd one; the shorter slice sets how many elements
/// are sorted.
#[inline(always)]
pub(crate) fn radix_sort<T: Copy>(
    elements: &mut [T],
    others: &mut [T],
    rounds: u32,
    key: impl Fn(&T) -> u32,
) {
    let count = elements.len().min(others.len());
    let (Some(mut from), Some(mut to)) = (elements.get_mut(..count), others.get_mut(..count))
    else {
        return;
    };
    for round in 0..rounds {
        let mut places = [0_u32; 1 << DIGIT];
        for element in from.iter() {
            let count = &mut places[digit(key(element), round)];
            *count = count.wrapping_add(1);
        }
        let mut before = 0_u32;
        for place in &mut places {
            (*place, before) = (before, before.wrapping_add(*place));
        }
        for element in from.iter() {
            let place = &mut places[digit(key(element), round)];
            if let Some(to) = to.get_mut(*place as usize) {
                *to = *element;
            }
            *place = place.wrapping_add(1);
        }
        (from, to) = (to, from);
    }
}

#[inline(always)]
const fn digit(key: u32, round: u32) -> usize {
    (key >> (DIGIT * round % u32::BITS)) as usize % (1 << DIGIT)
}

#[cfg(all(test, proofs))]
mod tests {
    extern crate std;

    use super::radix_sort;
    use crate::proofs::climb::Random;
    use std::vec;
    use std::vec::Vec;

    /// Equals the standard library's stable sort by as many bits as the rounds cover.
    #[test]
    fn elements_are_in_the_order_of_their_keys() {
        let mut random = Random(52);
        for rounds in 1..=4 {
            for count in [0, 1, 2, 255, 1000] {
                let mut element =
                    |number| ((random.below(1 << 20) as u32).wrapping_mul(4097), number);
                let mut elements: Vec<_> = (0..count).map(&mut element).collect();
                let mut expected = elements.clone();
                expected.sort_by_key(|(key, _)| key & u32::MAX >> (32 - 8 * rounds));
                let mut others = vec![(0, 0); count];
                radix_sort(&mut elements, &mut others, rounds, |(key, _)| *key);
                assert_eq!(if rounds % 2 == 0 { elements } else { others }, expected);
            }
        }
    }

    /// The longer slice stays as it is past the end of the shorter.
    #[test]
    fn the_shorter_says_how_many_are_sorted() {
        for (count, spare) in [(5, 9), (9, 5), (0, 3), (3, 0)] {
            let mut elements: Vec<u32> = (0..count).rev().map(|number| 300 * number).collect();
            let mut expected = elements.clone();
            expected[..(count.min(spare)) as usize].sort_unstable();
            let mut others = vec![7; spare as usize];
            radix_sort(&mut elements, &mut others, 2, |key| *key);
            assert_eq!(elements, expected);
            assert!(others.iter().skip(count as usize).all(|&other| other == 7));
        }
    }
}
