//! Packets that look the same way, walked through the tree together.
//!
//! # Method
//!
//! Up to four packets - 64 rays of 16 lanes - go down the tree as one bundle: a node's children are
//! tested against the bundle's [frustum](super::frustum), not against rays, nearest first; so are the
//! spheres of a leaf, and those inside against the narrower planes of each packet; what is left
//! is tested against the packet's rays, a ray a lane (`member.rs`). The depth beyond which nothing
//! matters shrinks with every hit.
//!
//! A bundle is walked so if its rays start at t >= 0, run the same way along an axis, and are
//! narrow: slopes within [`NARROW`]; others go one by one ([`nearest`](super::nearest)).

use super::frustum::{Frustum, Inside, Line, Sides, across, margin};
use super::member::Member;
use super::slabs::U;
use super::{Bvh, DEPTH, LEAF, NO_CHILD, WIDTH};
use crate::axes::axes;
use crate::{Accuracy, HitPacket, LaneMask, Lanes, RayPacket, Spheres};

/// How many packets go together.
const BUNDLE: usize = 4;
/// The widest range of slopes that is walked as one.
const NARROW: f32 = 0.5;
/// The least |n_k|.
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
    let nobody = RayPacket::<L>::inactive();
    for (rays, hits) in rays.chunks(BUNDLE).zip(hits.chunks_mut(BUNDLE)) {
        let mut members = members_of::<L>(token, rays, &nobody);
        let Some(members) = members.get_mut(..rays.len()) else { continue };
        if bvh.count == spheres.len() && walk.bundle::<A, L, false>(token, members, bvh) {
            for (member, hits) in members.iter().zip(hits) {
                *hits = member.hits();
            }
        } else {
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
    let nobody = RayPacket::<L>::inactive();
    for (rays, met) in rays.chunks(BUNDLE).zip(met.chunks_mut(BUNDLE)) {
        let mut members = members_of::<L>(token, rays, &nobody);
        let Some(members) = members.get_mut(..rays.len()) else { continue };
        if bvh.count == spheres.len() && walk.bundle::<A, L, true>(token, members, bvh) {
            for (member, met) in members.iter().zip(met) {
                *met = member.met();
            }
        } else {
            super::any::<A, L>(token, rays, spheres, bvh, met);
        }
    }
}

/// The members of a bundle; those past its end are `nobody`.
#[inline(always)]
fn members_of<'a, L: Lanes>(
    token: L::Token,
    rays: &'a [RayPacket<L>],
    nobody: &'a RayPacket<L>,
) -> [Member<'a, L>; BUNDLE] {
    let [a, b, c, d] = match *rays {
        [ref a, ref b, ref c, ref d] => [a, b, c, d],
        [ref a, ref b, ref c] => [a, b, c, nobody],
        [ref a, ref b] => [a, b, nobody, nobody],
        [ref a] => [a, nobody, nobody, nobody],
        _ => [nobody; BUNDLE],
    };
    [Member::new(token, a), Member::new(token, b), Member::new(token, c), Member::new(token, d)]
}

/// The largest of an expression in the live lanes of some members; `-inf` where none is live.
macro_rules! greatest_of {
    ($members:expr, $member:ident => $value:expr) => {{
        let mut lanes = None;
        for $member in $members.iter() {
            let value: L = $value;
            let value = L::select($member.live, value, value.like(f32::NEG_INFINITY));
            lanes = Some(match lanes {
                Some(so_far) => value.filter_max(so_far),
                None => value,
            });
        }
        match lanes {
            Some(lanes) => lanes.filter_greatest(),
            None => f32::NEG_INFINITY,
        }
    }};
}

/// Where the rays of a bundle run.
struct Course {
    along: usize,
    /// Which way along: 1 or -1.
    sign: f32,
    /// The extent of the tree and the farthest origin together.
    size: f32,
    /// Where all rays start, if they do so in one point.
    origin: Option<[f32; 3]>,
}

