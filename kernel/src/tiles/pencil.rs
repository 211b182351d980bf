//! What the rays of a group cannot leave: a pyramid from their common origin, or a prism along their
//! common direction.
//!
//! # Method
//!
//! Let x be places from where the viewpoint is: the common origin, or zero. The rays run the same way
//! along an axis k, with |n_i| <= 2 |n_k| on the two others. From a common origin their points have
//! x_i / x_k between the least and the greatest slope d_i / d_k, so they lie inside four planes
//! through it, x_i - low x_k >= 0 and so on. With a common direction of slope m_i, x_i - m_i x_k stays
//! what it is at the origin of the ray, so the planes are x_i - m_i x_k >= low (Reshetov, Soupikov and
//! Hurley 2005, Multi-Level Ray Tracing Algorithm). A fifth plane is where the rays start. A sphere
//! is outside where its centre is by more than its reach times the length of the normal.
//!
//! # The margin
//!
//! u = 2^-24, P = |p| + r with p = c - o, X = |x| + r and O = |o| seen from the viewpoint: P <= X + O, and O = 0
//! for a common origin. Let a tier answer t, a valid hit. Points of the line are o + s v, s = t |d|,
//! |v| = 1 within 4u.
//!
//! | | in P u |
//! |---|---|
//! | the line passes the centre at r + 16 P u at most (`Stable`: l^2 <= r^2 + 2^-40 (p^2 + r^2), `filter.rs`), and t |d| is 16 P u off (`accuracy/beyond.rs`), or less | 32 |
//! | x = c - o, rounded | 1 |
//! | x_i - m x_k as computed, \|m\| <= 2: 2u of \|x_i\| + 2 \|x_k\| <= sqrt 5 \|x\| | 5 |
//! | for a common direction: the same of o; m, 2u off, over the way to the hit | 7 |
//! | the reach times the normal's length, their sum, by which the rest is lowered | 3 |
//! | **together** | **48** |
//!
//! (Slopes from a common origin are 2u off and moved by 8u.) The reach is r + 64 u X, and of a common
//! direction 64 u O more, taken of the greatest O of the group, as 128 times the largest coordinate;
//! 2^-60 covers what underflows. `Fast` is as if r were up to SPREAD P larger besides
//! (`Accuracy::SPREAD`).
//!
//! The margin of one ray against one sphere (`tiles/packet.rs`) is that of `bvh/bracket.rs`: with its S <= P
//! the 48 u S there is less than the reach has more than r. So is that of the depth: |x| is 4u off, |x| - r
//! one more, and x.n 5u. The answer lies at |s| >= |p| - r and at |s| >= r - |p| but for 32 u P,
//! and at s >= p.n - r.
//!
//! Nothing overflows: x up to 2^42, reaches up to 2^43, d.d within [2^-100, 2^100].

use super::list::ListLanes;
use crate::axes::axes;
use crate::bvh::slabs::U;
use crate::{Accuracy, Lanes};

/// What the reach is raised by, of |x| + r.
pub(super) const MARGIN: f32 = 64.0 * U;
/// 2^-60.
pub(super) const LEAST_MARGIN: f32 = 1.0 / (1_073_741_824.0 * 1_073_741_824.0);

/// Two planes across the same axis: what is inside has x_i - slopes[0] x_k >= offsets[0] and
/// x_i - slopes[1] x_k <= offsets[1].
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    slopes: [f32; 2],
    offsets: [f32; 2],
    /// The lengths of the normals, rounded up.
    lengths: [f32; 2],
}

impl Side {
    #[inline(always)]
    pub(super) fn new(slopes: [f32; 2], offsets: [f32; 2]) -> Self {
        let [low, high] = slopes;
        let raised = 1.0 + 8.0 * U;
        let lengths =
            [libm::sqrtf(1.0 + low * low) * raised, libm::sqrtf(1.0 + high * high) * raised];
        Self { slopes, offsets, lengths }
    }

    #[inline(always)]
    fn may_meet<L: Lanes>(&self, across: L, along: L, reach: L) -> L::Mask {
        let [low, high] = self.slopes;
        let [low_length, high_length] = self.lengths;
        let above = along.filter_mul_add(along.like(-low), across);
        let below = along.filter_mul_add(along.like(-high), across);
        let above = reach.filter_mul_add(reach.like(low_length), above);
        let below = reach.filter_mul_add(reach.like(-high_length), below);
        reach.like(self.offsets[0]).le(above) & below.le(reach.like(self.offsets[1]))
    }
}

/// What the rays of a group cannot leave.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pencil {
    /// The axes across, and the one along.
    pub(super) axes: [usize; 3],
    pub(super) sides: [Side; 2],
    /// Of the plane that the rays start in, turned as the axes are.
    pub(super) normal: [f32; 3],
    pub(super) front: f32,
    /// What reaches are raised by, for the origins.
    pub(super) pad: f32,
    /// No ray goes deeper.
    pub(super) end: f32,
}

impl Pencil {
    /// Which spheres may be met.
    #[inline(always)]
    pub(super) fn may_meet<A: Accuracy, L: Lanes>(&self, lanes: &ListLanes<L>) -> L::Mask {
        let [x, y, along] = lanes.center;
        let reach = raised_reach::<A, L>(lanes.center, lanes.reach, along.like(self.pad));
        let [n_x, n_y, n_along] = axes!(i => along.like(self.normal[i]));
        let ahead =
            x.filter_mul_add(n_x, y.filter_mul_add(n_y, along.filter_mul_add(n_along, reach)));
        self.sides[0].may_meet(x, along, reach)
            & self.sides[1].may_meet(y, along, reach)
            & along.like(self.front).le(ahead)
            & lanes.depth.le(along.like(self.end))
    }
}

/// The reach for rays of a group with that `pad`.
#[inline(always)]
pub(super) fn raised_reach<A: Accuracy, L: Lanes>(center: [L; 3], reach: L, pad: L) -> L {
    let padded = reach + pad;
    if A::SPREAD > 0.0 {
        let size = center[0].abs() + center[1].abs() + center[2].abs() + reach;
        return size.filter_mul_add(size.like(A::SPREAD), padded);
    }
    padded
}
