//! The space in which a block's spheres have sizes of some 1, and are near zero.

use super::{BLOCK_SPHERES, LEAST_SIZE};
use crate::accuracy::{RayLanes, Underflow};
use crate::geometry::sphere::Sphere;
use crate::geometry::sphere_run::SphereRun;
use crate::lanes::Lanes;
use crate::numeric::axes::{axes, largest};
use crate::numeric::rounding::LARGEST;
use crate::scale::scene::{size, to_one};

/// The space that a block of spheres, or a ball, is seen in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// The power of two that lengths are multiplied by.
    pub(crate) scale: f32,
    /// K, scaled.
    pub(crate) shift: [f32; 3],
    /// No sphere counts as smaller, scaled. (When this was the square, the compiler also multiplied it by itself, to a
    /// subnormal number that nothing needs: half of the time of `Fast`.)
    pub(crate) least_size: f32,
    /// A direction without a larger component is not judged.
    pub(crate) least_length: f32,
}

impl Frame {
    /// The space as it is.
    pub(crate) const UNIT: Self =
        Self { scale: 1.0, shift: [0.0; 3], least_size: LEAST_SIZE, least_length: 0.0 };

    /// The frame lies around a point among the spheres of a block: coordinate by coordinate the median of three of them,
    /// which one sphere far away cannot move far. It is scaled so that the median of their sizes is some 1; or, if rays
    /// that start at `far` would be out of range then, so that `far` is some 1. Any finite point, and any scale, would be
    /// right.
    pub(crate) fn of(
        spheres: &(impl SphereRun + ?Sized),
        first: usize,
        underflow: Underflow,
        far: f32,
    ) -> Self {
        let count = (spheres.count() - first).min(BLOCK_SPHERES);
        let offsets = [0, count / 2, count.saturating_sub(1)];
        // In a closure the check that an index into an array is in bounds may stay, and with it a panic.
        let samples = axes!(i => match spheres.sphere(first + offsets[i]) {
            Some(sphere) => sphere,
            None => Sphere::from([0.0; 4]),
        });
        let sizes = axes!(i => size(&samples[i]));
        let typical = median(sizes);
        let largest = sizes[0].max(sizes[1]).max(sizes[2]);
        let scale = match (typical > 0.0, largest > 0.0) {
            (true, _) => to_one(typical),
            (_, true) => to_one(largest),
            _ => 1.0,
        };
        let scale = if far * scale <= LARGEST { scale } else { to_one(far) };
        let shift = axes!(axis => {
            let middle = median(axes!(i => samples[i].center()[axis] * scale));
            if middle.abs() <= LARGEST { middle } else { 0.0 }
        });
        let least_size = (underflow.size * scale).max(LEAST_SIZE);
        Self { scale, shift, least_size, least_length: underflow.length }
    }
}

/// The median of three numbers.
fn median([a, b, c]: [f32; 3]) -> f32 {
    a.max(b).min(a.min(b).max(c))
}

/// The largest coordinate of the origins of live rays.
#[inline(always)]
pub(super) fn farthest<L: Lanes>(rays: &RayLanes<L>) -> f32 {
    let far = largest(rays.origin);
    L::select(rays.live, far, far.like(0.0)).filter_greatest()
}
