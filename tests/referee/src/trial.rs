//! An intersector against all families: pairs, and scenes of eight spheres.

use crate::failure::Failure;
use crate::families::{FAMILIES, Family, SEED};
use crate::intersector::Intersector;
use crate::judge::Judge;
use crate::rules::Rules;
use crate::shrink::{Candidate, shrink};
use crate::snippet::{rust, sentence};
use crate::table::write_counts;
use crate::truth::Shared;
use crate::verdict::Kind;
use crate::watched::{Mishap, Question, Watched};
use spherule_kernel::{Ray, Sphere};
use std::fmt;
use std::time::{Duration, Instant};

/// How many pairs one call has.
const PAIRS: u64 = 1024;
/// How many rays and spheres one scene has.
const SCENE: usize = 8;
/// How many cases are shrunk in one call.
const AT_ONCE: usize = 64;
/// After so many mishaps, or one hang, the trial leaves out the rest of a family.
const MOST_MISHAPS: usize = 3;

/// What a trial asks, and for how long.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The families.
    pub families: Vec<Family>,
    /// How many cases of each.
    pub cases: u64,
    /// Their seed.
    pub seed: u32,
    /// Whether cases are also asked in scenes: every eight rays of a family against all their eight spheres.
    pub scenes: bool,
    /// How long the smallest case of each kind may be looked for.
    pub shrinking: Duration,
    /// How long to wait for an answer.
    pub patience: Duration,
}

impl Default for Trial {
    /// All families, a thousand cases of each, five seconds for each kind, ten for an answer.
    fn default() -> Self {
        Self {
            families: FAMILIES.to_vec(),
            cases: 1000,
            seed: SEED,
            scenes: true,
            shrinking: Duration::from_secs(5),
            patience: Duration::from_secs(10),
        }
    }
}

/// A question without answers.
#[derive(Clone, Debug)]
pub struct Unanswered {
    /// The family that the question is from.
    pub family: Family,
    /// What went wrong.
    pub mishap: Mishap,
    /// The ray, or the first of several.
    pub ray: Ray,
    /// The spheres of the question.
    pub spheres: Vec<Sphere>,
}

/// The result of a trial.
#[derive(Clone, Debug)]
pub struct Report {
    /// The name of the intersector.
    pub name: String,
    /// Counts by family, and the worst failures.
    pub judge: Judge,
    /// The smallest failure of each kind that occurred.
    pub smallest: Vec<Failure>,
    /// Questions without answers.
    pub unanswered: Vec<Unanswered>,
    /// The time until the first failure or mishap.
    pub first: Option<Duration>,
    /// How long the trial took.
    pub took: Duration,
}

impl Trial {
    /// Asks, judges, and shrinks what is wrong.
    ///
    /// If an intersector panics, hangs or answers too few rays, the trial goes on with a new clone.
    #[must_use]
    pub fn run<I: Intersector + Clone + Send + 'static>(&self, intersector: &I) -> Report {
        let start = Instant::now();
        let rules = intersector.rules();
        let mut watched = Watched::new(intersector, self.patience);
        let mut report = Report {
            name: intersector.name().to_owned(),
            judge: Judge::new(rules, true),
            smallest: Vec::new(),
            unanswered: Vec::new(),
            first: None,
            took: Duration::ZERO,
        };
        for family in &self.families {
            self.try_family(family, &mut watched, &mut report, start);
        }
        for kind in Kind::ALL {
            let Some(failure) = report.judge.simplest(kind) else { continue };
            let smallest = shrink(failure, (self.shrinking, AT_ONCE), |candidates| {
                candidates.iter().map(|case| failure_of(case, rules, &mut watched)).collect()
            });
            report.smallest.push(smallest);
        }
        report.took = start.elapsed();
        report
    }

    fn try_family<I: Intersector + Clone + Send + 'static>(
        &self,
        family: &Family,
        watched: &mut Watched<I>,
        report: &mut Report,
        start: Instant,
    ) {
        let mut mishaps = 0;
        let mut from = 0;
        while from < self.cases {
            let indices = from..(from + PAIRS).min(self.cases);
            from = indices.end;
            let (rays, spheres): (Vec<Ray>, Vec<Sphere>) = indices
                .map(|index| family.seeded(self.seed, index))
                .map(|case| (case.ray, case.sphere))
                .unzip();
            let all = Question { spheres, rays, pairs: true };
            let scenes = self.scenes.then(|| scenes(&all)).into_iter().flatten();
            for question in std::iter::once(all.clone()).chain(scenes) {
                let Err(mishap) = answer(&question, family, watched, &mut report.judge) else {
                    continue;
                };
                // Finds out which ray it is.
                let mut alone = parts(&question).into_iter().map(|part| {
                    let found = answer(&part, family, watched, &mut report.judge).err();
                    found.map(|mishap| (part, mishap))
                });
                let hangs = matches!(mishap, Mishap::Hung(_));
                let found: Vec<_> = if hangs {
                    alone.find_map(|found| found).into_iter().collect()
                } else {
                    alone.flatten().take(MOST_MISHAPS).collect()
                };
                let found = if found.is_empty() { vec![(question, mishap)] } else { found };
                for (question, mishap) in found {
                    mishaps += if hangs { MOST_MISHAPS } else { 1 };
                    let Question { spheres, rays, .. } = question;
                    let ray = rays.first().copied().unwrap_or(Ray::INACTIVE);
                    report.unanswered.push(Unanswered { family: *family, mishap, ray, spheres });
                }
                report.first.get_or_insert_with(|| start.elapsed());
                if mishaps >= MOST_MISHAPS {
                    return;
                }
            }
            if report.first.is_none()
                && Kind::ALL.iter().any(|&kind| report.judge.worst(kind).is_some())
            {
                report.first = Some(start.elapsed());
            }
        }
    }
}

