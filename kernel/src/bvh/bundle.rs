//! Packets that look the same way, walked through the tree together.
//!
//! # Method
//!
//! Up to four packets - 64 rays of 16 lanes - go down the tree as one bundle: a node's children are
//! tested against the bundle's [frustum](super::frustum), not against rays, nearest first; of a leaf
//! the spheres inside it are taken one by one, and each is tested against the rays, a ray a lane,
//! closest point first as in `bracket.rs`. Only what passes is asked of the tier. The depth beyond
//! which nothing matters shrinks with every hit.
//!
//! A bundle is walked so if its rays start at t >= 0, run the same way along an axis, and are
//! narrow: slopes within [`NARROW`]; others go one by one ([`nearest`](super::nearest)).

use super::frustum::{Frustum, Inside, Plane};
use super::resolve::{settle_outside, take};
use super::slabs::{Slabs, U, raised};
use super::{Bvh, BvhLeaf, DEPTH, LEAF, NO_CHILD, WIDTH};
use crate::accuracy::RayLanes;
use crate::axes::axes;
use crate::{Accuracy, HitPacket, LaneMask, Lanes, RayPacket, Spheres};

/// How many packets go together.
const BUNDLE: usize = 4;
/// The widest range of slopes that is walked as one.
const NARROW: f32 = 0.5;
/// The least n_k.
const ALONG: f32 = 1.0 / 16.0;
/// As in `walk.rs`.
const STACK: usize = 256;
const _: () = assert!(STACK >= (WIDTH - 1) * DEPTH + WIDTH);

/// The nearest hit of every ray, as [`nearest`](super::nearest), for rays that look the same way:
/// the rays of a camera, a tile of the picture a packet, or shadow rays to one light.
///
/// The answers are those of `nearest`, for any rays; rays that do not look the same way cost some
/// percent more than there.
#[inline(always)]
pub fn nearest_coherent<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    hits: &mut [HitPacket<L>],
) {
    let mut walk = BundleWalk::new();
    for (rays, hits) in rays.chunks(BUNDLE).zip(hits.chunks_mut(BUNDLE)) {
        if bvh.count != spheres.len() || !walk.bundle::<A, L, false>(token, rays, bvh, hits) {
            super::nearest::<A, L>(token, rays, spheres, bvh, hits);
        }
    }
}

/// Whether every ray meets anything, as [`any`](super::any), for rays that look the same way.
#[inline(always)]
pub fn any_coherent<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    met: &mut [u32],
) {
    let mut walk = BundleWalk::new();
    for (rays, met) in rays.chunks(BUNDLE).zip(met.chunks_mut(BUNDLE)) {
        let mut hits = [HitPacket::<L>::none(); BUNDLE];
        if bvh.count == spheres.len() && walk.bundle::<A, L, true>(token, rays, bvh, &mut hits) {
            for (met, hits) in met.iter_mut().zip(&hits) {
                *met = L::load(token, &hits.t).lt(L::splat(token, f32::INFINITY)).bits();
            }
        } else {
            super::any::<A, L>(token, rays, spheres, bvh, met);
        }
    }
}

/// A packet of a bundle: its rays with directions of unit length.
#[derive(Clone, Copy)]
struct Member<L: Lanes> {
    rays: RayLanes<L>,
    /// Whether the bounds cover all of its rays, and all start at t >= 0.
    covered: bool,
    direction: [L; 3],
    /// |d|: t times it is s.
    length: L,
    /// The start of the interval: an s.
    start: L,
    /// No hit beyond counts any more: an s.
    best: L,
}

impl<L: Lanes> Member<L> {
    #[inline(always)]
    fn new<A: Accuracy>(token: L::Token, packet: &RayPacket<L>, bvh: &Bvh<'_>) -> Self {
        let rays = RayLanes::load(token, packet);
        let slabs = Slabs::<L>::new::<A>(&rays, bvh.extent);
        let live = rays.live.bits();
        let forward = L::splat(token, 0.0).le(rays.t_min).bits();
        Self {
            rays,
            covered: live & !(slabs.judged & forward) == 0,
            direction: axes!(i => L::load(token, &slabs.direction[i])),
            length: L::load(token, &slabs.length),
            start: L::load(token, &slabs.start[0]),
            best: L::load(token, &slabs.end[1]),
        }
    }

