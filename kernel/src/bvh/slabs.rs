//! Rays as the boxes see them.
//!
//! # Method
//!
//! The direction is brought to unit length, n = d / |d|, and with it the ray's parameter: s = |d| t.
//! A slab low <= o_i + s n_i <= high is entered at (low - o_i) / n_i; with 1/n_i and o_i / n_i known
//! that is one multiply-add. The pad, which makes it safe, is part of o_i / n_i and costs nothing:
//! near = low * inverse - (o * inverse + pad * |inverse|), far = high * inverse - (o * inverse -
//! pad * |inverse|), with high and low changing places where n_i is negative. A box is looked into
//! where the largest near, or the start of the interval, is at most the least far, or the best
//! entry so far: closed, so that equal t are never culled.
//!
//! # Why nothing is lost
//!
//! u = 2^-24, first order; M = extent + |o|, with no coordinate of a box above the extent and
//! no coordinate of o above |o|; P = |p| + r, p = c - o: P <= 2 sqrt 3 M, generously. With rho = 1/|d| as rounded and v = rho d
//! in the reals, points of the line are o + s v for s = t / rho, and n_i = v_i (1 + u).
//!
//! Let t be what a tier answers, and x = o + t d in the reals. How far is x from the sphere?
//!
//! | tier | distance from the centre at most | in M, u |
//! |---|---|---|
//! | `Exact`: t is u off its root, or 2^-150, of \|t d\| <= P | r + u P | 4 |
//! | `Stable` calls it a hit where l^2 <= r^2 + 2^-40 (p^2 + r^2) (`filter.rs`), so l <= r + 2^-20 P; t is within 2^-20 (`accuracy/beyond.rs`), but near zero | r + 32 u P | 111 |
//!
//! (2^-20 is 16 u. P is largest where the ray starts in one corner of what is covered and the
//! sphere touches the other; 2 sqrt 3 = 3.47.) So x lies within 111 u M of the sphere's box, which was
//! rounded outward. On top of that, of near and far:
//!
//! | step, times inverse | at most |
//! |---|---|
//! | s n_i is not s v_i, inverse is not 1/n_i: 2u of \|low - o\| | 2 u M |
//! | low * inverse, unless fused; o * inverse | 2 u M |
//! | the sum with the pad, and the last one | 2 u (M + pad) |
//! | **together** | **7 u M** |
//!
//! A component |n_i| below 2^-60 is taken for that, its sign kept: over the length 4 M that changes
//! the place by 2^-58 M. Together below 120 u M: the pad is 128 u M, and 2^-80, which covers what
//! underflows. `Fast` may answer anything on a line that passes the box by: that is not covered;
//! where the line meets the box its t is, by a wider interval (`Accuracy::SPREAD`).
//!
//! The ends of the interval become s by one product with |d| as rounded: 3u, half of 2^-149 times
//! |d|; they are moved by 8u and 2^-80 to either side.
//!
//! All of it holds where nothing overflows: o and boxes up to 2^41, a = d.d within [2^-100, 2^100], so
//! that the inverse is below 2^60, products below 2^102, and no number is NaN: a box without
//! a child is entered at +inf. Other rays are not `judged`, and go to no box.

use crate::accuracy::RayLanes;
use crate::axes::{axes, dot};
use crate::{Accuracy, Lanes};

/// u.
pub(crate) const U: f32 = f32::EPSILON / 2.0;
/// 2^-60: the least component of a direction.
const LEAST_COMPONENT: f32 = 1.0 / (1_073_741_824.0 * 1_073_741_824.0);
/// 2^-80: what is added for underflow.
pub(super) const LEAST_PAD: f32 = LEAST_COMPONENT / 1_048_576.0;
/// 2^100: above it, or below its inverse, a squared direction is not judged.
pub(crate) const LONGEST: f32 = super::LARGEST * super::LARGEST * 1_048_576.0;

/// The rays of a packet, ready to be walked one by one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slabs<L: Lanes> {
    /// The rays that the bounds cover.
    pub(super) judged: u32,
    pub(super) origin: [L::Array; 3],
    /// n.
    pub(super) direction: [L::Array; 3],
    pub(super) inverse: [L::Array; 3],
    /// (o + pad, o - pad) / n, with the pad away from the box.
    pub(super) near: [L::Array; 3],
    pub(super) far: [L::Array; 3],
    /// The interval as s, its ends moved down and up.
    pub(super) start: [L::Array; 2],
    pub(super) end: [L::Array; 2],
    /// |d|: t times it is s.
    pub(super) length: L::Array,
    /// What `Fast` adds to either end for boxes.
    pub(super) spread: L::Array,
}

/// The course of a packet's rays: directions of unit length, and what the bounds cover.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course<L: Lanes> {
    /// The rays that the bounds cover.
    pub(super) judged: L::Mask,
    /// n.
    pub(super) direction: [L; 3],
    /// |d|: t times it is s.
    pub(super) length: L,
    /// The largest coordinate of the origin.
    pub(super) far: L,
}

impl<L: Lanes> Course<L> {
    #[inline(always)]
    pub(super) fn new(rays: &RayLanes<L>) -> Self {
        let d = rays.direction;
        let a = dot(d, d);
        let far = rays.origin[0].abs().filter_max(rays.origin[1].abs());
        let far = far.filter_max(rays.origin[2].abs());
        let judged = rays.live
            & a.like(1.0 / LONGEST).le(a)
            & a.le(a.like(LONGEST))
            & far.le(a.like(super::LARGEST));
        let one = a.like(1.0);
        let length = L::select(judged, a, one).sqrt();
        let per_length = one / length;
        Self { judged, direction: axes!(i => d[i] * per_length), length, far }
    }
}

impl<L: Lanes> Slabs<L> {
    #[inline(always)]
    pub(super) fn new<A: Accuracy>(rays: &RayLanes<L>, extent: f32) -> Self {
        let Course { judged, direction, length, far } = Course::new(rays);
        let (zero, one) = (length.like(0.0), length.like(1.0));
        let origin = rays.origin;

        let size = far + length.like(extent);
        let pad = size.filter_mul_add(length.like(128.0 * U), length.like(LEAST_PAD));
        let least = length.like(LEAST_COMPONENT);
        let inverse = axes!(i => {
            let clamped = least.filter_max(direction[i].abs());
            one / L::select(direction[i].lt(zero), -clamped, clamped)
        });
        let along = axes!(i => origin[i] * inverse[i]);
        let reach = axes!(i => pad * inverse[i].abs());
        let (start, end) = (rays.t_min * length, rays.t_max * length);
        Self {
            judged: crate::LaneMask::bits(judged),
            origin: axes!(i => origin[i].store()),
            direction: axes!(i => direction[i].store()),
            inverse: axes!(i => inverse[i].store()),
            near: axes!(i => (along[i] + reach[i]).store()),
            far: axes!(i => (along[i] - reach[i]).store()),
            start: [lowered(start).store(), raised(start).store()],
            end: [lowered(end).store(), raised(end).store()],
            length: length.store(),
            spread: (size * length.like(4.0 * A::SPREAD)).store(),
        }
    }
}

/// At most s, as [`raised`].
#[inline(always)]
pub(super) fn lowered<L: Lanes>(s: L) -> L {
    -raised(-s)
}

/// At least s, for `s` that was made of a t: see above.
#[inline(always)]
pub(crate) fn raised<L: Lanes>(s: L) -> L {
    let (more, less) = (s * s.like(1.0 + 8.0 * U), s * s.like(1.0 - 8.0 * U));
    more.filter_max(less) + s.like(LEAST_PAD)
}
