//! The box of some spheres, and the box of their centres.

use super::join::Join;
use crate::numeric::axes::axes;
use crate::numeric::rounding::U;
use wide::f32x4;

/// The bounds of more spheres than this are computed by halves, which two threads can do.
const WORTH_A_THREAD: usize = 16_384;

/// The corners of a box. The fourth lane fills a register; of a box of centres it is the radius.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners {
    pub(super) low: f32x4,
    pub(super) high: f32x4,
}

impl Corners {
    /// The box of nothing.
    pub(super) const EMPTY: Self =
        Self { low: f32x4::new([f32::INFINITY; 4]), high: f32x4::new([f32::NEG_INFINITY; 4]) };

    /// The box of a sphere, which is given as centre and radius.
    #[inline(always)]
    pub(super) fn of(sphere: [f32; 4]) -> Self {
        let (center, radius) = (f32x4::new(sphere), f32x4::splat(sphere[3]));
        Self { low: center - radius, high: center + radius }
    }

    /// The corners of a box of spheres as it was computed, rounded outward.
    pub(super) fn outward(&self) -> [[f32; 3]; 2] {
        let (low, high) = (self.low.to_array(), self.high.to_array());
        // Rounding to nearest is monotonic: one step covers all.
        [axes!(i => low[i].next_down()), axes!(i => high[i].next_up())]
    }

    /// Whether this is the box of nothing.
    #[inline(always)]
    pub(super) fn is_empty(&self) -> bool {
        self.low.to_array()[0] > self.high.to_array()[0]
    }

    /// Grows to hold another box, too.
    #[inline(always)]
    pub(super) fn hold(&mut self, other: Self) {
        self.low = self.low.fast_min(other.low);
        self.high = self.high.fast_max(other.high);
    }
}

/// The box of some spheres, rounded outward, and the box of their centres and radii.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
    pub(super) centers: Corners,
}

/// A node's box is padded by this share of its largest coordinate.
pub(crate) const PAD: f32 = 40.0 * U;

/// The corners of a box that is rounded outward, as nodes have them: farther out by that part of the margins
/// that is in proportion to the box itself (`docs/traversal-margins.md`).
pub(crate) fn padded(low: [f32; 3], high: [f32; 3]) -> [[f32; 3]; 2] {
    let mut largest = 0.0_f32;
    for axis in 0..3 {
        largest = largest.max(low[axis].abs()).max(high[axis].abs());
    }
    let pad = PAD * largest;
    let low = low.map(|coordinate| (coordinate - pad).next_down());
    [low, high.map(|coordinate| (coordinate + pad).next_up())]
}

impl Bounds {
    /// The bounds of spheres, by halves where they are many.
    pub(super) fn of(join: &impl Join, spheres: &[[f32; 4]]) -> Self {
        let [spheres, centers] = corners_of(join, spheres);
        Self::new(&spheres, &centers)
    }

    /// Bounds from the box of spheres, as it was computed, and that of their centres.
    pub(super) fn new(spheres: &Corners, centers: &Corners) -> Self {
        let [low, high] = spheres.outward();
        Self { low, high, centers: *centers }
    }

    /// The lower and the upper corner as nodes have them.
    pub(super) fn padded(&self) -> [[f32; 3]; 2] {
        padded(self.low, self.high)
    }

    /// Half the surface of the box: the chance to meet the box is proportional to it.
    pub(super) fn half_area(&self) -> f32 {
        let [x, y, z] = axes!(i => self.high[i] - self.low[i]);
        x * y + y * z + z * x
    }

    /// The axis along which the centres lie farthest apart; 3, for the radius, where they do not.
    pub(super) fn longest_axis(&self) -> usize {
        let mut axis = 3;
        let mut longest = 0.0;
        let [x, y, z, _] = (self.centers.high - self.centers.low).to_array();
        for (i, length) in [x, y, z].into_iter().enumerate() {
            if length > longest {
                (axis, longest) = (i, length);
            }
        }
        axis
    }
}

/// The box of spheres, and that of their centres and radii.
fn corners_of(join: &impl Join, spheres: &[[f32; 4]]) -> [Corners; 2] {
    let mut both = [Corners::EMPTY; 2];
    if let Some([first, second]) = halves(spheres) {
        let (one, other) = join.join(|| corners_of(join, first), || corners_of(join, second));
        for half in [one, other] {
            for (held, corners) in both.iter_mut().zip(half) {
                held.hold(corners);
            }
        }
        return both;
    }
    for sphere in spheres {
        let center = f32x4::new(*sphere);
        both[0].hold(Corners::of(*sphere));
        both[1].hold(Corners { low: center, high: center });
    }
    both
}

/// The two halves of spheres, if they are worth a thread.
pub(super) fn halves(spheres: &[[f32; 4]]) -> Option<[&[[f32; 4]]; 2]> {
    (spheres.len() > WORTH_A_THREAD).then(|| spheres.split_at(spheres.len() / 2).into())
}
