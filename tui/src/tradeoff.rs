//! `spherule tradeoff`: what every tier costs on a scene, and how wrong it is there.
//!
//! The rays are those that a picture of the scene takes; the truth is what `Exact` says.

mod lighting;
mod orders;
mod rays;
mod report;
mod speed;

use crate::arguments::{ComputingArguments, TradeoffArguments};
use crate::draw::{picture_workload, sample_grid};
use crate::error::{Error, write_stdout};
use crate::machine;
use crate::progress::Progress;
use crate::scene::Light;
use crate::structure::Structure;
use crate::structure::scene::SceneStructures;
use crate::structure::search::{Scratch, Search, Tracing};
use crate::style::{PIPE_SIZE, Style};
use crate::tally::Tally;
use crate::threads::{Threads, packets_a_task};
use lighting::{Lighting, LightingErrors};
use orders::Orders;
use rays::{Kind, Rays, most_rays};
use report::{Report, TierReport};
use spherule_kernel::{
    AnyHit, ClosestHit, Coherence, HitPacket, Level, RayPacket, Spheres, Stages, Tier, stages,
};
use std::array;
use std::hint::black_box;
use std::time::Duration;

/// Measures, and prints what was found.
///
/// # Errors
/// [`Error`] if there is no such scene, or the report cannot be written.
pub fn tradeoff(arguments: &TradeoffArguments) -> Result<(), Error> {
    let scene = arguments.scene.open()?;
    let ComputingArguments { structure, threads, level } = arguments.computing;
    let threads = Threads::new(threads)?;
    let level = level.unwrap_or_else(Level::best);
    let (columns, rows) = arguments.scene.size.unwrap_or(PIPE_SIZE);
    let style = Style { samples: arguments.scene.samples, ..Style::PLAIN };
    let view = arguments.scene.view(&scene, style.picture_aspect(columns, rows));

    let spheres = scene.spheres();
    let mut structures =
        SceneStructures::new(scene.list(), &threads).in_order(arguments.scene.order);
    // Building is not timed here, as if there were pictures without end.
    let workload = picture_workload(spheres.len(), &style, columns, rows, f64::INFINITY);
    let search = structures.picture(structure, &workload, &view, &scene.lighting)?;
    let (camera, width, height) = sample_grid(&view, &style, columns, rows);
    let most = most_rays(spheres.len(), search.structure);
    let camera = Rays::of_camera(&camera, width, height, most);
    let coherence = search.coherence;
    let for_camera = Machine { level, threads: &threads, coherence, searches: &[search.camera] };
    let for_shadow = Machine { searches: &search.to_lights, ..for_camera };
    let shadow = {
        let hits = for_camera.hits(Tier::Exact, &camera);
        let tracing = for_shadow.tracing(Tier::Exact);
        Rays::of_shadows(tracing, (&camera, &hits), spheres, &search.lights, most)
    };
    let tracing = for_camera.tracing(Tier::Exact);
    let orders = Orders::count(tracing, &threads, spheres, &view, &camera);
    let mut progress = Progress::after(Duration::ZERO);
    let lighting = for_shadow.lighting(&for_camera, &camera, (spheres, &search.lights), most);
    let mut tiers = Vec::new();
    for (machine, rays) in [(&for_camera, &camera), (&for_shadow, &shadow)] {
        if rays.count > 0 {
            tiers.extend(machine.measure(rays, spheres, &mut progress));
        }
    }
    drop(progress);

    let report = Report {
        scene: arguments.scene.name.clone(),
        spheres: spheres.len(),
        cpu: machine::cpu(),
        rustc: machine::RUSTC,
        order: search.order(),
        structure: search.structure,
        level: level.name(),
        lanes: RayPacket::COUNT,
        threads: threads.count(),
        orders,
        tiers,
        lighting,
    };
    let text = if arguments.json { report.json() } else { report.table() };
    write_stdout(text.as_bytes())
}

/// What measures.
#[derive(Clone, Copy)]
struct Machine<'a> {
    level: Level,
    threads: &'a Threads,
    coherence: Coherence,
    /// One for every part of the rays.
    searches: &'a [Search<'a>],
}