    /// Which rays may meet sphere `place` of a leaf: the margin is that of `bracket.rs`.
    #[inline(always)]
    fn candidates<A: Accuracy>(&self, leaf: &BvhLeaf, place: usize) -> L::Mask {
        let token = self.length.token();
        let f = axes!(i => L::splat(token, leaf.center[i][place % WIDTH]) - self.rays.origin[i]);
        let radius = L::splat(token, leaf.radius[place % WIDTH]);
        let n = self.direction;
        let middle = f[2].filter_mul_add(n[2], f[1].filter_mul_add(n[1], f[0] * n[0]));
        let back = -middle;
        let q = axes!(i => back.filter_mul_add(n[i], f[i]));
        let ll = q[2].filter_mul_add(q[2], q[1].filter_mul_add(q[1], q[0] * q[0]));
        let size = middle.abs() + radius;
        let delta = size.filter_mul_add(radius.like(48.0 * U), radius.like(LEAST_DELTA));
        let reach = radius + delta;
        let most = reach * reach;
        let near = self.rays.live & (middle - reach).le(self.best) & self.start.le(middle + reach);
        if A::SPREAD > 0.0 {
            let spread = size * size.like(A::SPREAD);
            return self.rays.live & ll.le(spread.filter_mul_add(spread, most));
        }
        near & ll.le(most)
    }

    #[inline(always)]
    fn may_meet<A: Accuracy>(&self, leaf: &BvhLeaf, place: usize) -> bool {
        self.candidates::<A>(leaf, place).any()
    }

    /// Asks the tier about sphere `place` of a leaf.
    #[inline(always)]
    fn meet<A: Accuracy, const ANY: bool>(
        &mut self,
        leaf: &BvhLeaf,
        place: usize,
        hit: &mut HitPacket<L>,
    ) {
        let token = self.length.token();
        let asked = self.candidates::<A>(leaf, place);
        let center = axes!(i => L::splat(token, leaf.center[i][place % WIDTH]));
        let radius = L::splat(token, leaf.radius[place % WIDTH]);
        let limit = L::load(token, &hit.t);
        let prepared = A::prepare(&self.rays);
        let t = A::first_root(&self.rays, &prepared, center, radius, asked, limit);
        let t = L::select(asked, t, t.like(f32::INFINITY));
        let mut nearer = (asked & t.le(limit) & t.lt(t.like(f32::INFINITY))).bits();
        let t = t.store();
        while nearer != 0 {
            let lane = nearer.trailing_zeros() as usize;
            nearer &= nearer - 1;
            if let Some(&t) = t.as_ref().get(lane) {
                take(hit, lane, t, leaf.index[place % WIDTH]);
            }
        }
        self.shorten::<ANY>(hit);
    }

    /// Takes the hits so far as the ends of the rays.
    #[inline(always)]
    fn shorten<const ANY: bool>(&mut self, hit: &HitPacket<L>) {
        let t = L::load(self.length.token(), &hit.t);
        let infinity = t.like(f32::INFINITY);
        if ANY {
            let met = t.lt(infinity);
            self.rays.live = self.rays.live & !met;
            self.best = L::select(met, -infinity, self.best);
        } else {
            self.best = least(self.best, raised(t * self.length));
        }
    }
}

/// 2^-60, as in `bracket.rs`.
const LEAST_DELTA: f32 = 1.0 / (1_073_741_824.0 * 1_073_741_824.0);

#[inline(always)]
fn least<L: Lanes>(a: L, b: L) -> L {
    -(-a).filter_max(-b)
}

/// How deep a bundle's rays go, from its origins and its rays' ends.
struct Depths {
    origin: f32,
    rate: f32,
    pad: f32,
}

