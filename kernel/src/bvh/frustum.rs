//! The lines and the depths between which a bundle of rays runs.
//!
//! # Method
//!
//! Rays that run the same way along an axis k, d_k of one sign sigma, have slopes w_i = d_i / d_k and
//! w_j = d_j / d_k along the two others. From its origin on, a ray with slope w between w_min and
//! w_max in terms of the depth sigma x_k stays on one side of each of two lines: x_i >= w x_k + D,
//! where w is the least slope (per depth) and D the least of o_i - w o_k; and x_i <= w x_k + D with
//! the greatest of both. So it does along j: four planes (Reshetov, Soupikov and Hurley 2005,
//! Multi-Level Ray Tracing Algorithm). A box is outside where its farthest corner is; a sphere where
//! its centre is by more than its radius times the length of the normal. Along k itself the bundle
//! is bounded by its origins, and by how far its rays still go.
//!
//! # The margin
//!
//! Rays are those of `approach.rs`, which begin at o' and meet everything beyond it; F, T and P as there.
//! z = sigma (x_k - o'_k) is how far along k a point x is. An error in proportion to z is a change of the
//! slope, one in proportion to F a change of D, and one in proportion to the radius a change of the
//! normal's length: so what is far away or large widens nothing but what is beside it.
//!
//! Let x be where a line meets a sphere, or passes it within 2^-36 P. Of x_i - w x_k - D:
//!
//! | error | of z, in u | of (1 + \|w\|) F, in u | of r, in u |
//! |---|---|---|---|
//! | o' is not on its line; 2^-36 P, with \|p\| <= 33 z + T | 2^-6 | 1, and 2^-35 T | |
//! | w: two components of n, a division, a product | 6 \|w\| | | |
//! | D | | 3 | |
//! | w x_k + D, unless fused | 2 \|w\| | 3 | 2 \|w\| |
//! | x_i, and the radius times the normal's length l | 2 \|w\| | 1 | 3 l |
//! | the answer is not the root: x may be before o' by 28 u r, where slopes one in two apart change sides | | | 14 |
//! | **together** | **10 \|w\| + 2^-6** | **8, and 2^-35 T** | **19 l** |
//!
//! (Of x_i: where the ray at hand has the slope w + e, the e z u that it adds is less than the e z by which it is
//! inside.) With |w| the largest of a packet's four, slopes are moved by 16 u |w| + u, D by
//! 16 u (F + 2^-11 T) (1 + |w|) and 2^-57, lengths by 48u: since the centre may lie before o' by r, where the
//! slopes are moved inward, 19 + 17 are needed.
//!
//! For a box it is the same, but that of its corner x_k may be far from that of x: then the line is inside by
//! more than what rounding that adds. What is in proportion to r it has itself, being 40 u of its largest
//! coordinate larger (`slabs.rs`).
//!
//! Along k, the answer is off by the blur and 24 u r + 4 u |c - o'|, which is below 28 u r of a sphere, 31 u of the
//! box's largest coordinate, and 4 u of best n_k; the roundings are 4 u of that and 3 u F.

use super::bracket::part_of;
use super::ray_walk::put_part;
use super::slabs::U;
use super::{BvhLeaf, BvhNode, WIDTH};
use crate::{LaneMask, Lanes};

/// A line that bounds x_i in terms of x_k: `slope * x_k + offset`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    slope: f32,
    offset: f32,
    /// At least the length of the plane's normal.
    length: f32,
}

impl Line {
    pub(super) const NONE: Self = Self { slope: 0.0, offset: 0.0, length: 0.0 };

    /// The line below (`side` 1) or above (-1) all rays, for slopes that end at `slope` and an offset
    /// that ends at `offset`, both moved outward.
    #[inline(always)]
    pub(super) fn new(slope: f32, offset: f32) -> Self {
        // At least the root of 1 + slope^2, and not much more where the slope is below one.
        Self { slope, offset, length: slope * slope * (0.5 * LARGER) + LARGER }
    }
}

/// How far a plane of that slope, at least zero, is moved; `aside` is the rays' largest.
#[inline(always)]
pub(super) fn margin(slope: f32, aside: f32) -> f32 {
    2.0 * aside * (1.0 + slope)
}

/// How far that slope is moved.
#[inline(always)]
pub(super) fn turn(slope: f32) -> f32 {
    16.0 * U * slope + U
}

