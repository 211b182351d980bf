//! Many spheres: the kernel's ways through the large scenes, against Embree and the trees of other crates.

use crate::builds::{Builds, Trees};
use crate::engine::kernel::{Kernel, Way, levels};
use crate::engine::{Label, Query, Rays};
use crate::left_out::LeftOut;
use crate::measure::{Effort, Measured, Plan, large_scenes};
use crate::rounds::{Median, Sampler, Samples};
use spherule_kernel::{HitPacket, Intersect, Level, LevelName, SphereTree, Tier, Trace};
use spherule_tests::scenes::{Kind, Scene, Size};
use std::sync::Mutex;
use std::thread::available_parallelism;
use std::time::{Duration, Instant};

/// The scene that threads are timed on.
pub(crate) const FOR_THREADS: &str = "u10k";

/// How many rays of a kind `--quick` takes, in runs from all of them.
const QUICK: usize = 1 << 16;

/// A scene's builds, and the times of both kinds of its rays.
pub(crate) struct OfScene {
    pub(crate) name: &'static str,
    pub(crate) spheres: usize,
    pub(crate) builds: Builds,
    pub(crate) measured: [Measured; 2],
}

/// All that was measured.
pub(crate) struct Structures {
    /// The most rays of a kind; `None` if all are taken.
    pub(crate) rays: Option<usize>,
    pub(crate) scenes: Vec<OfScene>,
    /// How many times as fast two threads are as one, in [`FOR_THREADS`].
    pub(crate) two_threads: Option<Median>,
    /// More and more uniform spheres.
    pub(crate) growth: Vec<OfScene>,
}

/// Measures all scenes, or `one` alone.
pub(crate) fn measure(effort: Effort, one: Option<&str>, left_out: &LeftOut) -> Structures {
    let levels = levels();
    // For growth: enough pixels to be timed, few enough for brute force to be shown; and the powers of ten.
    let (size, rays, seconds, rounds, builds, (pixels, most)) = match effort {
        Effort::Test => (Size::SMALL, usize::MAX, 0, 1..=1, 1, (32, 4)),
        Effort::Quick => (Size::FULL, QUICK, 4, 3..=9, 1, (512, 8)),
        Effort::Full => (Size::FULL, usize::MAX, 14, 5..=31, 5, (512, 8)),
    };
    let (time, sample) = (Duration::from_secs(seconds), Duration::ZERO);
    let plan = Plan { queries: &Query::ALL, time, rounds: rounds.clone(), rays, sample };
    let of_scene = |scene: &Scene| match (effort, one) {
        // Without other crates, and without the tiers that are no faster: so it takes less than a minute.
        (Effort::Quick, Some(_)) => {
            OfScene::measure(scene, None, (&levels, &[Tier::Stable, Tier::Exact]), &plan)
        }
        _ => OfScene::measure(scene, Some(builds), (&levels, &Tier::ALL), &plan),
    };
    let growth = Plan { time: time.min(Duration::from_secs(3)), ..plan.clone() };
    let step = |power| {
        let scene = Scene::uniform(10_usize.pow(power), pixels);
        let measure = || OfScene::measure(&scene, None, (&levels[..1], &[Tier::Stable]), &growth);
        left_out.unless_wrong(scene.name, measure)
    };
    let unless_wrong = |scene: Scene| left_out.unless_wrong(scene.name, || of_scene(&scene));
    let threads = || {
        let scene = Scene::large(FOR_THREADS, size).expect("listed");
        two_threads_by_one(&scene, levels[0], *rounds.end())
    };
    Structures {
        rays: (rays < usize::MAX).then_some(rays),
        scenes: large_scenes(one, size).filter_map(unless_wrong).collect(),
        two_threads: one.is_none().then(threads).flatten(),
        growth: (2..most).filter(|_| one.is_none()).filter_map(step).collect(),
    }
}

impl OfScene {
    /// Measures the builds in `rounds` rounds and with other crates; with `None` in one round and without them.
    fn measure(
        scene: &Scene,
        rounds: Option<usize>,
        (levels, tiers): (&[Level], &[Tier]),
        plan: &Plan<'_>,
    ) -> Self {
        let spheres = scene.spheres.len();
        eprintln!("{}, {spheres} spheres", scene.name);
        let trees = Trees::build(scene, rounds.is_some(), levels);
        let builds = Builds::measure(scene, &trees, rounds.is_some(), rounds.unwrap_or(1));
        let kernel = Kernel::new(scene, &trees.ours);
        let measured = Kind::ALL.map(|kind| {
            let ours = kernel.ways(kind, levels, tiers);
            let engines: Vec<_> = ours.iter().chain(&trees.others).collect();
            Measured::take((scene, kind), &engines, &kernel.truth(), plan)
        });
        Self { name: scene.name, spheres, builds, measured }
    }

