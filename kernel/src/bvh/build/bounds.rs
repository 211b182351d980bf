//! The box of some spheres, and the box of their centres.

use super::join::Join;
use crate::bvh::node::{BvhLeaf, WIDTH};
use crate::numeric::rounding::{U, least, most};

/// More leaves than these are counted by halves, which two threads can do.
const WORTH_A_THREAD: usize = 1024;

/// The box of some spheres, and the box of their centres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
    pub(super) least: [f32; 3],
    pub(super) most: [f32; 3],
}

/// Half the surface of a box: what the chance to meet it is proportional to.
#[inline(always)]
pub(super) fn half_area(low: [f32; 3], high: [f32; 3]) -> f32 {
    let [x, y, z] = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
    x * y + y * z + z * x
}

impl Bounds {
    pub(super) const NONE: Self = Self {
        low: [f32::INFINITY; 3],
        high: [f32::NEG_INFINITY; 3],
        least: [f32::INFINITY; 3],
        most: [f32::NEG_INFINITY; 3],
    };

    /// Of `leaves` that hold `count` spheres, by halves where they are many; the box is rounded
    /// outward.
    pub(super) fn of(join: &impl Join, leaves: &[BvhLeaf], count: usize) -> Self {
        let Some((first, second)) = halves(leaves) else { return Self::here(leaves, count) };
        let inside = first.len() * WIDTH;
        let (first, second) =
            join.join(|| Self::of(join, first, inside), || Self::of(join, second, count - inside));
        let mut both = first;
        for axis in 0..3 {
            both.low[axis] = least(both.low[axis], second.low[axis]);
            both.high[axis] = most(both.high[axis], second.high[axis]);
            both.least[axis] = least(both.least[axis], second.least[axis]);
            both.most[axis] = most(both.most[axis], second.most[axis]);
        }
        both
    }

    fn here(leaves: &[BvhLeaf], count: usize) -> Self {
        let mut bounds = Self::NONE;
        let (full, rest) = leaves.split_at(leaves.len().min(count / WIDTH));
        for axis in 0..3 {
            let mut low = [f32::INFINITY; WIDTH];
            let mut high = [f32::NEG_INFINITY; WIDTH];
            let (mut left, mut right) = (low, high);
            for leaf in full {
                let center = &leaf.center[axis];
                for lane in 0..WIDTH {
                    low[lane] = least(low[lane], center[lane] - leaf.radius[lane]);
                    high[lane] = most(high[lane], center[lane] + leaf.radius[lane]);
                    left[lane] = least(left[lane], center[lane]);
                    right[lane] = most(right[lane], center[lane]);
                }
            }
            if let Some(leaf) = rest.first() {
                for lane in 0..count % WIDTH {
                    let center = leaf.center[axis][lane];
                    low[lane] = least(low[lane], center - leaf.radius[lane]);
                    high[lane] = most(high[lane], center + leaf.radius[lane]);
                    left[lane] = least(left[lane], center);
                    right[lane] = most(right[lane], center);
                }
            }
            // Rounding to nearest is monotonic: one step covers all.
            bounds.low[axis] = low.into_iter().fold(f32::INFINITY, least).next_down();
            bounds.high[axis] = high.into_iter().fold(f32::NEG_INFINITY, most).next_up();
            bounds.least[axis] = left.into_iter().fold(f32::INFINITY, least);
            bounds.most[axis] = right.into_iter().fold(f32::NEG_INFINITY, most);
        }
        bounds
    }

    /// The lower and the upper corner as nodes have them: farther out by what of the margins is in
    /// proportion to the box itself (`docs/traversal-margins.md`).
    pub(super) fn padded(&self) -> [[f32; 3]; 2] {
        let mut largest = 0.0_f32;
        for axis in 0..3 {
            largest = largest.max(self.low[axis].abs()).max(self.high[axis].abs());
        }
        let pad = 40.0 * U * largest;
        let low = self.low.map(|coordinate| (coordinate - pad).next_down());
        [low, self.high.map(|coordinate| (coordinate + pad).next_up())]
    }

    pub(super) fn half_area(&self) -> f32 {
        half_area(self.low, self.high)
    }

    /// The axis along which the centres lie farthest apart; 3, for the radius, where they do not.
    pub(super) fn longest_axis(&self) -> usize {
        let mut axis = 3;
        let mut longest = 0.0;
        for i in 0..3 {
            let length = self.most[i] - self.least[i];
            if length > longest {
                (axis, longest) = (i, length);
            }
        }
        axis
    }
}

/// Two halves, the first of full leaves, of what is worth a thread.
pub(super) fn halves(leaves: &[BvhLeaf]) -> Option<(&[BvhLeaf], &[BvhLeaf])> {
    (leaves.len() > WORTH_A_THREAD).then(|| leaves.split_at(leaves.len() / 2))
}
