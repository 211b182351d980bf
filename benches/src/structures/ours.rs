//! The kernel's ways to the hits, by tier and level chosen at run time.

use crate::structures::contender::{Tier, Way};
use crate::workload::packets;
use spherule_kernel::dispatch::{self, Level, Packet};
use spherule_kernel::{
    Accuracy, Bvh, BvhLeaf, BvhNode, DepthOrder, Exact, Fast, Hit, HitPacket, Lanes, Question, Ray,
    RayPacket, Spheres, Stable, Viewpoint,
};

/// Memory for a tree.
#[derive(Debug)]
pub struct TreeMemory {
    nodes: Vec<BvhNode>,
    leaves: Vec<BvhLeaf>,
}

impl TreeMemory {
    /// Enough for any list of `count` spheres.
    #[must_use]
    pub fn new(count: usize) -> Self {
        let needed = Bvh::needed(count);
        Self {
            nodes: vec![BvhNode::EMPTY; needed.nodes],
            leaves: vec![BvhLeaf::EMPTY; needed.leaves],
        }
    }

    /// A tree over as many spheres as the memory is for.
    ///
    /// # Panics
    /// Where it is for fewer.
    pub fn build(&mut self, spheres: Spheres<'_>) -> Bvh<'_> {
        Bvh::build(spheres, &mut self.nodes, &mut self.leaves).expect("memory for this many")
    }
}

/// The bytes of a tree.
#[must_use]
pub fn bytes(bvh: &Bvh<'_>) -> usize {
    let size = bvh.size();
    size.nodes * size_of::<BvhNode>() + size.leaves * size_of::<BvhLeaf>()
}

/// Spheres, and the structures over them.
#[derive(Clone, Copy, Debug)]
pub struct Structures<'a> {
    /// The list.
    pub spheres: Spheres<'a>,
    /// A tree over it.
    pub bvh: &'a Bvh<'a>,
    /// What the rays have in common: without it there are no tile lists.
    pub viewpoint: Option<Viewpoint>,
}

impl Structures<'_> {
    /// Whether rays can go that way.
    #[must_use]
    pub fn have(&self, way: Way) -> bool {
        way != Way::Tiles || self.viewpoint.is_some()
    }
}

/// Rays in packets of 16.
#[derive(Debug)]
pub struct Rays {
    packets: Vec<RayPacket<Packet>>,
    count: usize,
}

impl Rays {
    /// In their order.
    #[must_use]
    pub fn new(rays: &[Ray]) -> Self {
        Self { packets: packets::<Packet>(rays), count: rays.len() }
    }

    /// How many rays.
    #[must_use]
    pub const fn count(&self) -> usize {
        self.count
    }

    /// In pieces of so many packets, each with room for its answers.
    pub fn pieces<'a>(
        &'a self,
        answers: &'a mut Answers,
        packets: usize,
    ) -> impl Iterator<Item = (&'a [RayPacket<Packet>], &'a mut [HitPacket<Packet>])> {
        self.packets.chunks(packets).zip(answers.hits.chunks_mut(packets))
    }
}

/// What rays were found to meet, and memory to find it.
#[derive(Debug)]
pub struct Answers {
    hits: Vec<HitPacket<Packet>>,
    met: Vec<u32>,
    count: usize,
    /// For the spheres of tile lists by depth, and for the lists.
    order: Vec<u32>,
    lists: Vec<u32>,
}

impl Answers {
    /// Room for those of so many rays.
    #[must_use]
    pub fn new(count: usize) -> Self {
        let packets = count.div_ceil(Packet::COUNT);
        let hits = vec![HitPacket::<Packet>::none(); packets];
        Self { hits, met: vec![0; packets], count, order: Vec::new(), lists: Vec::new() }
    }

    /// The hits of the last search for the nearest.
    #[must_use]
    pub fn nearest(&self) -> Vec<Option<Hit>> {
        let lanes = 0..Packet::COUNT;
        let all = self.hits.iter().flat_map(|packet| lanes.clone().map(|lane| packet.hit(lane)));
        all.take(self.count).collect()
    }

    /// The answers of the last search for any.
    #[must_use]
    pub fn any(&self) -> Vec<bool> {
        let lanes = 0..Packet::COUNT;
        let all =
            self.met.iter().flat_map(|bits| lanes.clone().map(move |lane| bits >> lane & 1 != 0));
        all.take(self.count).collect()
    }
}

