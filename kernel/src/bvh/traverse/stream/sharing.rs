//! Which rays go as a stream, and which ray by ray: what is seen of how many wait at a node.
//!
//! # Method
//!
//! A stream looks a node up once for all rays that wait at it, so it pays where these are many. How many depends on
//! the rays, the scene, and how many rays go down together; the tree's size, the level and the scene's name tell
//! less. So a few rays go as a stream first, and the mean is counted, over all nodes that any of them enters. With n
//! rays it is some 1 + c n: more rays meet at the same nodes. What that says of as many rays as there are decides;
//! every stream that follows is counted, too. After one that does not pay, rays go ray by ray for some time.
//!
//! Times a ray, ray by ray over stream, AVX-512 on a Sapphire Rapids, least of 3 to 7; AVX2 is within 0.06 of it:
//!
//! | spheres, rays of them together | at a node | closest | any |
//! |---|--:|--:|--:|
//! | 1,000,000, diffuse, 8,192 | 3.4 | 0.59 | 0.43 |
//! | 64,000, diffuse, 2,048 | 5.6 | 0.70 | 0.56 |
//! | 1,000,000, to a light, 8,192 | 13 | 1.01 | 0.60 |
//! | 10,000, diffuse, 2,048 | 20 | 0.80 | 0.69 |
//! | 64,000, along an axis, 2,048 | 22 | 1.06 | 0.86 |
//! | 256,000, to a light, 8,192 | 31 | 1.11 | 0.88 |
//! | 64,000, a shuffled camera, 2,048 | 41 | 1.28 | 1.20 |
//! | 256,000, a beam, 8,192 | 56 | 1.23 | 1.11 |
//! | 10,000, diffuse, 8,192 | 82 | 1.13 | 0.96 |
//! | 1,000, diffuse, 2,048 | 108 | 1.25 | 1.14 |
//! | 10,000, a beam, 8,192 | 457 | 1.29 | 1.13 |
//! | 64,000, two cameras, 8,192 | 195 | 1.60 | 1.51 |
//! | 7,381 of a flake, a beam, 4,096 | 104 | 1.27 | 0.94 |
//! | 4,000 nested, a beam, 4,096 | 506 | 1.71 | 0.46 |
//! | the same, from all around | 484 | 1.18 | 0.30 |
//! | 10,000 that overlap, diffuse, 4,096 | 75 | 1.20 | 0.69 |
//!
//! Of any hit the last rows say that rays at a node are not all: by itself a ray looks into the first leaf that it comes to, and
//! may be done. What a stream did in vain is seen, too: of nested and overlapping spheres rays took 1.2 to 1.4 places in queues
//! for each box that they entered in the end, or entered 2.5 to 5 leaves a node; of others at most 1.12, and 1.2.
//!
//! Trees of few leaves have a way of their own (`few.rs`), which is faster.
//!
//! Where too few meet, sorting may bring them together, if the tree is far from the core, and rays are many: a million
//! spheres, 65,536 rays, closest hit: to a light 1.43, a beam 1.17, diffuse 0.91 (262,144: 1.08). Rays that are done at
//! their first hit lose by it.

use super::{StreamMemory, TOGETHER};
use crate::bvh::traverse::few;
use crate::bvh::tree::Bvh;
use crate::query::Query;

/// How rays that have nothing in common go through a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    RayByRay,
    AsTheyCome,
    Sorted,
}

/// So many rays must wait at a node, on average: for the closest hit, and for any.
const ENOUGH: [f32; 2] = [20.0, 100.0];
/// Fewer of rays that are sorted are less than it costs.
const ENOUGH_SORTED: f32 = 10.0;
/// Fewer rays are no stream.
const LEAST_RAYS: usize = 2048;
/// A first stream takes an eighth of the rays, and at least and at most so many.
const FIRST: [usize; 2] = [256, 1024];
/// After a stream that does not pay so many rays go by themselves; after the next twice as many, up to so many.
const PASSED_OVER: [usize; 2] = [1 << 14, 1 << 18];
/// Queues with less room for a ray are cut short too often. (With one place a ray a stream took 2.5 times as long as ray by
/// ray, with 4 it runs at 0.87 of its speed.)
const LEAST_QUEUES: usize = 8;
/// Trees of more bytes are far from the core: rays that are sorted share what they read.
const FAR: usize = 1 << 21;
/// Of trees that are far, sorted rays meet if there is one for so many spheres.
const SPHERES_A_SORTED_RAY: usize = 16;

/// What is learnt of rays as they come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sharing {
    /// c, as it was seen last; not a number where nothing is known.
    per_ray: f32,
    as_they_come: Waiting,
    sorted: Waiting,
}

/// How many rays are passed over before the next are tried, of how many.
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
        self.left = self.of;
    }
}

/// What a stream has seen.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Seen {
    /// How often rays went down, and how many in all.
    pub(super) streams: u32,
    pub(super) rays: u32,
    /// How many nodes they entered, counted once for all that did at once, and once for each; leaves, once for each.
    pub(super) nodes: u32,
    pub(super) entered: u32,
    pub(super) leaves: u32,
    /// How many places in queues they took.
    pub(super) queued: u32,
}

