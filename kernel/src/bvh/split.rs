//! Cutting a run of spheres in two, by the surface area heuristic where that can tell.
//!
//! The spheres lie in the leaves that the tree will have, so that they are moved, not pointed at:
//! every pass reads memory in order, and no other memory is needed. Cuts fall on multiples of
//! sixteen, so a run is a run of leaves.

use super::join::Join;
use super::{BvhLeaf, WIDTH};

/// How many slices a run is sorted into, an axis.
const BINS: usize = 16;

/// More leaves than these are counted by halves, which two threads can do.
const WORTH_A_THREAD: usize = 1024;

/// Up to how many leaves all cuts are compared.
const EVERY_CUT: usize = 32;

/// The box of some spheres, and the box of their centres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
    least: [f32; 3],
    most: [f32; 3],
}

/// A run of leaves, and how many spheres are in them: all leaves are full but the last of all.
pub(super) struct Run<'a> {
    pub(super) leaves: &'a mut [BvhLeaf],
    pub(super) count: usize,
}

#[inline(always)]
fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn most(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// Half the surface of a box: what the chance to meet it is proportional to.
#[inline(always)]
fn half_area(low: [f32; 3], high: [f32; 3]) -> f32 {
    let [x, y, z] = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
    x * y + y * z + z * x
}

impl Bounds {
    const NONE: Self = Self {
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

    pub(super) fn half_area(&self) -> f32 {
        half_area(self.low, self.high)
    }

    /// The axis along which the centres lie farthest apart; 3, for the radius, where they do not.
    fn longest_axis(&self) -> usize {
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

    /// Which slice a centre is in is (centre - least) * scale: zero where an axis tells nothing.
    fn scales(&self) -> [f32; 3] {
        let mut scales = [0.0; 3];
        for (axis, scale) in scales.iter_mut().enumerate() {
            // A hair below sixteen, so that the last centre is in the last slice.
            let slices =
                BINS as f32 * (1.0 - 4.0 * f32::EPSILON) / (self.most[axis] - self.least[axis]);
            if slices < f32::MAX {
                *scale = slices;
            }
        }
        scales
    }
}

#[inline(always)]
fn bin_of(center: f32, least: f32, scale: f32) -> usize {
    ((center - least) * scale) as i32 as usize & (BINS - 1)
}

/// What lies in a slice; the fourth number is there to fill a register.
#[derive(Clone, Copy)]
struct Bin {
    low: [f32; 4],
    high: [f32; 4],
    count: usize,
}

impl Bin {
    const EMPTY: Self = Self { low: [f32::INFINITY; 4], high: [f32::NEG_INFINITY; 4], count: 0 };

    #[inline(always)]
    fn grow(&mut self, low: [f32; 4], high: [f32; 4], count: usize) {
        for i in 0..4 {
            self.low[i] = least(self.low[i], low[i]);
            self.high[i] = most(self.high[i], high[i]);
        }
        self.count += count;
    }

    fn half_area(&self) -> f32 {
        if self.count == 0 {
            return 0.0;
        }
        let [low, high] = [self.low, self.high].map(|[x, y, z, _]| [x, y, z]);
        half_area(low, high)
    }
}

/// Two halves, the first of full leaves, of what is worth a thread.
fn halves(leaves: &[BvhLeaf]) -> Option<(&[BvhLeaf], &[BvhLeaf])> {
    (leaves.len() > WORTH_A_THREAD).then(|| leaves.split_at(leaves.len() / 2))
}

/// Sorts the `count` spheres of `leaves` into slices, by halves where they are many.
fn bins_of(
    join: &impl Join,
    leaves: &[BvhLeaf],
    count: usize,
    bounds: &Bounds,
    scales: [f32; 3],
) -> [[Bin; BINS]; 3] {
    let Some((first, second)) = halves(leaves) else {
        return bins_here(leaves, count, bounds, scales);
    };
    let inside = first.len() * WIDTH;
    let (mut both, second) = join.join(
        || bins_of(join, first, inside, bounds, scales),
        || bins_of(join, second, count - inside, bounds, scales),
    );
    for (bins, others) in both.iter_mut().zip(&second) {
        for (bin, other) in bins.iter_mut().zip(others) {
            bin.grow(other.low, other.high, other.count);
        }
    }
    both
}

fn bins_here(
    leaves: &[BvhLeaf],
    count: usize,
    bounds: &Bounds,
    scales: [f32; 3],
) -> [[Bin; BINS]; 3] {
    let mut bins = [[Bin::EMPTY; BINS]; 3];
    for (place, leaf) in leaves.iter().enumerate() {
        let lanes = (count - place * WIDTH).min(WIDTH);
        for lane in 0..lanes {
            let [x, y, z] = [leaf.center[0][lane], leaf.center[1][lane], leaf.center[2][lane]];
            let r = leaf.radius[lane];
            let (low, high) = ([x - r, y - r, z - r, 0.0], [x + r, y + r, z + r, 0.0]);
            for (axis, center) in [x, y, z].into_iter().enumerate() {
                bins[axis][bin_of(center, bounds.least[axis], scales[axis])].grow(low, high, 1);
            }
        }
    }
    bins
}

/// Where to cut: before sphere `at`, in the order along `axis`.
struct Cut {
    axis: usize,
    at: usize,
    /// The slice that the cut is in, and what lies in the slices before.
    bin: usize,
    before: usize,
    inside: usize,
}

impl Run<'_> {
    /// Cuts the run where the heuristic says; answers with the leaves of the first part, at least
    /// one and fewer than all. The run has two leaves or more.
    pub(super) fn split(&mut self, join: &impl Join, bounds: &Bounds) -> usize {
        let scales = bounds.scales();
        match self.best_cut(join, bounds, scales) {
            Some(cut) => {
                let (least, scale) = (bounds.least[cut.axis], scales[cut.axis]);
                let before = self.gather(0, self.count, |leaf, lane| {
                    bin_of(leaf.center[cut.axis][lane], least, scale) < cut.bin
                });
                debug_assert_eq!(before, cut.before, "counted and gathered alike");
                if before < cut.at && cut.at < before + cut.inside {
                    let end = self.gather(before, self.count, |leaf, lane| {
                        bin_of(leaf.center[cut.axis][lane], least, scale) == cut.bin
                    });
                    self.order_about(cut.at, before, end, cut.axis);
                }
                cut.at / WIDTH
            }
            None => self.split_at(self.leaves.len() / 2, bounds),
        }
    }

    /// Cuts the run behind `leaves` leaves, by the centres along the longest axis, or by the radii
    /// where the centres coincide.
    pub(super) fn split_at(&mut self, leaves: usize, bounds: &Bounds) -> usize {
        self.order_about(leaves * WIDTH, 0, self.count, bounds.longest_axis());
        leaves
    }

    /// The cheapest cut between slices, moved to a multiple of sixteen; none where all centres
    /// coincide, or nearly.
    fn best_cut(&self, join: &impl Join, bounds: &Bounds, scales: [f32; 3]) -> Option<Cut> {
        let bins = bins_of(join, self.leaves, self.count, bounds, scales);
        let mut best = None;
        let mut least_cost = f32::INFINITY;
        for (axis, bins) in bins.iter().enumerate() {
            if scales[axis] == 0.0 {
                continue;
            }
            // Surfaces of the first so many slices, and of the others.
            let mut left = [0.0; BINS + 1];
            let mut right = [0.0; BINS + 1];
            let mut all = Bin::EMPTY;
            for (area, bin) in left.iter_mut().skip(1).zip(bins) {
                all.grow(bin.low, bin.high, bin.count);
                *area = all.half_area();
            }
            let mut all = Bin::EMPTY;
            for (area, bin) in right.iter_mut().zip(bins).rev().skip(1) {
                all.grow(bin.low, bin.high, bin.count);
                *area = all.half_area();
            }
            let mut before = 0;
            for (bin, Bin { count: inside, .. }) in bins.iter().enumerate() {
                if *inside == 0 {
                    continue;
                }
                // Of a short run every cut, of a long one that nearest to the end of the slice.
                let end = before + inside;
                let nearest = (end + WIDTH / 2) / WIDTH * WIDTH;
                let (mut at, last) = if self.leaves.len() <= EVERY_CUT {
                    (before / WIDTH * WIDTH + WIDTH, end / WIDTH * WIDTH)
                } else {
                    (nearest, nearest)
                };
                while at <= last {
                    if at > 0 && at < self.count {
                        let share = (at - before.min(at)) as f32 / *inside as f32;
                        let first = left[bin] + share * (left[bin + 1] - left[bin]);
                        let second = right[bin] + share * (right[bin + 1] - right[bin]);
                        let cost = first * at as f32 + second * (self.count - at) as f32;
                        if cost < least_cost {
                            least_cost = cost;
                            best = Some((axis, at));
                        }
                    }
                    at += WIDTH;
                }
                before = end;
            }
        }
        let (axis, at) = best?;
        let mut before = 0;
        for (bin, Bin { count, .. }) in bins[axis].iter().enumerate() {
            if at <= before + count {
                return Some(Cut { axis, at, bin, before, inside: *count });
            }
            before += count;
        }
        None
    }
}
