//! The spheres of a leaf against one ray, or one sphere against the rays of a packet: which may be hit, and
//! between which s.
//!
//! # Method
//!
//! The closest point comes first: with f = c - o', m = f.n is the s of the point closest to the centre, l = |f - m n| its
//! distance, h = sqrt(r^2 - l^2) half the chord, m - h and m + h the roots. All are in single precision, each with a margin.
//! For every sphere that may be hit, they give an s that no answer is below and, if the sphere is surely hit, an s that its
//! answer is surely not above. So the closest of many spheres is known, except for a few, before a tier tests it, and the tier
//! can test sixteen rays at once.
//!
//! Let S = |m| + r and delta = 48 u S + the absolute error of the ray. A hit has l <= r + delta, and l^2 within r^2 + W, W =
//! (delta / 4) (2 r + 5 delta / 4); l^2 <= r^2 - W is surely a hit. The proof is in `docs/traversal-margins.md`, which
//! `tests/structures/far.rs` guards.
//!
//! A far root that is surely in the interval is a bound too where the near one is not: the answer is one
//! of them.

use crate::bvh::leaf::Leaf;
use crate::geometry::sphere_columns::SphereColumns;
use crate::lanes::{LaneMask, Lanes, WIDTH};
use crate::numeric::axes::{axes, largest};
use crate::numeric::rounding::{LEAST_COMPONENT, least};
use crate::query::Query;

/// Between which s spheres are hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RootInterval<L: Lanes> {
    /// Which spheres may be hit in the ray's interval.
    pub(crate) candidates: L::Mask,
    /// An s that no root of the sphere in the interval is below.
    pub(crate) entry: L,
    /// An s above which no root can be answered by less than this sphere's answer; `+inf` where no hit is sure.
    pub(crate) bound: L,
}

/// So many candidates, or more, are compared in lanes: two are as fast number by number.
const MANY: u32 = 3;

impl<L: Lanes> RootInterval<L> {
    /// Which of the spheres `among` to look at one by one, if some answer is not above `best`: the candidates. For the closest
    /// hit, where there are many, a candidate is left out if another is surely closer. (Each candidate is a branch that cannot
    /// be predicted: among nested spheres these took a quarter of a ray's time.)
    #[inline(always)]
    pub(crate) fn candidates<Q: Query>(&self, among: u32, best: f32) -> u32 {
        let candidates = self.candidates.bits() & among;
        if Q::ANY || candidates.count_ones() < MANY {
            return candidates;
        }
        let (entry, bound) = (self.entry, self.bound);
        let those = L::mask(entry.token(), candidates);
        let bounds = L::select(those, -bound, entry.like(f32::NEG_INFINITY));
        let limit = least(-bounds.filter_greatest(), best);
        candidates & entry.le(entry.like(limit)).bits()
    }
}

/// One ray in all lanes, as leaves see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayProbe<L: Lanes> {
    pub(crate) origin: [L; 3],
    pub(crate) direction: [L; 3],
    /// Where the interval starts: an s below, and an s above.
    pub(crate) start: [L; 2],
    /// Where it ends: an s below; above, or the best s that is known.
    pub(crate) end: [L; 2],
    /// As [`PreparedLanes::absolute_error`](super::prepared_ray::PreparedLanes::absolute_error).
    pub(crate) absolute_error: L,
    /// As [`RayTime::raise`](super::ray_time::RayTime::raise).
    pub(crate) raise: L,
    /// The spread of the tier.
    pub(crate) spread: f32,
}

impl<L: Lanes> RayProbe<L> {
    /// Which spheres of a leaf may be hit, a bit each, as far as can be told without a root.
    #[inline(always)]
    pub(super) fn may_hit<const SPREADS: bool>(&self, leaf: &Leaf<'_>) -> u32 {
        let mut spheres = 0;
        for part in 0..WIDTH / L::COUNT {
            let pass = self.pass(&leaf.columns, part);
            let those = pass.may_hit::<SPREADS>(self.start[0], self.end[1], self.spread);
            spheres |= those.bits() << (part * L::COUNT);
        }
        spheres & leaf.lanes
    }

    #[inline(always)]
    pub(super) fn pass(&self, spheres: &SphereColumns<'_>, part: usize) -> Pass<L> {
        let token = self.origin[0].token();
        let center = axes!(i => L::load_part(token, spheres.center[i], part));
        let radius = L::load_part(token, spheres.radius, part);
        Pass::new(self.origin, self.direction, self.absolute_error, center, radius)
    }

