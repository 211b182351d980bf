//! Rays whose squares may overflow in a tier.
//!
//! A tier sees no hit where its squares overflow, but bounds see that a sphere is surely hit. There no root is sure: every candidate is the
//! tier's to decide, and a tree or depth list answers as a list does.

use super::prepared_ray::{ABSOLUTE_ERROR, PreparedLanes, WORTH_IT};
use crate::accuracy::Squares;
use crate::lanes::Lanes;

/// 2^61. No coordinate of p and no radius is larger than a size: |p|^2 is at most 3 size^2. `Stable` brings |d|^2 below 12 (48 from 2^127 on),
/// and computes a r^2 and a times the square of a line's distance, which is no larger where a hit is sure. In `Fast`, b^2 and a c are at most
/// 4 size^2 times |d|^2 as given.
const LARGEST: f32 = (1_u64 << 61) as f32;

impl<L: Lanes> PreparedLanes<L> {
    /// The rays whose squares may overflow, in a scene of that extent that is scaled by `factor`.
    #[inline(always)]
    pub(crate) fn overflowing(&self, squares: Squares, factor: f32, extent: f32) -> L::Mask {
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

    /// The same rays, but no root of those is sure.
    #[inline(always)]
    pub(crate) fn left_to_tier(mut self, rays: L::Mask) -> Self {
        let infinity = self.absolute_error.like(f32::INFINITY);
        self.start[1] = L::select(rays, infinity, self.start[1]);
        self.end[0] = L::select(rays, -infinity, self.end[0]);
        self
    }
}
