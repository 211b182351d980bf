//! Where the rays of a group run, and the planes around them.

use super::frustum::{Frustum, Sides, across, margin, turn};
use super::packet_state::PacketState;
use crate::bvh::traverse::prepared_ray::ABSOLUTE_ERROR;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::numeric::rounding::{U, least, most};

/// The least |n_k|.
pub(super) const ALONG: f32 = 1.0 / 16.0;

/// The largest value of an expression in the live lanes of some packets; `-inf` if none is live.
macro_rules! greatest_of {
    ($states:expr, $state:ident => $value:expr) => {{
        let mut lanes = None;
        for $state in $states.iter() {
            let value: L = $value;
            let value = L::select($state.live, value, value.like(f32::NEG_INFINITY));
            lanes = Some(match lanes {
                Some(so_far) => value.filter_max(so_far),
                None => value,
            });
        }
        match lanes {
            Some(lanes) => lanes.filter_greatest(),
            None => f32::NEG_INFINITY,
        }
    }};
}
pub(super) use greatest_of;

/// Where the rays of a group run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    /// The axis that all rays run along.
    pub(super) along: usize,
    /// Which way along: 1 or -1.
    pub(super) sign: f32,
    /// The largest of [`PreparedLanes::absolute_error`](crate::bvh::traverse::prepared_ray::PreparedLanes).
    pub(super) absolute_error: f32,
    /// What the spread of a tier adds to depths.
    pub(super) spread: f32,
    /// The point in which all rays start, if there is one.
    origin: Option<[f32; 3]>,
}

/// Returns the axis that a direction runs along, and which way: 1 or -1.
#[inline(always)]
pub(super) fn heading([x, y, z]: [f32; 3]) -> (usize, f32) {
    let (along, travel) = if x.abs() >= y.abs() && x.abs() >= z.abs() {
        (0, x)
    } else if y.abs() >= z.abs() {
        (1, y)
    } else {
        (2, z)
    };
    (along, if travel < 0.0 { -1.0 } else { 1.0 })
}

impl Fit {
    /// For rays along an axis, whose origins are not known here.
    #[inline(always)]
    pub(super) fn along(along: usize, sign: f32, absolute_error: f32, spread: f32) -> Self {
        Self { along, sign, absolute_error, spread, origin: None }
    }

