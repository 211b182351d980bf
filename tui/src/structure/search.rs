//! A scene structure that is chosen at run time.

use spherule_kernel::{
    Bvh, Coherence, DepthList, HitPacket, Intersect, Level, RayPacket, Spheres, Tier, Trace,
};

/// Spheres, and how rays find them. Threads may share it.
#[derive(Clone, Copy, Debug)]
pub enum Search<'a> {
    /// From end to end.
    Brute(Spheres<'a>),
    /// By their depth, for rays of one viewpoint.
    DepthList(DepthList<'a>),
    /// By a tree.
    Bvh(Bvh<'a>),
}

/// What all rays of a call have in common.
#[derive(Clone, Copy, Debug)]
pub struct Tracing {
    /// Which tier decides hits.
    pub tier: Tier,
    /// The instructions.
    pub level: Level,
    /// Whether the rays lie close together.
    pub coherence: Coherence,
}

/// The memory that one thread lends to depth lists.
#[derive(Clone, Debug, Default)]
pub struct Scratch(Vec<f32>);

impl Scratch {
    /// As long as `search` has a use for; shorter if there is no memory, which takes longer.
    fn of(&mut self, search: &Search<'_>) -> &mut [f32] {
        if let Search::DepthList(list) = search {
            let missing = DepthList::scratch(list.spheres().len()).saturating_sub(self.0.len());
            if self.0.try_reserve_exact(missing).is_ok() {
                self.0.resize(self.0.len() + missing, 0.0);
            }
        }
        &mut self.0
    }
}

impl Search<'_> {
    /// The closest hit of every ray.
    pub fn closest_hits(
        &self,
        Tracing { tier, level, coherence }: Tracing,
        scratch: &mut Scratch,
        rays: &[RayPacket],
        hits: &mut [HitPacket],
    ) {
        let trace = &mut Trace { level, coherence, scratch: scratch.of(self) };
        match self {
            Self::Brute(spheres) => spheres.closest_hit_packets(tier, trace, rays, hits),
            Self::DepthList(list) => list.closest_hit_packets(tier, trace, rays, hits),
            Self::Bvh(tree) => tree.closest_hit_packets(tier, trace, rays, hits),
        }
    }

    /// Whether every ray meets anything: lane i in bit i.
    pub fn any_hits(
        &self,
        Tracing { tier, level, coherence }: Tracing,
        scratch: &mut Scratch,
        rays: &[RayPacket],
        met: &mut [u32],
    ) {
        let trace = &mut Trace { level, coherence, scratch: scratch.of(self) };
        match self {
            Self::Brute(spheres) => spheres.any_hit_packets(tier, trace, rays, met),
            Self::DepthList(list) => list.any_hit_packets(tier, trace, rays, met),
            Self::Bvh(tree) => tree.any_hit_packets(tier, trace, rays, met),
        }
    }
}
