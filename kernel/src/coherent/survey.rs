//! What the rays of many packets cannot leave, and how deep they go.

use super::fit::{ALONG, Fit, heading, spread_of};
use super::frustum::{Frustum, Outline, across, margin};
use super::view::View;
use crate::accuracy::RayLanes;
use crate::bvh::traverse::prepared_ray::PreparedLanes;
use crate::count::count;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;

/// A survey of packets that follow each other.
pub(super) struct Survey {
    /// How many packets, from the first on, have a viewpoint in common and run the same way.
    pub(super) packets: usize,
    /// What their rays cannot leave, and the greatest depth of the list that a ray goes to.
    pub(super) frustum: Frustum,
    pub(super) reach: f32,
    /// By which spheres count, for the tier.
    pub(super) outline: Outline,
}

/// Returns how deep the rays of a packet go, raised by the margin: the depth at which they start, and their s.
#[inline(always)]
pub(super) fn reaches<L: Lanes>(view: &View, best: L, origin: [L; 3], absolute_error: L) -> L {
    best + view.start_depth(origin) + absolute_error * absolute_error.like(16.0)
}

impl Survey {
    /// Of no packet.
    const NONE: Self =
        Self { packets: 0, frustum: Frustum::NONE, reach: 0.0, outline: Outline::Sphere };

    /// For packets against spheres that are scaled by a factor and have an extent, by a tier that has a spread: these are `size`.
    /// Returns a survey of no packet if the first does not fit.
    #[inline(always)]
    pub(super) fn new<L: Lanes>(
        token: L::Token,
        view: &View,
        rays: &[RayPacket<L::Array>],
        size: (f32, f32, f32),
    ) -> Self {
        match Self::of::<L, false>(token, view, rays, size) {
            Some(survey) => survey,
            None => L::out_of_line(
                token,
                #[inline(always)]
                || match Self::of::<L, true>(token, view, rays, size) {
                    Some(survey) => survey,
                    None => Self::NONE,
                },
            ),
        }
    }

    /// Returns `None` if a direction has no usual length, unless `ANY_LENGTH` is set.
    #[inline(always)]
    fn of<L: Lanes, const ANY_LENGTH: bool>(
        token: L::Token,
        view: &View,
        rays: &[RayPacket<L::Array>],
        (factor, extent, spread): (f32, f32, f32),
    ) -> Option<Self> {
        // The first live ray shows the way.
        let mut first = axes!(_i => f32::NAN);
        for packet in rays {
            let rays = RayLanes::<L>::load(token, packet);
            if rays.live.any() {
                let (n, lane) = (
                    prepared::<L, ANY_LENGTH>(view, &rays, factor).direction,
                    rays.live.bits().trailing_zeros(),
                );
                first = axes!(i => n[i].store().get(lane as usize));
                break;
            }
        }
        let (along, sign) = heading(first);
        let (k, [i, j]) = (along % 3, across(along));
        // Rays of a common direction have its slopes, and bound only offsets; others bound slopes.
        let common = [[first[i % 3] * (sign / first[k]); 2], [first[j % 3] * (sign / first[k]); 2]];
        let turned = Fit::along(along, sign, 0.0, spread).turned(common);
        let parallel = matches!(view, View::Parallel { .. });

        let none = L::splat(token, f32::NEG_INFINITY);
        let (mut minus_low, mut high) = ([none; 2], [none; 2]);
        let (mut minus_start, mut reach, mut error) = (none, none, none.like(0.0));
        let mut packets = 0;
        for packet in rays {
            count!(GroupPacket);
            let rays = RayLanes::<L>::load(token, packet);
            let prepared = prepared::<L, ANY_LENGTH>(view, &rays, factor);
            let PreparedLanes { origin, direction: n, absolute_error, covered, end, .. } = prepared;
            let (live, forward) = (rays.live, n[k] * none.like(sign));
            let forward_in_time = if ANY_LENGTH {
                prepared.forward(rays.t_min)
            } else {
                none.like(0.0).le(rays.t_min)
            };
            let fits = view.shares(&rays) & covered & forward_in_time;
            if (live & !(fits & none.like(ALONG).le(forward))).any() {
                if !ANY_LENGTH && (live & !covered).any() {
                    return None;
                }
                break;
            }
            let per_depth = none.like(sign) / n[k];
            for side in 0..2 {
                let axis = across(along)[side] % 3;
                let [low, up] = if parallel {
                    let ([low, up], o) = (turned[side], origin);
                    [o[axis] - o[k] * none.like(low), o[axis] - o[k] * none.like(up)]
                } else {
                    [n[axis] * per_depth; 2]
                };
                minus_low[side] = minus_low[side].filter_max(L::select(live, -low, none));
                high[side] = high[side].filter_max(L::select(live, up, none));
            }
            let start = origin[k] * none.like(-sign);
            minus_start = minus_start.filter_max(L::select(live, start, none));
            let reached = reaches(view, end[1], origin, absolute_error);
            reach = reach.filter_max(L::select(live, reached, none));
            error = error.filter_max(L::select(live, absolute_error, none));
            packets += 1;
        }

        let error = error.filter_greatest();
        let bounds = [
            [-minus_low[0].filter_greatest(), high[0].filter_greatest()],
            [-minus_low[1].filter_greatest(), high[1].filter_greatest()],
        ];
        let (slopes, offsets) = if parallel { (common, bounds) } else { (bounds, [[0.0; 2]; 2]) };
        let frustum = Frustum {
            sides: Fit::along(along, sign, error, spread).sides(slopes, offsets),
            sign,
            start: -minus_start.filter_greatest() - margin(0.0, error),
            end: f32::INFINITY,
        };
        let reach = reach.filter_greatest() + spread_of(spread, extent, error);
        let outline = Outline::in_list(spread, error);
        Some(Self { packets, frustum, reach, outline })
    }
}

/// Returns the rays in the frame, which have usual lengths unless `ANY_LENGTH` is set.
#[inline(always)]
fn prepared<L: Lanes, const ANY_LENGTH: bool>(
    view: &View,
    rays: &RayLanes<L>,
    factor: f32,
) -> PreparedLanes<L> {
    if ANY_LENGTH {
        PreparedLanes::of_any_length(&view.in_frame(rays), factor, None)
    } else {
        PreparedLanes::as_they_are(&view.scaled_in_frame(rays, factor))
    }
}
