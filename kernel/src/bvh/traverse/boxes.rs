//! Boxes of a node against one ray: which it enters, and where.
//!
//! The slabs of [`prepared_ray`](super::prepared_ray), a box a lane. (With AVX2, leaving out a half of a node that has no
//! child ran at 0.97 to 1.00 of the speed, since under 0.3 % of visits have such a half.)

use super::prepared_ray::PreparedLanes;
use crate::bvh::node::{BvhNode, WIDTH};
use crate::lanes::Lanes;
use crate::numeric::axes::axes;
use crate::numeric::rounding::LEAST_COMPONENT;

/// Some of a node's boxes, a box a lane, as the rays of an octant see them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Boxes<L> {
    nearer: [L; 3],
    farther: [L; 3],
}

impl<L: Lanes> Boxes<L> {
    /// Part `part` of a node's boxes, for rays that run down along the axes `down`.
    #[inline(always)]
    pub(super) fn load(token: L::Token, node: &BvhNode, down: [bool; 3], part: usize) -> Self {
        let nearer = axes!(i => if down[i] { &node.high[i] } else { &node.low[i] });
        let farther = axes!(i => if down[i] { &node.low[i] } else { &node.high[i] });
        Self {
            nearer: axes!(i => L::load_part(token, nearer[i], part)),
            farther: axes!(i => L::load_part(token, farther[i], part)),
        }
    }
}

/// One ray in all lanes, as boxes see it: as in [`PreparedPacket`](super::prepared_packet::PreparedPacket).
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxProbe<L> {
    pub(super) inverse: [L; 3],
    pub(super) minus_inverse: [L; 3],
    pub(super) minus_near: [L; 3],
    pub(super) far: [L; 3],
    /// The s from which, and up to which, boxes matter; the end with its sign changed.
    pub(super) start: L,
    pub(super) minus_end: L,
}

impl<L: Lanes> BoxProbe<L> {
    /// Which boxes the ray enters, and the s at which it does.
    #[inline(always)]
    pub(super) fn enter(&self, boxes: &Boxes<L>) -> (L::Mask, L) {
        let (entry, leave) = self.interval(boxes);
        (entry.le(leave), entry)
    }

    /// The s at which the ray enters boxes, and that at which it leaves them, which is less if it does not meet them.
    #[inline(always)]
    pub(super) fn interval(&self, boxes: &Boxes<L>) -> (L, L) {
        let Self { inverse, minus_inverse, minus_near, far, start, minus_end } = *self;
        let entry = axes!(i => boxes.nearer[i].filter_mul_add(inverse[i], minus_near[i]));
        let minus_leave = axes!(i => boxes.farther[i].filter_mul_add(minus_inverse[i], far[i]));
        let entry = entry[0].filter_max(entry[1]).filter_max(entry[2].filter_max(start));
        let minus_leave = minus_leave[0]
            .filter_max(minus_leave[1])
            .filter_max(minus_leave[2].filter_max(minus_end));
        (entry, -minus_leave)
    }
}

/// Which rays enter a box of a node before `best`, except for rounding: for counts, not for answers.
#[inline(always)]
pub(crate) fn enter_about<L: Lanes>(
    rays: &PreparedLanes<L>,
    best: L,
    node: &BvhNode,
    slot: usize,
) -> L::Mask {
    let (mut entry, mut minus_leave) = (rays.start[0], -best);
    for i in 0..3 {
        let (origin, n) = (rays.origin[i], rays.direction[i]);
        let least = best.like(LEAST_COMPONENT);
        let clamped = least.filter_max(n.abs());
        let inverse = best.like(1.0) / L::select(n.lt(best.like(0.0)), -clamped, clamped);
        let low = (best.like(node.low[i][slot % WIDTH]) - origin) * inverse;
        let high = (best.like(node.high[i][slot % WIDTH]) - origin) * inverse;
        entry = entry.filter_max(-(-low).filter_max(-high));
        minus_leave = minus_leave.filter_max(-low.filter_max(high));
    }
    entry.lt(-minus_leave)
}
