//! Spheres that move: the time of a refit, divided by the time of a build.

use crate::rounds::{Median, Sampler, Samples, timed};
use spherule_kernel::{InTurn, Sphere, SphereList, SphereTree, Vec3};
use spherule_tests::scenes::Scene;
use std::time::Duration;

/// With fewer spheres, several builds or refits are timed together, of about so many spheres: reading the clock takes
/// as long as a small one.
const AT_ONCE: usize = 4096;

/// Spheres of a scene that move, against building anew.
pub(crate) struct Refit {
    pub(crate) scene: &'static str,
    pub(crate) spheres: usize,
    /// By how much boxes have grown.
    pub(crate) growth: f32,
    /// A refit's time by a build's.
    pub(crate) by_build: Option<Median>,
}

impl Refit {
    /// Every sphere moves by up to its radius along each axis, there and back.
    pub(super) fn measure(scene: &Scene, rounds: usize) -> Self {
        let spheres = scene.spheres.spheres();
        let moved = |(index, sphere): (usize, Sphere)| {
            let part = |axis: usize| ((index * 31 + axis * 17) % 64) as f32 / 32.0 - 1.0;
            let step = Vec3::new(part(0), part(1), part(2));
            Sphere { center: sphere.center + sphere.radius * step, ..sphere }
        };
        let there: SphereList = spheres.iter().enumerate().map(moved).collect();
        let lists = [there, (*scene.spheres).clone()];
        let tree = SphereTree::build_with(&InTurn, (*scene.spheres).clone());
        let mut tree = tree.expect("enough memory");
        let growth = tree.refit(lists[0].clone()).expect("as many");
        let times = (AT_ONCE / spheres.len().max(1)).clamp(1, 256);
        let build = || {
            let all = vec![lists[1].clone(); times];
            timed(|| {
                for list in all {
                    drop(std::hint::black_box(SphereTree::build_with(&InTurn, list)));
                }
            })
        };
        let mut turn = 1;
        let refit = || {
            let all: Vec<_> = (turn..turn + times).map(|turn| lists[turn % 2].clone()).collect();
            turn += times;
            timed(|| {
                for list in all {
                    tree.refit(list).expect("as many");
                }
            })
        };
        let samplers: Vec<(_, Sampler<'_>)> =
            vec![(false, Box::new(build)), (true, Box::new(refit))];
        let times = Samples::take(samplers, Duration::from_millis(300), rounds..=20 * rounds);
        let by_build = times.ratio(&true, &false);
        Self { scene: scene.name, spheres: spheres.len(), growth, by_build }
    }
}
