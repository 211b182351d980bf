//! Decides which rays go as a stream, and which ray by ray, from how many rays were seen to meet at a box.
//!
//! # Method
//!
//! A stream looks a node or a leaf up once for all rays that wait at it, so it pays where many rays wait. How many wait depends on the
//! rays, the scene, and how many rays go down together; the tree's size, the level and the number of rays tell less. So a few rays go as a
//! stream first, and the mean number at a box is counted, over all boxes that any of them enters. With n rays the mean is some 1 + c
//! n^(2/3) where few meet, and more where many do. It is some 1 + c n^(1/3) where most rays that meet at a leaf come one after the other,
//! as in short runs of a camera's rays: one run has little in common with the next. (By n^(2/3), 2,048 rays in cloud, 64 of a camera and 64
//! diffuse ones by turns, were predicted to be 6.1 at a box. 2.8 were, and the rays ran at 0.56 of the speed of ray by ray.) The mean so
//! predicted for all rays that would go down together decides. Every later stream is counted, too. After a stream that does not pay, rays
//! go ray by ray for some time.
//!
//! Time per ray, ray by ray over stream, with AVX-512 on a Sapphire Rapids, least of 3 to 7 (AVX2 and the baseline are within 0.1 of it):
//!
//! | spheres, rays, how many go down together | rays at a box | closest | any |
//! |---|--:|--:|--:|
//! | 1,000,000, diffuse, 8,192 | 1.9 | 0.59 | 0.43 |
//! | 64,000, diffuse, 2,048 | 2.2 | 0.70 | 0.56 |
//! | 1,000,000, to a light, 8,192 | 3.6 | 1.01 | 0.60 |
//! | 10,000, diffuse, 2,048 | 4.0 | 0.80 | 0.69 |
//! | 100,000 in chains, diffuse, 4,096 | 5.9 | 0.88 | 0.81 |
//! | 256,000, to a light, 8,192 | 6.3 | 1.11 | 0.88 |
//! | 4,000, diffuse, 2,048 | 6.8 | 1.01 | 0.89 |
//! | 1,000,000, a beam, 8,192 | 9.0 | 1.10 | 0.99 |
//! | 64,000, a shuffled camera, 2,048 | 10 | 1.28 | 1.20 |
//! | 10,000, diffuse, 8,192 | 11 | 1.13 | 0.96 |
//! | 64,000, along an axis, 8,192 | 13 | 1.39 | 1.17 |
//! | 100,000 in chains, a shuffled camera, 4,096 | 14 | 1.28 | 1.14 |
//! | 1,000, diffuse, 2,048 | 17 | 1.25 | 1.14 |
//! | 100,000 in chains, a beam, 4,096 | 19 | 1.39 | 1.27 |
//! | 200,000 that overlap, a beam, 8,192 | 32 | 1.24 | 1.08 |
//! | 64,000, two cameras, 8,192 | 34 | 1.60 | 1.51 |
//! | 4,000 nested, a beam, 4,096 | | 1.71 | 0.46 |
//! | the same, from all around | | 1.18 | 0.30 |
//! | 10,000 that overlap, diffuse, 4,096 | | 1.20 | 0.69 |
//!
//! For any hit, the last rows show that the number of rays at a box is not all: by itself, a ray looks into the first leaf that it comes
//! to, and may be done; a stream takes it to all boxes of a node first. So some rays go by themselves before a stream does, and the boxes
//! that they enter are counted, too. As a share of the boxes that they enter in a stream (4,096 rays, any hit, AVX-512 and AVX2):
//!
//! | spheres, rays | rays at a box | boxes by itself over those in a stream | times |
//! |---|--:|--:|--:|
//! | nested, from all around | 505 | 0.12 | 0.59, 0.67 |
//! | nested, after three bounces | 230 | 0.21 | 0.70, 0.75 |
//! | huge and tiny, from all around | 307 | 0.44 | 1.08, 1.09 |
//! | on huge ones, a beam | 285 | 0.56 | 1.08, 1.10 |
//! | nested, a beam | 179 | 0.65 | 1.22, 1.25 |
//! | 10,000, a beam | 22 | 0.72 | 1.11, 1.13 |
//! | 10,000, two cameras | 25 | 0.77 | 1.16, 1.18 |
//! | nested, a shuffled camera | 202 | 0.80 | 1.34, 1.31 |
//! | 10,000, diffuse | 7.1 | 0.84 | 0.95, 0.97 |
//!
//! On a Zen 3 (AVX2, 8,192 rays) a stream needs a larger share where the tree lies in the core's own cache: streams among 3,000 spheres
//! that overlap, share 0.54, run at 0.80 to 0.88 of the speed of ray by ray; with rays from between the spheres, share 0.35, at 0.78.
//!
//! Small trees have a traversal of their own (`small_tree.rs`), which is faster.
//!
//! Rays that would gain by being sorted are sorted before they come here (`coherent/ray_order.rs`).

