//! The trial before the clock: checks every way's answers, on a few rays first, and drops the ways that are far behind.

use super::ways::{Way, Work};
use crate::engine::{EMBREE_DIFFERS, Engine, Query, Rays};
use crate::forms::Answer;
use spherule_kernel::{Level, Ray};
use spherule_tests::scenes::sample;

/// How many rays the first trials take, in runs from all of them.
const PARTS: [usize; 2] = [256, 1024];
const LAST_PART: usize = PARTS[1];
/// A run that takes more nanoseconds is not repeated.
const LONG: f64 = 1e6;
/// A way that takes so many times as long as the best on a part is not timed on all rays.
const SLOW: f64 = 8.0;
/// A way that takes so many times as long as the best on all rays is not the best.
const NEAR: f64 = 1.6;
/// The fewest rays of a sample.
const LEAST: usize = 1024;
/// How many tests of brute force a check may cost.
const TESTS: usize = 1 << 20;

/// The ways that are shown however slow they are; the plain call is timed in any case.
const SHOWN: [Way; 3] = [Way::RayByRay, Way::Coherent, Way::Plain];

/// What is to be timed.
pub(super) struct Trial {
    /// Ray by ray, every way that may be the best, and those of [`SHOWN`] that were not too slow.
    pub(super) ways: Vec<Way>,
    /// The ways that were too slow, with how many times as long as ray by ray they took on the same rays.
    pub(super) slow: Vec<(Way, f64)>,
    /// Which of Embree's calls may be the best.
    pub(super) embree: Vec<usize>,
    /// The rays, which `work` has, too.
    pub(super) rays: Rays,
}

impl Trial {
    /// # Panics
    /// If an answer is wrong.
    pub(super) fn of(
        (level, query): (Level, Query),
        work: &mut Work<'_>,
        embree: &[&Engine],
        rays: &[Ray],
        (nanoseconds, is_far): (f64, bool),
        name: &str,
    ) -> Self {
        let (mut slow, mut best) = (Vec::new(), f64::INFINITY);
        let mut answers = Vec::new();
        // A few rays are all in one part.
        let parts = if rays.len() > PARTS[0] { &PARTS[..] } else { &PARTS[..1] };
        for &part in parts {
            work.take(sample(rays, part));
            let few = TESTS / work.spheres().max(1);
            answers = work.checked((level, query), few.clamp(1, part / 4), name);
            let timed = times((level, query), work, &mut slow, &answers, name);
            best = timed.into_iter().fold(f64::INFINITY, |best, (_, time)| time.min(best));
        }
        let (embree, of_embree) = nearest(embree, work.rays(), (query, is_far), &answers, name);
        let fit = (2.0 * nanoseconds / (best + of_embree)) as usize;
        let all = sample(rays, fit.max(LEAST).min(rays.len()));
        work.take(all);
        let answers = work.checked((level, query), 0, name);
        let timed = times((level, query), work, &mut slow, &answers, name);
        let best = timed.iter().fold(f64::INFINITY, |best, (_, time)| time.min(best));
        let is_kept = |&(way, time): &(Way, f64)| SHOWN.contains(&way) || time < NEAR * best;
        let ways = timed.into_iter().filter(is_kept).map(|(way, _)| way).collect();
        slow.retain(|(way, _)| SHOWN.contains(way));
        Self { ways, slow, embree, rays: Rays::new(work.rays()) }
    }
}

/// Checks all ways that are not among the slow; returns nanoseconds a ray of those that have not become slow, ray by ray's first.
fn times(
    (level, query): (Level, Query),
    work: &mut Work<'_>,
    slow: &mut Vec<(Way, f64)>,
    truth: &[Answer],
    name: &str,
) -> Vec<(Way, f64)> {
    let count = work.rays().len() as f64;
    let (mut timed, mut best) = (Vec::<(Way, f64)>::new(), f64::INFINITY);
    for way in Way::ALL {
        if !way.is_for(work) || slow.iter().any(|(other, _)| *other == way) {
            continue;
        }
        work.forget();
        let mut time = work.run(way, level, query) / count;
        assert!(work.answers(way, query) == truth, "{name}: {way:?} differs from ray by ray");
        // A part takes little time, so the best of some runs counts: the first run finds nothing in the cache.
        let again = if work.rays().len() > LAST_PART || time * count > LONG { 0 } else { 2 };
        for _ in 0..again {
            time = time.min(work.run(way, level, query) / count);
        }
        // Streams and the plain call may be slow for few rays, but not for more.
        if time > SLOW * best && !matches!(way, Way::Stream | Way::Plain) {
            slow.push((way, time / timed[0].1));
        } else {
            timed.push((way, time));
        }
        best = best.min(time);
    }
    timed
}

/// Embree's calls that may be the quickest, and nanoseconds a ray of the quickest.
fn nearest(
    embree: &[&Engine],
    rays: &[Ray],
    (query, is_far): (Query, bool),
    truth: &[Answer],
    name: &str,
) -> (Vec<usize>, f64) {
    /// A call that takes so many times as long as the quickest is not the quickest: on the first part, and on the second.
    const FAR: [f64; 2] = [2.0, 1.35];
    let (mut chosen, mut best) = ((0..embree.len()).collect::<Vec<_>>(), 0.0);
    for (part, far) in PARTS.into_iter().zip(FAR) {
        let rays = Rays::new(&rays[..part.min(rays.len())]);
        let count = rays.list.len() as f64;
        let time = |&index: &usize| {
            let engine = embree[index];
            let mut run = (engine.ready)(&rays);
            let time = run.time(query, 1).min(run.time(query, 1)) / count;
            let differs = |(ray, hit): &(usize, bool)| *hit != truth[*ray].is_some();
            let hits = run.hits().into_iter().map(|hit| hit.is_some()).enumerate();
            let differ = hits.filter(differs).count() as f64;
            // From far away it may lose all spheres if they are small, since it subtracts squares of the distance.
            let is_like_ours = is_far || differ <= EMBREE_DIFFERS * count;
            assert!(is_like_ours, "{name}: {} in {differ} rays", engine.label);
            (index, time)
        };
        let times: Vec<_> = chosen.iter().map(time).collect();
        best = times.iter().fold(f64::INFINITY, |best, (_, time)| time.min(best));
        chosen = times.into_iter().filter(|(_, time)| *time < far * best).map(|it| it.0).collect();
        if best * count > LONG {
            break;
        }
    }
    (chosen, if embree.is_empty() { 0.0 } else { best })
}
