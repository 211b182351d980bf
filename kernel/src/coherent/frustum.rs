//! The lines and the depths between which a group of rays runs.
//!
//! # Method
//!
//! Rays that run the same way along an axis k, d_k of one sign sigma, have slopes w_i = d_i / d_k and
//! w_j = d_j / d_k along the two others. From its origin on, a ray with slope w between w_min and
//! w_max in terms of the depth sigma x_k stays on one side of each of two lines: x_i >= w x_k + D,
//! where w is the least slope (per depth) and D the least of o_i - w o_k; and x_i <= w x_k + D with
//! the greatest of both. So it does along j: four planes (Reshetov, Soupikov and Hurley 2005,
//! Multi-Level Ray Tracing Algorithm). A box is outside if its farthest corner is; a sphere if
//! its centre is by more than its radius times the length of the normal. Along k itself the group
//! is bounded by its origins, and by how far its rays still go.
//!
//! Slopes are moved by 16 u |w| + u / 64, D by A (1 + |w|), A = 8 u (F + 2^-11 T), 2^-58 and four steps of t, the lengths of normals by
//! 64 u: `docs/traversal-margins.md` proves that this is enough, and `tests/structures/far.rs` guards it.

use crate::bvh::node::{BvhNode, WIDTH};
use crate::bvh::traverse::prepared_ray::ABSOLUTE_ERROR;
use crate::count::count;
use crate::geometry::sphere_columns::SphereColumns;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::numeric::rounding::U;
use crate::query::Query;
use wide::f32x4;

/// A line that bounds x_i in terms of x_k: `slope * x_k + offset`.
#[derive(Clone, Copy, Debug)]
struct Line {
    slope: f32,
    offset: f32,
    /// At least the length of the plane's normal.
    length: f32,
}

/// By how many absolute errors, times 1 + |w|, planes are moved.
pub(crate) const MARGIN: f32 = 1.0;
/// By how much slopes are moved: a part of |w|, and an amount.
pub(crate) const TURN: [f32; 2] = [16.0 * U, U / 64.0];
/// How much larger a radius counts: 64u.
pub(crate) const LARGER: f32 = 1.0 + 64.0 * U;

/// Returns how far a plane of that slope, which is at least zero, is moved; the error is the largest of the rays.
#[inline(always)]
pub(crate) fn margin<L: Lanes>(slope: L, absolute_error: L) -> L {
    slope.like(MARGIN) * absolute_error * (slope.like(1.0) + slope)
}

/// Returns how far that slope is moved.
#[inline(always)]
pub(crate) fn turn<L: Lanes>(slope: L) -> L {
    slope.like(TURN[0]) * slope + slope.like(TURN[1])
}

/// Returns at least the length of the normal of a plane of that slope, times [`LARGER`], and not much more where the slope is
/// below one.
#[inline(always)]
pub(crate) fn length<L: Lanes>(slope: L) -> L {
    slope * slope * slope.like(0.5 * LARGER) + slope.like(LARGER)
}

/// By how much of its distance a box is larger: 16u.
pub(crate) const BORDER: f32 = 16.0 * U;

/// What of a sphere counts at planes and depths.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Outline {
    /// The sphere.
    Sphere,
    /// Its box: a tier with a spread sees hits of lines that pass the sphere, and a tree loses those past the box alone. The box is larger,
    /// as a [`Spread`](Self::Spread) of 16u is: a ray by itself is taken to meet it from 9u of its distance outside, and turned planes
    /// are off by less than as much again.
    Box { far: f32 },
    /// A sphere that is larger by `spread` times its distance: from the frame's origin, and that from there to the rays' origins.
    Spread { spread: f32, far: f32 },
}

impl Outline {
    /// For a tier of that spread in a tree; the error is the largest of the rays.
    #[inline(always)]
    pub(super) fn in_tree(spread: f32, absolute_error: f32) -> Self {
        match Self::in_list(spread, absolute_error) {
            Self::Spread { far, .. } => Self::Box { far },
            other => other,
        }
    }

    /// For a tier of that spread in a depth list; the error is the largest of the rays.
    #[inline(always)]
    pub(super) fn in_list(spread: f32, absolute_error: f32) -> Self {
        if spread == 0.0 {
            return Self::Sphere;
        }
        // The error has |o|_inf times its factor; |o|_2 is less than twice that.
        Self::Spread { spread, far: absolute_error * (2.0 / ABSOLUTE_ERROR / U) }
    }

