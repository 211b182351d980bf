//! Rays as the boxes see them.
//!
//! # Method
//!
//! A slab low <= o'_i + s n_i <= high (o', n and s as in `approach.rs`) is entered at (low - o'_i) / n_i; with
//! 1/n_i and o'_i / n_i known that is one multiply-add. The pad, which makes it safe, is part of o'_i / n_i
//! and costs nothing: near = low * inverse - (o' * inverse + pad * |inverse|), far = high * inverse -
//! (o' * inverse - pad * |inverse|), with high and low changing places where n_i is negative. A box is
//! looked into where the largest near, or the start of the interval, is at most the least far, or the
//! best entry so far: closed, so that equal t are never culled.
//!
//! # Why nothing is lost
//!
//! u = 2^-24, first order; F, T, P and the blur as in `approach.rs`. C is the largest coordinate of the box
//! of spheres in question: so |c|, r and a point x in it are within sqrt 3 C, C and sqrt 3 C, and what
//! is proportional to them is paid by the box itself, which the build makes larger (`bounds.rs`): a large
//! sphere does not widen the boxes of small ones. What is proportional to F is paid by the ray.
//! With rho = 1/|d| as rounded and v = rho d in the reals, points of the line are o' + s v for s = t / rho -
//! tau / rho, and n_i = v_i (1 + u).
//!
//! Let x be the point of the line where a sphere of the box has the root that a tier answers with, or the
//! closest point where there is none: it is within 2^-36 P of the sphere.
//!
//! | what must be covered | at most, for the box | for the ray |
//! |---|---|---|
//! | x is not in the sphere, o' is not on the line | | u F + 2^-35 T |
//! | s n_i is not s v_i, inverse is not 1/n_i: 2u of \|low - o'\| | 2 u C | 2 u F |
//! | low * inverse, unless fused; o' * inverse | u C | u F |
//! | the sum with the pad, and the last one | u C | 2 u (F + pad) |
//! | the answer is not the root: 24 u r + 4 u \|c - o'\| of s, so no more of x_i, and the blur | 31 u C | 7 u F |
//! | **together** | **35 u C** | **13 u F + 2^-35 T** |
//!
//! The box pays 40 u C, the ray 16 u (F + 2^-11 T), and 2^-57 for what underflows. A component |n_i| below
//! 2^-60 is taken for that, its sign kept: over the length 4 (C + F) that changes the place by 2^-58 of
//! it. `Fast` may answer anything on a line that passes the box by: that is not covered; where the line
//! meets the box its t is, by a wider interval (`Accuracy::SPREAD`).
//!
//! All of it holds where nothing overflows: o and boxes up to 2^41, a = d.d within [2^-100, 2^100], so
//! that the inverse is below 2^60, products below 2^102, and no number is NaN: a box without
//! a child is entered at +inf. Other rays are not `judged`, and go to no box.

use super::approach::{Approach, RayTime, far_away};
use crate::accuracy::RayLanes;
use crate::{Accuracy, LaneArray, LaneMask, Lanes};

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
#[repr(align(64))]
pub(super) struct Slabs<L: Lanes> {
    /// The rays that the bounds cover.
    pub(super) judged: u32,
    /// o'.
    pub(super) origin: [L::Array; 3],
    /// n.
    pub(super) direction: [L::Array; 3],
    pub(super) inverse: [L::Array; 3],
    pub(super) minus_inverse: [L::Array; 3],
    /// -(o' + pad) / n and (o' - pad) / n, with the pad away from the box.
    pub(super) minus_near: [L::Array; 3],
    pub(super) far: [L::Array; 3],
    /// As [`Approach::start`] and [`Approach::end`].
    pub(super) start: [L::Array; 2],
    pub(super) end: [L::Array; 2],
    /// As in [`RayTime`](super::approach::RayTime).
    pub(super) shift: L::Array,
    pub(super) length: L::Array,
    /// As [`Approach::aside`].
    pub(super) aside: L::Array,
    /// What `Fast` adds to either end for boxes.
    pub(super) spread: L::Array,
    /// Where n runs down along each axis, a bit a ray.
    pub(super) down: [u32; 3],
}

