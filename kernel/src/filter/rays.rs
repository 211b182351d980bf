//! The rays of a packet as the filter reads them, and the test.

use super::KAPPA;
use super::block::{FilterBlock, FilterGroup};
use super::frame::Frame;
use crate::accuracy::RayLanes;
use crate::lanes::{LaneMask, Lanes};
use crate::numeric::axes::{axes, dot, largest};
use crate::numeric::power_of_two::inverse_powers_of_two;
use crate::numeric::rounding::{LARGEST, LONGEST, SHORTEST};

/// The rays of a packet as the filter reads them, for one block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FilterRays<L: Lanes> {
    /// d, of unit length up to 4.5 u.
    pub(crate) direction: [L; 3],
    /// 2 o.
    pub(crate) twice_origin: [L; 3],
    /// -d.o.
    pub(crate) minus_along: L,
    /// |o|^2, lowered by the bound: a sphere passes whose raised number is not below it.
    pub(crate) threshold: L,
}

impl<L: Lanes> FilterRays<L> {
    #[inline(always)]
    pub(crate) fn new(token: L::Token, rays: &RayLanes<L>, block: &FilterBlock) -> Self {
        Self::widened(token, rays, &block.frame, KAPPA)
    }

    #[inline(always)]
    pub(crate) fn widened(token: L::Token, rays: &RayLanes<L>, frame: &Frame, kappa: f32) -> Self {
        let Frame { scale, shift, least_length, .. } = *frame;
        let (mut direction, mut a) = (rays.direction, dot(rays.direction, rays.direction));
        // Rays that the bound does not cover are replaced by one that it does.
        let mut judged = rays.live & (largest(rays.origin) * a.like(scale)).le(a.like(LARGEST));
        let usual = a.like(SHORTEST).le(a) & a.le(a.like(LONGEST));
        if (rays.live & !usual).any() {
            let longest = largest(direction);
            let to_one = inverse_powers_of_two(longest);
            direction = axes!(i => direction[i] * to_one);
            a = dot(direction, direction);
            judged = judged & a.like(least_length).le(longest);
        }
        let (zero, one) = (a.like(0.0), a.like(1.0));
        let per_length = one / L::select(judged, a, one).sqrt();
        let direction = axes!(i => L::select(judged, direction[i] * per_length, zero));
        let origin = axes!(i => {
            let shifted = rays.origin[i] * a.like(scale) - L::splat(token, shift[i]);
            L::select(judged, shifted, zero)
        });
        let along = dot(direction, origin);
        let oo = dot(origin, origin);
        let otherwise = L::select(rays.live, a.like(f32::NEG_INFINITY), a.like(f32::INFINITY));
        Self {
            direction,
            twice_origin: axes!(i => origin[i] + origin[i]),
            minus_along: -along,
            threshold: L::select(judged, oo - oo.like(kappa) * oo, otherwise),
        }
    }

    /// Lets nothing pass any more in lanes that are not `live`.
    #[inline(always)]
    pub(crate) fn keep(&mut self, live: L::Mask) {
        let never = L::splat(self.threshold.token(), f32::INFINITY);
        self.threshold = L::select(live, self.threshold, never);
    }

    /// D/a + |o|^2, raised by the bound.
    #[inline(always)]
    pub(crate) fn raised(&self, group: &FilterGroup, slot: usize) -> L {
        let token = self.threshold.token();
        let [dx, dy, dz] = self.direction;
        let [fx, fy, fz] = self.twice_origin;
        let [x, y, z] = axes!(i => L::splat(token, group.center[i][slot]));
        let w = L::splat(token, group.excess[slot]);
        let b = x.filter_mul_add(dx, y.filter_mul_add(dy, z.filter_mul_add(dz, self.minus_along)));
        let c = x.filter_mul_add(fx, y.filter_mul_add(fy, z.filter_mul_add(fz, w)));
        b.filter_mul_add(b, c)
    }

    /// Whether any lane may meet any sphere of the group.
    #[inline(always)]
    pub(crate) fn may_meet_any(&self, group: &FilterGroup) -> bool {
        let low = self.raised(group, 0).filter_max(self.raised(group, 1));
        let high = self.raised(group, 2).filter_max(self.raised(group, 3));
        self.threshold.le(low.filter_max(high)).any()
    }

    /// Which lanes may meet sphere `slot` of the group.
    #[inline(always)]
    pub(crate) fn may_meet(&self, group: &FilterGroup, slot: usize) -> L::Mask {
        self.threshold.le(self.raised(group, slot))
    }
}
