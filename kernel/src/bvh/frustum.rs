//! The planes and the depths between which a bundle of rays runs.
//!
//! # Method
//!
//! Rays that run the same way along an axis k, n_k of one sign sigma, have slopes n_i / n_k and n_j /
//! n_k along the two others. With the least and the greatest of each, every point that a ray
//! reaches from its origin on is inside four planes, sigma (x_i - u_min x_k) >= D and so on, where
//! D is the least of the same expression at the origins (Reshetov, Soupikov and Hurley 2005, Multi-
//! Level Ray Tracing Algorithm). A box is outside where its farthest corner is; a sphere where its
//! centre is by more than its radius times the length of the normal. Along k itself the bundle is
//! bounded by its origins, and by how far its rays still go.
//!
//! # The margin
//!
//! As `slabs.rs` shows, what a tier calls a hit lies within 111 u M of the sphere's box, where M is the
//! extent and |o| together.
//! A slope is 3u off in itself and is moved by 8u. With the plane's |normal|_1 = 1 + |slope|
//! that is 111 u M (1 + |slope|) of the plane's expression; its rounding, and that of D, are below
//! 8 u M (1 + |slope|). The pad is 128 u M (1 + |slope|), and 2^-80 for what underflows. Depths are
//! the case of slope 0.

use super::slabs::{LEAST_PAD, U};
use super::{BvhLeaf, BvhNode, WIDTH};
use crate::Lanes;
use crate::bvh::bracket::part_of;

/// A plane: inside is `side * x_across - slope * x_along >= offset`, with `side` 1 or -1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    pub(super) across: usize,
    /// The sign of the coordinate across, and whether the box's upper corner is the farther.
    pub(super) side: f32,
    /// What the coordinate along is multiplied by, the sign of travel in it.
    pub(super) slope: f32,
    /// The least of the expression at the origins, lowered by the margin.
    pub(super) offset: f32,
    /// The length of the normal, rounded up.
    pub(super) length: f32,
}

/// What a bundle of rays cannot leave.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frustum {
    pub(super) planes: [Plane; 4],
    /// The axis that all rays run along.
    pub(super) along: usize,
    /// In which direction: 1 or -1.
    pub(super) sign: f32,
    /// The least depth, sigma x_k, of an origin, lowered by the margin.
    pub(super) start: f32,
    /// The greatest depth that a ray still goes to, raised by the margin.
    pub(super) end: f32,
}

/// What of a node or a leaf is inside: a bit a child or sphere, and the depth it begins at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inside {
    pub(super) places: u32,
    pub(super) depths: [f32; WIDTH],
}

impl Plane {
    #[inline(always)]
    pub(super) fn pad(slope: f32, size: f32) -> f32 {
        128.0 * U * size * (1.0 + slope.abs()) + LEAST_PAD
    }
}

impl Frustum {
    /// Which children of a node may be met.
    #[inline(always)]
    pub(super) fn enter<L: Lanes>(&self, token: L::Token, node: &BvhNode, inside: &mut Inside) {
        let k = self.along;
        let (first, last) = if self.sign > 0.0 {
            (&node.low[k], &node.high[k])
        } else {
            (&node.high[k], &node.low[k])
        };
        let sign = L::splat(token, self.sign);
        inside.places = 0;
        for part in 0..WIDTH / L::COUNT {
            let begin = part_of::<L>(token, first, part) * sign;
            let finish = part_of::<L>(token, last, part) * sign;
            let mut met =
                begin.le(L::splat(token, self.end)) & L::splat(token, self.start).le(finish);
            for plane in &self.planes {
                let i = plane.across;
                let across = if plane.side > 0.0 { &node.high[i] } else { &node.low[i] };
                let along = if plane.slope > 0.0 { &node.high[k] } else { &node.low[k] };
                let across = part_of::<L>(token, across, part) * L::splat(token, plane.side);
                let along = part_of::<L>(token, along, part);
                let farthest = along.filter_mul_add(L::splat(token, plane.slope), across);
                met = met & L::splat(token, plane.offset).le(farthest);
            }
            inside.places |= crate::LaneMask::bits(met) << (part * L::COUNT);
            super::ray_walk::put_part(&mut inside.depths, part, begin);
        }
    }

    /// Which spheres of a leaf may be met.
    #[inline(always)]
    pub(super) fn look<L: Lanes>(&self, token: L::Token, leaf: &BvhLeaf) -> u32 {
        let k = self.along;
        let mut places = 0;
        for part in 0..WIDTH / L::COUNT {
            let radius = part_of::<L>(token, &leaf.radius, part);
            let along = part_of::<L>(token, &leaf.center[k], part);
            let depth = along * L::splat(token, self.sign);
            let mut met = L::splat(token, 0.0).le(radius)
                & (depth - radius).le(L::splat(token, self.end))
                & L::splat(token, self.start).le(depth + radius);
            for plane in &self.planes {
                let across = part_of::<L>(token, &leaf.center[plane.across], part);
                let across = across * L::splat(token, plane.side);
                let at = along.filter_mul_add(L::splat(token, plane.slope), across);
                let farthest = radius.filter_mul_add(L::splat(token, plane.length), at);
                met = met & L::splat(token, plane.offset).le(farthest);
            }
            places |= crate::LaneMask::bits(met) << (part * L::COUNT);
        }
        places
    }
}
