//! What a picture needs beyond hits: surfaces, and shadow rays from them.

use crate::engine::Rays;
use crate::measure::Effort;
use crate::rounds::{Median, Sampler, Samples, timed};
use spherule_kernel::{
    Coherence, HitPacket, Intersect, Level, RayPacket, SphereTree, SurfacePacket, Tier, Towards,
    Trace, Vec3, shadow_packets, surface, surface_packets,
};
use spherule_tests::scenes::{Kind, LARGE, Scene, Size};
use std::cell::RefCell;
use std::time::Duration;

/// How far a pass over the rays goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pass {
    Hits,
    Surfaces,
    ShadowRays,
}

impl Pass {
    const ALL: [Self; 3] = [Self::Hits, Self::Surfaces, Self::ShadowRays];
}

/// A scene's rays of a kind, through the tree.
pub(crate) struct OfRays {
    pub(crate) scene: &'static str,
    pub(crate) kind: Kind,
    /// The share of the rays that hit anything.
    pub(crate) hit: f64,
    /// Nanoseconds a ray.
    times: Samples<(Tier, Pass)>,
}

/// Where the light is.
const LIGHT: Towards = Towards::Direction(Vec3::new(0.4, 0.8, 0.45));

/// Measures all large scenes, or `one` alone: primary rays by coherent packets, diffuse ones ray by ray.
pub(crate) fn measure(effort: Effort, one: Option<&str>) -> Vec<OfRays> {
    let (size, rounds) = match effort {
        Effort::Test => (Size::SMALL, 1),
        Effort::Quick => (Size::FULL, 3),
        Effort::Full => (Size::FULL, 9),
    };
    let chosen = LARGE.into_iter().filter(|name| one.is_none_or(|one| one == *name));
    let of_scene = |name| {
        eprintln!("surfaces of {name}");
        let scene = Scene::large(name, size).expect("listed");
        let tree = SphereTree::new((*scene.spheres).clone());
        Kind::ALL.map(|kind| OfRays::measure(&scene, kind, &tree, rounds))
    };
    chosen.flat_map(of_scene).collect()
}

impl OfRays {
    fn measure(scene: &Scene, kind: Kind, tree: &SphereTree, rounds: usize) -> Self {
        let packets = Rays::new(scene.rays(kind)).packets();
        let passes = RefCell::new(Passes::new(tree, kind, &packets));
        let mut samplers = Vec::<(_, Sampler<'_>)>::new();
        let mut hit = 0;
        for tier in [Tier::Stable, Tier::Exact] {
            hit = passes.borrow_mut().checked(tier);
            for pass in Pass::ALL {
                let (passes, rays) = (&passes, scene.rays(kind).len() as f64);
                let sample = move || timed(|| passes.borrow_mut().run(tier, pass)) / rays;
                samplers.push(((tier, pass), Box::new(sample)));
            }
        }
        let times = Samples::take(samplers, Duration::ZERO, rounds..=rounds);
        let hit = hit as f64 / scene.rays(kind).len() as f64;
        Self { scene: scene.name, kind, hit, times }
    }

    pub(crate) fn rounds(&self) -> usize {
        self.times.rounds()
    }

    /// Nanoseconds a ray.
    pub(crate) fn time(&self, tier: Tier, pass: Pass) -> Option<Median> {
        self.times.median(&(tier, pass))
    }

    /// The time of `pass`, divided by the time of `other`.
    pub(crate) fn ratio(&self, tier: Tier, pass: Pass, other: Pass) -> Option<Median> {
        self.times.ratio(&(tier, pass), &(tier, other))
    }
}

/// How many packets are traced at a time, as in making a picture: their hits and surfaces stay in the cache.
const AT_ONCE: usize = 64;

/// The rays, and memory for what is found.
struct Passes<'a> {
    tree: &'a SphereTree,
    coherence: Coherence,
    rays: &'a [RayPacket],
    hits: [HitPacket; AT_ONCE],
    surfaces: [SurfacePacket; AT_ONCE],
    shadow_rays: [RayPacket; AT_ONCE],
}

impl<'a> Passes<'a> {
    fn new(tree: &'a SphereTree, kind: Kind, rays: &'a [RayPacket]) -> Self {
        let coherence =
            if kind == Kind::Primary { Coherence::Coherent } else { Coherence::Incoherent };
        Self {
            tree,
            coherence,
            rays,
            hits: [HitPacket::none(); AT_ONCE],
            surfaces: [SurfacePacket::none(); AT_ONCE],
            shadow_rays: [RayPacket::inactive(); AT_ONCE],
        }
    }

    fn run(&mut self, tier: Tier, pass: Pass) {
        self.rays.chunks(AT_ONCE).for_each(|rays| self.some(rays, tier, pass));
        std::hint::black_box(self);
    }

    fn some(&mut self, rays: &[RayPacket], tier: Tier, pass: Pass) {
        let Self { hits, surfaces, shadow_rays, .. } = self;
        let (level, spheres) = (Level::best(), self.tree.list().spheres());
        let mut trace = Trace::new().with(self.coherence);
        self.tree.closest_hit_packets(tier, &mut trace, rays, hits);
        if pass != Pass::Hits {
            surface_packets(tier, level, spheres, rays, hits, surfaces);
        }
        if pass == Pass::ShadowRays {
            shadow_packets(tier, level, spheres, (rays, hits, surfaces), LIGHT, shadow_rays);
        }
    }

    /// Returns how many rays hit anything. Each of their surfaces must be the one that a call for one ray returns.
    fn checked(&mut self, tier: Tier) -> usize {
        let mut hit_rays = 0;
        for rays in self.rays.chunks(AT_ONCE) {
            self.some(rays, tier, Pass::Surfaces);
            for (place, packet) in rays.iter().enumerate() {
                for lane in 0..RayPacket::COUNT {
                    let Some(hit) = self.hits[place].hit(lane) else { continue };
                    let sphere = self.tree.list().spheres().get(hit.sphere as usize);
                    let sphere = sphere.expect("a sphere of the list");
                    let truth = surface(tier, &packet.ray(lane), hit.t, &sphere);
                    assert_eq!(self.surfaces[place].surface(lane), truth, "{tier:?} {sphere:?}");
                    hit_rays += 1;
                }
            }
        }
        hit_rays
    }
}
