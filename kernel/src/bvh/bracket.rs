//! The spheres of a leaf against one ray: which may be hit, and between which s.
//!
//! # Method
//!
//! Closest point first: with f = c - o, m = f.n is the s of the point nearest to the centre, l = |f -
//! m n| its distance, h = sqrt(r^2 - l^2) half the chord, m - h and m + h the roots. All in
//! single precision, each with a margin; what comes out is, for every sphere that may be hit, an s
//! that no answer is below, and one that an answer is surely not above - if the sphere is surely
//! hit. So the nearest of many spheres is known, but for a few, before a tier is asked, and the
//! tier can be asked about sixteen rays at once.
//!
//! # The margin
//!
//! u, n, v, s, the blur and o' as in `approach.rs`; p = c - o' in the reals, S = |m| + r, first order.
//!
//! | step | error at most, in u |
//! |---|---|
//! | \|v\| is 1: length 1.5u (a) + 1u (root), 1u (division) | 3.5 |
//! | m: f 1u, n 1u, sum 3u; from p.v to its part of \|v\|^2: 8u | 13 \|p\| |
//! | f - m n against p - m v: f 1u, n 1u, product 1u, difference 1u | 4 \|p\| |
//! | l^2: m is 13u \|p\| off, at right angles to l | (13 \|p\|)^2, in u^2 |
//! | the root of l^2 as computed: three sums, and the row but one before | 6 \|p\| |
//! | r^2 and the comparison, as a change of r | 2 r |
//! | o' is not on the line, the tier is not exact (`approach.rs`) | aside / 4 |
//! | m, from o' that is not where it was to be | aside / 4 |
//! | the tier's t against the root, but for the blur | 24 r + 4 \|p\| |
//!
//! Where l <= r, |p| <= S (1 + 13u). Let delta = 48 u S + aside. Then a hit has l^2 as computed at most
//! (r + 8 u S + aside / 4)^2 + (20 u S)^2, and so at most r^2 + W, W = (delta / 4) (2 r + 5 delta / 4); and l^2 <=
//! r^2 - W is a hit, since at l = r (and the more so beyond, where l grows faster than its error) the line is
//! found no nearer than r - 8 u S - aside / 4. In the same way r^2 - l^2 -+ W contains h^2. The rest of the
//! roots: m 13u |p|, |v| 4u h, the root 1u h, the sum 1u, the tier's t: 47u S, below delta. Before any root
//! is computed l <= r + delta is enough, and the simplest. What underflows is covered by 2^-58 in
//! aside. `Fast`: l^2 is (SPREAD S)^2 more.
//!
//! A far root that is surely in the interval is a bound too where the near one is not: the answer is one
//! of them.

use super::slabs::U;
use super::{BvhLeaf, WIDTH};
use crate::axes::axes;
use crate::{Accuracy, LaneMask, Lanes};

/// What may be hit in `L::COUNT` spheres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bracket<L: Lanes> {
    /// Which spheres may be hit in the interval.
    pub(super) candidates: L::Mask,
    /// No root of the sphere is below.
    pub(super) entry: L,
    /// No root above can be answered by less than this sphere's answer; `+inf` where none is sure.
    pub(super) bound: L,
}

/// One ray in all lanes, as leaves see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Probe<L: Lanes> {
    pub(super) origin: [L; 3],
    pub(super) direction: [L; 3],
    /// Where the interval starts: an s below, and an s above.
    pub(super) start: [L; 2],
    /// Where it ends: an s below; above, or the best s that is known.
    pub(super) end: [L; 2],
    /// As [`Approach::aside`](super::approach::Approach::aside).
    pub(super) aside: L,
    /// As in [`RayTime`](super::approach::RayTime).
    pub(super) blur: L,
}

/// The lanes of part `part` of sixteen numbers.
#[inline(always)]
pub(super) fn part_of<L: Lanes>(token: L::Token, numbers: &[f32; WIDTH], part: usize) -> L {
    let mut array = L::Array::default();
    let from = part * L::COUNT % WIDTH;
    for (element, number) in array.as_mut().iter_mut().zip(numbers.iter().skip(from)) {
        *element = *number;
    }
    L::load(token, &array)
}

impl<L: Lanes> Probe<L> {
    /// Which spheres of part `part` of a leaf may be hit, as far as can be told without a root.
    #[inline(always)]
    pub(super) fn may_meet<A: Accuracy>(&self, leaf: &BvhLeaf, part: usize) -> u32 {
        self.passed(leaf, part).may_meet::<A>(self.start[0], self.end[1]).bits()
    }

    #[inline(always)]
    fn passed(&self, leaf: &BvhLeaf, part: usize) -> Passed<L> {
        let token = self.origin[0].token();
        let center = axes!(i => part_of::<L>(token, &leaf.center[i], part));
        let radius = part_of::<L>(token, &leaf.radius, part);
        Passed::new(self.origin, self.direction, self.aside, center, radius)
    }

    /// Between which s the spheres of part `part` of a leaf are hit.
    #[inline(always)]
    pub(super) fn meet<A: Accuracy>(&self, leaf: &BvhLeaf, part: usize) -> Bracket<L> {
        self.passed(leaf, part).bracket::<A>(self.start, self.end, self.blur)
    }
}

/// How near a ray passes a sphere, in every lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passed<L> {
    radius: L,
    middle: L,
    /// l^2.
    ll: L,
    /// S.
    size: L,
    delta: L,
}

impl<L: Lanes> Passed<L> {
    #[inline(always)]
    pub(super) fn new(origin: [L; 3], n: [L; 3], aside: L, center: [L; 3], radius: L) -> Self {
        let f = axes!(i => center[i] - origin[i]);
        let middle = f[2].filter_mul_add(n[2], f[1].filter_mul_add(n[1], f[0] * n[0]));
        let back = -middle;
        let q = axes!(i => back.filter_mul_add(n[i], f[i]));
        let ll = q[2].filter_mul_add(q[2], q[1].filter_mul_add(q[1], q[0] * q[0]));

        let size = middle.abs() + radius;
        let delta = size.filter_mul_add(radius.like(48.0 * U), aside);
        Self { radius, middle, ll, size, delta }
    }

    /// Which may be hit between the s `start` and `end`, as far as can be told without a root.
    #[inline(always)]
    pub(super) fn may_meet<A: Accuracy>(&self, start: L, end: L) -> L::Mask {
        let reach = self.radius + self.delta;
        if A::SPREAD > 0.0 {
            let spread = self.size * self.size.like(A::SPREAD);
            return self.ll.le(spread.filter_mul_add(spread, reach * reach));
        }
        self.ll.le(reach * reach) & (self.middle - reach).le(end) & start.le(self.middle + reach)
    }

    /// Between which s the spheres are hit; the interval starts and ends somewhere in
    /// `start` and `end`.
    #[inline(always)]
    pub(super) fn bracket<A: Accuracy>(&self, start: [L; 2], end: [L; 2], blur: L) -> Bracket<L> {
        let Self { middle, radius, delta, ll, size } = *self;
        let zero = radius.like(0.0);
        let half = radius * radius.like(0.5);
        let mut slack = delta * delta.filter_mul_add(radius.like(0.3125), half);
        if A::SPREAD > 0.0 {
            let spread = size * radius.like(A::SPREAD);
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
        Bracket { candidates, entry, bound: bound + (blur + blur) }
    }
}
