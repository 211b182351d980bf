//! Distance in ulp, and what a tier's answers come to when held against the oracle's.

/// The place of `x` among all `f32`: neighbours are one apart, both zeros are 0, infinities come
/// after the largest numbers, NaN beyond.
#[must_use]
pub const fn ordered(x: f32) -> i64 {
    let magnitude = (x.to_bits() & 0x7fff_ffff) as i64;
    if x.is_sign_negative() { -magnitude } else { magnitude }
}

/// How many `f32` steps apart `a` and `b` are, across zero too.
#[must_use]
pub const fn distance(a: f32, b: f32) -> u64 {
    ordered(a).abs_diff(ordered(b))
}

/// The number `steps` places up (or down) from `x`; no further than the infinities. Never `-0`.
#[must_use]
pub fn step(x: f32, steps: i64) -> f32 {
    let infinity = ordered(f32::INFINITY);
    let place = ordered(x).saturating_add(steps).clamp(-infinity, infinity);
    let magnitude = f32::from_bits(u32::try_from(place.abs()).expect("at most infinity"));
    if place < 0 { -magnitude } else { magnitude }
}

/// Answers held against the truth, as they come in.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    cases: u32,
    hits: u32,
    wrong_hits: u32,
    wrong_misses: u32,
    errors: Vec<u64>,
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
    /// The error of t in ulp that half of the right hits do not exceed.
    pub median: u64,
    /// The error of t in ulp that 999 of 1000 right hits do not exceed.
    pub p999: u64,
    /// The largest error of t in ulp.
    pub max: u64,
}

impl Tally {
    /// Takes in one answer: the t that was found, against the true one.
    pub fn record(&mut self, expected: Option<f32>, found: Option<f32>) {
        self.cases += 1;
        self.hits += u32::from(expected.is_some());
        match (expected, found) {
            (Some(expected), Some(found)) => self.errors.push(distance(expected, found)),
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
            median: quantile(500),
            p999: quantile(999),
            max: quantile(1000),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_one_apart() {
        let tiny = f32::from_bits(1);
        for (a, b, apart) in [
            (1.0, 1.0, 0),
            (1.0, 1.0 + f32::EPSILON, 1),
            (1.0, 1.0 - f32::EPSILON / 2.0, 1),
            (0.0, -0.0, 0),
            (0.0, tiny, 1),
            (-tiny, tiny, 2),
            (f32::MIN_POSITIVE, f32::from_bits(0x007f_ffff), 1),
            (f32::MAX, f32::INFINITY, 1),
            (1.0, 2.0, 1 << 23),
            (-1.0, 1.0, 2 * 0x3f80_0000),
        ] {
            assert_eq!(distance(a, b), apart, "{a:e} {b:e}");
            assert_eq!(distance(b, a), apart, "{b:e} {a:e}");
        }
    }

    #[test]
    fn steps_are_the_neighbours_of_the_standard_library() {
        for x in [1.0, -1.0, 0.0, f32::MIN_POSITIVE, -f32::from_bits(1), f32::MAX, 0.1] {
            assert_eq!(step(x, 1), x.next_up());
            assert_eq!(step(x, -1), x.next_down());
            assert_eq!(step(step(x, 5), -5), if x == f32::MAX { step(x, -4) } else { x });
        }
        assert_eq!(step(f32::MAX, 7), f32::INFINITY);
        assert!(step(f32::from_bits(1), -1).is_sign_positive());
    }

    #[test]
    fn wrong_decisions_are_counted_by_their_kind() {
        let mut tally = Tally::default();
        tally.record(None, None);
        tally.record(None, Some(1.0));
        tally.record(None, Some(1.0));
        tally.record(Some(1.0), None);
        tally.record(Some(1.0), Some(1.0));
        let expected = Summary {
            cases: 5,
            hits: 2,
            wrong_hits: 2,
            wrong_misses: 1,
            median: 0,
            p999: 0,
            max: 0,
        };
        assert_eq!(tally.summary(), expected);
    }

    #[test]
    fn quantiles_are_errors_that_occurred() {
        let mut tally = Tally::default();
        for error in 0..2000 {
            tally.record(Some(1.0), Some(step(1.0, error)));
        }
        let summary = tally.summary();
        assert_eq!((summary.median, summary.p999, summary.max), (999, 1997, 1999));
        let empty = Tally::default().summary();
        assert_eq!((empty.median, empty.p999, empty.max), (0, 0, 0));
    }
}
