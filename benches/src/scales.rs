//! Other units: a scene of 2,000 spheres multiplied by powers of two, with rays of other lengths, against the unscaled
//! scene.

use crate::engine::Query;
use crate::engine::kernel::{Kernel, Way, levels};
use crate::measure::{Effort, checked};
use crate::rounds::{Median, Sampler, Samples};
use spherule_kernel::Tier;
use spherule_tests::scenes::{Kind, Scene};
use std::time::Duration;

/// Exponents of the scene and of directions. The first pair is the unscaled scene.
pub(crate) const SCALES: [[i64; 2]; 11] = [
    [0, 0],
    [41, 0],
    [100, 0],
    [-60, 0],
    [-100, 0],
    [0, 51],
    [0, 100],
    [0, -51],
    [0, -100],
    [100, 100],
    [-100, -100],
];

/// What is timed.
pub(crate) const WAYS: [(Kind, Way); 5] = [
    (Kind::Primary, Way::BruteForce),
    (Kind::Primary, Way::Packets),
    (Kind::Primary, Way::DepthList),
    (Kind::Diffuse, Way::BruteForce),
    (Kind::Diffuse, Way::RayByRay),
];

/// A scale, a way, and a query.
type Name = ([i64; 2], (Kind, Way), Query);

/// Times of all scales, taken in turns.
pub(crate) struct Scales(Samples<Name>);

/// Measures `Exact` at the best level.
pub(crate) fn measure(effort: Effort) -> Scales {
    let (pixels, rounds, sample) = match effort {
        Effort::Test => (16, 1, 0),
        Effort::Quick => (128, 5, 2),
        Effort::Full => (128, 31, 5),
    };
    eprintln!("scales: {rounds} rounds");
    let plain = Scene::uniform(2000, pixels);
    let mut samplers = Vec::<(Name, Sampler<'_>)>::new();
    for scale in SCALES {
        let scene = plain.scaled(scale);
        let kernel = Kernel::new(&scene, &scene.tree());
        for kind in Kind::ALL {
            let engines = kernel.ways(kind, &levels()[..1], &[Tier::Exact]);
            let engines: Vec<_> = engines.iter().collect();
            for engine in checked((&scene, kind), &engines, &kernel.truth(), usize::MAX) {
                let is_own =
                    |(of, way): &&(Kind, Way)| *of == kind && way.as_str() == engine.label.way;
                let Some(&way) = WAYS.iter().find(is_own) else { continue };
                let named = engine.samplers(&Query::ALL, Duration::from_millis(sample)).into_iter();
                samplers.extend(named.map(|(query, sampler)| ((scale, way, query), sampler)));
            }
        }
    }
    Scales(Samples::take(samplers, Duration::ZERO, rounds..=rounds))
}

impl Scales {
    pub(crate) fn rounds(&self) -> usize {
        self.0.rounds()
    }

    /// The time of a scale, divided by the time of the unscaled scene.
    pub(crate) fn ratio(&self, scale: [i64; 2], way: (Kind, Way), query: Query) -> Option<Median> {
        self.0.ratio(&(scale, way, query), &(SCALES[0], way, query))
    }
}