use super::StreamMemory;
use super::likeness::Likeness;
use super::seen::Seen;
use crate::bvh::traverse::small_tree;
use crate::bvh::traverse::wavefront::Entered;
use crate::bvh::tree::Bvh;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::LaneArray;
use crate::query::Query;

/// How many rays must meet at a box, on average, for a stream to pay: for the closest hit; and for any hit, where the mean is multiplied by
/// the share of its boxes that a ray enters by itself. (With 10 for any hit, whatever the share: rays sorted by direction among 120,000
/// spheres that overlap, mean 13 and share 0.48, ran at 0.88 to 0.96 of the speed; diffuse ones in chains, mean 8.8 and share 1, at 0.8 to
/// 0.95.)
const ENOUGH: [f32; 2] = [6.0, 7.0];
/// The same for any hit in a tree that is near. (With 7, diffuse rays among radii that spread over 10^6, mean 9 and share 0.79, ran at 0.88
/// of the speed; with 8.5, short rays in a city, which enter few boxes, at 0.86.)
const ENOUGH_NEAR: f32 = 10.0;
/// As [`ENOUGH`], for rays that enter [`MANY`] boxes each, or more: what a stream takes for a ray, however few its boxes, matters less
/// there. (Huge and tiny spheres, 3,600 shuffled rays that enter 44 boxes each, 4 to 5 rays at a box: a stream of all is 1.8 to 1.9 times
/// as fast as ray by ray. A call ran at 0.64 to 0.78 of the speed of that stream; now it runs at 0.76 to 0.98.)
const ENOUGH_OF_MANY: [f32; 2] = [3.5, 4.0];
const MANY: f32 = 20.0;
/// The share of its boxes in a stream that a ray must at least enter by itself, or the stream is in vain: in a tree that is far from the
/// core, and in one that is near it.
const SPARED: [f32; 2] = [0.35, 0.6];
/// Nothing is learnt of rays that enter fewer boxes, in all. (A picture of ground from the top: 112 rays met at a box, over four boxes, and
/// 2.4 later; 1,024 rays ran at 0.63 to 0.66 of the speed of ray by ray. With three boxes a ray as the limit instead, two
/// cameras over flake4, 1,024 rays, ran at 0.94 instead of 1.07.)
const TELLING: u32 = 8;
/// Nor is anything learnt of fewer rays; rays that groups have answered do not count. (A sample of 19 rays suggested that too few rays
/// would meet. All later rays looked alike, so none was sampled again: any hits of 33,000 rays from a point all around, sorted, among
/// 200,000 spheres, ran at 0.77 of the speed of 34,000.)
const TELLING_RAYS: u32 = 64;
/// How many rays go down together, if there is memory for so many. In u10k, 4,096 are 3 to 5 % slower, and 2,048 a sixth; 32,768 take
/// longer at all levels except AVX-512.
pub(super) const TOGETHER: usize = 8192;
/// Fewer rays do not go as a stream.
const LEAST_RAYS: usize = 1024;
/// A first stream takes an eighth of the rays, but at least and at most so many; for any hit, as many go by themselves before it. (Tried:
/// before every stream, a sample of packets from everywhere among the next 8,192 rays. On a Zen 3, where diffuse rays lose most by streams,
/// a camera's rays and then diffuse ones, 6,000 to 16,000 among a million spheres, took 0.6 to 0.95 of the time. But calls of 16,384 rays
/// of flake4 took 1.05; with samples of 256 rays, diffuse ones took 1.16, since too few seemed to meet.)
const FIRST: [usize; 2] = [128, 1024];
/// What is left of [`LEAST_RAYS`] after the fewest that go by themselves first.
const LEAST_LEFT: usize = LEAST_RAYS - FIRST[0];
/// Rays that have entered more boxes by themselves than so many times as many as others enter in a stream are not like these others.
const MOST_ALONE: f32 = 1.25;
/// After so many rays, the boxes that rays enter by themselves are counted anew; at once, if the last count does not fit a stream. (Rays of
/// the upper rows of a picture enter a box or two. By that, streams of the rows below seemed to be in vain: any hits of two cameras over
/// chains ran at 0.61 to 0.70 of the speed of a stream of all.)
const BELIEVED: usize = 1 << 15;
/// After a stream that does not pay, the first number of rays go by themselves; after the next such stream twice as many, up to the second
/// number.
const PASSED_OVER: [usize; 2] = [1 << 14, 1 << 18];
/// Queues with fewer places for a ray are cut short too often. (With one place a ray, a stream took 2.5 times as long as ray by ray; with
/// 4, it runs at 0.87 of the speed of ray by ray.)
const LEAST_QUEUES: usize = 8;

