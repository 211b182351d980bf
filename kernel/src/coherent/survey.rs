//! How far the rays of large groups of packets reach to the sides, and how deep they go.

use super::fit::{ALONG, Fit, heading, spread_of};
use super::frustum::{Frustum, across, margin};
use super::view::View;
use crate::accuracy::RayLanes;
use crate::bvh::traverse::prepared_ray::PreparedLanes;
use crate::geometry::ray::RayPacket;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::numeric::rounding::{least, most};

/// How many packets share the larger list.
pub(super) const LARGE: usize = 1024;
/// How many share the shorter one.
pub(super) const MIDDLE: usize = 64;

/// The bounds of a group's live rays; of none, the empty ones.
#[derive(Clone, Copy, Debug)]
pub(super) struct GroupBounds {
    /// The least and greatest slopes per depth of rays from a common origin, offsets of others.
    low: [f32; 2],
    high: [f32; 2],
    /// The least depth along the axis that a ray starts at.
    start: f32,
    /// The greatest depth of the list that a ray goes to.
    pub(super) reach: f32,
    /// The largest absolute error.
    error: f32,
}

impl GroupBounds {
    const EMPTY: Self = Self {
        low: [f32::INFINITY; 2],
        high: [f32::NEG_INFINITY; 2],
        start: f32::INFINITY,
        reach: f32::NEG_INFINITY,
        error: 0.0,
    };

    /// Bounds of both.
    fn and(self, other: &Self) -> Self {
        Self {
            low: [least(self.low[0], other.low[0]), least(self.low[1], other.low[1])],
            high: [most(self.high[0], other.high[0]), most(self.high[1], other.high[1])],
            start: least(self.start, other.start),
            reach: most(self.reach, other.reach),
            error: most(self.error, other.error),
        }
    }
}

/// How deep the rays of a packet go, raised by the margin: their s beyond that at which they start.
#[inline(always)]
pub(super) fn reaches<L: Lanes>(view: &View, best: L, origin: [L; 3], absolute_error: L) -> L {
    best + view.start_depth(origin) + absolute_error * absolute_error.like(16.0)
}

/// The bounds of a group, lane by lane.
#[derive(Clone, Copy, Debug)]
struct BoundLanes<L> {
    minus_low: [L; 2],
    high: [L; 2],
    minus_start: L,
    reach: L,
    error: L,
}

impl<L: Lanes> BoundLanes<L> {
    #[inline(always)]
    fn empty(token: L::Token) -> Self {
        let none = L::splat(token, f32::NEG_INFINITY);
        let zero = L::splat(token, 0.0);
        Self { minus_low: [none; 2], high: [none; 2], minus_start: none, reach: none, error: zero }
    }

    #[inline(always)]
    fn add(&mut self, view: &View, way: &Way, live: L::Mask, rays: &PreparedLanes<L>) {
        let PreparedLanes { origin, direction, absolute_error, .. } = *rays;
        let none = absolute_error.like(f32::NEG_INFINITY);
        let k = way.along % 3;
        let per_depth = none.like(way.sign) / direction[k];
        for side in 0..2 {
            let i = across(k)[side] % 3;
            let (low, high) = match way.slopes {
                None => {
                    let slope = direction[i] * per_depth;
                    (slope, slope)
                }
                Some((_, turned)) => {
                    let [low, high] = turned[side];
                    (
                        origin[i] - origin[k] * none.like(low),
                        origin[i] - origin[k] * none.like(high),
                    )
                }
            };
            self.minus_low[side] = self.minus_low[side].filter_max(L::select(live, -low, none));
            self.high[side] = self.high[side].filter_max(L::select(live, high, none));
        }
        let start = origin[k] * none.like(-way.sign);
        self.minus_start = self.minus_start.filter_max(L::select(live, start, none));
        let reach = reaches(view, rays.end[1], origin, absolute_error);
        self.reach = self.reach.filter_max(L::select(live, reach, none));
        self.error = self.error.filter_max(L::select(live, absolute_error, none));
    }

    #[inline(always)]
    fn bounds(&self) -> GroupBounds {
        GroupBounds {
            low: [-self.minus_low[0].filter_greatest(), -self.minus_low[1].filter_greatest()],
            high: [self.high[0].filter_greatest(), self.high[1].filter_greatest()],
            start: -self.minus_start.filter_greatest(),
            reach: self.reach.filter_greatest(),
            error: self.error.filter_greatest(),
        }
    }
}

/// Where the first live ray of a group runs, as the others must.
#[derive(Clone, Copy, Debug)]
struct Way {
    along: usize,
    sign: f32,
    /// Of a common direction: its slopes per depth, and those turned outward.
    slopes: Option<([[f32; 2]; 2], [[f32; 2]; 2])>,
}

