//! Rays as the bounds of boxes and spheres see them.
//!
//! # Method
//!
//! The ray is scaled by powers of two (`scale/rays.rs`): a t of 1 is f multiples of its scaled direction. The
//! direction is brought to unit length, n = d / |d|, and t becomes s = |d| (f t - tau). A ray that starts far
//! from the scene is taken from o' = o + tau d, two scene sizes before the point where it is closest to the
//! coordinates' origin, since what a filter computes is off by some u of the distance to the ray's origin. Other
//! rays have tau = 0 and o' = o. The tiers test the ray as it was given: no answer changes.
//!
//! A slab low <= o'_i + s n_i <= high is entered at (low - o'_i) / n_i; with 1 / n_i and o'_i / n_i known
//! that is one multiply-add. The pad, which makes it safe, is part of o'_i / n_i and costs nothing: near =
//! low * inverse - (o' * inverse + pad * |inverse|), far = high * inverse - (o' * inverse - pad *
//! |inverse|), with high and low changing places where n_i is negative. A box is entered if the largest
//! near, or the start of the interval, is at most the least far, or the best s so far: closed, so that
//! equal t are never culled.
//!
//! `docs/traversal-margins.md` says why no hit is lost, and what every constant covers; `tests/structures/far.rs`
//! guards it.

use super::ray_time::RayTime;
use crate::accuracy::RayLanes;
use crate::lanes::{LaneMask, Lanes};
use crate::numeric::axes::{axes, dot, largest};
use crate::numeric::error_free::{VeltkampSplit, two_sum};
use crate::numeric::rounding::{LARGEST, LEAST_COMPONENT, LONGEST};
use crate::scale::rays::ScaledRays;

/// The rays of a packet, prepared, in registers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PreparedLanes<L: Lanes> {
    /// The rays that the bounds cover.
    pub(crate) covered: L::Mask,
    /// o'.
    pub(crate) origin: [L; 3],
    /// n.
    pub(crate) direction: [L; 3],
    pub(crate) time: RayTime<L>,
    /// The sum of 8 u (F + 2^-11 T), 2^-58 and four steps of t, where F is the largest coordinate of o', and T =
    /// |tau d|. It is four times what o' may be off, and a tier because of T.
    pub(crate) absolute_error: L,
    /// The interval as s: start and end, each from below and from above.
    pub(crate) start: [L; 2],
    pub(crate) end: [L; 2],
}

/// Slabs across an axis, as rays see them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slab<L: Lanes> {
    /// 1 / n.
    pub(super) inverse: L,
    /// -(o' + pad) / n and (o' - pad) / n, with the pad away from the box.
    pub(super) minus_near: L,
    pub(super) far: L,
    /// Where n runs down along the axis.
    pub(super) down: L::Mask,
}

/// Rays are moved where the closest point is farther than this many times the distance that is left.
pub(super) const WORTH_IT: f32 = 8.0;
/// The absolute error of F + 2^-11 T, in u.
pub(crate) const ABSOLUTE_ERROR: f32 = 8.0;
/// The ray's pad of a slab is so many times the absolute error.
pub(crate) const PADS: f32 = 2.0;
/// 2^-58: the part of the absolute error that covers what underflows.
const LEAST_ERROR: f32 = 1.0 / (1_u64 << 58) as f32;

impl<L: Lanes> PreparedLanes<L> {
    /// Prepares the rays from where they begin.
    #[inline(always)]
    pub(crate) fn as_they_are(scaled: &ScaledRays<L>) -> Self {
        Self::from_there::<false>(scaled)
    }

    /// Prepares the rays from where they begin. With `COVERED`, a ray that the bounds do not cover gets any
    /// numbers.
    #[inline(always)]
    pub(super) fn from_there<const COVERED: bool>(
        ScaledRays { rays, per_t, step, .. }: &ScaledRays<L>,
    ) -> Self {
        let far = largest(rays.origin);
        let d = rays.direction;
        let a = dot(d, d);
        let covered = rays.live
            & a.like(1.0 / LONGEST).le(a)
            & a.le(a.like(LONGEST))
            & far.le(a.like(LARGEST));
        let (zero, one) = (a.like(0.0), a.like(1.0));
        let length = if COVERED { a } else { L::select(covered, a, one) }.sqrt();
        let per_length = one / length;
        let time = RayTime { per_t: *per_t, shift: zero, length };
        let step = *step * length;
        let [start, end] = time.around([rays.t_min, rays.t_max], step);
        Self {
            covered,
            origin: rays.origin,
            direction: axes!(i => d[i] * per_length),
            time,
            absolute_error: absolute_error(far, step),
            start,
            end,
        }
    }