    /// Between which s the spheres of part `part` are hit.
    #[inline(always)]
    pub(crate) fn root_interval<const SPREADS: bool>(
        &self,
        spheres: &SphereColumns<'_>,
        part: usize,
    ) -> RootInterval<L> {
        let Self { start, end, raise, spread, .. } = *self;
        let pass = self.pass(spheres, part);
        let mut interval = pass.root_interval::<SPREADS>(start, end, raise, spread);
        if SPREADS {
            interval.candidates = interval.candidates & pass.meets_box();
        }
        interval
    }
}

/// How closely a ray passes a sphere, in every lane.
///
/// Tiers with a spread are tested out of line, as `SPREADS`: a branch in the middle, on a number that is not known at build
/// time, cost the other tiers 7 % on u10k.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pass<L> {
    /// f.
    to_center: [L; 3],
    /// n.
    direction: [L; 3],
    pub(crate) radius: L,
    pub(crate) middle: L,
    /// l^2.
    pub(crate) ll: L,
    /// S.
    pub(crate) size: L,
    pub(crate) delta: L,
}

/// delta of S, in u.
pub(crate) const DELTA: f32 = 48.0;
/// How far outside the border of a box a line still meets it, in u of f: what single precision is off, so that no true hit is lost.
pub(crate) const BORDER: f32 = 5.0;
/// The factors of delta r and of delta^2 in W.
pub(crate) const SLACK: [f32; 2] = [0.5, 0.3125];

impl<L: Lanes> Pass<L> {
    #[inline(always)]
    pub(crate) fn new(
        origin: [L; 3],
        n: [L; 3],
        absolute_error: L,
        center: [L; 3],
        radius: L,
    ) -> Self {
        let f = axes!(i => center[i] - origin[i]);
        let middle = f[2].filter_mul_add(n[2], f[1].filter_mul_add(n[1], f[0] * n[0]));
        let back = -middle;
        let q = axes!(i => back.filter_mul_add(n[i], f[i]));
        let ll = q[2].filter_mul_add(q[2], q[1].filter_mul_add(q[1], q[0] * q[0]));

        let size = middle.abs() + radius;
        let delta = size.filter_mul_add(radius.like(DELTA * L::UNIT_ROUNDOFF), absolute_error);
        Self { to_center: f, direction: n, radius, middle, ll, size, delta }
    }

    /// Whether the ray's line meets the box around the sphere, its border up to 5u of f farther out.
    ///
    /// `Fast` and `Geometric` see hits on lines that pass a sphere at a distance. Boxes and planes lose some of them, and which ones depends
    /// on the rays that go together. So every way through a tree asks this, by the same operations at every level, and keeps the same ones:
    /// a line meets the box if it does so along each axis, |f_i n_j - f_j n_i| <= r (|n_i| + |n_j|) for each two. (2^-60 more on either side of
    /// the product, where others are subnormal.)
    #[inline(always)]
    pub(crate) fn meets_box(&self) -> L::Mask {
        let Self { to_center: f, direction: n, radius, .. } = *self;
        let tiny = radius.like(LEAST_COMPONENT);
        let reach = radius + largest(f) * radius.like(BORDER * L::UNIT_ROUNDOFF) + tiny;
        let ways = axes!(i => {
            let j = (i + 1) % 3;
            let across = (f[i] * n[j] - f[j] * n[i]).abs();
            across.le(reach * (n[i].abs() + n[j].abs() + tiny))
        });
        ways[0] & ways[1] & ways[2]
    }

    /// Which spheres may be hit between the s `start` and `end`, as far as can be told without a root.
    #[inline(always)]
    pub(crate) fn may_hit<const SPREADS: bool>(&self, start: L, end: L, spread: f32) -> L::Mask {
        let reach = self.radius + self.delta;
        if SPREADS {
            let spread = self.size * self.size.like(spread);
            return self.ll.le(spread.filter_mul_add(spread, reach * reach));
        }
        self.ll.le(reach * reach) & (self.middle - reach).le(end) & start.le(self.middle + reach)
    }