    /// The radii of part `part` of sixteen spheres.
    #[inline(always)]
    fn radius<L: Lanes>(self, token: L::Token, spheres: &SphereColumns<'_>, part: usize) -> L {
        let radius = L::load_part(token, spheres.radius, part);
        // (A call of itself would not be inlined, and runs without its level: a camera's rays at 0.83 of the speed, by `Fast` at 0.3.)
        let (spread, far) = match self {
            Self::Sphere => return radius,
            Self::Box { far } => (BORDER, far),
            Self::Spread { spread, far } => (spread, far),
        };
        let [x, y, z] = axes!(i => L::load_part(token, spheres.center[i], part).abs());
        (x + y + z + radius + radius.like(far)).filter_mul_add(radius.like(spread), radius)
    }

    /// By how many radii the outline reaches past its centre, along an axis across, at a plane.
    #[inline(always)]
    fn reach(self, line: &Line) -> f32 {
        match self {
            Self::Sphere | Self::Spread { .. } => line.length,
            Self::Box { .. } => LARGER + LARGER * line.slope.abs(),
        }
    }
}

/// The four planes: for the first of the two axes across, then for the second, a line below and one above the rays.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sides {
    /// The axis that all rays run along.
    pub(crate) along: usize,
    pub(crate) slope: [f32; 4],
    pub(crate) offset: [f32; 4],
    pub(crate) length: [f32; 4],
}

/// The axes that are not `along`.
#[inline(always)]
pub(super) fn across(along: usize) -> [usize; 2] {
    [(along + 1) % 3, (along + 2) % 3]
}

impl Sides {
    pub(super) const NONE: Self =
        Self { along: 0, slope: [0.0; 4], offset: [0.0; 4], length: [0.0; 4] };

    /// Planes that leave out nothing.
    pub(super) const ALL: Self = Self {
        offset: [f32::NEG_INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::INFINITY],
        ..Self::NONE
    };

    /// For the least and greatest slope, and the least and greatest offset, of each axis, all moved outward.
    #[inline(always)]
    pub(super) fn new(along: usize, slopes: [[f32; 2]; 2], offsets: [[f32; 2]; 2]) -> Self {
        let [[a, b], [c, d]] = slopes;
        let [[e, f], [g, h]] = offsets;
        let (slope, offset) = (f32x4::new([a, b, c, d]), f32x4::new([e, f, g, h]));
        Self::of_lines(along, slope, offset)
    }

    /// The same for four packets, a lane each.
    #[inline(always)]
    pub(super) fn of_each(
        along: usize,
        slopes: [[f32x4; 2]; 2],
        offsets: [[f32x4; 2]; 2],
    ) -> [Self; 4] {
        let [[a, b], [c, d]] = slopes;
        let [[e, f], [g, h]] = offsets;
        let (slopes, offsets) = (f32x4::transpose([a, b, c, d]), f32x4::transpose([e, f, g, h]));
        let mut sides = [Self::NONE; 4];
        for packet in 0..4 {
            sides[packet] = Self::of_lines(along, slopes[packet], offsets[packet]);
        }
        sides
    }

    #[inline(always)]
    fn of_lines(along: usize, slope: f32x4, offset: f32x4) -> Self {
        let (slope, offset, length) =
            (slope.to_array(), offset.to_array(), length(slope).to_array());
        Self { along: along % 3, slope, offset, length }
    }

    /// The lines below and above the rays, along the first or second of the axes [`across`].
    #[inline(always)]
    fn lines(&self, side: usize) -> [Line; 2] {
        [self.line(2 * side), self.line(2 * side + 1)]
    }

    #[inline(always)]
    fn line(&self, at: usize) -> Line {
        let at = at % 4;
        Line { slope: self.slope[at], offset: self.offset[at], length: self.length[at] }
    }

    /// Returns which of sixteen spheres may be between the planes, by their outlines.
    #[inline(always)]
    pub(crate) fn look<L: Lanes>(
        &self,
        token: L::Token,
        spheres: &SphereColumns<'_>,
        outline: Outline,
    ) -> u32 {
        let k = self.along % 3;
        let mut places = 0;
        for part in 0..WIDTH / L::COUNT {
            let radius = outline.radius::<L>(token, spheres, part);
            let along = L::load_part(token, spheres.center[k], part);
            let mut met = L::splat(token, 0.0).le(radius);
            let axes = across(k);
            for side in 0..2 {
                let [below, above] = self.lines(side);
                let across = L::load_part(token, spheres.center[axes[side] % 3], part);
                let least = along
                    .filter_mul_add(L::splat(token, below.slope), L::splat(token, below.offset));
                let most = along
                    .filter_mul_add(L::splat(token, above.slope), L::splat(token, above.offset));
                let [up, down] = [outline.reach(&below), outline.reach(&above)];
                let highest = radius.filter_mul_add(L::splat(token, up), across);
                let lowest = (-radius).filter_mul_add(L::splat(token, down), across);
                met = met & least.le(highest) & lowest.le(most);
            }
            places |= met.bits() << (part * L::COUNT);
        }
        places
    }
}