impl Way {
    /// `None` if no ray of the packets is live.
    #[inline(always)]
    fn of<L: Lanes>(token: L::Token, view: &View, packets: &[RayPacket<L::Array>]) -> Option<Self> {
        for packet in packets {
            let rays = RayLanes::<L>::load(token, packet);
            let live = rays.live.bits();
            if live == 0 {
                continue;
            }
            let lane = live.trailing_zeros() as usize;
            let direction = PreparedLanes::as_they_are(&rays).direction;
            let n = axes!(i => direction[i].store().get(lane));
            let (along, sign) = heading(n);
            let slopes = match view {
                View::Perspective { .. } => None,
                View::Parallel { .. } => {
                    let per_depth = sign / n[along % 3];
                    let [i, j] = across(along);
                    let [a, b] = [n[i % 3] * per_depth, n[j % 3] * per_depth];
                    let slopes = [[a, a], [b, b]];
                    Some((slopes, Fit::along(along, sign, 0.0, 0.0).turned(slopes)))
                }
            };
            return Some(Self { along, sign, slopes });
        }
        None
    }

    /// Whether all rays of a packet are covered and run this way.
    #[inline(always)]
    fn fits<L: Lanes>(&self, view: &View, rays: &RayLanes<L>, prepared: &PreparedLanes<L>) -> bool {
        let forward = prepared.direction[self.along % 3] * rays.t_min.like(self.sign);
        let fits = view.shares(rays)
            & prepared.covered
            & rays.t_min.like(0.0).le(rays.t_min)
            & forward.like(ALONG).le(forward);
        !(rays.live & !fits).any()
    }
}

/// The packets, at the front of some, that make up a large group, and the bounds of its parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Survey {
    way: Way,
    /// How many.
    pub(super) packets: usize,
    pub(super) bounds: [GroupBounds; LARGE / MIDDLE],
}

impl Survey {
    /// `None` if not even the first packet's rays fit, or no ray of a whole group is live.
    #[inline(always)]
    pub(super) fn new<L: Lanes>(
        token: L::Token,
        view: &View,
        packets: &[RayPacket<L::Array>],
    ) -> Option<Self> {
        let packets = packets.get(..LARGE).unwrap_or(packets);
        let way = Way::of::<L>(token, view, packets)?;
        let mut survey = Self { way, packets: 0, bounds: [GroupBounds::EMPTY; LARGE / MIDDLE] };
        for (packets, bounds) in packets.chunks(MIDDLE).zip(&mut survey.bounds) {
            let mut lanes = BoundLanes::<L>::empty(token);
            let before = survey.packets;
            for packet in packets {
                let rays = RayLanes::<L>::load(token, packet);
                let prepared = PreparedLanes::as_they_are(&view.in_frame(&rays));
                if !way.fits(view, &rays, &prepared) {
                    break;
                }
                lanes.add(view, &way, rays.live, &prepared);
                survey.packets += 1;
            }
            *bounds = lanes.bounds();
            if survey.packets < before + MIDDLE {
                break;
            }
        }
        (survey.packets > 0).then_some(survey)
    }

    /// The bounds of all packets.
    #[inline(always)]
    pub(super) fn all(&self) -> GroupBounds {
        let mut all = GroupBounds::EMPTY;
        for bounds in &self.bounds {
            all = all.and(bounds);
        }
        all
    }

    /// What a group with such bounds cannot leave, in a scene of that extent, and how deep it goes.
    #[inline(always)]
    pub(super) fn frustum(&self, bounds: &GroupBounds, extent: f32, spread: f32) -> (Frustum, f32) {
        let GroupBounds { low, high, start, reach, error } = *bounds;
        let screen = [[low[0], high[0]], [low[1], high[1]]];
        let (slopes, offsets) = match self.way.slopes {
            None => (screen, [[0.0; 2]; 2]),
            Some((slopes, _)) => (slopes, screen),
        };
        let fit = Fit::along(self.way.along, self.way.sign, error, spread);
        let frustum = Frustum {
            sides: fit.sides(slopes, offsets),
            sign: fit.sign,
            start: start - margin(0.0, error),
            end: f32::INFINITY,
        };
        (frustum, reach + spread_of(spread, extent, error))
    }
}

/// How many packets there are until one whose rays all fit; at least one.
#[inline(always)]
pub(super) fn unfit<L: Lanes>(
    token: L::Token,
    view: &View,
    packets: &[RayPacket<L::Array>],
) -> usize {
    let mut count = 1;
    for packet in packets.iter().skip(1) {
        if let Some(way) = Way::of::<L>(token, view, core::slice::from_ref(packet)) {
            let rays = RayLanes::<L>::load(token, packet);
            let prepared = PreparedLanes::as_they_are(&view.in_frame(&rays));
            if way.fits(view, &rays, &prepared) {
                break;
            }
        }
        count += 1;
    }
    count
}
