//! Rays in every order: the plain call against the best way for them, ray by ray, and Embree.

mod trial;
mod ways;

pub(crate) use ways::Way;

use crate::builds::Trees;
use crate::engine::kernel::levels;
use crate::engine::{Engine, Query};
use crate::left_out::LeftOut;
use crate::measure::Effort;
use crate::rounds::{Median, Sampler, Samples};
use spherule_kernel::{Level, LevelName, Ray};
use spherule_tests::orders::{Extent, Order};
use spherule_tests::scenes::{LARGE, SPREAD, Scene, Size};
use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::time::Duration;
use trial::Trial;
use ways::Work;

/// What was timed: a way, or one of Embree's calls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Timed {
    Ours(Way),
    Embree(usize),
}

/// Times of one order of rays in a scene, for a query, at a level.
pub(crate) struct Row {
    pub(crate) scene: &'static str,
    pub(crate) order: Order,
    pub(crate) query: Query,
    pub(crate) level: LevelName,
    /// How many rays a sample took.
    pub(crate) rays: usize,
    /// Whether the plain call was so slow that it was timed on a part of the rays alone.
    pub(crate) is_cut_short: bool,
    /// Nanoseconds a ray.
    times: Samples<Timed>,
}

/// How many rays, and rounds.
#[derive(Clone, Copy)]
struct Plan {
    rays: usize,
    /// At least so many, and up to three times as many, as long as `time` allows.
    rounds: usize,
    time: Duration,
    /// What a sample of the quickest way, or of Embree's, may take on average; otherwise there are fewer rays.
    nanoseconds: f64,
    /// Whether every row is timed at all levels, or rows take levels in turn.
    every_level: bool,
}

/// Measures all scenes and orders, or one alone; in calls of `rays` rays if given.
pub(crate) fn measure(
    effort: Effort,
    (one, order): (Option<&str>, Option<Order>),
    rays: Option<usize>,
    left_out: &LeftOut,
) -> Vec<Row> {
    let (size, usual, rounds, milliseconds, nanoseconds) = match effort {
        Effort::Test => (Size::SMALL, 256, 1, 0, 0.0),
        Effort::Quick => (Size::FULL, 1 << 14, 3, 60, 8e6),
        Effort::Full => (Size::FULL, 1 << 16, 7, 1000, 1e8),
    };
    let plan = Plan {
        rays: rays.unwrap_or(usual),
        rounds,
        time: Duration::from_millis(milliseconds),
        nanoseconds,
        every_level: effort != Effort::Test,
    };
    let chosen = |name: &&str| one.is_none_or(|one| one == *name);
    let mut rows = Vec::new();
    for name in LARGE.into_iter().chain([SPREAD]).filter(chosen) {
        let scene = match name {
            SPREAD => Scene::spread(size),
            _ => Scene::large(name, size).expect("listed"),
        };
        let measured = left_out.unless_wrong(name, || of_scene(&scene, order, plan));
        rows.extend(measured.into_iter().flatten());
    }
    rows
}

fn of_scene(scene: &Scene, one: Option<Order>, plan: Plan) -> Vec<Row> {
    let (levels, spheres) = (levels(), scene.spheres.spheres());
    let (trees, extent) = (Trees::build(scene, false, &levels), Extent::of(spheres));
    let mut work = Work::new(&trees.ours);
    let mut rows = Vec::new();
    for (index, order) in Order::ALL.into_iter().enumerate() {
        if one.is_some_and(|one| one != order) {
            continue;
        }
        eprintln!("{}, {}", scene.name, order.as_str());
        let rays = order.rays_in(&extent, spheres, plan.rays, 1);
        let at = |place: usize| plan.every_level || place == index % levels.len();
        for (_, &level) in levels.iter().enumerate().filter(|(place, _)| at(*place)) {
            let embree = trees.embree(level);
            for query in Query::ALL {
                let asked = (scene.name, order, query, level);
                rows.push(Row::measure(asked, &mut work, &embree, &rays, plan));
            }
        }
    }
    rows
}