impl Machine<'_> {
    /// Every tier on these rays.
    fn measure(
        &self,
        rays: &Rays,
        spheres: Spheres<'_>,
        progress: &mut Progress,
    ) -> [TierReport; Tier::ALL.len()] {
        let passes = Tier::ALL.map(|tier| self.pass(tier, rays));
        let seconds = speed::medians(passes, |share| {
            progress.show(&format!("measuring {} rays", rays.kind.name()), share);
        });
        let hits = Tier::ALL.map(|tier| self.hits(tier, rays));
        let [.., exact] = &hits;
        let errors = hits.each_ref().map(|found| {
            let [found, truth] = [found, exact].map(|hits| hits.iter().flat_map(HitPacket::hits));
            Tally::of(found, truth).summary()
        });
        // Of every test there is, as if by brute force; of some rays, if those are too many.
        let some = most_rays(spheres.len(), Structure::Brute) / RayPacket::COUNT;
        let step = rays.packets.len().div_ceil(some).max(1);
        let some: Vec<_> = rays.packets.iter().step_by(step).copied().collect();
        let exact = match rays.kind {
            Kind::Camera => stages(ClosestHit, &some, spheres),
            Kind::Shadow => stages(AnyHit, &some, spheres),
        };
        // The other tiers know single precision alone.
        let single = Stages { double: 0, expansions: 0, ..exact };
        array::from_fn(|index| {
            let tier = Tier::ALL[index];
            TierReport {
                tier,
                rays_kind: rays.kind.name(),
                rays: rays.count,
                seconds: seconds[index],
                errors: errors[index],
                stages: if tier == Tier::Exact { exact } else { single },
            }
        })
    }

    /// What is wrong with how every tier lights the points that it hits, if there is a light.
    fn lighting(
        &self,
        for_camera: &Self,
        camera: &Rays,
        (spheres, lights): (Spheres<'_>, &[Light]),
        most: usize,
    ) -> Option<[LightingErrors; Tier::ALL.len()]> {
        if lights.is_empty() {
            return None;
        }
        let step = (camera.count * lights.len()).div_ceil(most).max(1);
        let lighting = Tier::ALL.map(|tier| {
            let hits = for_camera.hits(tier, camera);
            Lighting::new(tier, (camera, &hits), step, (spheres, lights), self)
        });
        let [.., exact] = &lighting;
        Some(lighting.each_ref().map(|of_tier| of_tier.errors(exact)))
    }

    /// Which rays meet anything by a tier.
    fn any_hits(&self, tier: Tier, rays: &Rays) -> Vec<u32> {
        let mut met = vec![0; rays.packets.len()];
        self.trace(rays, &mut met, |search, rays, scratch, met| {
            search.any_hits(self.tracing(tier), scratch, rays, met);
        });
        met
    }

    /// What is timed: the kernel's calls for all rays.
    fn pass<'a>(&'a self, tier: Tier, rays: &'a Rays) -> impl FnMut() + 'a {
        let mut hits = vec![HitPacket::none(); rays.packets.len()];
        let mut met = vec![0; rays.packets.len()];
        move || match rays.kind {
            Kind::Camera => {
                self.closest_hits(tier, rays, &mut hits);
                black_box(&hits);
            }
            Kind::Shadow => {
                self.trace(rays, &mut met, |search, rays, scratch, met| {
                    search.any_hits(self.tracing(tier), scratch, rays, met);
                });
                black_box(&met);
            }
        }
    }

    /// The closest hits of a tier.
    fn hits(&self, tier: Tier, rays: &Rays) -> Vec<HitPacket> {
        let mut hits = vec![HitPacket::none(); rays.packets.len()];
        self.closest_hits(tier, rays, &mut hits);
        hits
    }

    fn closest_hits(&self, tier: Tier, rays: &Rays, hits: &mut [HitPacket]) {
        self.trace(rays, hits, |search, rays, scratch, hits| {
            search.closest_hits(self.tracing(tier), scratch, rays, hits);
        });
    }

    fn tracing(&self, tier: Tier) -> Tracing {
        Tracing { tier, level: self.level, coherence: self.coherence }
    }

    /// Hands packets and results to the threads, part by part.
    fn trace<R: Send>(
        &self,
        rays: &Rays,
        results: &mut [R],
        trace: impl Fn(&Search<'_>, &[RayPacket], &mut Scratch, &mut [R]) + Sync,
    ) {
        let (mut packets, mut results) = (&*rays.packets, results);
        let mut tasks = Vec::new();
        for (&length, search) in rays.parts.iter().zip(self.searches) {
            let own = packets.split_off(..length).unwrap_or_default();
            let answers = results.split_off_mut(..length).unwrap_or_default();
            let size = packets_a_task(length);
            let pieces = own.chunks(size).zip(answers.chunks_mut(size));
            tasks.extend(pieces.map(|(rays, results)| (search, rays, results)));
        }
        let tasks = tasks.into_iter();
        self.threads.share(&mut Vec::new(), tasks, |scratch, (search, rays, results)| {
            trace(search, rays, scratch, results);
        });
    }
}
