//! An intersector against all families: pairs, and scenes of eight spheres.

use crate::answer::Answer;
use crate::failure::Failure;
use crate::families::{FAMILIES, Family, SEED};
use crate::intersector::Intersector;
use crate::judge::Judge;
use crate::rules::{Directions, Rules};
use crate::shrink::{Candidate, shrink};
use crate::snippet::{rust, sentence};
use crate::table::write_counts;
use crate::truth::Shared;
use crate::verdict::Kind;
use crate::watched::{Mishap, Question, Watched};
use spherule_kernel::{Ray, Sphere};
use std::fmt;
use std::ops::Range;
use std::time::{Duration, Instant};

/// How many pairs one call has, unless the intersector is slow.
const PAIRS: usize = 1024;
/// A slow intersector is asked so many times fewer rays at once.
const FEWER: usize = 4;
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
    /// How long the smallest case of each kind may be looked for, besides one case that takes longer.
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
    /// If an intersector panics, hangs or answers too few rays, the trial goes on with a new clone. If it is slow, it is asked fewer rays
    /// at once. If its rules want directions of length one, so are those of the cases.
    ///
    /// # Panics
    /// As [`Judge::pairs`] does.
    #[must_use]
    pub fn run<I: Intersector + Clone + Send + 'static>(&self, intersector: &I) -> Report {
        let start = Instant::now();
        let rules = intersector.rules();
        let report = Report {
            name: intersector.name().to_owned(),
            judge: Judge::new(rules, true),
            smallest: Vec::new(),
            unanswered: Vec::new(),
            first: None,
            took: Duration::ZERO,
        };
        let watched = Watched::new(intersector, self.patience);
        let mut course = Course { trial: self, watched, report, start, at_once: PAIRS };
        for family in &self.families {
            course.try_family(family);
        }
        let Course { mut watched, mut report, .. } = course;
        for kind in Kind::ALL {
            let Some(failure) = report.judge.simplest(kind) else { continue };
            let begun = Instant::now();
            let smallest = shrink(failure, (self.shrinking, AT_ONCE), |candidates| {
                // One case may take as long as patience lasts.
                let in_time = candidates.iter().take_while(|_| begun.elapsed() < self.shrinking);
                in_time.map(|case| failure_of(case, rules, &mut watched)).collect()
            });
            report.smallest.push(smallest);
        }
        report.took = start.elapsed();
        report
    }
}

/// A trial on its way.
struct Course<'a, I> {
    trial: &'a Trial,
    watched: Watched<I>,
    report: Report,
    start: Instant,
    /// The most rays of a question.
    at_once: usize,
}

impl<I: Intersector + Clone + Send + 'static> Course<'_, I> {
    fn try_family(&mut self, family: &Family) {
        let Trial { cases, seed, scenes: has_scenes, .. } = *self.trial;
        let is_unit = self.report.judge.rules().directions == Directions::Unit;
        let case = |index| {
            if is_unit { family.seeded_unit(seed, index) } else { family.seeded(seed, index) }
        };
        let mut mishaps = 0;
        for from in (0..cases).step_by(PAIRS) {
            let indices = from..(from + PAIRS as u64).min(cases);
            let (rays, spheres): (Vec<Ray>, Vec<Sphere>) =
                indices.map(case).map(|case| (case.ray, case.sphere)).unzip();
            let all = Question { spheres, rays, pairs: true };
            let scenes = if has_scenes { scenes(&all) } else { Vec::new() };
            for question in std::iter::once(all).chain(scenes) {
                let (rays, mut asked) = (question.rays.len(), 0);
                while asked < rays {
                    let some = asked..(asked + self.at_once).min(rays);
                    asked = some.end;
                    mishaps += self.ask(part(&question, some), family);
                    if mishaps >= MOST_MISHAPS {
                        return;
                    }
                }
            }
            let judge = &self.report.judge;
            if self.report.first.is_none()
                && Kind::ALL.iter().any(|&kind| judge.worst(kind).is_some())
            {
                self.report.first = Some(self.start.elapsed());
            }
        }
    }

    /// Asks, and if there are no answers, every ray alone. Returns the number of mishaps; a hang counts as the most.
    fn ask(&mut self, question: Question, family: &Family) -> usize {
        let Err(mishap) = self.answer(&question, family) else { return 0 };
        let hangs = matches!(mishap, Mishap::Hung(_));
        let (most, begun) = (if hangs { 1 } else { MOST_MISHAPS }, Instant::now());
        let rays = question.rays.len();
        let alone = (0..rays).map(|ray| part(&question, ray..ray + 1));
        let without_answer = alone.filter_map(|one| {
            let mishap = self.answer(&one, family).err();
            mishap.map(|mishap| (one, mishap))
        });
        let mut found: Vec<_> = without_answer.take(most).collect();
        if found.is_empty() {
            // Alone they take as long, so it is slow.
            if hangs && begun.elapsed() >= self.trial.patience / 2 {
                self.at_once = (rays / FEWER).max(1);
                return 0;
            }
            found.push((question, mishap));
        }
        let mishaps = if hangs { MOST_MISHAPS } else { found.len() };
        for (Question { spheres, rays, .. }, mishap) in found {
            let ray = rays.first().copied().unwrap_or(Ray::INACTIVE);
            self.report.unanswered.push(Unanswered { family: *family, mishap, ray, spheres });
        }
        self.report.first.get_or_insert_with(|| self.start.elapsed());
        mishaps
    }

    fn answer(&mut self, question: &Question, family: &Family) -> Result<(), Mishap> {
        let answers = self.watched.ask(question)?;
        let families = vec![family.number; answers.len()];
        judged(&mut self.report.judge, question, &answers, &families);
        Ok(())
    }
}

/// Judges the answers to a question.
fn judged(judge: &mut Judge, question: &Question, answers: &[Option<Answer>], families: &[u8]) {
    let Question { spheres, rays, pairs } = question;
    if *pairs {
        judge.pairs(rays, spheres, answers, families);
    } else {
        judge.shared(&Shared::new(spheres), rays, answers, families);
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

/// Some rays of a question.
fn part(question: &Question, some: Range<usize>) -> Question {
    let Question { spheres, rays, pairs } = question;
    let spheres = if *pairs { spheres[some.clone()].to_vec() } else { spheres.clone() };
    Question { spheres, rays: rays[some].to_vec(), pairs: *pairs }
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
    judged(&mut judge, &question, &answers, &[]);
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