impl Seen {
    /// How many rays entered a node at once.
    fn at_a_node(self) -> f32 {
        self.entered as f32 / self.nodes as f32
    }

    /// Whether rays that are done at their first hit would have done much less by themselves: where they find something
    /// before it is their turn at most boxes, or look into many leaves.
    fn is_in_vain(self) -> bool {
        let [entered, leaves] = [self.entered, self.leaves].map(u64::from);
        20 * u64::from(self.queued) > 23 * (entered + leaves) || 2 * leaves > 3 * entered
    }
}

impl Sharing {
    /// Nothing.
    pub(crate) const NOTHING: Self =
        Self { per_ray: f32::NAN, as_they_come: Waiting::NONE, sorted: Waiting::NONE };

    /// How many rays of that number would wait at a node.
    fn at_a_node(&self, rays: usize) -> f32 {
        1.0 + self.per_ray * rays as f32
    }

    /// Whether a stream of so many rays may pay, or it is not known, if they are of so many in all.
    #[cfg(feature = "alloc")]
    pub(crate) fn may_pay<Q: Query>(&self, bvh: &Bvh<'_>, rays: usize, in_all: usize) -> bool {
        let batch = rays.min(together(in_all));
        let pays = if self.per_ray.is_nan() {
            self.as_they_come.left == 0
        } else {
            self.at_a_node(batch) >= ENOUGH[usize::from(Q::ANY)]
        };
        rays >= LEAST_RAYS && few::few(bvh).is_none() && (pays || self.may_sort::<Q>(bvh, rays))
    }

    /// Whether it may pay to sort so many rays.
    pub(crate) fn may_sort<Q: Query>(&self, bvh: &Bvh<'_>, rays: usize) -> bool {
        let size = size_of_val(bvh.nodes) + size_of_val(bvh.numbers);
        let are_many = rays > TOGETHER && rays >= bvh.spheres.len() / SPHERES_A_SORTED_RAY;
        // (What is outside would have to be known ray by ray.)
        let is_for = !Q::ANY && size > FAR && bvh.outside.is_empty();
        is_for && are_many && self.sorted.left == 0
    }

    /// The way of the next rays of so many, and of how many; they can be sorted if there is nothing known of any.
    pub(super) fn next<Q: Query>(
        &mut self,
        bvh: &Bvh<'_>,
        memory: &StreamMemory<'_>,
        rays: usize,
        is_new: bool,
    ) -> (Way, usize) {
        let together = memory.rays.len().min(TOGETHER);
        let sortable = if is_new { rays.min(memory.order.len() / 2) } else { 0 };
        if memory.everywhere {
            let is_sorted = bvh.outside.is_empty() && sortable > together;
            return if is_sorted { (Way::Sorted, rays) } else { (Way::AsTheyCome, rays) };
        }
        if few::few(bvh).is_some() || memory.queues.len() < LEAST_QUEUES * together {
            return (Way::RayByRay, rays);
        }

        let batch = rays.min(together);
        if self.at_a_node(batch) >= ENOUGH[usize::from(Q::ANY)] {
            return (Way::AsTheyCome, batch);
        }
        if self.per_ray.is_nan() && self.as_they_come.left == 0 && rays >= LEAST_RAYS {
            return (Way::AsTheyCome, (rays / 8).clamp(FIRST[0], FIRST[1]).min(batch));
        }
        if self.may_sort::<Q>(bvh, sortable) {
            return (Way::Sorted, sortable);
        }
        let passed = rays.min(TOGETHER);
        self.pass_over(passed);
        (Way::RayByRay, passed)
    }

    /// So many rays went by themselves.
    pub(crate) fn pass_over(&mut self, rays: usize) {
        self.as_they_come.pass_over(rays);
        self.sorted.pass_over(rays);
    }

    /// Takes what a stream has seen, of which at most so many rays would go down together.
    pub(super) fn take<Q: Query>(&mut self, way: Way, seen: Seen, most: usize) {
        // Rays that enter no node tell nothing.
        if seen.nodes == 0 {
            return;
        }
        let mean = seen.at_a_node();
        if way == Way::Sorted {
            self.sorted.take(mean >= ENOUGH_SORTED);
            return;
        }
        let rays = seen.rays as f32 / seen.streams as f32;
        self.per_ray = (mean - 1.0) / rays;
        let paid =
            !(Q::ANY && seen.is_in_vain()) && self.at_a_node(most) >= ENOUGH[usize::from(Q::ANY)];
        self.as_they_come.take(paid);
        if !paid {
            self.per_ray = f32::NAN;
        }
    }
}

/// How many of so many rays best go down together in memory that is new, which is as slow as some of the way: an eighth.
#[cfg(feature = "alloc")]
pub(crate) fn together(rays: usize) -> usize {
    (rays / 8).clamp(LEAST_RAYS, TOGETHER)
}