/// What a group of rays cannot leave.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frustum {
    pub(super) sides: Sides,
    /// sigma: 1 or -1.
    pub(super) sign: f32,
    /// The least depth, sigma x_k, of an origin, lowered by the margin.
    pub(super) start: f32,
    /// The greatest depth that a ray still goes to, raised by the margin.
    pub(super) end: f32,
}

/// Which children of a node are inside, a bit each, and from which depth on each may matter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inside {
    pub(super) places: u32,
    pub(super) depths: [f32; WIDTH],
}

impl Frustum {
    pub(super) const NONE: Self =
        Self { sides: Sides::NONE, sign: 1.0, start: f32::INFINITY, end: f32::NEG_INFINITY };

    /// Finds which children of a node may be entered, and the depths at which they begin: nearer children are looked into sooner. For
    /// any hit a child is looked into sooner by its size across the rays' axis, since a large child soon ends many rays. (Without this,
    /// any hit of huge and tiny took 1.28 times as long in the mean of 22 orders, a scanner's rays 6 times as long. In the order of
    /// slots, in which rays by themselves take children, bursts of rays on the ground took twice as long.)
    #[inline(always)]
    pub(super) fn enter<L: Lanes, Q: Query>(
        &self,
        token: L::Token,
        node: &BvhNode,
        inside: &mut Inside,
    ) {
        count!(GroupNode);
        let k = self.sides.along % 3;
        let (low, high) = (&node.low[k], &node.high[k]);
        let (first, last) = if self.sign > 0.0 { (low, high) } else { (high, low) };
        let sign = L::splat(token, self.sign);
        let (start, end) = (L::splat(token, self.start), L::splat(token, self.end));
        inside.places = 0;
        for part in 0..WIDTH / L::COUNT {
            let begin = L::load_part(token, first, part) * sign;
            let finish = L::load_part(token, last, part) * sign;
            let mut met = begin.le(end) & start.le(finish);
            let axes = across(k);
            let mut size = begin.like(0.0);
            for side in 0..2 {
                let (i, [below, above]) = (axes[side] % 3, self.sides.lines(side));
                // Where along k the line is farthest out.
                let corner = if below.slope > 0.0 { low } else { high };
                let least = L::load_part(token, corner, part)
                    .filter_mul_add(L::splat(token, below.slope), L::splat(token, below.offset));
                let corner = if above.slope > 0.0 { high } else { low };
                let most = L::load_part(token, corner, part)
                    .filter_mul_add(L::splat(token, above.slope), L::splat(token, above.offset));
                let lowest = L::load_part(token, &node.low[i], part);
                let highest = L::load_part(token, &node.high[i], part);
                met = met & least.le(highest) & lowest.le(most);
                size = size + (highest - lowest);
            }
            inside.places |= met.bits() << (part * L::COUNT);
            let key = if Q::ANY { begin - size } else { begin };
            key.store().put_part(&mut inside.depths, part);
        }
    }

    /// Returns which of sixteen spheres may be hit, by their outlines.
    #[inline(always)]
    pub(super) fn look<L: Lanes>(
        &self,
        token: L::Token,
        spheres: &SphereColumns<'_>,
        outline: Outline,
    ) -> u32 {
        count!(GroupLeaf);
        let sign = L::splat(token, self.sign);
        let (start, end) = (L::splat(token, self.start), L::splat(token, self.end));
        let mut places = 0;
        for part in 0..WIDTH / L::COUNT {
            let radius = outline.radius::<L>(token, spheres, part);
            let radius = radius * radius.like(LARGER);
            let depth = L::load_part(token, spheres.center[self.sides.along % 3], part) * sign;
            let met = (depth - radius).le(end) & start.le(depth + radius);
            places |= met.bits() << (part * L::COUNT);
        }
        places & self.sides.look::<L>(token, spheres, outline)
    }
}
