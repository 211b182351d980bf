//! What a tier's answers come to when held against the oracle's.

use crate::aim::double;
use crate::case::Case;
use crate::oracle;
use crate::random::{dot, power_of_two};
use crate::ulp::distance;

/// Answers held against the truth, as they come in.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    cases: u32,
    hits: u32,
    wrong_hits: u32,
    wrong_misses: u32,
    wrong_roots: u32,
    errors: Vec<u64>,
    worst_place: f64,
}

/// What a [`Tally`] comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Summary {
    /// How many answers.
    pub cases: u32,
    /// How many of them are hits in truth.
    pub hits: u32,
    /// Hits that are misses in truth.
    pub wrong_hits: u32,
    /// Misses that are hits in truth.
    pub wrong_misses: u32,
    /// Hits at the other root of the line: the right one was taken to be behind the origin, or the
    /// wrong one before it. The errors below are those of the other hits.
    pub wrong_roots: u32,
    /// The error of t in ulp that half of the right hits do not exceed.
    pub median: u64,
    /// The error of t in ulp that 999 of 1000 right hits do not exceed.
    pub p999: u64,
    /// The largest error of t in ulp.
    pub max: u64,
    /// The largest error of the place of a hit, rounded up to a multiple of 2^-24 of the
    /// scene: of the larger of radius and distance of the centre. Says what ulp of a t next to
    /// zero do not.
    pub place: u64,
}

impl Tally {
    /// Takes in one answer: the t that was found, against the line's true roots.
    pub fn record(&mut self, case: &Case, roots: Option<[f32; 2]>, found: Option<f32>) {
        let expected = roots.and_then(|roots| oracle::accepted(&case.ray, roots));
        self.cases += 1;
        self.hits += u32::from(expected.is_some());
        match (expected, found) {
            (Some(expected), Some(found)) => {
                let away = |t: f32| (f64::from(found) - f64::from(t)).abs();
                let error = away(expected);
                if roots.is_some_and(|roots| roots.into_iter().any(|root| away(root) < error)) {
                    self.wrong_roots += 1;
                } else {
                    self.errors.push(distance(expected, found));
                    self.worst_place = self.worst_place.max(error / scene_unit(case));
                }
            }
            (Some(_), None) => self.wrong_misses += 1,
            (None, Some(_)) => self.wrong_hits += 1,
            (None, None) => {}
        }
    }

    /// Counts and quantiles so far; the errors of no right hits are zero.
    #[must_use]
    pub fn summary(&self) -> Summary {
        let mut errors = self.errors.clone();
        errors.sort_unstable();
        // The smallest error that at least `thousandths` of all do not exceed.
        let quantile = |thousandths: usize| {
            let rank = (errors.len() * thousandths).div_ceil(1000);
            rank.checked_sub(1).map_or(0, |index| errors[index])
        };
        Summary {
            cases: self.cases,
            hits: self.hits,
            wrong_hits: self.wrong_hits,
            wrong_misses: self.wrong_misses,
            wrong_roots: self.wrong_roots,
            median: quantile(500),
            p999: quantile(999),
            max: quantile(1000),
            // Too large a number saturates.
            place: self.worst_place.ceil() as u64,
        }
    }
}

/// The t on which the ray goes 2^-24 of the scene.
fn scene_unit(case: &Case) -> f64 {
    let (o, c) = (double(case.ray.origin), double(case.sphere.center));
    let p = [c[0] - o[0], c[1] - o[1], c[2] - o[2]];
    let d = double(case.ray.direction);
    let scene = dot(p, p).sqrt().max(f64::from(case.sphere.radius));
    scene * power_of_two(-24) / dot(d, d).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ulp::step;

    /// The half-line from (0, 0, -2) along (0, 0, 4).
    fn case() -> Case {
        let numbers = [0.0, 0.0, -2.0, 0.0, 0.0, 4.0, 0.0, 9.0, 0.0, 0.0, 0.0, 1.0];
        Case::from_numbers(numbers)
    }

    #[test]
    fn wrong_decisions_are_counted_by_their_kind() {
        let (mut tally, case) = (Tally::default(), case());
        tally.record(&case, None, None);
        tally.record(&case, None, Some(1.0));
        tally.record(&case, Some([-2.0, -1.0]), Some(1.0));
        tally.record(&case, Some([1.0, 2.0]), None);
        tally.record(&case, Some([1.0, 2.0]), Some(1.0));
        tally.record(&case, Some([1.0, 2.0]), Some(1.75));
        tally.record(&case, Some([-1.0, 2.0]), Some(2.0));
        tally.record(&case, Some([2.0, 2.0]), Some(2.0));
        let expected = Summary {
            cases: 8,
            hits: 5,
            wrong_hits: 2,
            wrong_misses: 1,
            wrong_roots: 1,
            median: 0,
            p999: 0,
            max: 0,
            place: 0,
        };
        assert_eq!(tally.summary(), expected);
    }

    #[test]
    fn quantiles_are_errors_that_occurred() {
        let (mut tally, case) = (Tally::default(), case());
        for error in 0..2000 {
            tally.record(&case, Some([1.0, 2.0]), Some(step(1.0, error)));
        }
        let summary = tally.summary();
        assert_eq!((summary.median, summary.p999, summary.max), (999, 1997, 1999));
        let empty = Tally::default().summary();
        assert_eq!((empty.median, empty.p999, empty.max), (0, 0, 0));
    }

    #[test]
    fn places_are_measured_in_the_scene() {
        // |p| = 2, |d| = 4: 2^-24 of the scene is 2^-25 of t.
        let (mut tally, case) = (Tally::default(), case());
        tally.record(&case, Some([0.25, 0.75]), Some(step(0.25, 1)));
        assert_eq!(tally.summary().place, 1);
        tally.record(&case, Some([0.25, 0.75]), Some(step(0.25, -12)));
        assert_eq!(tally.summary().place, 6);
        tally.record(&case, Some([0.25, 0.25]), Some(f32::MAX));
        assert_eq!(tally.summary().place, u64::MAX);
    }
}