    /// How many times as fast as Embree the primary and the diffuse rays are, at the best level.
    pub(crate) fn times_embree(&self) -> (&'static str, [Option<f64>; 2]) {
        let times = |of: &Measured| {
            let level = of.levels().next()?;
            of.times_embree(level, Query::ClosestHit).map(|times| times.middle)
        };
        (self.name, self.measured.each_ref().map(times))
    }

    /// What the chart of growth shows: million rays a second, if the way took part.
    pub(crate) fn rates(&self) -> [(&'static str, Option<f64>); 6] {
        let [primary, diffuse] = &self.measured;
        let query = Query::ClosestHit;
        let rate = |of: &Measured, chosen: &dyn Fn(&Label) -> bool| {
            of.rate(of.fastest(query, chosen)?, query)
        };
        let ours =
            |of, ways: &[Way]| rate(of, &|label| ways.iter().any(|way| label.way == way.as_str()));
        let embree = |of| rate(of, &Label::is_embree);
        [
            ("tree, primary", ours(primary, &[Way::Packets])),
            ("depth list, primary", ours(primary, &[Way::DepthList])),
            ("Embree, primary", embree(primary)),
            ("tree, diffuse", ours(diffuse, &[Way::RayByRay, Way::Stream])),
            ("Embree, diffuse", embree(diffuse)),
            ("brute force, primary", ours(primary, &[Way::BruteForce])),
        ]
    }
}

impl Measured {
    /// The levels that the kernel was timed at, the best first.
    pub(crate) fn levels(&self) -> impl Iterator<Item = &'static str> {
        let is_timed = |level: &&str| {
            self.labels().any(|label| label.name == Tier::Stable.as_str() && label.lanes == *level)
        };
        LevelName::ALL.into_iter().rev().map(LevelName::as_str).filter(is_timed)
    }

    /// The kernel's quickest way in a tier, at a level.
    pub(crate) fn quickest(&self, tier: Tier, level: &str, query: Query) -> Option<&Label> {
        self.fastest(query, |label| label.name == tier.as_str() && label.lanes == level)
    }

    /// Embree's quickest call with the instructions of a level, over all its versions that took part.
    pub(crate) fn embree(&self, level: &str, query: Query) -> Option<&Label> {
        self.fastest(query, |label| label.is_embree() && label.lanes == level)
    }

    /// How many times as fast as Embree's quickest call `Stable` is in its quickest way, at a level.
    pub(crate) fn times_embree(&self, level: &str, query: Query) -> Option<Median> {
        self.ratio(self.embree(level, query)?, self.quickest(Tier::Stable, level, query)?, query)
    }
}

/// How many times as fast as one thread two threads find the closest hits of the primary rays with `Stable`. Both trace
/// the same packets, handed out in pieces. By wall-clock time; `None` on a machine with one core.
fn two_threads_by_one(scene: &Scene, level: Level, rounds: usize) -> Option<Median> {
    if available_parallelism().map_or(1, usize::from) < 2 {
        return None;
    }
    /// Packets that a thread takes at a time.
    const PIECE: usize = 256;
    let tree = &SphereTree::new((*scene.spheres).clone());
    let packets = &Rays::new(scene.rays(Kind::Primary)).packets();
    let samplers = [1, 2].map(|threads| -> (usize, Sampler<'_>) {
        let mut hits = vec![HitPacket::none(); packets.len()];
        let sample = move || {
            let start = Instant::now();
            let pieces = Mutex::new(packets.chunks(PIECE).zip(hits.chunks_mut(PIECE)));
            let work = || {
                // Releases the lock before the piece is worked on.
                let next = || pieces.lock().ok()?.next();
                while let Some((rays, hits)) = next() {
                    let mut trace = Trace::new().at(level).coherent();
                    tree.closest_hit_packets(Tier::Stable, &mut trace, rays, hits);
                }
            };
            std::thread::scope(|scope| (0..threads).for_each(|_| drop(scope.spawn(work))));
            start.elapsed().as_nanos() as f64
        };
        (threads, Box::new(sample))
    });
    Samples::take(samplers.into(), Duration::ZERO, rounds..=rounds).ratio(&1, &2)
}