/// What is searched for, and how.
#[derive(Clone, Copy, Debug)]
pub struct Search {
    /// What.
    pub question: Question,
    /// Through what.
    pub way: Way,
    /// With what promise.
    pub tier: Tier,
    /// With what instructions.
    pub level: Level,
}

impl Search {
    /// Finds what the rays meet, as far as there is room for answers.
    ///
    /// # Panics
    /// Where tile lists are asked of rays that have nothing in common.
    pub fn run(&self, structures: Structures<'_>, rays: &Rays, answers: &mut Answers) {
        match self.tier {
            Tier::Fast => self.run_tier::<Fast>(structures, rays, answers),
            Tier::Stable => self.run_tier::<Stable>(structures, rays, answers),
            Tier::Exact => self.run_tier::<Exact>(structures, rays, answers),
        }
        std::hint::black_box(answers);
    }

    fn run_tier<A: Accuracy>(
        &self,
        Structures { spheres, bvh, viewpoint }: Structures<'_>,
        Rays { packets, .. }: &Rays,
        Answers { hits, met, order, lists, .. }: &mut Answers,
    ) {
        let level = self.level;
        if self.way == Way::Tiles {
            let viewpoint = viewpoint.expect("rays with a viewpoint");
            order.resize(order.len().max(DepthOrder::needed(spheres.len())), 0);
            lists.resize(lists.len().max(DepthOrder::lists(spheres.len())), 0);
            let order = &DepthOrder::new(spheres, viewpoint, order).expect("memory for this many");
            return match self.question {
                Question::Nearest => {
                    dispatch::tiles::nearest::<A>(level, packets, spheres, order, lists, hits);
                }
                Question::Any => {
                    dispatch::tiles::any::<A>(level, packets, spheres, order, lists, met);
                }
            };
        }
        match (self.question, self.way) {
            (Question::Nearest, Way::Brute) => {
                dispatch::nearest::<A>(level, packets, spheres, hits);
            }
            (Question::Nearest, Way::Single) => {
                dispatch::bvh::nearest::<A>(level, packets, spheres, bvh, hits);
            }
            (Question::Nearest, Way::Coherent) => {
                dispatch::bvh::nearest_coherent::<A>(level, packets, spheres, bvh, hits);
            }
            (Question::Any, Way::Brute) => dispatch::any::<A>(level, packets, spheres, met),
            (Question::Any, Way::Single) => {
                dispatch::bvh::any::<A>(level, packets, spheres, bvh, met);
            }
            (Question::Any, Way::Coherent) => {
                dispatch::bvh::any_coherent::<A>(level, packets, spheres, bvh, met);
            }
            (_, Way::Tiles) => {}
        }
    }
}

/// About `count` of the rays, in runs that start every so often, so that packets stay together.
#[must_use]
pub fn sample(rays: &[Ray], count: usize) -> Vec<Ray> {
    /// Packets that go together in the tree, and more.
    const RUN: usize = 256;
    if rays.len() <= count.max(RUN) {
        return rays.to_vec();
    }
    let runs = (count / RUN).max(1);
    let stride = rays.len() / runs;
    // Anywhere in each stretch, by the golden ratio: at the same place they would all be of one
    // column of a picture.
    let within = |run: usize| (run as f64 * 0.618_034).fract() * (stride - RUN) as f64;
    let start = |run: usize| run * stride + within(run) as usize / RUN * RUN;
    (0..runs).flat_map(|run| rays[start(run)..].iter().take(RUN)).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::{Kind, Name, Size};

    #[test]
    fn a_sample_is_from_all_of_the_picture() {
        let size = Size { pixels: 256, spheres: 64 };
        let scene = Name::Uniform64.scene(size);
        let rays = sample(scene.rays(Kind::Primary), 1 << 13);
        assert_eq!(rays.len(), 1 << 13);
        for quadrant in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
            let inside = |ray: &&Ray| {
                ray.direction.x * quadrant[0] > 0.0 && ray.direction.y * quadrant[1] > 0.0
            };
            let share = rays.iter().filter(inside).count() as f64 / rays.len() as f64;
            assert!((0.15..0.35).contains(&share), "{quadrant:?}: {share}");
        }
    }
}