/// How much larger a radius counts: 48u.
const LARGER: f32 = 1.0 + 48.0 * U;

/// The four planes: two lines for each of the axes across.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sides {
    /// The axis that all rays run along.
    pub(super) along: usize,
    /// Below and above the rays, along the axes [`across`].
    pub(super) lines: [[Line; 2]; 2],
}

/// The axes that are not `along`.
#[inline(always)]
pub(super) fn across(along: usize) -> [usize; 2] {
    [(along + 1) % 3, (along + 2) % 3]
}

impl Sides {
    pub(super) const NONE: Self = Self { along: 0, lines: [[Line::NONE; 2]; 2] };

    /// Which spheres of a leaf may be between the planes.
    #[inline(always)]
    pub(super) fn look<L: Lanes>(&self, token: L::Token, leaf: &BvhLeaf) -> u32 {
        let k = self.along % 3;
        let mut places = 0;
        for part in 0..WIDTH / L::COUNT {
            let radius = part_of::<L>(token, &leaf.radius, part);
            let along = part_of::<L>(token, &leaf.center[k], part);
            let mut met = L::splat(token, 0.0).le(radius);
            for (i, [below, above]) in across(k).into_iter().zip(&self.lines) {
                let across = part_of::<L>(token, &leaf.center[i % 3], part);
                let least = along
                    .filter_mul_add(L::splat(token, below.slope), L::splat(token, below.offset));
                let most = along
                    .filter_mul_add(L::splat(token, above.slope), L::splat(token, above.offset));
                let highest = radius.filter_mul_add(L::splat(token, below.length), across);
                let lowest = (-radius).filter_mul_add(L::splat(token, above.length), across);
                met = met & least.le(highest) & lowest.le(most);
            }
            places |= met.bits() << (part * L::COUNT);
        }
        places
    }
}

/// What a bundle of rays cannot leave.
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

/// What of a node is inside: a bit a child, and the depth it begins at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inside {
    pub(super) places: u32,
    pub(super) depths: [f32; WIDTH],
}

impl Frustum {
    /// Which children of a node may be met.
    #[inline(always)]
    pub(super) fn enter<L: Lanes>(&self, token: L::Token, node: &BvhNode, inside: &mut Inside) {
        let k = self.sides.along % 3;
        let (low, high) = (&node.low[k], &node.high[k]);
        let (first, last) = if self.sign > 0.0 { (low, high) } else { (high, low) };
        let sign = L::splat(token, self.sign);
        let (start, end) = (L::splat(token, self.start), L::splat(token, self.end));
        inside.places = 0;
        for part in 0..WIDTH / L::COUNT {
            let begin = part_of::<L>(token, first, part) * sign;
            let finish = part_of::<L>(token, last, part) * sign;
            let mut met = begin.le(end) & start.le(finish);
            for (i, [below, above]) in across(k).into_iter().zip(&self.sides.lines) {
                // Where along k the line is farthest out.
                let corner = if below.slope > 0.0 { low } else { high };
                let least = part_of::<L>(token, corner, part)
                    .filter_mul_add(L::splat(token, below.slope), L::splat(token, below.offset));
                let corner = if above.slope > 0.0 { high } else { low };
                let most = part_of::<L>(token, corner, part)
                    .filter_mul_add(L::splat(token, above.slope), L::splat(token, above.offset));
                met = met
                    & least.le(part_of::<L>(token, &node.high[i % 3], part))
                    & part_of::<L>(token, &node.low[i % 3], part).le(most);
            }
            inside.places |= met.bits() << (part * L::COUNT);
            put_part(&mut inside.depths, part, begin);
        }
    }

    /// Which spheres of a leaf may be met.
    #[inline(always)]
    pub(super) fn look<L: Lanes>(&self, token: L::Token, leaf: &BvhLeaf) -> u32 {
        let sign = L::splat(token, self.sign);
        let (start, end) = (L::splat(token, self.start), L::splat(token, self.end));
        let mut places = 0;
        for part in 0..WIDTH / L::COUNT {
            let radius = part_of::<L>(token, &leaf.radius, part);
            let radius = radius * radius.like(LARGER);
            let depth = part_of::<L>(token, &leaf.center[self.sides.along % 3], part) * sign;
            let met = (depth - radius).le(end) & start.le(depth + radius);
            places |= met.bits() << (part * L::COUNT);
        }
        places & self.sides.look::<L>(token, leaf)
    }
}
