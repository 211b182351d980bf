//! Answers compared with the truth: counts of wrong decisions, and the error of t in ulp.

/// What is wrong with an answer, from nothing to the worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Both miss: right, and nothing to see.
    Miss,
    /// The same sphere at the same t, bit for bit.
    Right,
    /// The same sphere, and t is off by at least two to this power in ulp, but less than twice as much.
    Off(u8),
    /// The same sphere, and t nearer to the other root of the line.
    OtherRoot,
    /// A miss that is a hit in truth.
    LostHit,
    /// A hit that is a miss in truth.
    FalseHit,
    /// Another sphere than the one that is hit first in truth.
    OtherSphere,
}

impl Class {
    /// Returns the class of the t of an answer against the true t, and how far it is off in ulp if both hit. `elsewhere` says that they hit
    /// different spheres. Only a [verdict](crate::compare::verdict::Verdict) can tell which root it is.
    #[must_use]
    pub fn of(answer: Option<f32>, truth: Option<f32>, elsewhere: bool) -> (Self, u64) {
        match (answer, truth) {
            (None, None) => (Self::Miss, 0),
            (Some(_), None) => (Self::FalseHit, 0),
            (None, Some(_)) => (Self::LostHit, 0),
            (Some(_), Some(_)) if elsewhere => (Self::OtherSphere, 0),
            (Some(answer), Some(truth)) => {
                let ulp = ulp_between(answer, truth);
                (ulp.checked_ilog2().map_or(Self::Right, |log| Self::Off(log as u8)), ulp)
            }
        }
    }
}

/// Answers against the truth, ray by ray.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    counts: Summary,
    /// The error of every right hit.
    ulp: Vec<u64>,
}

/// The result of a [`Tally`], in rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// All rays.
    pub rays: u64,
    /// Rays that hit in truth.
    pub hits: u64,
    /// Hits that are misses in truth.
    pub wrong_hits: u64,
    /// Misses that are hits in truth.
    pub wrong_misses: u64,
    /// Hits at another place than the true one: of another sphere, or at the other root of the same.
    pub wrong_places: u64,
    /// Right hits whose t has the bits of the true one.
    pub rounded: u64,
    /// The error of t of the right hits; `None` if there are none.
    pub ulp: Option<Ulp>,
}

/// Quantiles of errors in ulp, each an error that occurred.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ulp {
    /// Half of the errors do not exceed it.
    pub median: u64,
    /// 999 of 1000 errors do not exceed it.
    pub p999: u64,
    /// The largest error.
    pub max: u64,
}

impl Tally {
    /// Adds one ray: the t of the answer, the t of the truth and, if both hit, whether they hit different places: different spheres, or
    /// different roots of one.
    pub fn record(&mut self, answer: Option<f32>, truth: Option<f32>, elsewhere: bool) {
        let counts = &mut self.counts;
        counts.rays += 1;
        counts.hits += u64::from(truth.is_some());
        match Class::of(answer, truth, elsewhere) {
            (Class::Miss, _) => {}
            (Class::FalseHit, _) => counts.wrong_hits += 1,
            (Class::LostHit, _) => counts.wrong_misses += 1,
            (Class::OtherSphere, _) => counts.wrong_places += 1,
            (Class::Right | Class::Off(_) | Class::OtherRoot, ulp) => {
                // Zeros of either sign are one place, but have different bits.
                let same = answer.map(f32::to_bits) == truth.map(f32::to_bits);
                counts.rounded += u64::from(same);
                self.ulp.push(ulp);
            }
        }
    }

    /// Counts and quantiles of the rays so far.
    #[must_use]
    pub fn summary(&self) -> Summary {
        let mut errors = self.ulp.clone();
        errors.sort_unstable();
        // The least error that so many thousandths of all errors do not exceed.
        let quantile = |thousandths: usize| {
            errors[(errors.len() * thousandths).div_ceil(1000).saturating_sub(1)]
        };
        let ulp = (!errors.is_empty()).then(|| Ulp {
            median: quantile(500),
            p999: quantile(999),
            max: quantile(1000),
        });
        Summary { ulp, ..self.counts }
    }
}

/// How many `f32` steps apart two numbers are, across zero too; zeros of either sign are one place.
#[must_use]
pub const fn ulp_between(a: f32, b: f32) -> u64 {
    const fn place(x: f32) -> i64 {
        let magnitude = (x.to_bits() & 0x7fff_ffff) as i64;
        if x.is_sign_negative() { -magnitude } else { magnitude }
    }
    place(a).abs_diff(place(b))
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
            (1.0_f32.next_down(), 1.0_f32.next_up(), 2),
            (0.0, -0.0, 0),
            (0.0, tiny, 1),
            (-tiny, tiny, 2),
            (f32::MIN_POSITIVE, f32::from_bits(0x007f_ffff), 1),
            (f32::MAX, f32::INFINITY, 1),
            (1.0, 2.0, 1 << 23),
            (-1.0, 1.0, 2 * 0x3f80_0000),
        ] {
            assert_eq!(ulp_between(a, b), apart, "{a:e} {b:e}");
            assert_eq!(ulp_between(b, a), apart, "{b:e} {a:e}");
        }
    }

    #[test]
    fn wrong_decisions_are_counted_by_their_kind() {
        let mut tally = Tally::default();
        for (answer, truth, elsewhere) in [
            (None, None, false),
            (Some(1.0), None, false),
            (None, Some(1.0), false),
            (Some(1.0), Some(1.0), true),
            (Some(1.0), Some(1.0), false),
            (Some(1.0_f32.next_up()), Some(1.0), false),
        ] {
            tally.record(answer, truth, elsewhere);
        }
        let expected = Summary {
            rays: 6,
            hits: 4,
            wrong_hits: 1,
            wrong_misses: 1,
            wrong_places: 1,
            rounded: 1,
            ulp: Some(Ulp { median: 0, p999: 1, max: 1 }),
        };
        assert_eq!(tally.summary(), expected);
    }

    #[test]
    fn quantiles_are_errors_that_occurred() {
        let ulp = |count: u32| {
            let mut tally = Tally::default();
            for error in 0..count {
                tally.record(Some(f32::from_bits(1.0_f32.to_bits() + error)), Some(1.0), false);
            }
            tally.summary().ulp
        };
        assert_eq!(ulp(0), None);
        assert_eq!(ulp(1), Some(Ulp::default()));
        assert_eq!(ulp(2000), Some(Ulp { median: 999, p999: 1997, max: 1999 }));
    }
}
