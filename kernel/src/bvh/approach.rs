//! Rays as the tree sees them: directions of unit length, and no start that is far away.
//!
//! # Method
//!
//! The direction is brought to unit length, n = d / |d|. What a filter computes from a ray's origin
//! is off by some u of the distance to it: from 10^4 scene sizes away by as much as small spheres are
//! wide. But the line does not change if it is thought to begin elsewhere. So a ray that starts far
//! from the scene is taken from o' = o + tau d, two scene sizes before the point where it is nearest to
//! the coordinates' origin, and the parameter from there: s = |d| (t - tau). Other rays have
//! tau = 0 and o' = o. The tiers are asked with the ray as it is: no answer changes.
//!
//! # Errors
//!
//! u = 2^-24, first order; F is the largest coordinate of o', T = |tau d|, E the extent of the tree.
//!
//! *o'.* With tau d_i = high + low and o_i + high = sum + error, both exact, o'_i is sum + (error + low), where
//! |error| is below u (F + u T) and |low| below u T: o'_i is u F + 2 u^2 T off. Products below 2^-102 are
//! a few 2^-149 off besides.
//!
//! *s.* t - tau is one rounding, of the difference; |d| as rounded is 2.5u off, the product 1u:
//! below 5u of s, which the ends of an interval are moved by 8u for, and by 2^-80 for half of 2^-149
//! times |d|.
//!
//! *Forward.* Everything in the tree lies at s > 0 of a ray that was moved. A point x of it has |x| <= sqrt 3 E,
//! so x.n >= -1.74 E. With far the largest coordinate of o, o' is to be 2 E + 32 u far before the nearest
//! point. The distance to that, -o.n, is 7.5u |o| off, the difference and the quotient add 5.5u: with
//! |o| <= 1.74 far together 23 u far. So o'.n < -2 E - 9 u far, which is less than x.n.
//!
//! # How far off a tier is
//!
//! P = |p| + r with p = c - o, and so P <= |c - o'| + T + r: a tier's error does not know of o'. In
//! `Stable`, q is the centre from a point of the line near the closest one; u^2 P is its error
//! beside 2u |q|, since every number is kept in two terms.
//!
//! | tier | calls a line a hit only where, and always but where, its distance l from the centre is |
//! |---|---|
//! | `Exact` | l <= r |
//! | `Stable`, the first discriminant: believed where it exceeds 2^-5 (q^2 + r^2), and 26 u q^2 + 10 u r^2 + 28 u^2 \|p\| \|q\| off, so wrong only where \|q\| and r are below 2^-38 \|p\| | r -+ 2^-37 P |
//! | `Stable`, the second: u^2 (122 l^2 + 36 r^2 + 28 l \|p\|) + (14 u^2 \|p\|)^2 off | r -+ 2^-41 P |
//!
//! Generously r -+ 2^-36 P. And along the ray, of the root that it stands for, the answer s = |d| t is off:
//!
//! | tier | at most |
//! |---|---|
//! | `Exact` | u \|s\| |
//! | `Stable`, the first: half the chord, at least r / 4, is 8u r^2 / (2 r / 4) and 6u of itself off, the closest point 5u l, sums u \|s\| | 24 u r + u \|p\| |
//! | `Stable`, the second: half the chord is the root of the second's error off, below u (15.3 r + 2.7 \|p\|) | 24 u r + 4 u \|p\| |
//!
//! (Measured, of 60,000 lines each, |p| up to 2^70 r and 2^24 r: 2^-49 P to the side; u |p| + 3 u r along.)
//!
//! Of 24 u r + 4 u |p| the part 4 u T is the same for all spheres. It is the *blur*: an answer's s is
//! within it, and what a sphere or box is held to be off for by itself, of a root. Roots are what boxes and
//! spheres are computed for; so the ends of the interval are moved by the blur, outward where it must hold
//! all answers, inward where an answer must be in it, and a bound that an answer sets is raised.
//!
//! `Fast` is off by so much more that nothing is gained: its rays are not moved.

use super::slabs::{LONGEST, U, lowered, raised};
use crate::Lanes;
use crate::accuracy::RayLanes;
use crate::axes::{axes, dot};
use crate::error_free::{Halved, two_sum};

