//! How fast every contender is: nanoseconds a ray-sphere test of brute force.
//!
//! All are checked, then timed in turns ([`crate::rounds`]), each for about as long.

use crate::check;
use crate::report::contender::{Contender, Engine};
use crate::rounds::{self, Median, Samples, Subject};
use crate::workload::{Cloud, Kind, RAYS};
use spherule_kernel::Ray;
use std::time::Duration;

/// What stands in the list of spheres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum List {
    /// A cube of small spheres.
    Cube,
    /// The same, and a ground sphere of radius 1000.
    Ground,
    /// Spheres that every line hits.
    EveryLine,
}

/// Which rays against which spheres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Workload {
    /// The rays.
    pub kind: Kind,
    /// The spheres.
    pub list: List,
    /// How many, without the ground.
    pub count: usize,
}

impl Workload {
    const fn new(kind: Kind, list: List, count: usize) -> Self {
        Self { kind, list, count }
    }

    /// All of them, in the order of the tables.
    pub const ALL: [Self; 10] = [
        Self::new(Kind::Camera, List::Cube, 64),
        Self::new(Kind::Camera, List::Cube, 1024),
        Self::new(Kind::Incoherent, List::Cube, 64),
        Self::new(Kind::Incoherent, List::Cube, 1024),
        Self::new(Kind::Camera, List::Ground, 64),
        Self::new(Kind::Camera, List::Ground, 1024),
        Self::new(Kind::Incoherent, List::Ground, 64),
        Self::new(Kind::Incoherent, List::Ground, 1024),
        Self::new(Kind::Camera, List::EveryLine, 64),
        Self::new(Kind::Incoherent, List::EveryLine, 64),
    ];

    fn cloud(&self) -> Cloud {
        match self.list {
            List::Cube => Cloud::new(self.count),
            List::Ground => Cloud::with_ground(self.count),
            List::EveryLine => Cloud::on_every_line(self.count),
        }
    }
}

impl core::fmt::Display for Workload {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let list = match self.list {
            List::Cube => "",
            List::Ground => " + ground",
            List::EveryLine => ", every line hits",
        };
        write!(formatter, "{} {}{list}", self.kind.name(), self.count)
    }
}

/// The times of all contenders on all workloads.
#[derive(Clone, Debug)]
pub struct Speed {
    samples: Samples,
    worst: Vec<(&'static str, List, f64)>,
    /// How often each was timed.
    pub rounds: usize,
}

/// Checks every contender on every workload, then times them `rounds` times for `at_least`.
///
/// # Panics
/// Where an answer is further from the truth than the contender's tolerance.
#[must_use]
pub fn measure(contenders: &[Contender], rounds: usize, at_least: Duration) -> Speed {
    let loads: Vec<_> = Workload::ALL
        .into_iter()
        .map(|workload| {
            let (rays, cloud) = (workload.kind.rays(), workload.cloud());
            let truth = check::reference(&rays, &cloud.list());
            (workload, rays, cloud, truth)
        })
        .collect();
    let (mut subjects, mut worst) = (Vec::new(), Vec::new());
    for (workload, rays, cloud, truth) in &loads {
        for contender in in_turns(contenders) {
            let (subject, error) = subject(contender, workload, rays, cloud, truth, at_least);
            subjects.push(subject);
            worst.push((contender.name, workload.list, error));
        }
    }
    Speed { samples: rounds::take(&mut subjects, rounds), worst, rounds }
}

/// Engine by engine, so that what is compared is timed as closely together as can be.
fn in_turns(contenders: &[Contender]) -> Vec<&Contender> {
    let mut all: Vec<_> = contenders.iter().collect();
    all.sort_by_key(|contender| {
        contenders.iter().position(|other| other.engine == contender.engine)
    });
    all
}

/// Something to time, and the largest relative error of its t.
fn subject<'a>(
    contender: &Contender,
    workload: &Workload,
    rays: &[Ray],
    cloud: &'a Cloud,
    truth: &[Option<(f64, u32)>],
    at_least: Duration,
) -> (Subject<'a>, f64) {
    let name = name(contender.name, contender.engine, *workload);
    let spheres = cloud.spheres();
    let mut run = (contender.ready)(rays, spheres);
    run.run();
    let Contender { tolerance, over_ground, .. } = *contender;
    let tolerance = if workload.list == List::Ground { over_ground } else { tolerance };
    let hits = run.hits();
    check::near_reference(&name, &hits, truth, tolerance);
    let worst = check::worst(&hits, truth);

    let start = rounds::busy();
    run.run();
    let once = (rounds::busy() - start).max(100.0);
    let passes = (at_least.as_secs_f64() * 1e9 / once).ceil() as usize;
    let tests = passes * RAYS * spheres.len();
    let subject = Subject::new(name, move || {
        for _ in 0..passes {
            run.run();
        }
        tests
    });
    (subject, worst)
}

fn name(contender: &str, engine: Engine, workload: Workload) -> String {
    format!("{contender} in {engine} on {workload}")
}

impl Speed {
    /// Nanoseconds a test.
    #[must_use]
    pub fn time(&self, contender: &str, engine: Engine, workload: Workload) -> Median {
        self.samples.median(&name(contender, engine, workload))
    }

    /// How many times the time of `other` a contender takes, round by round.
    #[must_use]
    pub fn ratio(
        &self,
        (contender, engine): (&str, Engine),
        (other, other_engine): (&str, Engine),
        workload: Workload,
    ) -> Median {
        let name = |contender, engine| name(contender, engine, workload);
        self.samples.ratio(&name(contender, engine), &name(other, other_engine))
    }

    /// The largest relative error of t of a contender on the rays that were timed.
    #[must_use]
    pub fn worst(&self, contender: &str, list: List) -> f64 {
        let own = self.worst.iter().filter(|(name, on, _)| *name == contender && *on == list);
        own.fold(0.0, |worst, (_, _, error)| worst.max(*error))
    }

    /// The engine in which `name` is quickest on `workload`, of those that `chosen` keeps.
    #[must_use]
    pub fn quickest(
        &self,
        contenders: &[Contender],
        contender: &str,
        workload: Workload,
        chosen: impl Fn(Engine) -> bool,
    ) -> Option<Engine> {
        let engines = contenders.iter().filter(|other| other.name == contender);
        let time = |engine: &Engine| self.time(contender, *engine, workload).middle;
        engines
            .map(|contender| contender.engine)
            .filter(|&engine| chosen(engine))
            .min_by(|a, b| time(a).total_cmp(&time(b)))
    }
}
