//! What measures: the kernel's calls for rays, timed and judged.

use super::rays::{Kind, Rays, most_rays};
use super::report::TierReport;
use super::speed;
use super::watch::{Step, Watch};
use crate::compare::verdict::tally;
use crate::structure::Structure;
use crate::structure::search::{Scratch, Search, Tracing};
use crate::threads::{Threads, packets_a_task};
use spherule_kernel::{
    AnyHit, ClosestHit, Coherence, HitPacket, Level, RayPacket, Spheres, Stages, Tier, stages,
};
use std::hint::black_box;

/// The tests are counted in so many parts, and the watch is told before each.
const PARTS_OF_STAGES: usize = 8;

/// By which instructions, threads and searches rays are traced.
#[derive(Clone, Copy)]
pub(super) struct Machine<'a> {
    pub(super) level: Level,
    pub(super) threads: &'a Threads,
    pub(super) coherence: Coherence,
    /// One for every part of the rays.
    pub(super) searches: &'a [Search<'a>],
}

impl Machine<'_> {
    /// Every tier on these rays; `None` if the watch ends it.
    pub(super) fn measure(
        &self,
        rays: &Rays,
        spheres: Spheres<'_>,
        watch: &mut Watch<'_>,
    ) -> Option<Vec<TierReport>> {
        let step = match rays.kind {
            Kind::Camera => Step::Camera,
            Kind::Shadow => Step::Shadow,
        };
        let passes = Tier::ALL.map(|tier| self.pass(tier, rays));
        // Timing takes this share; the rest is for the errors.
        let seconds = speed::medians(passes, |share| watch.go_on(step, 0.9 * share))?;
        let hits = Tier::ALL.into_iter().map(|tier| {
            watch.go_on(step, 0.9)?;
            Some(self.hits(tier, rays))
        });
        let hits = hits.collect::<Option<Vec<_>>>()?;
        let exact = hits.last()?;
        let errors = hits.iter().map(|found| {
            watch.go_on(step, 0.95)?;
            let [found, truth] = [found, exact].map(|hits| hits.iter().flat_map(HitPacket::hits));
            Some(tally(rays.each(), spheres, found, truth).summary())
        });
        let errors = errors.collect::<Option<Vec<_>>>()?;
        let exact = stages_of(rays, spheres, || watch.go_on(step, 1.0))?;
        // The other tiers compute in single precision alone.
        let single = Stages { double: 0, expansions: 0, ..exact };
        let tiers = Tier::ALL.into_iter().zip(seconds).zip(errors);
        let tiers = tiers.map(|((tier, seconds), errors)| TierReport {
            tier,
            rays_kind: rays.kind.name(),
            rays: rays.count,
            seconds,
            errors,
            stages: if tier == Tier::Exact { exact } else { single },
        });
        Some(tiers.collect())
    }

    /// Which rays meet anything by a tier.
    pub(super) fn any_hits(&self, tier: Tier, rays: &Rays) -> Vec<u32> {
        let mut occluded = vec![0; rays.packets.len()];
        self.trace(rays, &mut occluded, |search, rays, scratch, occluded| {
            search.any_hits(self.tracing(tier), scratch, rays, occluded);
        });
        occluded
    }

    /// What is timed: the kernel's calls for all rays.
    fn pass<'a>(&'a self, tier: Tier, rays: &'a Rays) -> impl FnMut() + 'a {
        let mut hits = vec![HitPacket::none(); rays.packets.len()];
        let mut occluded = vec![0; rays.packets.len()];
        move || match rays.kind {
            Kind::Camera => {
                self.closest_hits(tier, rays, &mut hits);
                black_box(&hits);
            }
            Kind::Shadow => {
                self.trace(rays, &mut occluded, |search, rays, scratch, occluded| {
                    search.any_hits(self.tracing(tier), scratch, rays, occluded);
                });
                black_box(&occluded);
            }
        }
    }

    /// The closest hits of a tier.
    pub(super) fn hits(&self, tier: Tier, rays: &Rays) -> Vec<HitPacket> {
        let mut hits = vec![HitPacket::none(); rays.packets.len()];
        self.closest_hits(tier, rays, &mut hits);
        hits
    }

    fn closest_hits(&self, tier: Tier, rays: &Rays, hits: &mut [HitPacket]) {
        self.trace(rays, hits, |search, rays, scratch, hits| {
            search.closest_hits(self.tracing(tier), scratch, rays, hits);
        });
    }

    pub(super) fn tracing(&self, tier: Tier) -> Tracing {
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

/// How far `Exact` goes: in every test, as if by brute force; in the tests of some rays, if there are too many.
fn stages_of(
    rays: &Rays,
    spheres: Spheres<'_>,
    mut go_on: impl FnMut() -> Option<()>,
) -> Option<Stages> {
    let some = most_rays(spheres.len(), Structure::Brute) / RayPacket::COUNT;
    let step = rays.packets.len().div_ceil(some).max(1);
    let some: Vec<_> = rays.packets.iter().step_by(step).copied().collect();
    let mut sum = Stages::default();
    for packets in some.chunks(some.len().div_ceil(PARTS_OF_STAGES).max(1)) {
        go_on()?;
        sum += match rays.kind {
            Kind::Camera => stages(ClosestHit, packets, spheres),
            Kind::Shadow => stages(AnyHit, packets, spheres),
        };
    }
    Some(sum)
}
