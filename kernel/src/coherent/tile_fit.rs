//! The planes around tiles of a camera, by their corner pixels alone.
//!
//! # Method
//!
//! The points of a camera's pixels are an affine function of their indices. So are the origins of a parallel projection,
//! and the offsets of planes of one slope. In perspective a slope is the quotient of two such functions. Neither an offset nor a slope is
//! larger within a tile than at one of its four corner pixels, as long as the divisor keeps its sign.
//! Rounding moves each point by up to `CameraTiles::point_error`. Slopes, or offsets, are moved outward by what
//! that can amount to, at a corner and at the pixel that it bounds. Four tiles are done at once, a lane each; only the
//! first ray is looked at. Proof: `docs/traversal-margins.md`.

use super::fit::{ALONG, Fit, greatest_of, heading, spread_of};
use super::frustum::{Frustum, Sides, across, margin, turn};
use super::packet_group::GROUP;
use super::packet_state::PacketState;
use crate::geometry::camera::Projection;
use crate::geometry::camera::tiles::CameraTiles;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::{axes, dot};
use wide::f32x4;

/// How often the error of a point counts: at a corner and at a pixel, and a quarter of both for what is of second order.
pub(crate) const ERRORS: f32 = 2.5;
/// The error of a point is at most such a part of the least depth.
pub(crate) const SMALL: f32 = 1.0 / 64.0;
/// 2^100: with a larger error a point may not be finite.
const MOST_ERROR: f32 = (1_u128 << 100) as f32;
/// 14^2: where |n_k| is at least 1/14 at the corners, it is at least 1/16 in between.
const STRAIGHT: f32 = 196.0;
/// Slopes that are moved by a larger part of their range would make planes too wide: then rays are looked at.
const WIDE: f32 = 1.0 / 16.0;

/// Least and greatest of each axis across, a lane a tile; the least with the sign changed, so that each is a maximum.
type Ranges = [[f32x4; 2]; 2];

