//! The box of some spheres, and the box of their centres.

use super::join::Join;
use crate::numeric::rounding::{U, least, most};

/// More spheres than these are counted by halves, which two threads can do.
const WORTH_A_THREAD: usize = 16_384;

/// The box of some spheres, and the box of their centres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
    pub(super) least: [f32; 3],
    pub(super) most: [f32; 3],
    /// The smallest and the largest radius.
    pub(super) sizes: [f32; 2],
}

/// Half the surface of a box: what the chance to meet it is proportional to.
#[inline(always)]
pub(super) fn half_area(low: [f32; 3], high: [f32; 3]) -> f32 {
    let [x, y, z] = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
    x * y + y * z + z * x
}

impl Bounds {
    /// Of spheres, by halves where they are many; the box is rounded outward.
    pub(super) fn of(join: &impl Join, spheres: &[[f32; 4]]) -> Self {
        let Some([first, second]) = halves(spheres) else { return Self::here(spheres) };
        let (mut both, second) = join.join(|| Self::of(join, first), || Self::of(join, second));
        for axis in 0..3 {
            both.low[axis] = least(both.low[axis], second.low[axis]);
            both.high[axis] = most(both.high[axis], second.high[axis]);
            both.least[axis] = least(both.least[axis], second.least[axis]);
            both.most[axis] = most(both.most[axis], second.most[axis]);
        }
        both.sizes = [least(both.sizes[0], second.sizes[0]), most(both.sizes[1], second.sizes[1])];
        both
    }

    fn here(spheres: &[[f32; 4]]) -> Self {
        // The fourth number is there to fill a register.
        let (mut low, mut high) = ([f32::INFINITY; 4], [f32::NEG_INFINITY; 4]);
        let (mut left, mut right) = (low, high);
        for sphere in spheres {
            let radius = sphere[3];
            for axis in 0..4 {
                low[axis] = least(low[axis], sphere[axis] - radius);
                high[axis] = most(high[axis], sphere[axis] + radius);
                left[axis] = least(left[axis], sphere[axis]);
                right[axis] = most(right[axis], sphere[axis]);
            }
        }
        let [[x, y, z, _], [far_x, far_y, far_z, _]] = [low, high];
        let [[a, b, c, small], [d, e, f, large]] = [left, right];
        Self {
            // Rounding to nearest is monotonic: one step covers all.
            low: [x.next_down(), y.next_down(), z.next_down()],
            high: [far_x.next_up(), far_y.next_up(), far_z.next_up()],
            least: [a, b, c],
            most: [d, e, f],
            sizes: [small, large],
        }
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

/// Two halves of what is worth a thread.
pub(super) fn halves(spheres: &[[f32; 4]]) -> Option<[&[[f32; 4]]; 2]> {
    (spheres.len() > WORTH_A_THREAD).then(|| spheres.split_at(spheres.len() / 2).into())
}
