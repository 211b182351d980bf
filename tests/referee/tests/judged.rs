//! Judges intersectors whose faults are known.

use spherule_kernel::{Exact, Side, Tier, roots, side};
use spherule_referee::answer::Answer;
use spherule_referee::families::{FAMILIES, Family};
use spherule_referee::intersector::{Kernel, Pair};
use spherule_referee::rules::{Directions, Inside, Interval, Precision, Promise, Starts, Tangents};
use spherule_referee::verdict::Kind;
use spherule_referee::watched::Mishap;
use spherule_referee::{Intersector, Ray, Rules, Sphere, Trial, Vec3, snippet};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

fn trial() -> Trial {
    Trial { cases: 300, ..Trial::default() }
}

/// A trial of these families, in which nothing is shrunk.
fn trial_of(names: &[&str]) -> Trial {
    let families = names.iter().map(|name| Family::named(name).expect("a family")).collect();
    Trial { families, shrinking: Duration::ZERO, ..trial() }
}

#[path = "../examples/textbook.rs"]
#[allow(dead_code)]
mod textbook;

/// In double precision, by the contract's rules.
fn double(ray: &Ray, sphere: &Sphere) -> Option<f64> {
    let [o, d, c] = [ray.origin, ray.direction, sphere.center].map(|v| v.to_array().map(f64::from));
    let dot = |v: [f64; 3], w: [f64; 3]| v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
    let p = [0, 1, 2].map(|i| c[i] - o[i]);
    let r = f64::from(sphere.radius);
    let (a, b) = (dot(d, d), dot(d, p));
    let root = (b * b - a * (dot(p, p) - r * r)).sqrt();
    let ends = f64::from(ray.t_min)..=f64::from(ray.t_max);
    [(b - root) / a, (b + root) / a].into_iter().find(|t| ends.contains(t))
}

#[test]
fn exact_is_never_wrong() {
    let report = trial().run(&Kernel(Tier::Exact));
    let total = report.judge.total();
    assert_eq!((report.wrong(), total.by_contract.wrong(), report.first), (0, 0, None), "{report}");
    assert_eq!(total.by_rules.judged, 2 * 300 * FAMILIES.len() as u64);
    assert!(total.by_rules.hits * 3 > total.by_rules.judged);
    assert_eq!(total.by_rules.ulp.max(), Some(0));
}

#[test]
fn other_tiers_are_wrong_where_they_are_known_to_be() {
    for tier in [Tier::Fast, Tier::Geometric, Tier::Stable] {
        let counts = trial_of(&["far-1e4"]).run(&Kernel(tier)).judge.total().by_rules;
        let wrong = counts.of(Kind::FalseHit) + counts.of(Kind::LostHit);
        assert_eq!(wrong > 50, tier != Tier::Stable, "{tier:?}: {wrong}");
    }
}

#[test]
fn a_textbook_is_shrunk_to_what_can_be_read() {
    let report = trial().run(&Pair::new("textbook", textbook::textbook));
    println!("{report}");
    assert!(report.first.is_some_and(|first| first < Duration::from_secs(1)));
    let kinds: Vec<Kind> = report.smallest.iter().map(|failure| failure.kind).collect();
    assert!(kinds.contains(&Kind::FalseHit) && kinds.contains(&Kind::LostHit), "{kinds:?}");
    for failure in &report.smallest {
        assert_eq!(failure.spheres.len(), if failure.kind == Kind::OtherSphere { 2 } else { 1 });
        // The pasted case still fails.
        let again = textbook::textbook(&failure.ray, &failure.spheres[0]).map(f64::from);
        if failure.spheres.len() == 1 {
            let answered = failure.answer.map(|answer| answer.t);
            assert_eq!(again.map(f64::to_bits), answered.map(f64::to_bits), "{failure:?}");
        }
        assert!(
            snippet::c(failure).contains("expected") && snippet::python(failure).contains("h(")
        );
    }
}

