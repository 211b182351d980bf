//! What a call costs: one ray a call beside Embree's, slices and columns beside packets; and spheres that move.

mod refit;
mod work;

pub(crate) use self::refit::Refit;
use self::work::Work;
pub(crate) use self::work::{Call, SHORT};
use crate::agreement::{WithTruth, check};
use crate::builds::Trees;
use crate::engine::kernel::{Kernel, levels};
use crate::engine::{Engine, Query, Rays};
use crate::left_out::LeftOut;
use crate::measure::{Effort, large_scenes};
use crate::rounds::{Median, Sampler, Samples};
use spherule_kernel::{Level, LevelName, SphereTree};
use spherule_tests::scenes::{Kind, Scene, Size};
use std::cell::RefCell;
use std::time::Duration;

/// Embree's call of one ray, among its engines.
const ONE_RAY: &str = "1 rays a call";

/// What was timed: one of the kernel's calls, or Embree's call of one ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Timed {
    Ours(Call),
    Embree(usize),
}

/// The times of a scene's rays of one kind, for one query, at one level.
pub(crate) struct Row {
    pub(crate) scene: &'static str,
    pub(crate) kind: Kind,
    pub(crate) query: Query,
    pub(crate) level: LevelName,
    /// Nanoseconds a ray.
    times: Samples<Timed>,
}

/// All that was measured.
pub(crate) struct Calls {
    pub(crate) rows: Vec<Row>,
    pub(crate) refits: Vec<Refit>,
}

/// Measures all scenes, or `one` alone.
pub(crate) fn measure(effort: Effort, one: Option<&str>, left_out: &LeftOut) -> Calls {
    let (size, rays, time, rounds) = match effort {
        Effort::Test => (Size::SMALL, 256, 0, 1),
        Effort::Quick => (Size::FULL, 1 << 13, 150, 5),
        Effort::Full => (Size::FULL, 1 << 14, 1000, 9),
    };
    let plan = (Duration::from_millis(time), rounds);
    let mut all = Calls { rows: Vec::new(), refits: Vec::new() };
    for scene in large_scenes(one, size) {
        eprintln!("calls, {}", scene.name);
        let measure = || (of_scene(&scene, rays, plan), Refit::measure(&scene, rounds));
        if let Some((rows, refit)) = left_out.unless_wrong(scene.name, measure) {
            all.rows.extend(rows);
            all.refits.push(refit);
        }
    }
    all
}

fn of_scene(scene: &Scene, rays: usize, plan: (Duration, usize)) -> Vec<Row> {
    let levels = levels();
    let trees = Trees::build(scene, false, &levels);
    let exact = Kernel::new(scene, &trees.ours).truth();
    let mut rows = Vec::new();
    for kind in Kind::ALL {
        let some = WithTruth::new((scene, kind), rays);
        for &level in &levels {
            let mut engines = trees.embree(level);
            engines.retain(|engine| engine.label.name == ONE_RAY);
            for &engine in &engines {
                let mut run = (engine.ready)(&some.rays);
                check((scene, engine), (&some, &some), &mut *run, &exact);
            }
            for query in Query::ALL {
                let asked = (scene.name, kind, query, level);
                rows.push(Row::measure(asked, &trees.ours, &engines, &some.rays, plan));
            }
        }
    }
    rows
}

impl Row {
    /// # Panics
    /// If calls differ in a bit.
    fn measure(
        (scene, kind, query, level): (&'static str, Kind, Query, Level),
        tree: &SphereTree,
        embree: &[&Engine],
        rays: &Rays,
        (time, rounds): (Duration, usize),
    ) -> Self {
        let work = RefCell::new(Work::new(tree, &rays.list));
        let count = rays.list.len() as f64;
        let run = |call| {
            let mut work = work.borrow_mut();
            work.forget();
            work.run(call, level, query);
            work.answers(call, query)
        };
        let expected = run(Call::PACKETS);
        for call in Call::ALL {
            let is_same = run(call) == expected;
            assert!(is_same, "{scene}, {kind:?}, {query:?}, {level:?}: {call:?}");
        }
        let mut samplers = Vec::<(_, Sampler<'_>)>::new();
        for call in Call::ALL {
            let work = &work;
            let sample = move || work.borrow_mut().run(call, level, query) / count;
            samplers.push((Timed::Ours(call), Box::new(sample)));
        }
        for (index, engine) in embree.iter().enumerate() {
            samplers.push((Timed::Embree(index), engine.sampler(rays, query)));
        }
        let times = Samples::take(samplers, time, rounds..=8 * rounds);
        Self { scene, kind, query, level: level.name(), times }
    }

    /// Million rays a second.
    pub(crate) fn rate(&self, call: Call) -> Option<f64> {
        Some(1e3 / self.times.median(&Timed::Ours(call))?.middle)
    }

    /// How many times as fast `call` is as `other`.
    pub(crate) fn ratio(&self, call: Call, other: Call) -> Option<Median> {
        self.times.ratio(&Timed::Ours(other), &Timed::Ours(call))
    }

    /// How many times as fast one ray a call is as Embree's call of one ray, in its quicker version.
    pub(crate) fn by_embree(&self) -> Option<Median> {
        let quicker = self.times.quickest(|timed| matches!(timed, Timed::Embree(_)))?;
        self.times.ratio(quicker, &Timed::Ours(Call::OneRay))
    }

    pub(crate) fn rounds(&self) -> usize {
        self.times.rounds()
    }
}
