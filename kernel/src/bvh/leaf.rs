//! Leaves: up to sixteen spheres, coordinate by coordinate, in the caller's memory.
//!
//! Leaves lie one behind the other, and take no more room than their spheres do, rounded up to fours. A leaf has
//! first the x of all its spheres, then y, z and the radii. So a leaf of n lanes is 16 n bytes long, and where it
//! begins and how many lanes it has is all that must be known of it. Sixteen numbers are loaded from where a column
//! begins; behind the last lane they are of another column or leaf, and a mask takes them out.

use super::node::{LEAF, WIDTH};
use crate::geometry::sphere_columns::SphereColumns;

/// Leaves begin at multiples of this many places, and their lengths are multiples of it.
pub(crate) const STEP: usize = 4;
/// Places behind the last leaf, so that sixteen numbers can be loaded anywhere.
pub(crate) const BEHIND: usize = STEP;
/// Places before the first, so that leaves can begin where a line of the cache does.
pub(crate) const BEFORE: usize = STEP;
/// Bits of a leaf's number that say where it begins, in steps; the two above are its length, in steps, less one.
const BEGIN_BITS: u32 = 26;
/// How many places leaves can have.
pub(crate) const MOST_PLACES: usize = STEP << BEGIN_BITS;

/// The `child` of a node for a leaf that begins at `begin`, a multiple of four, and has `count` spheres.
pub(crate) const fn leaf_at(begin: usize, count: usize) -> u32 {
    let steps = count.div_ceil(STEP) as u32;
    LEAF | steps.wrapping_sub(1) << BEGIN_BITS | (begin / STEP) as u32
}

/// Where the leaf of a number begins, and how many lanes it has.
#[inline(always)]
pub(crate) const fn extent_of(number: u32) -> (usize, usize) {
    let steps = (number >> BEGIN_BITS & 3) as usize + 1;
    ((number & ((1 << BEGIN_BITS) - 1)) as usize * STEP, steps * STEP)
}

/// The spheres of a leaf, as bounds see them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leaf<'a> {
    pub(crate) columns: SphereColumns<'a>,
    /// A bit for each lane that is of the leaf; a radius is NaN where there is no sphere.
    pub(crate) lanes: u32,
}

impl<'a> Leaf<'a> {
    /// The leaf of a number, in the numbers of all leaves.
    #[inline(always)]
    pub(crate) fn of(numbers: &'a [f32], number: u32) -> Option<Self> {
        let (begin, lanes) = extent_of(number);
        // Columns are in it if the last one is: one comparison, not four.
        let leaf = numbers.get(begin * STEP..begin * STEP + 3 * lanes + WIDTH)?;
        let column = |at: usize| match leaf.get(at..) {
            Some(rest) => rest.first_chunk::<WIDTH>(),
            None => None,
        };
        let (Some(x), Some(y), Some(z), Some(radius)) =
            (column(0), column(lanes), column(2 * lanes), column(3 * lanes))
        else {
            return None;
        };
        let columns = SphereColumns { center: [x, y, z], radius };
        Some(Self { columns, lanes: u32::MAX >> (u32::BITS - lanes as u32) })
    }
}

/// The place of a lane of a leaf, by which a sphere is found again.
#[inline(always)]
pub(crate) const fn place_of(number: u32, lane: u32) -> u32 {
    number * WIDTH as u32 + lane
}

/// The number of the leaf that a place is of, and the lane.
#[inline(always)]
pub(crate) const fn number_of(place: u32) -> (u32, usize) {
    (place / WIDTH as u32, place as usize % WIDTH)
}

#[cfg(all(test, proofs))]
mod tests {
    use super::*;

    #[test]
    fn a_leaf_is_where_its_number_says() {
        for begin in [0, 4, 400, MOST_PLACES - 16] {
            for count in 1..=WIDTH {
                let child = leaf_at(begin, count);
                assert!(child & LEAF != 0);
                let number = child & !LEAF;
                assert_eq!(extent_of(number), (begin, count.next_multiple_of(STEP)));
                for lane in 0..WIDTH as u32 {
                    assert_eq!(number_of(place_of(number, lane)), (number, lane as usize));
                }
            }
        }
    }
}