/// Returns what the rays of whole tiles cannot leave, and sets the planes around each packet. Returns `None` if corners do not tell:
/// rays are not covered, or were moved, or run too far aslant, or rounding moves them by too much.
#[inline(always)]
pub(super) fn enclose<L: Lanes>(
    tiles: &CameraTiles<'_>,
    corners: &[(u32, u32)],
    states: &mut [PacketState<'_, L>],
    (factor, extent, spread, narrow): (f32, f32, f32, f32),
) -> Option<(Fit, Frustum)> {
    for state in states.iter() {
        if !state.covered || state.moved {
            return None;
        }
    }
    let rays = states.first()?.rays;
    let is_parallel = matches!(tiles.camera.projection, Projection::Parallel { .. });
    let [origin, direction] =
        [axes!(i => rays.origin[i].store().get(0)), axes!(i => rays.direction[i].store().get(0))];
    let points = Points {
        at_corners: tiles.corner_points::<L::Array>(corners),
        error: tiles.point_error(),
        heading: heading(direction),
    };
    let (along, sign) = points.heading;
    let k = along % 3;
    // A point that is not finite would spoil the planes of all.
    let error = points.error_together();
    if error.is_nan() || error > MOST_ERROR {
        return None;
    }

    let slopes = if is_parallel {
        shared_slopes(direction, points.heading)?
    } else {
        points.slopes(L::COUNT > 1)?
    };
    let error = greatest_of!(states, s => s.rays.absolute_error);
    let fit = Fit::along(along, sign, error, spread_of(spread, extent, error));

    // Each packet's planes. Slopes are moved once more, for rays, and become slopes per x_k, as in `Fit::sides`.
    let (signs, steepest) = (f32x4::splat(sign), steepest(&slopes));
    let turn = turn(steepest);
    let margins = margin(steepest, f32x4::splat(error));
    let mut turned = slopes;
    for side in 0..2 {
        turned[side] = [-signs * (slopes[side][0] + turn), signs * (slopes[side][1] + turn)];
    }
    let offsets = if is_parallel {
        points.offsets(&turned, steepest, factor, margins)
    } else {
        offsets_from(origin, k, &turned, margins)
    };
    let sides = Sides::of_each(k, turned, offsets);
    for packet in 0..GROUP {
        if let Some(state) = states.get_mut(packet) {
            state.sides = sides[packet];
        }
    }

    // The planes around all packets together.
    let mut all = [[0.0; 2]; 2];
    for side in 0..2 {
        all[side] = [-slopes[side][0].filter_greatest(), slopes[side][1].filter_greatest()];
        if all[side][1] - all[side][0] > narrow {
            return None;
        }
    }
    let turned = fit.turned(all);
    let (sides, start) = if is_parallel {
        let mut farthest = [[0.0; 2]; 2];
        for side in 0..2 {
            let [low, high] = offsets[side];
            farthest[side] = [-(-low).filter_greatest(), high.filter_greatest()];
        }
        (Sides::new(k, turned, farthest), points.start(factor))
    } else {
        let mut offsets = [[0.0; 2]; 2];
        for side in 0..2 {
            let (axis, [low, high]) = (across(k)[side] % 3, turned[side]);
            offsets[side] = [origin[axis] - low * origin[k], origin[axis] - high * origin[k]];
        }
        (fit.sides(all, offsets), sign * origin[k])
    };
    // Rays of a camera do not end.
    Some((fit, Frustum { sides, sign, start: start - margin(0.0, error), end: f32::MAX }))
}

/// The points of the corner pixels of tiles, a lane a tile: directions in perspective, origins in parallel projection. (With a record
/// for each tile u64 runs at 0.77 of the speed, AVX-512.)
pub(crate) struct Points {
    pub(crate) at_corners: [[f32x4; 3]; 4],
    /// How far a point may be off.
    pub(crate) error: [f32; 3],
    /// The axis that the rays run along, and which way.
    pub(crate) heading: (usize, f32),
}

impl Points {
    /// For points that are directions: returns the slopes per depth; `None` if one runs too far aslant for its rays, or is off by too
    /// much. Their range is checked only `if_wide`, since the range of one pixel is zero.
    #[inline(always)]
    pub(crate) fn slopes(&self, if_wide: bool) -> Option<Ranges> {
        let (k, sign) = (self.heading.0 % 3, f32x4::splat(self.heading.1));
        let (zero, none) = (f32x4::ZERO, f32x4::splat(f32::NEG_INFINITY));
        let (mut fits, mut minus_nearest) = (zero.le(zero), none);
        let mut slopes = [[none; 2]; 2];
        for corner in 0..4 {
            let d = self.at_corners[corner];
            let depth = d[k] * sign;
            let straight = dot(d, d).le(depth * depth * f32x4::splat(STRAIGHT));
            fits = fits & zero.lt(depth) & straight;
            minus_nearest = minus_nearest.filter_max(-depth);
            let per_depth = f32x4::ONE / depth;
            for side in 0..2 {
                let slope = d[across(k)[side] % 3] * per_depth;
                let [minus_low, high] = slopes[side];
                slopes[side] = [minus_low.filter_max(-slope), high.filter_max(slope)];
            }
        }
        let error = f32x4::splat(self.error_together());
        fits = fits & error.le(-minus_nearest * f32x4::splat(SMALL));

        let steepest = steepest(&slopes);
        let per_depth = f32x4::splat(-ERRORS) / minus_nearest;
        for side in 0..2 {
            let off = self.off(side, steepest) * per_depth;
            // Neither `off` nor a slope is a number if a depth has no inverse.
            fits = fits & off.lt(f32x4::splat(f32::INFINITY));
            let [minus_low, high] = slopes[side];
            if if_wide {
                fits = fits & off.le((minus_low + high) * f32x4::splat(WIDE));
            }
            slopes[side] = [minus_low + off, high + off];
        }
        if fits.bits() == 15 { Some(slopes) } else { None }
    }

    /// For points that are origins: returns the offsets of planes of those slopes, moved outward by the margins, too.
    #[inline(always)]
    pub(crate) fn offsets(
        &self,
        slopes: &Ranges,
        steepest: f32x4,
        factor: f32,
        margins: f32x4,
    ) -> Ranges {
        let (k, scale) = (self.heading.0 % 3, f32x4::splat(factor));
        let none = f32x4::splat(f32::NEG_INFINITY);
        let mut offsets = [[none; 2]; 2];
        for side in 0..2 {
            let [low, high] = slopes[side];
            let (mut minus_least, mut greatest) = (none, none);
            for corner in 0..4 {
                let point = self.at_corners[corner];
                let (across, along) = (point[across(k)[side] % 3] * scale, point[k] * scale);
                minus_least = minus_least.filter_max(along * low - across);
                greatest = greatest.filter_max(across - along * high);
            }
            let moved = self.off(side, steepest) * f32x4::splat(ERRORS * factor) + margins;
            offsets[side] = [-(minus_least + moved), greatest + moved];
        }
        offsets
    }

    /// For points that are origins: returns the least depth.
    #[inline(always)]
    fn start(&self, factor: f32) -> f32 {
        let (along, sign) = self.heading;
        let mut minus_start = f32x4::splat(f32::NEG_INFINITY);
        for corner in 0..4 {
            let depth = self.at_corners[corner][along % 3] * f32x4::splat(factor * sign);
            minus_start = minus_start.filter_max(-depth);
        }
        -minus_start.filter_greatest() - ERRORS * factor * self.error[along % 3]
    }

    /// Returns at least the largest of the errors; NaN if one is NaN.
    #[inline(always)]
    fn error_together(&self) -> f32 {
        let [x, y, z] = self.error;
        x + y + z
    }

    /// Returns e_i + |w| e_k, for the errors e of a point and a slope w.
    #[inline(always)]
    fn off(&self, side: usize, slope: f32x4) -> f32x4 {
        let k = self.heading.0 % 3;
        f32x4::splat(self.error[across(k)[side] % 3]) + slope * f32x4::splat(self.error[k])
    }
}

/// Returns the slopes of a common unit direction; `None` if it runs too far aslant.
#[inline(always)]
fn shared_slopes(direction: [f32; 3], (along, sign): (usize, f32)) -> Option<Ranges> {
    let depth = direction[along % 3] * sign;
    if depth.is_nan() || depth < ALONG {
        return None;
    }
    let mut slopes = [[f32x4::ZERO; 2]; 2];
    for side in 0..2 {
        let slope = f32x4::splat(direction[across(along % 3)[side] % 3] * (1.0 / depth));
        slopes[side] = [-slope, slope];
    }
    Some(slopes)
}

/// Returns the offsets of planes of those slopes around a common origin.
#[inline(always)]
fn offsets_from(origin: [f32; 3], along: usize, slopes: &Ranges, margins: f32x4) -> Ranges {
    let mut offsets = *slopes;
    let depth = f32x4::splat(origin[along % 3]);
    for side in 0..2 {
        let (across, [low, high]) = (f32x4::splat(origin[across(along)[side] % 3]), slopes[side]);
        offsets[side] = [across - low * depth - margins, across - high * depth + margins];
    }
    offsets
}

/// The largest magnitude of the slopes of each tile.
#[inline(always)]
fn steepest(slopes: &Ranges) -> f32x4 {
    let [[a, b], [c, d]] = *slopes;
    let (a, b) = (a.filter_max(-a), b.filter_max(-b));
    let (c, d) = (c.filter_max(-c), d.filter_max(-d));
    a.filter_max(b).filter_max(c.filter_max(d))
}
