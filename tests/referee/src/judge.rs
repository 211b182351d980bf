//! Answers against the truth, ray by ray, under an intersector's own rules and under the contract.
//!
//! Rays may come in any number, since only counts are kept, and the worst and the simplest failure of each kind.

use crate::answer::Answer;
use crate::counts::Counts;
use crate::failure::{Failure, Failures, NewFailure};
use crate::families::FAMILIES;
use crate::rules::Rules;
use crate::truth::{self, Shared, Truth};
use crate::verdict::{Kind, Verdict, margin, verdict};
use spherule_kernel::{Hit, Ray, Sphere, float_environment_is_sound};

/// How many bins [`Score::places`] has: powers of two of how near to a tangent the line passes.
pub const PLACES: usize = 26;

/// The counts of the answers of one family.
#[derive(Clone, Debug, Default)]
pub struct Score {
    /// Under the rules of the intersector.
    pub by_rules: Counts,
    /// Under the contract.
    pub by_contract: Counts,
    /// Judged rays and wrong decisions under the rules, by how near to a tangent the line passes: place i counts lines with |D| / (a r^2)
    /// from 4^-i to 4^-(i + 1). The last place counts all nearer lines too, and the first all other lines. A ray that
    /// misses several spheres has no place unless the answer names one.
    pub places: [[u64; 2]; PLACES],
}

/// A judge, and what it has seen.
#[derive(Clone, Debug)]
pub struct Judge {
    rules: Rules,
    maps_places: bool,
    scores: Vec<Score>,
    failures: Failures,
    rows: u64,
}

impl Judge {
    /// A judge under these rules. If `maps_places`, it keeps [`Score::places`], which costs some 30 ns a ray.
    #[must_use]
    pub fn new(rules: Rules, maps_places: bool) -> Self {
        let scores = vec![Score::default(); FAMILIES.len() + 1];
        Self { rules, maps_places, scores, failures: Failures::NONE, rows: 0 }
    }

    /// Judges the answers to `rays[i]` against `spheres[i]` alone, whose index is 0.
    ///
    /// `families[i]` is the family of ray i, which is unknown if the slice is shorter.
    ///
    /// # Panics
    /// If this thread's floats are not what `Exact` needs, as [`float_environment_is_sound`] tells: truths would be wrong.
    pub fn pairs(
        &mut self,
        rays: &[Ray],
        spheres: &[Sphere],
        answers: &[Option<Answer>],
        families: &[u8],
    ) {
        assert_sound_floats();
        let (mut by_rules, mut by_contract) = (Vec::new(), Vec::new());
        truth::of_pairs(&Rules::CONTRACT, rays, spheres, &mut by_contract);
        let same = self.rules.closed_as_contract();
        if !same {
            truth::of_pairs(&self.rules, rays, spheres, &mut by_rules);
        }
        for (index, (ray, answer)) in rays.iter().zip(answers).enumerate() {
            let sphere = &spheres[index];
            let truths =
                [if same { by_contract[index] } else { by_rules[index] }, by_contract[index]];
            let covered = self.rules.cover_ray(ray) && self.rules.cover_sphere(sphere);
            let judged = Judged { ray, truths, answer: *answer, covered };
            let spheres = std::slice::from_ref(sphere);
            let is_there = |answered: u32| answered == 0;
            self.row(&judged, spheres, families.get(index).copied(), |_, _, answered| {
                is_there(answered)
            });
        }
    }

    /// Judges the answers to rays that share their spheres. If the rules do not cover one of the spheres, they promise nothing of any ray.
    ///
    /// # Panics
    /// As [`Judge::pairs`] does.
    pub fn shared(
        &mut self,
        shared: &Shared<'_>,
        rays: &[Ray],
        answers: &[Option<Answer>],
        families: &[u8],
    ) {
        assert_sound_floats();
        let (mut by_rules, mut by_contract) = (Vec::new(), Vec::new());
        shared.truths(&Rules::CONTRACT, rays, &mut by_contract);
        let same = self.rules.closed_as_contract();
        if !same {
            shared.truths(&self.rules, rays, &mut by_rules);
        }
        let rules = self.rules;
        let all_covered =
            rules.covers_all() || shared.spheres().iter().all(|sphere| rules.cover_sphere(sphere));
        for (index, (ray, answer)) in rays.iter().zip(answers).enumerate() {
            let truths =
                [if same { by_contract[index] } else { by_rules[index] }, by_contract[index]];
            let covered = all_covered && rules.cover_ray(ray);
            let judged = Judged { ray, truths, answer: *answer, covered };
            let family = families.get(index).copied();
            self.row(&judged, shared.spheres(), family, |rules, truth, answered| {
                shared.is_as_close(rules, ray, truth, answered)
            });
        }
    }