/// How rays that have nothing in common go through a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StreamStrategy {
    RayByRay,
    Stream,
}

/// What is learnt of rays as they come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sharing {
    /// How many rays met at a box in the last stream, NaN where nothing is known; and how many went together.
    met: f32,
    of: f32,
    /// Whether a ray entered many boxes.
    is_many: bool,
    /// Whether most of the rays that met came one after the other.
    in_bunches: bool,
    /// How many boxes a ray enters by itself, NaN where that is not known, and of how many more rays that is believed.
    alone: f32,
    believed: usize,
    /// `alone` as a share of the boxes that a ray enters in a stream; all of them where that is not known.
    share: f32,
    /// Whether the rays that `alone` was counted of came right before the next.
    is_alone_next: bool,
    waiting: Waiting,
    /// The likeness of the rays that were seen last.
    likeness: Likeness,
}

/// How many rays are still passed over before a stream is tried again, and how many were to be.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    left: usize,
    of: usize,
}

impl Waiting {
    const NONE: Self = Self { left: 0, of: 0 };

    fn pass_over(&mut self, rays: usize) {
        self.left = self.left.saturating_sub(rays);
    }

    fn take(&mut self, paid: bool) {
        let [least, most] = PASSED_OVER;
        self.of = if paid { 0 } else { (2 * self.of).clamp(least, most) };
        self.left = self.of.max(least);
    }
}

impl Sharing {
    /// Nothing is known.
    pub(crate) const NOTHING: Self = Self {
        met: f32::NAN,
        of: 1.0,
        is_many: false,
        in_bunches: false,
        alone: f32::NAN,
        believed: 0,
        share: 1.0,
        is_alone_next: false,
        waiting: Waiting::NONE,
        likeness: Likeness::OF_NONE,
    };

    /// Whether enough of so many rays would meet at a box; `false` where nothing is known.
    fn is_enough<Q: Query>(&self, bvh: &Bvh<'_>, rays: usize) -> bool {
        let root = libm::cbrtf(rays as f32 / self.of);
        let times = if self.in_bunches { root } else { root * root };
        let together = 1.0 + (self.met - 1.0) * times;
        let [closest, any] = if self.is_many { ENOUGH_OF_MANY } else { ENOUGH };
        if !Q::ANY {
            return together >= closest;
        }
        let any = if bvh.is_near() && !self.is_many { ENOUGH_NEAR } else { any };
        together * self.share >= any
    }

    /// How many of so many rays go down together.
    #[cfg(feature = "alloc")]
    pub(crate) fn together(rays: usize) -> usize {
        rays.clamp(LEAST_RAYS, TOGETHER)
    }

    /// Whether a stream of so many rays would pay, or may be tried because nothing is known.
    #[cfg(feature = "alloc")]
    pub(crate) fn may_pay<Q: Query>(&self, bvh: &Bvh<'_>, rays: usize) -> bool {
        let pays = if self.met.is_nan() {
            self.waiting.left == 0
        } else {
            self.is_enough::<Q>(bvh, rays.min(TOGETHER))
        };
        rays >= LEAST_RAYS && small_tree::leaves(bvh).is_none() && pays
    }

