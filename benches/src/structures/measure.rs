//! A scene: every contender checked, then all timed in turns.

#[cfg(feature = "embree")]
use crate::embree::Embree;
use crate::rounds;
use crate::scenes::{Kind, Scene, viewpoint};
use crate::structures::agreement;
use crate::structures::build::{self, Builds};
use crate::structures::contender::{Tier, Way};
use crate::structures::measured::Measured;
use crate::structures::ours::{Answers, Rays, Search, Structures, TreeMemory, sample};
use crate::structures::peer::Builder;
use crate::structures::race::Race;
use spherule_kernel::dispatch::Level;
use spherule_kernel::{Question, Ray};
use std::cell::RefCell;
use std::ops::RangeInclusive;
use std::time::Duration;

/// Tests of brute force that a round may cost.
const TESTS: usize = 1 << 25;
/// Rays of what takes single rays, where that is not what it is for: enough for a time.
const SINGLE_RAYS: usize = 1 << 15;

/// Who takes part, and how often.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    /// The first is the best, and the one at which all tiers are timed.
    pub levels: &'a [Level],
    /// The tiers; at other levels than the first, `Stable` alone.
    pub tiers: &'a [Tier],
    /// Other trees.
    pub builders: &'a [Builder],
    /// How long a kind of a scene's rays may be timed.
    pub time: Duration,
    /// And how often at least and at most.
    pub rounds: RangeInclusive<usize>,
    /// How often trees are built.
    pub builds: usize,
}

/// A scene's builds, and the times of both kinds of its rays.
///
/// # Panics
/// Where an answer is wrong.
#[must_use]
pub fn scene(scene: &Scene, plan: &Plan<'_>) -> (Builds, Vec<Measured>) {
    let spheres = scene.spheres.spheres();
    let mut memory = TreeMemory::new(spheres.len());
    let bvh = memory.build(spheres);
    let builds = build::measure(spheres, &bvh, plan.builders, plan.builds);
    let mut peers: Vec<_> = plan.builders.iter().map(|builder| (builder.build)(spheres)).collect();
    #[cfg(feature = "embree")]
    let embree = Embree::build(spheres);

    let measured = Kind::ALL.map(|kind| {
        let list = scene.rays(kind);
        let structures = Structures { spheres, bvh: &bvh, viewpoint: viewpoint(list) };
        let name = format!("{}, {}", scene.name, kind.as_str());
        let [few, some] = [TESTS / spheres.len().max(1), SINGLE_RAYS].map(|n| sample(list, n));
        let [few_packets, some_packets, all_packets] = [&few, &some, list].map(Rays::new);
        let answers = RefCell::new(Answers::new(all_packets.count()));
        let mut race = Race {
            structures,
            answers: &answers,
            contenders: Vec::new(),
            agreements: Vec::new(),
            subjects: Vec::new(),
        };
        // Rays that have nothing in common gain nothing as packets: not timed so.
        let ways: &[(Way, &Rays)] = match kind {
            Kind::Primary => &[
                (Way::Brute, &few_packets),
                (Way::Single, &some_packets),
                (Way::Coherent, &all_packets),
                (Way::Tiles, &all_packets),
            ],
            Kind::Diffuse => &[(Way::Brute, &few_packets), (Way::Single, &all_packets)],
        };
        let question = Question::Nearest;
        for (index, &level) in plan.levels.iter().enumerate() {
            agreement::ours(&name, list, level, structures);
            let tiers = if index == 0 { plan.tiers } else { &[Tier::Stable] };
            for &(way, rays) in ways {
                for &tier in tiers {
                    race.ours(Search { question, way, tier, level }, rays);
                }
            }
        }
        let exact = Search { question, way: Way::Single, tier: Tier::Exact, level: plan.levels[0] };
        let truth = |rays: &[Ray]| {
            let rays = Rays::new(rays);
            let mut answers = Answers::new(rays.count());
            exact.run(structures, &rays, &mut answers);
            answers.nearest()
        };
        let truth_of_some = truth(&some);
        for peer in &mut peers {
            peer.take_rays(&some);
            race.peer(&**peer, &name, &some, &truth_of_some);
        }
        #[cfg(feature = "embree")]
        race.embree(&embree, &name, (kind, list), &truth(list));

        let samples = rounds::take_within(&mut race.subjects, plan.time, plan.rounds.clone());
        Measured {
            scene: scene.name,
            kind,
            spheres: spheres.len(),
            level: plan.levels[0].name(),
            contenders: race.contenders,
            agreements: race.agreements,
            samples,
        }
    });
    (builds, measured.into())
}