impl Depths {
    /// The greatest depth that a ray still goes to, raised by the margin.
    #[inline(always)]
    fn end<L: Lanes>(&self, members: &[Member<L>]) -> f32 {
        let mut farthest = f32::NEG_INFINITY;
        for member in members {
            let none = member.best.like(f32::NEG_INFINITY);
            farthest = greatest(L::select(member.rays.live, member.best, none), farthest);
        }
        let ahead = farthest * self.rate;
        self.origin + ahead + 8.0 * U * ahead.abs() + self.pad
    }
}

/// The largest of the lanes and `more`.
#[inline(always)]
fn greatest<L: Lanes>(lanes: L, more: f32) -> f32 {
    let mut largest = more;
    for &lane in lanes.store().as_ref() {
        if lane > largest {
            largest = lane;
        }
    }
    largest
}

/// The largest of an expression in the live lanes of all members; of what is not live, nothing.
macro_rules! greatest_of {
    ($members:ident, $member:ident => $value:expr) => {{
        let mut lanes = None;
        for $member in $members.iter() {
            let value: L = $value;
            let value = L::select($member.rays.live, value, value.like(f32::NEG_INFINITY));
            lanes = Some(match lanes {
                Some(so_far) => value.filter_max(so_far),
                None => value,
            });
        }
        match lanes {
            Some(lanes) => greatest(lanes, f32::NEG_INFINITY),
            None => f32::NEG_INFINITY,
        }
    }};
}

/// What the rays cannot leave, and how deep they go; nothing where they do not look the same way.
#[inline(always)]
fn frustum_of<L: Lanes>(members: &[Member<L>], bvh: &Bvh<'_>) -> Option<(Frustum, Depths)> {
    let mut along = None;
    for member in members {
        if !member.covered {
            return None;
        }
        if along.is_none() && member.rays.live.any() {
            let lane = member.rays.live.bits().trailing_zeros() as usize;
            let [x, y, z] = axes!(i => *member.direction[i].store().as_ref().get(lane)?);
            let axis = if x.abs() >= y.abs() && x.abs() >= z.abs() {
                (0, x)
            } else if y.abs() >= z.abs() {
                (1, y)
            } else {
                (2, z)
            };
            along = Some(axis);
        }
    }
    let (k, travel) = along?;
    let sign = if travel < 0.0 { -1.0 } else { 1.0 };
    let rate = greatest_of!(members, m => m.direction[k] * m.length.like(sign));
    let least_rate = -greatest_of!(members, m => m.direction[k] * m.length.like(-sign));
    if least_rate < ALONG {
        return None;
    }

    let far = axes!(i => greatest_of!(members, m => m.rays.origin[i].abs()));
    let size = bvh.extent + far[0].max(far[1]).max(far[2]);
    let mut planes = [Plane { across: 0, side: 0.0, slope: 0.0, offset: 0.0, length: 0.0 }; 4];
    for (pair, i) in [(k + 1) % 3, (k + 2) % 3].into_iter().enumerate() {
        let high = greatest_of!(members, m => m.direction[i] / m.direction[k]);
        let low = -greatest_of!(members, m => -(m.direction[i] / m.direction[k]));
        if high - low > NARROW {
            return None;
        }
        let (high, low) = (high + 8.0 * U * high.abs(), low - 8.0 * U * low.abs());
        for (one, (side, slope)) in
            [(sign, -sign * low), (-sign, sign * high)].into_iter().enumerate()
        {
            // The least of side x_i + slope x_k at the origins.
            let offset = -greatest_of!(members, m => {
                let across = m.rays.origin[i] * m.length.like(-side);
                across + m.rays.origin[k] * m.length.like(-slope)
            });
            let plane = planes.get_mut(2 * pair + one)?;
            *plane = Plane {
                across: i,
                side,
                slope,
                offset: offset - Plane::pad(slope, size),
                length: libm::sqrtf(1.0 + slope * slope) * (1.0 + 8.0 * U),
            };
        }
    }
    let pad = Plane::pad(0.0, size);
    let origin = greatest_of!(members, m => m.rays.origin[k] * m.length.like(sign));
    let start = -greatest_of!(members, m => m.rays.origin[k] * m.length.like(-sign));
    let depths = Depths { origin, rate, pad };
    let end = depths.end(members);
    Some((Frustum { planes, along: k, sign, start: start - pad, end }, depths))
}

