//! Spheres sorted into slices along each axis, as the surface area heuristic compares them.

use super::bounds::{Bounds, half_area, halves};
use super::join::Join;
use crate::numeric::rounding::{least, most};

/// How many slices a run is sorted into, an axis.
pub(super) const BINS: usize = 16;

/// An axis at a time, the scale by which (centre - least) becomes the number of a slice: zero if an
/// axis tells nothing.
pub(super) fn scales(bounds: &Bounds) -> [f32; 3] {
    let mut scales = [0.0; 3];
    for (axis, scale) in scales.iter_mut().enumerate() {
        // A hair below sixteen, so that the last centre is in the last slice.
        let slices =
            BINS as f32 * (1.0 - 4.0 * f32::EPSILON) / (bounds.most[axis] - bounds.least[axis]);
        if slices < f32::MAX {
            *scale = slices;
        }
    }
    scales
}

/// The slice that a centre is in.
#[inline(always)]
pub(super) fn bin_of(center: f32, least: f32, scale: f32) -> usize {
    ((center - least) * scale) as i32 as usize & (BINS - 1)
}

/// What lies in a slice; the fourth number is there to fill a register.
#[derive(Clone, Copy)]
pub(super) struct Bin {
    pub(super) low: [f32; 4],
    pub(super) high: [f32; 4],
    pub(super) count: usize,
}

impl Bin {
    pub(super) const EMPTY: Self =
        Self { low: [f32::INFINITY; 4], high: [f32::NEG_INFINITY; 4], count: 0 };

    #[inline(always)]
    pub(super) fn grow(&mut self, low: [f32; 4], high: [f32; 4], count: usize) {
        for i in 0..4 {
            self.low[i] = least(self.low[i], low[i]);
            self.high[i] = most(self.high[i], high[i]);
        }
        self.count += count;
    }

    pub(super) fn half_area(&self) -> f32 {
        if self.count == 0 {
            return 0.0;
        }
        let [low, high] = [self.low, self.high].map(|[x, y, z, _]| [x, y, z]);
        half_area(low, high)
    }
}

/// Sorts spheres into slices, by halves where they are many.
pub(super) fn bins_of(
    join: &impl Join,
    spheres: &[[f32; 4]],
    bounds: &Bounds,
    scales: [f32; 3],
) -> [[Bin; BINS]; 3] {
    let Some([first, second]) = halves(spheres) else { return bins_here(spheres, bounds, scales) };
    let (mut both, second) = join
        .join(|| bins_of(join, first, bounds, scales), || bins_of(join, second, bounds, scales));
    for (bins, others) in both.iter_mut().zip(&second) {
        for (bin, other) in bins.iter_mut().zip(others) {
            bin.grow(other.low, other.high, other.count);
        }
    }
    both
}

fn bins_here(spheres: &[[f32; 4]], bounds: &Bounds, scales: [f32; 3]) -> [[Bin; BINS]; 3] {
    let mut bins = [[Bin::EMPTY; BINS]; 3];
    for sphere in spheres {
        let radius = sphere[3];
        let (low, high) =
            (sphere.map(|center| center - radius), sphere.map(|center| center + radius));
        for axis in 0..3 {
            bins[axis][bin_of(sphere[axis], bounds.least[axis], scales[axis])].grow(low, high, 1);
        }
    }
    bins
}