impl Course {
    /// Nothing where not all rays run the same way, and far enough, along an axis.
    #[inline(always)]
    fn of<L: Lanes>(members: &[Member<'_, L>], bvh: &Bvh<'_>) -> Option<Self> {
        let mut first = None;
        for member in members {
            if !member.covered {
                return None;
            }
            if first.is_none() && member.live.any() {
                first = Some((member, member.live.bits().trailing_zeros() as usize));
            }
        }
        let (member, lane) = first?;
        let [x, y, z] = axes!(i => *member.direction[i].store().as_ref().get(lane)?);
        let (along, travel) = if x.abs() >= y.abs() && x.abs() >= z.abs() {
            (0, x)
        } else if y.abs() >= z.abs() {
            (1, y)
        } else {
            (2, z)
        };
        let sign = if travel < 0.0 { -1.0 } else { 1.0 };
        let origin = axes!(i => *member.origin[i].store().as_ref().get(lane)?);

        let mut one_origin = true;
        for member in members {
            let (live, o) = (member.live, member.origin);
            let forward = member.direction[along % 3] * member.length.like(sign);
            if (live & forward.lt(forward.like(ALONG))).any() {
                return None;
            }
            let [x, y, z] = axes!(i => {
                let shared = o[i].like(origin[i]);
                o[i].lt(shared) | shared.lt(o[i])
            });
            one_origin = one_origin && !(live & (x | y | z)).any();
        }
        let far = if one_origin {
            origin[0].abs().max(origin[1].abs()).max(origin[2].abs())
        } else {
            {
                let far = axes!(i => greatest_of!(members, m => m.origin[i].abs()));
                far[0].max(far[1]).max(far[2])
            }
        };
        let origin = one_origin.then_some(origin);
        Some(Self { along, sign, size: bvh.extent + far, origin })
    }

    /// The planes around some members, whose slopes along the axes across lie in `slopes`: least
    /// and greatest, per depth.
    #[inline(always)]
    fn sides<L: Lanes>(&self, members: &[Member<'_, L>], slopes: [[f32; 2]; 2]) -> Sides {
        let k = self.along % 3;
        let mut sides = Sides { along: k, ..Sides::NONE };
        for ((i, [low, high]), lines) in across(k).into_iter().zip(slopes).zip(&mut sides.lines) {
            let low = self.sign * (low - 8.0 * U * low.abs());
            let high = self.sign * (high + 8.0 * U * high.abs());
            let (least, most) = match self.origin {
                Some(origin) => (origin[i % 3] - low * origin[k], origin[i % 3] - high * origin[k]),
                None => {
                    let least = -greatest_of!(members, m => {
                        m.origin[k] * m.length.like(low) - m.origin[i % 3]
                    });
                    let most = greatest_of!(members, m => {
                        m.origin[i % 3] - m.origin[k] * m.length.like(high)
                    });
                    (least, most)
                }
            };
            *lines =
                [Line::new(1.0, low, least, self.size), Line::new(-1.0, high, most, self.size)];
        }
        sides
    }

    /// What the rays cannot leave, and the same for each member; nothing where they are not narrow.
    #[inline(always)]
    fn enclose<L: Lanes>(&self, members: &mut [Member<'_, L>]) -> Option<Frustum> {
        let k = self.along % 3;
        let mut all = [[f32::INFINITY, f32::NEG_INFINITY]; 2];
        for member in &mut *members {
            let per_depth = member.length.like(self.sign) / member.direction[k];
            let mut slopes = all;
            for ((i, [low, high]), all) in across(k).into_iter().zip(&mut slopes).zip(&mut all) {
                let slope = member.direction[i % 3] * per_depth;
                let none = slope.like(f32::NEG_INFINITY);
                *high = L::select(member.live, slope, none).filter_greatest();
                *low = -L::select(member.live, -slope, none).filter_greatest();
                *all = [all[0].min(*low), all[1].max(*high)];
            }
            member.sides = self.sides(core::slice::from_ref(&*member), slopes);
        }
        if all[0][1] - all[0][0] > NARROW || all[1][1] - all[1][0] > NARROW {
            return None;
        }
        let start = match self.origin {
            Some(origin) => self.sign * origin[k],
            None => -greatest_of!(members, m => m.origin[k] * m.length.like(-self.sign)),
        };
        Some(Frustum {
            sides: self.sides(members, all),
            sign: self.sign,
            start: start - margin(0.0, self.size),
            end: self.end(members),
        })
    }

    /// The greatest depth that a ray still goes to, raised by the margin.
    #[inline(always)]
    fn end<L: Lanes>(&self, members: &[Member<'_, L>]) -> f32 {
        let k = self.along % 3;
        let end = greatest_of!(members, m => {
            let (sign, per_depth) = (m.length.like(self.sign), m.direction[k]);
            (m.best * per_depth + m.origin[k]) * sign
        });
        end + 8.0 * U * end.abs() + 2.0 * margin(0.0, self.size)
    }
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
        members: &mut [Member<'_, L>],
        bvh: &Bvh<'_>,
    ) -> bool {
        let Some(course) = Course::of(members, bvh) else { return false };
        let Some(mut frustum) = course.enclose(members) else { return false };
        if !bvh.outside.is_empty() {
            for member in &mut *members {
                member.meet_outside::<A, ANY>(bvh.outside);
            }
            frustum.end = course.end(members);
        }

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
                continue;
            }
            let number = child & !LEAF;
            let Some(leaf) = bvh.leaves.get(number as usize) else { continue };
            let places = frustum.look::<L>(token, leaf);
            if places == 0 {
                continue;
            }
            let mut changed = false;
            for member in &mut *members {
                let mut places = places & member.sides.look::<L>(token, leaf);
                while places != 0 {
                    let place = places.trailing_zeros() as usize;
                    places &= places - 1;
                    changed |= member.meet::<A, ANY>(bvh, (number, leaf), place);
                }
            }
            if changed {
                frustum.end = course.end(members);
            }
        }
        for member in members {
            member.finish::<A, ANY>(bvh.leaves);
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
