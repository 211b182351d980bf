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
        Self { rules, maps_places, scores, failures: Failures::default(), rows: 0 }
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
        let truths = self.truths(|rules, truths| truth::of_pairs(rules, rays, spheres, truths));
        for (index, (ray, answer)) in rays.iter().zip(answers).enumerate() {
            let sphere = &spheres[index];
            let judged = Judged {
                ray,
                spheres: std::slice::from_ref(sphere),
                truths: truths[index],
                answer: *answer,
                covered: self.rules.cover_ray(ray) && self.rules.cover_sphere(sphere),
                family: families.get(index).copied(),
            };
            self.row(&judged, None);
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
        let truths = self.truths(|rules, truths| shared.truths(rules, rays, truths));
        let (rules, spheres) = (self.rules, shared.spheres());
        let all_covered =
            rules.covers_all() || spheres.iter().all(|sphere| rules.cover_sphere(sphere));
        for (index, (ray, answer)) in rays.iter().zip(answers).enumerate() {
            let judged = Judged {
                ray,
                spheres,
                truths: truths[index],
                answer: *answer,
                covered: all_covered && rules.cover_ray(ray),
                family: families.get(index).copied(),
            };
            self.row(&judged, Some(shared));
        }
    }

    /// For each ray the truth under the rules, then that under the contract; `under` overwrites a list with the truths under some rules.
    fn truths(&self, under: impl Fn(&Rules, &mut Vec<Truth>)) -> Vec<[Truth; 2]> {
        assert!(
            float_environment_is_sound(),
            "this thread does not round to nearest, or takes subnormals for zero: truths would be wrong"
        );
        let mut by_contract = Vec::new();
        under(&Rules::CONTRACT, &mut by_contract);
        let mut by_rules = by_contract.clone();
        if !self.rules.closed_as_contract() {
            under(&self.rules, &mut by_rules);
        }
        by_rules.into_iter().zip(by_contract).map(Into::into).collect()
    }

    /// Judges one ray; `shared` knows which spheres are as close as others, if there are others.
    fn row(&mut self, judged: &Judged<'_>, shared: Option<&Shared<'_>>) {
        let row = self.rows;
        self.rows += 1;
        let Judged { ray, spheres, truths: [truth, contract], answer, covered, family } = *judged;
        let place = family.map(usize::from).filter(|&place| place < FAMILIES.len());
        let score = &mut self.scores[place.unwrap_or(FAMILIES.len())];
        let named = answer.and_then(|answer| answer.sphere);
        let there = |index: u32| spheres.get(index as usize);
        let only = (spheres.len() == 1).then_some(0);
        // The true sphere, else the named one, else the only one.
        let sphere_of =
            |hit: Option<Hit>| hit.map(|hit| hit.sphere).or(named).or(only).and_then(there);
        let found = |rules: &Rules, hit: Option<Hit>| {
            if named.is_some_and(|named| there(named).is_none()) {
                return Verdict::Wrong { kind: Kind::NoAnswer, severity: f64::INFINITY };
            }
            let is_as_close = |hit: Hit, named| {
                shared.is_some_and(|shared| shared.is_as_close(rules, ray, hit, named))
            };
            let is_true = hit
                .zip(named)
                .is_none_or(|(hit, named)| named == hit.sphere || is_as_close(hit, named));
            verdict(ray, sphere_of(hit), hit, answer, (is_true, rules.ulp))
        };

        // The contract promises something of every ray, and leaves none open.
        let by_contract = found(&Rules::CONTRACT, contract.hit());
        score.by_contract.add(contract.hit().is_some(), by_contract);
        if !covered {
            score.by_rules.unpromised += 1;
            return;
        }
        if truth == Truth::Open {
            score.by_rules.open += 1;
            return;
        }
        let hit = truth.hit();
        let is_contract = self.rules == Rules::CONTRACT;
        let by_rules = if is_contract { by_contract } else { found(&self.rules, hit) };
        score.by_rules.add(hit.is_some(), by_rules);
        if self.maps_places
            && let Some(sphere) = sphere_of(hit)
        {
            let [judged, wrong] = &mut score.places[place_of(margin(ray, sphere))];
            let is_wrong = matches!(by_rules, Verdict::Wrong { kind, .. } if kind != Kind::T);
            (*judged, *wrong) = (*judged + 1, *wrong + u64::from(is_wrong));
        }
        if let Verdict::Wrong { kind, severity } = by_rules {
            let new = NewFailure { kind, severity, ray, spheres, answer, truth: hit, family, row };
            self.failures.add(&new);
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
        self.failures.worst[kind as usize].as_ref()
    }

    /// The failure of a kind that has the fewest digits. For t, only answers that are plainly off count, if there are any.
    #[must_use]
    pub fn simplest(&self, kind: Kind) -> Option<&Failure> {
        self.failures.simplest[kind as usize].as_ref()
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

/// A ray with its spheres, its truths, under the rules and under the contract, and the answer.
struct Judged<'a> {
    ray: &'a Ray,
    spheres: &'a [Sphere],
    truths: [Truth; 2],
    answer: Option<Answer>,
    covered: bool,
    family: Option<u8>,
}

fn place_of(margin: f64) -> usize {
    let size = margin.abs();
    if size.is_nan() || size >= 1.0 {
        return 0;
    }
    // The logarithm of zero is infinite, so zero falls into the last place.
    ((-size.log2() / 2.0) as usize).min(PLACES - 1)
}
