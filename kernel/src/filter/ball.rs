//! Rays that begin so far away that a tree is a ball to them.

use super::block::FilterGroup;
use super::frame::{Frame, farthest};
use super::rays::FilterRays;
use super::{KAPPA, LEAST_SIZE};
use crate::accuracy::RayLanes;
use crate::geometry::sphere::Sphere;
use crate::lanes::Lanes;
use crate::scale::scene::to_one;

/// Which rays may come within `radius` of the coordinates' origin, from however far away.
#[inline(always)]
pub(crate) fn may_come_near<L: Lanes>(token: L::Token, rays: &RayLanes<L>, radius: f32) -> L::Mask {
    let ball = Sphere::from([0.0, 0.0, 0.0, radius]);
    if !ball.is_valid() {
        return rays.live;
    }
    let scale = to_one(farthest(rays));
    let frame = Frame { scale, shift: [0.0; 3], least_size: LEAST_SIZE, least_length: 0.0 };
    let mut group = FilterGroup::EMPTY;
    group.put(0, &ball, &frame, KAPPA);
    FilterRays::widened(token, rays, &frame, KAPPA).may_meet(&group, 0)
}