/// The rays of a packet from where they come near.
#[derive(Clone, Copy, Debug)]
pub(super) struct Approach<L: Lanes> {
    /// The rays that the bounds cover.
    pub(super) judged: L::Mask,
    /// o'.
    pub(super) origin: [L; 3],
    /// n.
    pub(super) direction: [L; 3],
    pub(super) time: RayTime<L>,
    /// 8 u (F + 2^-11 T) and 2^-58: four times what o', and a tier by T, may be off.
    pub(super) aside: L,
    /// The interval as s: start and end, each from below and from above.
    pub(super) start: [L; 2],
    pub(super) end: [L; 2],
}

/// From t to s.
#[derive(Clone, Copy, Debug)]
pub(super) struct RayTime<L> {
    /// tau.
    pub(super) shift: L,
    /// |d|.
    pub(super) length: L,
}

impl<L: Lanes> RayTime<L> {
    /// The blur: 4 u T. (Kept in memory instead: a packet's beginning loses what its hits gain.)
    #[inline(always)]
    pub(super) fn blur(&self) -> L {
        self.shift * self.length * self.shift.like(4.0 * U)
    }

    /// At least the s of a root that is answered by t.
    #[inline(always)]
    pub(super) fn after(&self, t: L) -> L {
        raised((t - self.shift) * self.length) + self.blur()
    }

    /// At most the s of a root that is answered by t.
    #[inline(always)]
    fn before(&self, t: L) -> L {
        lowered((t - self.shift) * self.length) - self.blur()
    }
}

/// Rays are moved where the nearest point is farther than this many times the distance that is left.
const WORTH_IT: f32 = 8.0;
/// 2^-58.
const LEAST_ASIDE: f32 = 1.0 / (1_u64 << 58) as f32;

impl<L: Lanes> Approach<L> {
    /// From where the rays begin.
    #[inline(always)]
    pub(super) fn as_it_is(rays: &RayLanes<L>) -> Self {
        let far = largest(rays.origin);
        let d = rays.direction;
        let a = dot(d, d);
        let judged = rays.live
            & a.like(1.0 / LONGEST).le(a)
            & a.le(a.like(LONGEST))
            & far.le(a.like(super::LARGEST));
        let (zero, one) = (a.like(0.0), a.like(1.0));
        let length = L::select(judged, a, one).sqrt();
        let per_length = one / length;
        let (start, end) = (rays.t_min * length, rays.t_max * length);
        Self {
            judged,
            origin: rays.origin,
            direction: axes!(i => d[i] * per_length),
            time: RayTime { shift: zero, length },
            aside: aside(far),
            start: [lowered(start), raised(start)],
            end: [lowered(end), raised(end)],
        }
    }

    /// From nearer, where the rays begin far away.
    #[inline(always)]
    pub(super) fn nearer(self, rays: &RayLanes<L>, extent: f32) -> Self {
        let far = largest(rays.origin);
        let (zero, length) = (far.like(0.0), self.time.length);
        let left = far.filter_mul_add(far.like(32.0 * U), far.like(2.0 * extent));
        let nearest = -dot(rays.origin, self.direction);
        let moved = self.judged & (left * far.like(WORTH_IT)).lt(nearest);

        let shift = L::select(moved, (nearest - left) / length, zero);
        let halved_shift = Halved::new(shift);
        let origin = axes!(i => {
            let (high, low) = halved_shift.times(Halved::new(rays.direction[i]));
            let (sum, error) = two_sum(rays.origin[i], high);
            L::select(moved, sum + (error + low), rays.origin[i])
        });
        let (by, time) = (shift * length, RayTime { shift, length });
        Self {
            origin,
            time,
            aside: aside(by.filter_mul_add(by.like(1.0 / 2048.0), largest(origin))),
            start: [time.before(rays.t_min), time.after(rays.t_min)],
            end: [time.before(rays.t_max), time.after(rays.t_max)],
            ..self
        }
    }
}

/// Which of `rays`, that begin where they are, may be worth moving: no point of a line that is nearest to
/// the coordinates' origin is farther from where it begins than sqrt 3 F.
#[inline(always)]
pub(super) fn far_away<L: Lanes>(rays: L::Mask, aside: L, extent: f32) -> L::Mask {
    rays & aside.like(WORTH_IT * 8.0 * U * extent).lt(aside)
}

/// What is left aside for rays of that size, F + 2^-11 T.
#[inline(always)]
fn aside<L: Lanes>(size: L) -> L {
    size.filter_mul_add(size.like(8.0 * U), size.like(LEAST_ASIDE))
}

/// The largest coordinate.
#[inline(always)]
fn largest<L: Lanes>(v: [L; 3]) -> L {
    v[0].abs().filter_max(v[1].abs()).filter_max(v[2].abs())
}