#[test]
fn double_precision_is_judged_where_single_can_tell() {
    let double = Pair::new("double", double);
    // It cannot tell the sign of D = 0.
    let tangents = Tangents::Either;
    let rules = Rules { precision: Precision::F64, tangents, ..double.rules() };
    let trial = trial_of(&["far-1e6", "inside", "tie"]);
    let counts = trial.run(&double.with_rules(rules)).judge.total().by_rules;
    assert_eq!(counts.decided_wrong(), 0, "{counts:?}");
    assert!(counts.judged > 1000);
}

/// A rule changes what is true, and nothing else does.
#[test]
fn rules_are_kept_or_broken() {
    // A ball that rays do not see from inside, with open ends, without tangents.
    fn open(ray: &Ray, sphere: &Sphere) -> Option<f32> {
        let [near, far] = roots(Exact, ray, sphere)?;
        let smaller = Sphere { radius: sphere.radius.next_down(), ..*sphere };
        let is_tangent = near == far && roots(Exact, ray, &smaller).is_none();
        if side(ray.origin, sphere) == Some(Side::Inside) || is_tangent {
            return None;
        }
        [near, far].into_iter().find(|t| ray.t_min < *t && *t < ray.t_max && t.is_finite())
    }
    let rules = Rules {
        interval: Interval::Open,
        tangents: Tangents::Either,
        inside: Inside::Miss,
        ..Pair::new("open", open).rules()
    };
    let trial =
        trial_of(&["ordinary", "tangent", "inside", "on-surface", "interval-at-root", "outside"]);
    let total = trial.run(&Pair::new("open", open).with_rules(rules)).judge.total();
    assert_eq!(total.by_rules.decided_wrong(), 0, "{:?}", total.by_rules);
    assert!(total.by_rules.open > 300 && total.by_contract.of(Kind::LostHit) > 500);
    let total = trial.run(&Pair::new("open", open)).judge.total();
    assert!(total.by_rules.of(Kind::LostHit) > 500);
}

#[test]
fn what_is_not_promised_is_not_judged() {
    let rules = Rules {
        invalid: Promise::None,
        starts: Starts::NotBehind,
        largest: 1e18,
        ..Rules::CONTRACT
    };
    let textbook = Pair::new("textbook", textbook::textbook).with_rules(rules);
    let total = trial_of(&["overflow", "degenerate"]).run(&textbook).judge.total();
    assert!(total.by_rules.unpromised > 600, "{total:?}");
    assert_eq!(
        total.by_rules.judged + total.by_rules.open + total.by_rules.unpromised,
        total.by_contract.judged
    );
}

#[test]
fn rules_that_want_unit_directions_get_them() {
    let exact = |ray: &Ray, sphere: &Sphere| {
        let roots = roots(Exact, ray, sphere)?;
        roots.into_iter().find(|t| t.is_finite() && ray.t_min <= *t && *t <= ray.t_max)
    };
    let exact = Pair::new("exact", exact);
    let rules = Rules { directions: Directions::Unit, ..exact.rules() };
    let report = trial_of(&["far-1e4", "interval-at-root"]).run(&exact.with_rules(rules));
    // In pairs and in scenes.
    assert_eq!(report.judge.scores().count(), 2);
    for (family, score) in report.judge.scores() {
        let counts = &score.by_rules;
        assert!(counts.judged > 590 && counts.wrong() == 0, "{family:?}: {counts:?}");
    }
}

/// Panics at some rays, hangs at others, answers too few.
#[derive(Clone)]
struct Faulty(Fault);

#[derive(Clone, Copy, PartialEq)]
enum Fault {
    Panics,
    Hangs,
    AnswersTooFew,
    AnswersNonsense,
}

impl Intersector for Faulty {
    fn name(&self) -> &str {
        "faulty"
    }