impl<L: Lanes> Slabs<L> {
    /// No rays.
    pub(super) fn none() -> Self {
        Self {
            judged: 0,
            origin: Default::default(),
            direction: Default::default(),
            inverse: Default::default(),
            minus_inverse: Default::default(),
            minus_near: Default::default(),
            far: Default::default(),
            start: Default::default(),
            end: Default::default(),
            shift: Default::default(),
            length: Default::default(),
            aside: Default::default(),
            spread: Default::default(),
            down: [0; 3],
        }
    }

    /// Makes the rays of a packet ready, in the place of others. (As a value it was copied: 3 % of a
    /// walk.)
    #[inline(always)]
    pub(super) fn take<A: Accuracy>(&mut self, rays: &RayLanes<L>, extent: f32) {
        let approach = Approach::as_it_is(rays);
        if A::SPREAD > 0.0 || !far_away(approach.judged, approach.aside, extent).any() {
            return self.set::<A>(approach, extent);
        }
        // A copy, so that others stay in registers.
        let rays = *rays;
        L::out_of_line(
            approach.aside.token(),
            #[inline(always)]
            move || self.set::<A>(Approach::as_it_is(&rays).nearer(&rays, extent), extent),
        );
    }

    #[inline(always)]
    fn set<A: Accuracy>(&mut self, approach: Approach<L>, extent: f32) {
        let Approach { judged, origin, direction, time, aside, start, end } = approach;
        let (zero, one) = (aside.like(0.0), aside.like(1.0));

        let pad = aside + aside;
        let least = aside.like(LEAST_COMPONENT);
        self.judged = judged.bits();
        for i in 0..3 {
            let clamped = least.filter_max(direction[i].abs());
            let inverse = one / L::select(direction[i].lt(zero), -clamped, clamped);
            let (along, reach) = (origin[i] * inverse, pad * inverse.abs());
            self.origin[i] = origin[i].store();
            self.direction[i] = direction[i].store();
            self.inverse[i] = inverse.store();
            self.minus_inverse[i] = (-inverse).store();
            self.minus_near[i] = (-(along + reach)).store();
            self.far[i] = (along - reach).store();
            self.down[i] = direction[i].lt(zero).bits();
        }
        self.start = [start[0].store(), start[1].store()];
        self.end = [end[0].store(), end[1].store()];
        self.shift = time.shift.store();
        self.length = time.length.store();
        self.aside = aside.store();
        let size = aside.filter_mul_add(aside.like(0.125 / U), aside.like(extent));
        self.spread = (size * size.like(4.0 * A::SPREAD)).store();
    }

    /// From t to s, for one ray.
    #[inline(always)]
    pub(super) fn time(&self, lane: usize) -> RayTime<f32> {
        RayTime { shift: at(&self.shift, lane), length: at(&self.length, lane) }
    }

    /// Takes a t that a ray surely has as its end.
    pub(super) fn shorten(&mut self, lane: usize, t: f32) {
        let sooner = self.time(lane).after(t);
        if let Some(end) = self.end[1].as_mut().get_mut(lane)
            && sooner < *end
        {
            *end = sooner;
        }
    }
}

/// A number of one lane.
#[inline(always)]
pub(super) fn at<A: LaneArray>(array: &A, lane: usize) -> f32 {
    // The remainder tells the compiler that it is there.
    match array.as_ref().get(lane % A::COUNT) {
        Some(value) => *value,
        None => f32::NAN,
    }
}

/// At most s, as [`raised`].
#[inline(always)]
pub(super) fn lowered<L: Lanes>(s: L) -> L {
    -raised(-s)
}

/// At least s, for `s` that was made of a t (`approach.rs`).
#[inline(always)]
pub(crate) fn raised<L: Lanes>(s: L) -> L {
    let (more, less) = (s * s.like(1.0 + 8.0 * U), s * s.like(1.0 - 8.0 * U));
    more.filter_max(less) + s.like(LEAST_PAD)
}
