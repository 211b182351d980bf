//! Measures a scene's rays: checks every engine, then times all in turns.

use crate::agreement::{WithTruth, check};
use crate::engine::{Engine, Label, Query, Ready, Run};
use crate::rounds::{Median, Sampler, Samples};
use spherule_tests::scenes::{Kind, LARGE, Scene, Size};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::rc::Rc;
use std::time::Duration;

/// How much is measured.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Effort {
    Test,
    Quick,
    Full,
}

/// The large scenes, or `one` alone.
pub(crate) fn large_scenes(one: Option<&str>, size: Size) -> impl Iterator<Item = Scene> {
    let chosen = LARGE.into_iter().filter(move |name| one.is_none_or(|one| one == *name));
    chosen.map(move |name| Scene::large(name, size).expect("listed"))
}

/// How long and how often everything is timed.
#[derive(Clone)]
pub(crate) struct Plan<'a> {
    pub(crate) queries: &'a [Query],
    /// The time for one kind of a scene's rays.
    pub(crate) time: Duration,
    pub(crate) rounds: RangeInclusive<usize>,
    /// The most rays of a sample.
    pub(crate) rays: usize,
    /// How long a sample takes at least.
    pub(crate) sample: Duration,
}

/// A checked engine, with the number of rays that it is timed on.
pub(crate) struct Checked {
    pub(crate) label: Label,
    rays: usize,
    pub(crate) run: Box<dyn Run>,
}

impl Checked {
    /// Makes a sampler for each query. A sample takes `least` or longer, and counts nanoseconds a
    /// ray.
    pub(crate) fn samplers(
        self,
        queries: &[Query],
        least: Duration,
    ) -> Vec<(Query, Sampler<'static>)> {
        let run = Rc::new(RefCell::new(self.run));
        let sampler = |query| -> Sampler<'static> {
            let run = Rc::clone(&run);
            let time = move |runs| run.borrow_mut().time(query, runs);
            let fit = || (least.as_secs_f64() * 1e9 / time(1).max(100.0)).ceil().max(1.0);
            let runs = if least.is_zero() { 1.0 } else { fit() };
            Box::new(move || time(runs as usize) / (runs * self.rays as f64))
        };
        queries.iter().map(|&query| (query, sampler(query))).collect()
    }
}

/// Checks every engine on these rays, on `most` at most, and returns those that are to be timed.
///
/// # Panics
/// If an answer is wrong.
pub(crate) fn checked(
    (scene, kind): (&Scene, Kind),
    engines: &[&Engine],
    exact: &Ready,
    most: usize,
) -> Vec<Checked> {
    let few = WithTruth::few((scene, kind));
    let mut sets = BTreeMap::new();
    let mut timed = Vec::new();
    for &engine in engines {
        let count = engine.most_rays.min(most).min(scene.rays(kind).len());
        let own = sets.entry(count).or_insert_with(|| WithTruth::new((scene, kind), count));
        let mut run = (engine.ready)(&own.rays);
        check((scene, engine), (&few, own), &mut *run, exact);
        if count > 0 {
            timed.push(Checked { label: engine.label.clone(), rays: own.rays.list.len(), run });
        }
    }
    timed
}

/// The times of a scene's rays of one kind.
pub(crate) struct Measured {
    pub(crate) scene: &'static str,
    pub(crate) kind: Kind,
    /// How many spheres.
    pub(crate) spheres: usize,
    /// Nanoseconds a ray, in the order of the engines.
    times: Samples<(Label, Query)>,
}

impl Measured {
    /// Checks the engines, then times them in turns.
    pub(crate) fn take(
        (scene, kind): (&Scene, Kind),
        engines: &[&Engine],
        exact: &Ready,
        plan: &Plan<'_>,
    ) -> Self {
        let mut samplers = Vec::<(_, Sampler<'_>)>::new();
        for engine in checked((scene, kind), engines, exact, plan.rays) {
            let label = engine.label.clone();
            let named = engine.samplers(plan.queries, plan.sample).into_iter();
            samplers.extend(named.map(|(query, sampler)| ((label.clone(), query), sampler)));
        }
        let times = Samples::take(samplers, plan.time, plan.rounds.clone());
        Self { scene: scene.name, kind, spheres: scene.spheres.len(), times }
    }

    pub(crate) fn rounds(&self) -> usize {
        self.times.rounds()
    }

    /// What was timed.
    pub(crate) fn labels(&self) -> impl Iterator<Item = &Label> {
        let names = self.times.names.iter();
        names.filter(|(_, query)| *query == Query::ClosestHit).map(|(label, _)| label)
    }

    /// Nanoseconds a ray; `None` if `label` was not timed.
    fn time(&self, label: &Label, query: Query) -> Option<Median> {
        self.times.median(&(label.clone(), query))
    }

    /// Nanoseconds a ray and sphere, for the closest hit.
    pub(crate) fn time_a_test(&self, label: &Label) -> Option<Median> {
        Some(self.time(label, Query::ClosestHit)?.times(1.0 / self.spheres as f64))
    }

    /// Million rays a second.
    pub(crate) fn rate(&self, label: &Label, query: Query) -> Option<f64> {
        self.time(label, query).map(|time| 1e3 / time.middle)
    }

    /// The time of `label`, divided by the time of `other`, round by round.
    pub(crate) fn ratio(&self, label: &Label, other: &Label, query: Query) -> Option<Median> {
        self.times.ratio(&(label.clone(), query), &(other.clone(), query))
    }

    /// The fastest of the engines that `chosen` keeps.
    pub(crate) fn fastest(&self, query: Query, chosen: impl Fn(&Label) -> bool) -> Option<&Label> {
        let quickest = self.times.quickest(|(label, of)| *of == query && chosen(label));
        quickest.map(|(label, _)| label)
    }
}