/// The boxes that are yet to be looked into, the nearest on top.
struct BundleWalk {
    depths: [f32; STACK],
    children: [u32; STACK],
    top: usize,
}

impl BundleWalk {
    fn new() -> Self {
        Self { depths: [0.0; STACK], children: [NO_CHILD; STACK], top: 0 }
    }

    /// Walks one bundle; false, and nothing done, where its rays do not look the same way.
    #[inline(always)]
    fn bundle<A: Accuracy, L: Lanes, const ANY: bool>(
        &mut self,
        token: L::Token,
        packets: &[RayPacket<L>],
        bvh: &Bvh<'_>,
        hits: &mut [HitPacket<L>],
    ) -> bool {
        let Some(first) = packets.first() else { return true };
        let mut members = [Member::<L>::new::<A>(token, first, bvh); BUNDLE];
        for (member, packet) in members.iter_mut().zip(packets).skip(1) {
            *member = Member::<L>::new::<A>(token, packet, bvh);
        }
        let Some(members) = members.get_mut(..packets.len()) else { return false };
        let Some((mut frustum, depths)) = frustum_of(members, bvh) else { return false };
        for hit in hits.iter_mut() {
            *hit = HitPacket::<L>::none();
        }
        for (member, hit) in members.iter_mut().zip(hits.iter_mut()) {
            let live = member.rays.live.bits();
            settle_outside::<A, L>(token, &member.rays, bvh.outside, live, hit);
            member.shorten::<ANY>(hit);
        }

        frustum.end = depths.end(members);
        self.depths[0] = f32::NEG_INFINITY;
        self.children[0] = bvh.root;
        self.top = 1;
        let mut inside = Inside { places: 0, depths: [0.0; WIDTH] };
        while let Some(below) = self.top.checked_sub(1) {
            self.top = below;
            let at = below & (STACK - 1);
            let (depth, child) = (self.depths[at], self.children[at]);
            if depth > frustum.end {
                continue;
            }
            if child & LEAF == 0 {
                if let Some(node) = bvh.nodes.get(child as usize) {
                    frustum.enter::<L>(token, node, &mut inside);
                    self.push(&inside, &node.child);
                }
            } else if let Some(leaf) = bvh.leaves.get((child & !LEAF) as usize) {
                let mut places = frustum.look::<L>(token, leaf);
                let mut changed = false;
                while places != 0 {
                    let place = places.trailing_zeros() as usize % WIDTH;
                    places &= places - 1;
                    for (member, hit) in members.iter_mut().zip(hits.iter_mut()) {
                        if member.may_meet::<A>(leaf, place) {
                            changed = true;
                            L::out_of_line(
                                token,
                                #[inline(always)]
                                || member.meet::<A, ANY>(leaf, place, hit),
                            );
                        }
                    }
                }
                if changed {
                    frustum.end = depths.end(members);
                }
            }
        }
        true
    }

    #[inline(always)]
    fn push(&mut self, inside: &Inside, children: &[u32; WIDTH]) {
        let base = self.top;
        let mut places = inside.places;
        while places != 0 {
            let place = places.trailing_zeros() as usize % WIDTH;
            places &= places - 1;
            let depth = inside.depths[place];
            // Sink below what is nearer.
            let mut at = self.top;
            while at > base && self.depths[(at - 1) & (STACK - 1)] < depth {
                self.depths[at & (STACK - 1)] = self.depths[(at - 1) & (STACK - 1)];
                self.children[at & (STACK - 1)] = self.children[(at - 1) & (STACK - 1)];
                at -= 1;
            }
            self.depths[at & (STACK - 1)] = depth;
            self.children[at & (STACK - 1)] = children[place];
            self.top += 1;
        }
    }
}