    /// The strategy for the next rays, and how many rays it is for.
    pub(super) fn next<A: LaneArray, Q: Query>(
        &mut self,
        bvh: &Bvh<'_>,
        memory: &StreamMemory<'_>,
        packets: &[RayPacket<A>],
    ) -> (StreamStrategy, usize) {
        let rays = packets.len() * A::COUNT;
        let together = memory.rays.len().min(TOGETHER);
        if memory.everywhere {
            return (StreamStrategy::Stream, rays);
        }
        let is_too_little = together < LEAST_RAYS || memory.queues.len() < LEAST_QUEUES * together;
        if small_tree::leaves(bvh).is_some() || is_too_little {
            return (StreamStrategy::RayByRay, rays);
        }

        // Nothing is known of the next rays if they look otherwise.
        let next = packets.get(..together / A::COUNT).unwrap_or(packets);
        let mut alike = self.likeness.end(next) * A::COUNT;
        if alike == 0 {
            *self = Self::NOTHING;
            alike = next.len() * A::COUNT;
        }

        let batch = alike;
        let pays = self.is_enough::<Q>(bvh, batch);
        let is_tried = self.met.is_nan() && self.waiting.left == 0 && rays >= LEAST_LEFT;
        if pays | is_tried {
            let first = (rays / 8).clamp(FIRST[0], FIRST[1]).min(batch);
            if Q::ANY && self.believed == 0 {
                self.believed = BELIEVED;
                return (StreamStrategy::RayByRay, first);
            }
            let count = if pays { batch } else { first };
            let these = packets.get(..count.div_ceil(A::COUNT)).unwrap_or(packets);
            self.likeness = Likeness::of(these);
            return (StreamStrategy::Stream, count);
        }
        self.pass_over(alike);
        (StreamStrategy::RayByRay, alike)
    }

    /// Counts rays that went by themselves. Of fewer rays than a stream can have too few may meet, though of as many as it can have
    /// enough would: after a time that is forgotten, and other rays, or those in another tree, are tried.
    pub(crate) fn pass_over(&mut self, rays: usize) {
        self.waiting.pass_over(rays);
        if self.waiting.left == 0 {
            self.met = f32::NAN;
        }
    }

    /// Takes the count of boxes that rays by themselves have entered.
    pub(super) fn take_alone(&mut self, entered: Entered) {
        if entered.rays > 0 {
            self.alone = entered.boxes as f32 / entered.rays as f32;
            self.is_alone_next = true;
        }
    }

    /// Takes what a stream has seen.
    pub(super) fn take<Q: Query>(&mut self, bvh: &Bvh<'_>, seen: Seen) {
        // Rays that all enter the same few boxes, or none, tell nothing.
        if seen.boxes < TELLING || seen.rays < TELLING_RAYS {
            return;
        }
        let met = seen.entered as f32 / seen.boxes as f32;
        let rays = seen.rays as f32;
        (self.met, self.of) = (met, rays / seen.streams as f32);
        self.is_many = seen.entered as f32 >= MANY * rays;
        self.in_bunches = seen.is_in_bunches();
        // (NaN where nothing is known of rays by themselves.)
        let share = self.alone * rays / seen.entered as f32;
        let is_alone_next = core::mem::take(&mut self.is_alone_next);
        if is_alone_next {
            self.share = share.min(1.0);
        }
        // Judged for 8,192 rays, the most that go down together: more of those meet.
        let mut paid = self.is_enough::<Q>(bvh, TOGETHER);
        if Q::ANY {
            let is_in_vain = share < SPARED[usize::from(bvh.is_near())];
            self.believed = self.believed.saturating_sub(seen.rays as usize);
            if !is_alone_next && (is_in_vain || share > MOST_ALONE) {
                self.believed = 0;
                if is_in_vain {
                    (self.met, self.waiting.left) = (f32::NAN, 0);
                    return;
                }
            }
            paid &= !is_in_vain;
        }
        self.waiting.take(paid);
        if !paid {
            self.met = f32::NAN;
        }
    }
}

#[cfg(all(test, proofs))]
#[cfg(feature = "std")]
mod tests;
