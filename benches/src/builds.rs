//! All trees over a scene: how long builds take, how large the kernel's tree is, and the engines that use them.

#[cfg(feature = "embree")]
use crate::engine::embree::{self, Embree, libraries};
use crate::engine::{EMBREE, Engine, peers};
use crate::rounds::{Sampler, Samples, timed};
use spherule_kernel::{BvhNode, InTurn, Level, SphereTree};
use spherule_tests::scenes::Scene;
use std::rc::Rc;
use std::time::Duration;

/// The kernel's name among builds.
pub(crate) const OURS: &str = "ours";

pub(crate) struct Trees {
    pub(crate) ours: Rc<SphereTree>,
    /// Embree's and those of other crates, with the features `embree` and `peers`.
    pub(crate) others: Vec<Engine>,
}

impl Trees {
    /// Builds all trees, Embree's at every level; other crates' if `crates`.
    pub(crate) fn build(scene: &Scene, crates: bool, levels: &[Level]) -> Self {
        let spheres = scene.spheres.spheres();
        let others =
            peers::TREES.iter().filter(|_| crates).map(|(_, build)| build(spheres)).collect();
        #[cfg(feature = "embree")]
        let others = {
            let devices = libraries().iter().flat_map(|library| {
                levels.iter().map(move |level| Embree::build(library, level.name(), spheres))
            });
            let engines = devices.flat_map(|embree| embree::engines(&Rc::new(embree)));
            engines.chain::<Vec<_>>(others).collect()
        };
        #[cfg(not(feature = "embree"))]
        let _ = levels;
        Self { ours: scene.tree(), others }
    }

    /// Embree's calls with the instructions of a level.
    pub(crate) fn embree(&self, level: Level) -> Vec<&Engine> {
        let lanes = level.name().as_str();
        let is_it = |engine: &&Engine| engine.label.is_embree() && engine.label.lanes == lanes;
        self.others.iter().filter(is_it).collect()
    }
}

/// Times of builds, and the size of the kernel's tree.
pub(crate) struct Builds {
    /// Bytes a sphere, beyond the caller's list.
    pub(crate) bytes: f64,
    /// The depth of the tree, in nodes.
    pub(crate) depth: usize,
    /// Times, taken in turns, each on one thread.
    pub(crate) times: Samples<&'static str>,
}

impl Builds {
    /// Memory is part of each build: the kernel's tree is allocated, filled and freed.
    pub(crate) fn measure(scene: &Scene, trees: &Trees, crates: bool, rounds: usize) -> Self {
        let spheres = scene.spheres.spheres();
        let ours = || {
            let list = (*scene.spheres).clone();
            timed(|| drop(std::hint::black_box(SphereTree::build_with(&InTurn, list))))
        };
        let mut all: Vec<(_, Sampler<'_>)> = vec![(OURS, Box::new(ours))];
        #[cfg(feature = "embree")]
        all.extend(libraries().iter().map(|library| -> (_, Sampler<'_>) {
            let best = Level::best().name();
            let build = move || Embree::build(library, best, spheres).build_nanoseconds;
            (&library.name[..], Box::new(build))
        }));
        for &(name, build) in peers::TREES.iter().filter(|_| crates) {
            let sample = move || {
                let mut built = None;
                timed(|| built = Some(build(spheres)))
            };
            all.push((name, Box::new(sample)));
        }
        let (size, depth) = (trees.ours.bvh().size(), trees.ours.bvh().depth());
        let bytes = size.nodes * size_of::<BvhNode>() + size.places * size_of::<[f32; 5]>();
        let bytes = bytes as f64 / spheres.len().max(1) as f64;
        Self { bytes, depth, times: Samples::take(all, Duration::ZERO, rounds..=rounds) }
    }

    /// The version of Embree that builds fastest.
    pub(crate) fn embree(&self) -> Option<&'static str> {
        self.times.quickest(|name| name.starts_with(EMBREE)).copied()
    }

    /// Milliseconds; `None` for who did not take part.
    pub(crate) fn milliseconds(&self, name: &'static str) -> Option<f64> {
        self.times.median(&name).map(|time| time.middle * 1e-6)
    }
}
