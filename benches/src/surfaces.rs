//! What a picture needs beyond hits: surfaces, and shadow rays from them.

use crate::engine::Rays;
use crate::left_out::LeftOut;
use crate::measure::{Effort, large_scenes};
use crate::rounds::{Median, Sampler, Samples, timed};
use spherule_kernel::{
    Coherence, HitPacket, Intersect, Level, Ray, RayPacket, Side, Sphere, SphereTree, Surface,
    SurfacePacket, Tier, Towards, Trace, Vec3, shadow_packets, surface, surface_packets,
};
use spherule_tests::scenes::{Kind, Scene, Size};
use std::cell::RefCell;
use std::time::Duration;

/// How far a pass over the rays goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pass {
    Hits,
    Surfaces,
    /// Shadow rays are made, not traced.
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
const LIGHT: Vec3 = Vec3::new(0.4, 0.8, 0.45);

/// Measures all large scenes, or `one` alone: primary rays by coherent packets, diffuse ones ray by ray.
pub(crate) fn measure(effort: Effort, one: Option<&str>, left_out: &LeftOut) -> Vec<OfRays> {
    let (size, rounds) = match effort {
        Effort::Test => (Size::SMALL, 1),
        Effort::Quick => (Size::FULL, 3),
        Effort::Full => (Size::FULL, 9),
    };
    let of_scene = |scene: Scene| {
        eprintln!("surfaces of {}", scene.name);
        let tree = SphereTree::new((*scene.spheres).clone());
        let measure = || Kind::ALL.map(|kind| OfRays::measure(&scene, kind, &tree, rounds));
        left_out.unless_wrong(scene.name, measure)
    };
    large_scenes(one, size).filter_map(of_scene).flatten().collect()
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
            let hit = (rays, &hits[..], &surfaces[..]);
            shadow_packets(tier, level, spheres, hit, Towards::Direction(LIGHT), shadow_rays);
        }
    }

    /// Forgets what was found, so that a call that finds nothing is seen.
    fn forget(&mut self) {
        self.hits.fill(HitPacket::none());
        self.surfaces.fill(SurfacePacket::none());
        self.shadow_rays.fill(RayPacket::inactive());
    }

    /// Returns how many rays hit anything.
    ///
    /// # Panics
    /// If anything is not what a call for one ray returns.
    fn checked(&mut self, tier: Tier) -> usize {
        let mut hit_rays = 0;
        for rays in self.rays.chunks(AT_ONCE) {
            self.forget();
            self.some(rays, tier, Pass::ShadowRays);
            hit_rays += self.compared(rays, tier);
        }
        hit_rays
    }

    /// Compares all surfaces of `rays`, and the shadow rays from some of them, with what a call for one ray returns. Returns how many rays
    /// hit anything.
    fn compared(&self, rays: &[RayPacket], tier: Tier) -> usize {
        let mut hit_rays = 0;
        for (place, packet) in rays.iter().enumerate() {
            for lane in 0..RayPacket::COUNT {
                let is_chosen = lane == place % RayPacket::COUNT;
                let Some(hit) = self.hits[place].hit(lane) else {
                    let truth = is_chosen.then(|| self.tree.closest_hit(tier, &packet.ray(lane)));
                    assert_eq!(truth.flatten(), None, "{tier:?}");
                    continue;
                };
                let sphere = self.tree.list().spheres().get(hit.sphere as usize);
                let (ray, sphere) = (packet.ray(lane), sphere.expect("a sphere of the list"));
                let truth = surface(tier, &ray, hit.t, &sphere);
                assert_eq!(self.surfaces[place].surface(lane), truth, "{tier:?} {sphere:?}");
                if is_chosen {
                    let found = Some(self.shadow_rays[place].ray(lane)).filter(Ray::is_live);
                    let truth = shadow_ray(tier, &ray, &truth, &sphere);
                    assert_eq!(found, truth, "{tier:?} {sphere:?}");
                }
                hit_rays += 1;
            }
        }
        hit_rays
    }
}

/// The shadow ray from where a ray hits, by a call for one ray; `None` where the surface does not face the light.
fn shadow_ray(tier: Tier, ray: &Ray, surface: &Surface, sphere: &Sphere) -> Option<Ray> {
    let side = surface.incident_side(ray.direction);
    let normal = surface.normal.as_dvec3();
    let outward = if side == Side::Inside { -normal } else { normal };
    let faces = outward.dot(LIGHT.as_dvec3()) > 0.0;
    faces.then(|| surface.spawn_ray(tier, sphere, side, LIGHT))?
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    /// As if a later call had found nothing.
    #[test]
    fn a_call_that_finds_nothing_is_seen() {
        let scene = Scene::large("u64", Size::SMALL).expect("listed");
        let (tree, packets) = (scene.tree(), Rays::new(scene.rays(Kind::Primary)).packets());
        let mut passes = Passes::new(&tree, Kind::Primary, &packets);
        for tier in [Tier::Stable, Tier::Exact] {
            assert!(passes.checked(tier) > 100);
            for pass in Pass::ALL {
                passes.forget();
                passes.some(&packets, tier, pass);
                let compared = catch_unwind(AssertUnwindSafe(|| passes.compared(&packets, tier)));
                assert_eq!(compared.is_ok(), pass == Pass::ShadowRays, "{tier:?} {pass:?}");
            }
        }
    }
}
