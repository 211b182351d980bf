//! The rays of a packet, prepared (`prepared_ray.rs`), in memory, for where they go one by one.

use super::prepared_ray::{PreparedLanes, Slab, far_away};
use super::ray_time::RayTime;
use crate::accuracy::{RayLanes, Squares};
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::scale::rays::ScaledRays;

/// The rays of a packet, prepared, in memory: to be traced one by one.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct PreparedPacket<A: LaneArray> {
    /// The rays that the bounds cover.
    pub(crate) covered: u32,
    /// o'.
    pub(crate) origin: [A; 3],
    /// n.
    pub(crate) direction: [A; 3],
    pub(crate) inverse: [A; 3],
    pub(crate) minus_inverse: [A; 3],
    /// -(o' + pad) / n and (o' - pad) / n, with the pad away from the box.
    pub(crate) minus_near: [A; 3],
    pub(crate) far: [A; 3],
    /// As [`PreparedLanes::start`] and [`PreparedLanes::end`].
    pub(crate) start: [A; 2],
    pub(crate) end: [A; 2],
    /// As in [`RayTime`].
    per_t: A,
    shift: A,
    length: A,
    /// As [`PreparedLanes::absolute_error`].
    pub(crate) absolute_error: A,
    /// What the spread of a tier adds to either end for boxes.
    pub(crate) spread: A,
    /// Where n runs down along each axis, a bit a ray.
    pub(crate) down: [u32; 3],
}

impl<A: LaneArray> PreparedPacket<A> {
    /// No rays; all zeros, so that an array of many is cleared, and not copied.
    pub(crate) const NONE: Self = Self {
        covered: 0,
        origin: [A::ZEROS; 3],
        direction: [A::ZEROS; 3],
        inverse: [A::ZEROS; 3],
        minus_inverse: [A::ZEROS; 3],
        minus_near: [A::ZEROS; 3],
        far: [A::ZEROS; 3],
        start: [A::ZEROS; 2],
        end: [A::ZEROS; 2],
        per_t: A::ZEROS,
        shift: A::ZEROS,
        length: A::ZEROS,
        absolute_error: A::ZEROS,
        spread: A::ZEROS,
        down: [0; 3],
    };

    /// Prepares the rays of a packet for a scene that is scaled by `factor`, and a tier of that spread which squares that much; replaces those
    /// that were here. (Returned as a
    /// value, they were copied: 3 % of a traversal.)
    #[inline(always)]
    pub(crate) fn prepare<L: Lanes<Array = A>>(
        &mut self,
        rays: &RayLanes<L>,
        factor: f32,
        extent: f32,
        (spread, squares): (f32, Squares),
    ) {
        let prepared = PreparedLanes::as_they_are(&ScaledRays::new(rays, factor));
        // `Fast` and `Geometric` are off by so much more that moving rays gains nothing: their rays are not moved.
        let unusual =
            rays.live & (!prepared.covered | prepared.may_overflow(squares, factor, extent));
        let again = if spread > 0.0 {
            unusual
        } else {
            unusual | far_away(prepared.covered, prepared.absolute_error, extent)
        };
        if !again.any() {
            return self.set(prepared, extent, spread);
        }
        // A copy, so that others stay in registers.
        let rays = *rays;
        L::out_of_line(
            prepared.absolute_error.token(),
            #[inline(always)]
            move || {
                let of_tier = (squares, spread == 0.0);
                let prepared = PreparedLanes::of_any_size(&rays, (factor, extent), of_tier);
                self.set(prepared, extent, spread);
            },
        );
    }

    #[inline(always)]
    fn set<L: Lanes<Array = A>>(&mut self, rays: PreparedLanes<L>, extent: f32, spread: f32) {
        let PreparedLanes { covered, origin, direction, time, absolute_error, start, end } = rays;
        self.covered = covered.bits();
        for i in 0..3 {
            let (n, one) = (direction[i], direction[i].like(1.0));
            let Slab { inverse, minus_near, far, down } = rays.slab(i, n, one);
            self.origin[i] = origin[i].store();
            self.direction[i] = n.store();
            self.inverse[i] = inverse.store();
            self.minus_inverse[i] = (-inverse).store();
            self.minus_near[i] = minus_near.store();
            self.far[i] = far.store();
            self.down[i] = down.bits();
        }
        self.start = [start[0].store(), start[1].store()];
        self.end = [end[0].store(), end[1].store()];
        self.per_t = time.per_t.store();
        self.shift = time.shift.store();
        self.length = time.length.store();
        self.absolute_error = absolute_error.store();
        self.spread = rays.spread_of_boxes(extent, spread).store();
    }

    /// From t to s, for one ray.
    #[inline(always)]
    pub(crate) fn time(&self, lane: usize) -> RayTime<f32> {
        let (per_t, shift) = (self.per_t.get(lane), self.shift.get(lane));
        RayTime { per_t, shift, length: self.length.get(lane) }
    }

    /// Ends a ray at `t`, if that is before its end so far.
    #[inline(always)]
    pub(crate) fn shorten(&mut self, lane: usize, t: f32) {
        let sooner = self.time(lane).after(t);
        if sooner < self.end[1].get(lane) {
            self.end[1].set(lane, sooner);
        }
    }
}