/// Asks all rays of a few cases against all their spheres.
fn scenes(pairs: &Question) -> Vec<Question> {
    let some = pairs.spheres.chunks(SCENE).zip(pairs.rays.chunks(SCENE));
    let scene = |(spheres, rays): (&[Sphere], &[Ray])| Question {
        spheres: spheres.to_vec(),
        rays: rays.to_vec(),
        pairs: false,
    };
    some.map(scene).collect()
}

/// A question for every ray.
fn parts(question: &Question) -> Vec<Question> {
    let Question { spheres, rays, pairs } = question;
    let of = |(index, ray): (usize, &Ray)| {
        let spheres = if *pairs { vec![spheres[index]] } else { spheres.clone() };
        Question { spheres, rays: vec![*ray], pairs: *pairs }
    };
    rays.iter().enumerate().map(of).collect()
}

fn answer<I: Intersector + Clone + Send + 'static>(
    question: &Question,
    family: &Family,
    watched: &mut Watched<I>,
    judge: &mut Judge,
) -> Result<(), Mishap> {
    let answers = watched.ask(question)?;
    let families = vec![family.number; answers.len()];
    let Question { spheres, rays, pairs } = question;
    if *pairs {
        judge.pairs(rays, spheres, &answers, &families);
    } else {
        judge.shared(&Shared::new(spheres), rays, &answers, &families);
    }
    Ok(())
}

/// How one case fails, if it does.
fn failure_of<I: Intersector + Clone + Send + 'static>(
    (ray, spheres): &Candidate,
    rules: Rules,
    watched: &mut Watched<I>,
) -> Option<Failure> {
    let pairs = spheres.len() == 1;
    let question = Question { spheres: spheres.clone(), rays: vec![*ray], pairs };
    let answers = watched.ask(&question).ok()?;
    let mut judge = Judge::new(rules, false);
    if pairs {
        judge.pairs(&question.rays, spheres, &answers, &[]);
    } else {
        judge.shared(&Shared::new(spheres), &question.rays, &answers, &[]);
    }
    Kind::ALL.into_iter().find_map(|kind| judge.worst(kind).cloned())
}

impl Report {
    /// How many answers are wrong under the intersector's rules, plus the questions without answers.
    #[must_use]
    pub fn wrong(&self) -> u64 {
        self.judge.total().by_rules.wrong() + self.unanswered.len() as u64
    }
}

impl fmt::Display for Report {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, judge, smallest, unanswered, .. } = self;
        writeln!(formatter, "{name}, under its own rules")?;
        write_counts(judge, formatter)?;
        for Unanswered { family, mishap, .. } in unanswered {
            writeln!(formatter, "{}: {mishap}", family.name)?;
        }
        for failure in smallest {
            writeln!(formatter, "\nthe smallest {}", sentence(failure))?;
            write!(formatter, "{}", rust(failure))?;
        }
        Ok(())
    }
}
