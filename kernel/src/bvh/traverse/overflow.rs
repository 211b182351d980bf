//! Rays whose squares may overflow in a tier.
//!
//! A tier sees no hit where its squares overflow, but bounds see that a sphere is surely hit. There no root is sure: every candidate is the
//! tier's to decide, and a tree or depth list answers as a list does.

use super::prepared_ray::{ABSOLUTE_ERROR, PreparedLanes, WORTH_IT};
use crate::accuracy::{RayLanes, Squares};
use crate::lanes::Lanes;

/// 2^61. No coordinate of p and no radius is larger than a size: |p|^2 is at most 3 size^2. `Stable` brings |d|^2 below 12 (48 from 2^127 on),
/// and computes a r^2 and a times the square of a line's distance, which is no larger where a hit is sure. In `Fast`, b^2 and a c are at most
/// 4 size^2 times |d|^2 as given.
const LARGEST: f32 = (1_u64 << 61) as f32;

impl<L: Lanes> PreparedLanes<L> {
    /// Prepares rays of any length and place, for a scene that is scaled by `factor`, and a tier that squares that much: if it `moves`
    /// rays, from nearer, where they begin far away from a scene of that extent. No root is sure of rays whose squares may overflow.
    #[inline(always)]
    pub(crate) fn of_any_size(
        rays: &RayLanes<L>,
        (factor, extent): (f32, f32),
        (squares, moves): (Squares, bool),
    ) -> Self {
        let nearer_to = if moves { Some(extent) } else { None };
        let mut prepared = Self::of_any_length(rays, factor, nearer_to);
        let overflowing = prepared.overflowing(squares, factor, extent);
        let infinity = prepared.absolute_error.like(f32::INFINITY);
        prepared.start[1] = L::select(overflowing, infinity, prepared.start[1]);
        prepared.end[0] = L::select(overflowing, -infinity, prepared.end[0]);
        prepared
    }

    /// The rays whose squares may overflow, in a scene of that extent that is scaled by `factor`.
    #[inline(always)]
    fn overflowing(&self, squares: Squares, factor: f32, extent: f32) -> L::Mask {
        // At least the largest coordinate of where a ray is taken from, and of the scene. (`Stable`, whose rays may be moved, squares distances
        // from the line there, not from where the ray begins.)
        let error = self.absolute_error;
        let per_error = error.like(1.0 / ABSOLUTE_ERROR / L::UNIT_ROUNDOFF);
        let size = error.filter_mul_add(per_error, error.like(extent));
        let most = error.like(LARGEST * factor);
        match squares {
            Squares::None => L::mask(error.token(), 0),
            Squares::OfPoints => !size.le(most),
            Squares::OfPointsAndDirections => {
                let per_factor = error.like(1.0 / factor);
                let length = self.time.length * self.time.per_t * per_factor;
                let longest = error.like(LARGEST);
                !(size.le(most) & length.le(longest) & (length * size).le(most))
            }
        }
    }

    /// All of these, and perhaps others, among rays that are not [far away](super::prepared_ray::far_away).
    #[inline(always)]
    pub(crate) fn may_overflow(&self, squares: Squares, factor: f32, extent: f32) -> L::Mask {
        let token = self.absolute_error.token();
        match squares {
            Squares::None => L::mask(token, 0),
            Squares::OfPoints => {
                let overflows = 2.0 * WORTH_IT * extent > LARGEST * factor;
                L::mask(token, if overflows { u32::MAX } else { 0 })
            }
            // Out of line, since only directions of two tiers ask for it.
            Squares::OfPointsAndDirections => L::out_of_line(
                token,
                #[inline(always)]
                || self.overflowing(squares, factor, extent),
            ),
        }
    }
}