    fn row(
        &mut self,
        judged: &Judged<'_>,
        spheres: &[Sphere],
        family: Option<u8>,
        is_as_close: impl Fn(&Rules, Hit, u32) -> bool,
    ) {
        let row = self.rows;
        self.rows += 1;
        let place = family.map(usize::from).filter(|&place| place < FAMILIES.len());
        let score = &mut self.scores[place.unwrap_or(FAMILIES.len())];
        let Judged { ray, truths, answer, covered } = *judged;
        let rules = [self.rules, Rules::CONTRACT];
        let named = answer.and_then(|answer| answer.sphere);
        let there = |index: u32| spheres.get(index as usize);
        let only = (spheres.len() == 1).then_some(0);
        // If the rules are the contract, there is one verdict; it is counted under both.
        let count_of_rules = if rules[0] == rules[1] { 1 } else { 2 };
        for (which, (rules, truth)) in rules.iter().zip(truths).take(count_of_rules).enumerate() {
            let counts = if which == 0 { &mut score.by_rules } else { &mut score.by_contract };
            if which == 0 && !covered {
                counts.unpromised += 1;
                continue;
            }
            if truth == Truth::Open {
                counts.open += 1;
                continue;
            }
            let hit = truth.hit();
            let found = if named.is_some_and(|named| there(named).is_none()) {
                Verdict::Wrong { kind: Kind::NoAnswer, severity: f64::INFINITY }
            } else {
                let sphere = hit.map(|hit| hit.sphere).or(named).and_then(there);
                let sphere = sphere.or(only.and_then(there));
                let is_true = hit.is_none_or(|hit| {
                    named.is_none_or(|named| named == hit.sphere || is_as_close(rules, hit, named))
                });
                verdict(ray, sphere, hit, answer, (is_true, rules.ulp))
            };
            counts.add(hit.is_some(), found);
            if which == 1 {
                continue;
            }
            let is_contract = *rules == Rules::CONTRACT;
            if is_contract {
                score.by_contract.add(hit.is_some(), found);
            }
            if self.maps_places
                && let Some(sphere) = hit.map(|hit| hit.sphere).or(named).or(only).and_then(there)
            {
                let place = place_of(margin(ray, sphere));
                score.places[place][0] += 1;
                let decided_wrong = |kind| kind != Kind::T;
                let is_wrong = matches!(found, Verdict::Wrong { kind, .. } if decided_wrong(kind));
                score.places[place][1] += u64::from(is_wrong);
            }
            let Verdict::Wrong { kind, severity } = found else { continue };
            self.failures.add(&NewFailure {
                kind,
                severity,
                ray,
                spheres,
                answer,
                truth: hit,
                family,
                row,
            });
        }
    }

    /// The rules.
    #[must_use]
    pub fn rules(&self) -> &Rules {
        &self.rules
    }

    /// The families of which there were rays, by number; last, the rays of unknown family.
    pub fn scores(&self) -> impl Iterator<Item = (Option<u8>, &Score)> {
        let number = |place: usize| (place < FAMILIES.len()).then_some(place as u8);
        let seen = |score: &Score| score.by_contract.judged + score.by_rules.unpromised > 0;
        let all = self.scores.iter().enumerate();
        all.filter(move |(_, score)| seen(score)).map(move |(place, score)| (number(place), score))
    }

    /// All families together.
    #[must_use]
    pub fn total(&self) -> Score {
        let mut total = Score::default();
        for (_, score) in self.scores() {
            total.by_rules.add_all(&score.by_rules);
            total.by_contract.add_all(&score.by_contract);
            for (sum, place) in total.places.iter_mut().zip(score.places) {
                *sum = [sum[0] + place[0], sum[1] + place[1]];
            }
        }
        total
    }

    /// The worst failure of a kind.
    #[must_use]
    pub fn worst(&self, kind: Kind) -> Option<&Failure> {
        self.failures.worst(kind)
    }

    /// The failure of a kind that has the fewest digits. For t, only answers that are plainly off count, if there are any.
    #[must_use]
    pub fn simplest(&self, kind: Kind) -> Option<&Failure> {
        self.failures.simplest(kind)
    }
}

impl Rules {
    /// Whether truths under these rules are those under the contract.
    fn closed_as_contract(&self) -> bool {
        self.follow_from_roots() && self.interval == Rules::CONTRACT.interval
    }

    /// Whether every sphere is covered.
    fn covers_all(&self) -> bool {
        let Self { invalid, smallest, largest, .. } = Rules::CONTRACT;
        (self.invalid, self.smallest, self.largest) == (invalid, smallest, largest)
    }
}

/// A ray with its truths, under the rules and under the contract, and the answer.
struct Judged<'a> {
    ray: &'a Ray,
    truths: [Truth; 2],
    answer: Option<Answer>,
    covered: bool,
}

fn assert_sound_floats() {
    assert!(
        float_environment_is_sound(),
        "this thread does not round to nearest, or takes subnormals for zero: truths would be wrong"
    );
}

fn place_of(margin: f64) -> usize {
    let size = margin.abs();
    if size.is_nan() || size >= 1.0 {
        return 0;
    }
    // The logarithm of zero is infinite, so zero falls into the last place.
    ((-size.log2() / 2.0) as usize).min(PLACES - 1)
}