impl Row {
    fn measure(
        (scene, order, query, level): (&'static str, Order, Query, Level),
        work: &mut Work<'_>,
        embree: &[&Engine],
        rays: &[Ray],
        plan: Plan,
    ) -> Self {
        let name = format!("{scene}, {}, {query:?}, {}", order.as_str(), level.name().as_str());
        let is_far = matches!(order, Order::FromFarAway | Order::LongLens);
        let asked = (plan.nanoseconds, is_far);
        let trial = Trial::of((level, query), work, embree, rays, asked, &name);
        let Trial { ways, slow, embree: chosen, rays } = trial;
        let (work, count) = (&RefCell::new(work), rays.list.len());
        let mut timed = Vec::<(_, Sampler<'_>)>::new();
        for way in ways {
            let sample = move || work.borrow_mut().run(way, level, query) / count as f64;
            timed.push((way, Box::new(sample)));
        }
        let is_cut_short = slow.iter().any(|(way, _)| *way == Way::Plain);
        let mut samplers = with_slow(timed, slow);
        for index in chosen {
            samplers.push((Timed::Embree(index), embree[index].sampler(&rays, query)));
        }
        let times = Samples::take(samplers, plan.time, plan.rounds..=3 * plan.rounds);
        Self { scene, order, query, level: level.name(), rays: count, is_cut_short, times }
    }

    /// How many times as fast the plain call is as another.
    fn plain_by(&self, other: &Timed) -> Option<Median> {
        self.times.ratio(other, &Timed::Ours(Way::Plain))
    }

    /// The best way; it may be the plain call.
    pub(crate) fn best(&self) -> Option<Way> {
        match self.times.quickest(|timed| matches!(timed, Timed::Ours(_)))? {
            Timed::Ours(way) => Some(*way),
            Timed::Embree(_) => None,
        }
    }

    /// How many times as fast a traversal is as the best of the others, and which that is.
    pub(crate) fn lead(&self, traversal: Way) -> Option<(Median, Way)> {
        let of = |timed: &Timed| match timed {
            Timed::Ours(way) => way.traversal(),
            Timed::Embree(_) => None,
        };
        let own = self.times.quickest(|timed| of(timed) == Some(traversal))?;
        let is_other = |timed: &Timed| of(timed).is_some_and(|other| other != traversal);
        let next = self.times.quickest(is_other)?;
        Some((self.times.ratio(next, own)?, of(next)?))
    }

    /// A million rays a second of the plain call.
    pub(crate) fn rate(&self) -> Option<f64> {
        Some(1e3 / self.times.median(&Timed::Ours(Way::Plain))?.middle)
    }

    /// The plain call's speed divided by the best way's: 1 where the plain call is the best.
    pub(crate) fn by_best(&self) -> Option<Median> {
        self.plain_by(&Timed::Ours(self.best()?))
    }

    /// The plain call's speed divided by that of ray by ray.
    pub(crate) fn by_ray_by_ray(&self) -> Option<Median> {
        self.plain_by(&Timed::Ours(Way::RayByRay))
    }

    /// The speed of rays said to be coherent, divided by that of ray by ray, whether they are coherent or not.
    pub(crate) fn coherent_by_ray_by_ray(&self) -> Option<Median> {
        self.times.ratio(&Timed::Ours(Way::RayByRay), &Timed::Ours(Way::Coherent))
    }

    /// The plain call's speed divided by that of Embree's quickest call.
    pub(crate) fn by_embree(&self) -> Option<Median> {
        self.plain_by(self.times.quickest(|timed| matches!(timed, Timed::Embree(_)))?)
    }

    pub(crate) fn rounds(&self) -> usize {
        self.times.rounds()
    }
}

/// The ways that are timed, ray by ray first, and those that were too slow for it. In each round those take so many times as long as ray by
/// ray: their time on a few rays and its time on all would not compare.
fn with_slow<'a>(
    timed: Vec<(Way, Sampler<'a>)>,
    slow: Vec<(Way, f64)>,
) -> Vec<(Timed, Sampler<'a>)> {
    let of_ray_by_ray = Rc::new(Cell::new(f64::NAN));
    let mut samplers = Vec::<(_, Sampler<'a>)>::new();
    for (way, mut sampler) in timed {
        let of_ray_by_ray = Rc::clone(&of_ray_by_ray);
        let sample = move || {
            let time = sampler();
            if way == Way::RayByRay {
                of_ray_by_ray.set(time);
            }
            time
        };
        samplers.push((Timed::Ours(way), Box::new(sample)));
    }
    for (way, times) in slow {
        let of_ray_by_ray = Rc::clone(&of_ray_by_ray);
        samplers.push((Timed::Ours(way), Box::new(move || times * of_ray_by_ray.get())));
    }
    samplers
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From round to round rays take longer.
    #[test]
    fn a_slow_way_is_held_against_ray_by_ray_on_the_same_rays() {
        let mut time = 0.0;
        let sample = move || {
            time += 1.0;
            time
        };
        let timed: Vec<(_, Sampler<'_>)> = vec![(Way::RayByRay, Box::new(sample))];
        let samplers = with_slow(timed, vec![(Way::Plain, 10.0)]);
        let row = Row {
            scene: "one",
            order: Order::ALL[0],
            query: Query::ClosestHit,
            level: LevelName::Baseline,
            rays: 1,
            is_cut_short: true,
            times: Samples::take(samplers, Duration::ZERO, 3..=3),
        };
        let tenth = Some(Median { low: 0.1, middle: 0.1, high: 0.1 });
        assert_eq!((row.by_ray_by_ray(), row.by_best()), (tenth, tenth));
    }
}