    /// W.
    #[inline(always)]
    pub(crate) fn slack(&self) -> L {
        let Self { radius, delta, .. } = *self;
        let half = radius * radius.like(SLACK[0]);
        delta * delta.filter_mul_add(radius.like(SLACK[1]), half)
    }

    /// Which spheres surely have their near root between the s `start` and `end`, as far as can be told without a root: no
    /// near root is below m - r - delta, or above m + delta.
    #[cfg(feature = "std")]
    #[inline(always)]
    pub(super) fn is_hit(&self, start: L, end: L) -> L::Mask {
        let Self { middle, radius, delta, ll, .. } = *self;
        let slack = self.slack();
        radius.like(0.0).lt(radius * radius - ll - slack)
            & start.le(middle - (radius + delta))
            & (middle + delta).le(end)
    }

    /// Between which s the spheres are hit; the interval starts somewhere in `start`, and ends somewhere in `end`.
    #[inline(always)]
    pub(crate) fn root_interval<const SPREADS: bool>(
        &self,
        start: [L; 2],
        end: [L; 2],
        raise: L,
        spread: f32,
    ) -> RootInterval<L> {
        let Self { middle, radius, delta, ll, size, .. } = *self;
        let zero = radius.like(0.0);
        let mut slack = self.slack();
        if SPREADS {
            let spread = size * radius.like(spread);
            slack = spread.filter_mul_add(spread, slack);
        }
        let left = radius * radius - ll;
        let longest = left + slack;
        let long = longest.filter_max(zero).sqrt() + delta;
        let sure = left - slack;
        let short = sure.filter_max(zero).sqrt() - delta;
        // The near root lies in [entry, entered], the far one in [leaving, left].
        let (entry, entered) = (middle - long, middle - short);
        let (leaving, left) = (middle + short, middle + long);

        let candidates = zero.le(longest) & zero.le(radius) & entry.le(end[1]) & start[0].le(left);
        let hit = zero.lt(sure);
        let near = hit & start[1].le(entry) & entered.le(end[0]);
        let far = hit & start[1].le(leaving) & left.le(end[0]);
        let infinity = radius.like(f32::INFINITY);
        let bound = L::select(near, entered, L::select(far, left, infinity));
        // Where the near root is surely before the start, the far one answers. (With the near root as entry, spheres
        // around the origin stayed candidates whatever else was hit.)
        let entry = L::select(entered.lt(start[0]), leaving, entry);
        RootInterval { candidates, entry, bound: bound + raise }
    }
}

#[cfg(all(test, proofs))]
mod tests {
    use super::*;
    use crate::proofs::climb::Random;
    use crate::query::{AnyHit, ClosestHit};
    use wide::f32x16;

    #[test]
    fn none_is_left_out_that_may_be_the_closest() {
        let mut random = Random(26);
        let (mut many, mut equal) = (0, 0);
        for _ in 0..20_000 {
            // Few numbers, so that many are the same.
            let entry: [f32; 16] = core::array::from_fn(|_| random.below(20) as f32);
            let bound: [f32; 16] = core::array::from_fn(|lane| match random.below(3) {
                0 => f32::INFINITY,
                more => entry[lane] + (more - 1) as f32,
            });
            let few = random.below(1 << 16) & random.below(1 << 16);
            let (mask, among) = (few as u32, random.below(1 << 16) as u32);
            let best = random.below(20) as f32;
            let interval = RootInterval::<f32x16> {
                candidates: f32x16::mask((), mask),
                entry: f32x16::load((), &entry),
                bound: f32x16::load((), &bound),
            };
            let candidates = mask & among;
            assert_eq!(interval.candidates::<AnyHit>(among, best), candidates);

            let those = |lane: &usize| candidates >> lane & 1 == 1;
            let limit = (0..16).filter(those).map(|lane| bound[lane]).fold(best, f32::min);
            let kept = (0..16).filter(those).filter(|&lane| entry[lane] <= limit);
            let kept = kept.fold(0, |bits, lane| bits | 1 << lane);
            let is_many = candidates.count_ones() >= MANY;
            let expected = if is_many { kept } else { candidates };
            assert_eq!(interval.candidates::<ClosestHit>(among, best), expected);
            many += usize::from(is_many && kept != candidates);
            equal += usize::from((0..16).any(|lane| kept >> lane & 1 == 1 && entry[lane] == limit));
        }
        assert!(many > 1000 && equal > 1000, "{many} {equal}");
    }
}
