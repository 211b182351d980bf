//! Answers to single cases, held against the oracle's by the program's own [engine](spherule::tally).

use crate::oracle;
use spherule::tally::Tally;
pub use spherule::tally::{Summary, Ulp};
use spherule_referee::aim::double;
use spherule_referee::case::Case;
use spherule_referee::middle::is_at_the_other_root;
use spherule_referee::random::{dot, power_of_two};

/// What one engine gets wrong.
#[derive(Clone, Debug, Default)]
pub struct Errors {
    tally: Tally,
    worst_place: f64,
}

impl Errors {
    /// Adds one answer: the t that was found, against the true roots of the line.
    ///
    /// A hit at the other root counts as a wrong place: the right root was taken to be behind the origin, or the wrong
    /// one before it.
    pub fn record(&mut self, case: &Case, roots: Option<[f32; 2]>, answer: Option<f32>) {
        let truth = roots.and_then(|roots| oracle::accepted(&case.ray, roots));
        let mut elsewhere = false;
        if let (Some(answer), Some(truth)) = (answer, truth) {
            let t = f64::from(answer);
            elsewhere = is_at_the_other_root(&case.ray, &case.sphere, t, truth);
            if !elsewhere {
                let error = (t - f64::from(truth)).abs();
                self.worst_place = self.worst_place.max(error / scene_unit(case));
            }
        }
        self.tally.record(answer, truth, elsewhere);
    }

    /// Counts and quantiles of the answers so far.
    #[must_use]
    pub fn summary(&self) -> Summary {
        self.tally.summary()
    }

    /// The largest error of the place of a right hit, in units of 2^-24 of the scene, rounded up. The scene is the
    /// larger of radius and distance of the centre. This says what ulp of a t next to zero cannot.
    #[must_use]
    pub fn place(&self) -> u64 {
        // A number that is too large saturates.
        self.worst_place.ceil() as u64
    }
}

/// What an engine answers in a case.
pub type Answer<'a> = &'a dyn Fn(&Case) -> Option<f32>;

/// The answers of each engine to all cases.
pub fn measure(cases: impl Iterator<Item = Case>, engines: &[Answer<'_>]) -> Vec<Errors> {
    let mut errors = vec![Errors::default(); engines.len()];
    for case in cases {
        let roots = oracle::roots(&case.ray, &case.sphere);
        for (errors, engine) in errors.iter_mut().zip(engines) {
            errors.record(&case, roots, engine(&case));
        }
    }
    errors
}

/// The difference of t for a way of 2^-24 of the scene.
fn scene_unit(case: &Case) -> f64 {
    let (o, c) = (double(case.ray.origin), double(case.sphere.center));
    let p = [c[0] - o[0], c[1] - o[1], c[2] - o[2]];
    let d = double(case.ray.direction);
    let scene = dot(p, p).sqrt().max(f64::from(case.sphere.radius));
    scene * power_of_two(-24) / dot(d, d).sqrt()
}