    fn closest_hits(&mut self, spheres: &[Sphere], rays: &[Ray]) -> Vec<Option<Answer>> {
        let fails = rays.iter().any(|ray| ray.direction == Vec3::ZERO);
        let mut answers = Kernel(Tier::Exact).closest_hits(spheres, rays);
        match self.0 {
            Fault::Panics if fails => panic!("a zero direction"),
            Fault::Hangs if fails => std::thread::sleep(Duration::from_secs(3600)),
            Fault::AnswersTooFew if fails => drop(answers.pop()),
            Fault::AnswersNonsense if fails => {
                answers[0] = Some(Answer { t: f64::NAN, sphere: Some(9) });
            }
            _ => {}
        }
        answers
    }
}

#[test]
fn mishaps_are_reported_and_the_trial_goes_on() {
    for (fault, expected) in [
        (Fault::Panics, Mishap::Panicked("a zero direction".to_owned())),
        (Fault::Hangs, Mishap::Hung(Duration::from_millis(300))),
        (Fault::AnswersTooFew, Mishap::Count { answers: 0, rays: 1 }),
    ] {
        let trial = trial_of(&["degenerate", "ordinary"]);
        let patience = Duration::from_millis(300);
        let report = Trial { cases: 40, patience, ..trial }.run(&Faulty(fault));
        let first = report.unanswered.first().expect("a mishap");
        assert_eq!((&first.mishap, first.spheres.len()), (&expected, 1));
        assert_eq!(first.ray.direction, Vec3::ZERO);
        assert!(report.unanswered.iter().all(|unanswered| unanswered.family.name == "degenerate"));
        // All of the other family is judged, and nothing is wrong.
        let ordinary =
            report.judge.scores().find(|(number, _)| *number == Some(0)).expect("scores").1;
        assert_eq!((ordinary.by_rules.judged, report.judge.total().by_rules.wrong()), (80, 0));
    }
}

#[test]
fn nonsense_is_no_answer() {
    let shrinking = Duration::from_secs(5);
    let trial = Trial { cases: 40, shrinking, ..trial_of(&["degenerate"]) };
    let report = trial.run(&Faulty(Fault::AnswersNonsense));
    assert!(report.judge.total().by_rules.of(Kind::NoAnswer) > 0);
    assert_eq!(report.smallest.len(), 1);
}

/// Takes some time for every call, and may see nothing.
#[derive(Clone)]
struct Slow {
    time: Duration,
    is_blind: bool,
    calls: Arc<AtomicU32>,
}

impl Slow {
    fn new(time: Duration, is_blind: bool) -> Self {
        Self { time, is_blind, calls: Arc::default() }
    }
}

impl Intersector for Slow {
    fn name(&self) -> &str {
        "slow"
    }

    fn closest_hits(&mut self, spheres: &[Sphere], rays: &[Ray]) -> Vec<Option<Answer>> {
        self.calls.fetch_add(1, Ordering::Relaxed);
        std::thread::sleep(self.time);
        if self.is_blind {
            return vec![None; rays.len()];
        }
        Kernel(Tier::Exact).closest_hits(spheres, rays)
    }
}

#[test]
fn who_is_slow_does_not_hang() {
    let patience = Duration::from_millis(500);
    let trial = Trial { cases: 1300, scenes: false, patience, ..trial_of(&["ordinary"]) };
    let report = trial.run(&Slow::new(patience / 500, false));
    assert!(report.unanswered.is_empty(), "{:?}", report.unanswered);
    assert_eq!(report.judge.total().by_rules.judged, 1300);
}

#[test]
fn a_slow_intersector_is_shrunk_no_longer_than_others() {
    let slow = Slow::new(Duration::from_millis(10), true);
    let shrinking = Duration::from_millis(100);
    let trial = Trial { cases: 20, scenes: false, shrinking, ..trial_of(&["ordinary"]) };
    let report = trial.run(&slow);
    assert_eq!(report.smallest.len(), 1);
    // A call a case, then those that the time allows.
    let calls = slow.calls.load(Ordering::Relaxed);
    assert!(calls <= 20 + 10, "{calls} calls");
}