    /// Returns `None` if not all rays run the same way, and far enough, along an axis; `extent` is that of the scene,
    /// `spread` that of the tier.
    #[inline(always)]
    pub(super) fn of<L: Lanes>(
        states: &[PacketState<'_, L>],
        extent: f32,
        spread: f32,
    ) -> Option<Self> {
        let mut first = None;
        for state in states {
            if !state.covered {
                return None;
            }
            if first.is_none() && state.live.any() {
                first = Some((state, state.live.bits().trailing_zeros() as usize));
            }
        }
        let (state, lane) = first?;
        let (along, sign) = heading(axes!(i => state.rays.direction[i].store().get(lane)));
        let origin = axes!(i => state.rays.origin[i].store().get(lane));

        let mut one_origin = true;
        for state in states {
            let (live, o) = (state.live, state.rays.origin);
            let forward = state.rays.direction[along % 3] * o[0].like(sign);
            if (live & forward.lt(forward.like(ALONG))).any() {
                return None;
            }
            let [x, y, z] = axes!(i => {
                let shared = o[i].like(origin[i]);
                o[i].lt(shared) | shared.lt(o[i])
            });
            one_origin = one_origin && !state.moved && !(live & (x | y | z)).any();
        }
        // From one point, too: a step of t, which is part of the error, is as long as a ray's direction.
        let error = greatest_of!(states, s => s.rays.absolute_error);
        let spread = spread_of(spread, extent, error);
        let origin = one_origin.then_some(origin);
        Some(Self { along, sign, absolute_error: error, spread, origin })
    }

    /// Moves slopes per depth outward, and returns them as slopes per x_k.
    #[inline(always)]
    pub(super) fn turned(&self, slopes: [[f32; 2]; 2]) -> [[f32; 2]; 2] {
        let turn = turn(steepest(slopes));
        let [[a, b], [c, d]] = slopes;
        let sign = self.sign;
        [[sign * (a - turn), sign * (b + turn)], [sign * (c - turn), sign * (d + turn)]]
    }

    /// The planes around rays with `slopes` per depth, and least and greatest offsets from the slopes
    /// [`turned`](Self::turned).
    #[inline(always)]
    pub(super) fn sides(&self, slopes: [[f32; 2]; 2], offsets: [[f32; 2]; 2]) -> Sides {
        let margin = margin(steepest(slopes), self.absolute_error);
        let [[a, b], [c, d]] = offsets;
        let offsets = [[a - margin, b + margin], [c - margin, d + margin]];
        Sides::new(self.along, self.turned(slopes), offsets)
    }

    /// The planes around some packets with `slopes`.
    #[inline(always)]
    fn sides_of<L: Lanes>(&self, states: &[PacketState<'_, L>], slopes: [[f32; 2]; 2]) -> Sides {
        let (k, turned) = (self.along % 3, self.turned(slopes));
        let mut offsets = [[0.0; 2]; 2];
        for side in 0..2 {
            let (i, [low, high]) = (across(k)[side] % 3, turned[side]);
            offsets[side] = match self.origin {
                Some(origin) => [origin[i] - low * origin[k], origin[i] - high * origin[k]],
                None => [
                    -greatest_of!(states, s => {
                        s.rays.origin[k] * s.rays.absolute_error.like(low) - s.rays.origin[i]
                    }),
                    greatest_of!(states, s => {
                        s.rays.origin[i] - s.rays.origin[k] * s.rays.absolute_error.like(high)
                    }),
                ],
            };
        }
        self.sides(slopes, offsets)
    }

    /// Returns what the rays cannot leave, and sets the planes around each packet. Returns `None` if the slopes of the rays
    /// differ by more than `narrow`.
    #[inline(always)]
    pub(super) fn enclose<L: Lanes>(
        &self,
        states: &mut [PacketState<'_, L>],
        narrow: f32,
    ) -> Option<Frustum> {
        let k = self.along % 3;
        let mut all = [[f32::INFINITY, f32::NEG_INFINITY]; 2];
        for state in &mut *states {
            let per_depth = state.rays.absolute_error.like(self.sign) / state.rays.direction[k];
            let mut slopes = all;
            for side in 0..2 {
                let slope = state.rays.direction[across(k)[side] % 3] * per_depth;
                let none = slope.like(f32::NEG_INFINITY);
                let high = L::select(state.live, slope, none).filter_greatest();
                let low = -L::select(state.live, -slope, none).filter_greatest();
                slopes[side] = [low, high];
                all[side] = [least(all[side][0], low), most(all[side][1], high)];
            }
            state.sides = self.sides_of(core::slice::from_ref(&*state), slopes);
        }
        if all[0][1] - all[0][0] > narrow || all[1][1] - all[1][0] > narrow {
            return None;
        }
        let start = match self.origin {
            Some(origin) => self.sign * origin[k],
            None => {
                -greatest_of!(states, s => s.rays.origin[k] * s.rays.absolute_error.like(-self.sign))
            }
        };
        Some(Frustum {
            sides: self.sides_of(states, all),
            sign: self.sign,
            start: start - margin(0.0, self.absolute_error),
            end: self.end(states),
        })
    }

    /// The greatest depth that a ray still goes to, raised by the margin.
    #[inline(always)]
    pub(super) fn end<L: Lanes>(&self, states: &[PacketState<'_, L>]) -> f32 {
        let k = self.along % 3;
        let end = greatest_of!(states, s => {
            (s.best * s.rays.direction[k] + s.rays.origin[k]) * s.rays.absolute_error.like(self.sign)
        });
        // Where no ray goes on, the end is -inf.
        let raise = 16.0 * U * end.abs().min(f32::MAX);
        end + raise + 2.0 * margin(0.0, self.absolute_error) + self.spread
    }
}

/// What the spread of a tier adds to depths in a scene of that extent.
#[inline(always)]
pub(super) fn spread_of(spread: f32, extent: f32, absolute_error: f32) -> f32 {
    4.0 * spread * (extent + absolute_error * (1.0 / ABSOLUTE_ERROR / U))
}

/// The largest magnitude of four slopes.
#[inline(always)]
fn steepest([[a, b], [c, d]]: [[f32; 2]; 2]) -> f32 {
    a.abs().max(b.abs()).max(c.abs().max(d.abs()))
}