    /// Prepares rays of any length; from nearer, where they begin far away from a scene of that `extent`, if it
    /// is given.
    #[inline(always)]
    pub(crate) fn of_any_length(rays: &RayLanes<L>, factor: f32, extent: Option<f32>) -> Self {
        let scaled = ScaledRays::of_any_length(rays, factor);
        let mut prepared = Self::as_they_are(&scaled);
        if let Some(extent) = extent
            && far_away(prepared.covered, prepared.absolute_error, extent).any()
        {
            prepared = prepared.nearer(&scaled, extent);
        }
        let (known, reach) = (prepared.time.is_known(), scaled.reach);
        prepared.start[0] = L::select(known, prepared.start[0], -reach);
        prepared.end[1] = L::select(known, prepared.end[1], reach);
        prepared
    }

    /// Prepares the rays from nearer, where they begin far away from a scene of that extent.
    #[inline(always)]
    fn nearer(self, ScaledRays { rays, step, .. }: &ScaledRays<L>, extent: f32) -> Self {
        let far = largest(rays.origin);
        let (zero, RayTime { per_t, length, .. }) = (far.like(0.0), self.time);
        let left = far.filter_mul_add(far.like(32.0 * L::UNIT_ROUNDOFF), far.like(2.0 * extent));
        let closest = -dot(rays.origin, self.direction);
        let moved = self.covered & (left * far.like(WORTH_IT)).lt(closest);

        let shift = L::select(moved, (closest - left) / length, zero);
        let split_shift = VeltkampSplit::new(shift);
        let origin = axes!(i => {
            let (high, low) = split_shift.times(VeltkampSplit::new(rays.direction[i]));
            let (sum, error) = two_sum(rays.origin[i], high);
            L::select(moved, sum + (error + low), rays.origin[i])
        });
        let (by, time) = (shift * length, RayTime { per_t, shift, length });
        let size = by.filter_mul_add(by.like(1.0 / 2048.0), largest(origin));
        let step = *step * length;
        let [start, end] = time.around([rays.t_min, rays.t_max], time.t_error() + step);
        Self { origin, time, absolute_error: absolute_error(size, step), start, end, ..self }
    }

    /// How the rays see the slabs of axis `axis`, by a direction of any length. (The unit direction is known one division later.)
    #[inline(always)]
    pub(super) fn slab(&self, axis: usize, direction: L, length: L) -> Slab<L> {
        let origin = self.origin[axis % 3];
        let pad = self.absolute_error * origin.like(PADS);
        let down = direction.lt(origin.like(0.0));
        let least = length * length.like(LEAST_COMPONENT);
        let clamped = least.filter_max(direction.abs());
        let inverse = length / L::select(down, -clamped, clamped);
        let (along, reach) = (origin * inverse, pad * inverse.abs());
        Slab { inverse, minus_near: -(along + reach), far: along - reach, down }
    }

    /// What the spread of a tier adds to either end for the boxes of a scene of that extent.
    #[inline(always)]
    pub(super) fn spread_of_boxes(&self, extent: f32, spread: f32) -> L {
        let error = self.absolute_error;
        let size = error.filter_mul_add(
            error.like(1.0 / ABSOLUTE_ERROR / L::UNIT_ROUNDOFF),
            error.like(extent),
        );
        size * size.like(4.0 * spread)
    }

    /// The rays that start at t >= 0, if anything can be said of t, as it can for usual lengths.
    #[inline(always)]
    pub(crate) fn forward(&self, t_min: L) -> L::Mask {
        let zero = t_min.like(0.0);
        zero.le(t_min) & zero.like(f32::NEG_INFINITY).lt(self.start[0])
    }
}

/// Which of `rays`, prepared from where they begin, may be worth moving: the point of a ray's line that is
/// closest to the coordinates' origin is at most sqrt 3 F from where the ray begins.
#[inline(always)]
pub(crate) fn far_away<L: Lanes>(rays: L::Mask, absolute_error: L, extent: f32) -> L::Mask {
    rays & absolute_error
        .like(WORTH_IT * ABSOLUTE_ERROR * L::UNIT_ROUNDOFF * extent)
        .lt(absolute_error)
}

/// The absolute error for rays of that size, F + 2^-11 T, and that step.
#[inline(always)]
fn absolute_error<L: Lanes>(size: L, step: L) -> L {
    let least = step.filter_mul_add(step.like(4.0), step.like(LEAST_ERROR));
    size.filter_mul_add(size.like(ABSOLUTE_ERROR * L::UNIT_ROUNDOFF), least)
}
