//! How many answers are right and wrong, in memory that does not grow with their number.

use crate::verdict::{Kind, Verdict};

/// The counts of many answers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Rays that were judged.
    pub judged: u64,
    /// Rays about which the rules promise nothing.
    pub unpromised: u64,
    /// Rays that the rules leave open.
    pub open: u64,
    /// Judged rays that hit in truth.
    pub hits: u64,
    /// Wrong answers, in the order of [`Kind::ALL`].
    wrong: [u64; Kind::ALL.len()],
    /// By how many ulp t is off, where the right root was found.
    pub ulp: Steps,
}

impl Counts {
    /// Adds a verdict, and whether the ray hits in truth.
    pub fn add(&mut self, hits: bool, verdict: Verdict) {
        self.judged += 1;
        self.hits += u64::from(hits);
        match verdict {
            Verdict::Right { ulp } => {
                if let Some(ulp) = ulp {
                    self.ulp.add(ulp);
                }
            }
            Verdict::Wrong { kind, severity } => {
                self.wrong[kind as usize] += 1;
                if kind == Kind::T {
                    self.ulp.add(severity as u64);
                }
            }
        }
    }

    /// Adds those of others.
    pub fn add_all(&mut self, others: &Self) {
        self.judged += others.judged;
        self.unpromised += others.unpromised;
        self.open += others.open;
        self.hits += others.hits;
        for (sum, wrong) in self.wrong.iter_mut().zip(others.wrong) {
            *sum += wrong;
        }
        self.ulp.add_all(&others.ulp);
    }

    /// How many are wrong in this way.
    #[must_use]
    pub fn of(&self, kind: Kind) -> u64 {
        self.wrong[kind as usize]
    }

    /// How many decisions are wrong: every kind of wrong answer except an inexact t.
    #[must_use]
    pub fn decided_wrong(&self) -> u64 {
        self.wrong.iter().sum::<u64>() - self.of(Kind::T)
    }

    /// How many answers are wrong in any way.
    #[must_use]
    pub fn wrong(&self) -> u64 {
        self.wrong.iter().sum()
    }
}

/// Numbers up to this are counted one by one; larger ones in bins of a 32nd of a power of two.
const EACH: u64 = 64;

/// Counts of whole numbers, for quantiles.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Steps {
    bins: Vec<u64>,
    count: u64,
    max: u64,
}

impl Steps {
    /// Adds one number.
    pub fn add(&mut self, number: u64) {
        let bin = if number < EACH {
            number
        } else {
            let exponent = u64::from(number.ilog2());
            EACH + (exponent - 6) * 32 + (number >> (exponent - 5) & 31)
        } as usize;
        if self.bins.len() <= bin {
            self.bins.resize(bin + 1, 0);
        }
        self.bins[bin] += 1;
        self.count += 1;
        self.max = self.max.max(number);
    }

    fn add_all(&mut self, others: &Self) {
        if self.bins.len() < others.bins.len() {
            self.bins.resize(others.bins.len(), 0);
        }
        for (sum, count) in self.bins.iter_mut().zip(&others.bins) {
            *sum += count;
        }
        self.count += others.count;
        self.max = self.max.max(others.max);
    }

    /// The largest number; `None` if there is none.
    #[must_use]
    pub fn max(&self) -> Option<u64> {
        (self.count > 0).then_some(self.max)
    }

    /// What so many thousandths of all numbers do not exceed: exact below 64, else up to a 32nd too large. `None` of
    /// none.
    #[must_use]
    pub fn quantile(&self, thousandths: u64) -> Option<u64> {
        let mut left = (u128::from(self.count) * u128::from(thousandths)).div_ceil(1000).max(1);
        for (bin, count) in (0..).zip(&self.bins) {
            if u128::from(*count) >= left {
                return Some(last_of(bin).min(self.max));
            }
            left -= u128::from(*count);
        }
        None
    }
}

/// The largest number of a bin.
fn last_of(bin: u64) -> u64 {
    if bin < EACH {
        return bin;
    }
    let (exponent, part) = (6 + (bin - EACH) / 32, (bin - EACH) % 32);
    ((33 + part) << (exponent - 5)) - 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn quantiles_are_those_of_a_sorted_list() {
        let mut random = Random::seeded(1);
        let mut numbers: Vec<u64> = (0..9999).map(|_| random.log_uniform(-1, 31) as u64).collect();
        let mut steps = Steps::default();
        numbers.iter().for_each(|&number| steps.add(number));
        numbers.sort_unstable();
        for thousandths in [1, 250, 500, 900, 999, 1000] {
            let exact = numbers[(numbers.len() * thousandths).div_ceil(1000) - 1];
            let found = steps.quantile(thousandths as u64).expect("numbers");
            assert!(
                exact <= found && found <= exact + exact / 32,
                "{thousandths}: {found}, {exact}"
            );
            assert!(exact >= EACH || found == exact);
        }
        assert_eq!(steps.max(), numbers.last().copied());
        assert_eq!(Steps::default().quantile(500), None);
    }

    #[test]
    fn sums_are_those_of_all() {
        let (mut one, mut other, mut all) =
            (Counts::default(), Counts::default(), Counts::default());
        for ulp in [0, 3, 70, 1 << 20] {
            one.add(true, Verdict::Right { ulp: Some(ulp) });
            all.add(true, Verdict::Right { ulp: Some(ulp) });
        }
        for kind in Kind::ALL {
            other.add(false, Verdict::Wrong { kind, severity: 5e8 });
            all.add(false, Verdict::Wrong { kind, severity: 5e8 });
        }
        one.add_all(&other);
        assert_eq!(one, all);
        assert_eq!((all.judged, all.hits, all.wrong(), all.decided_wrong()), (10, 4, 6, 5));
    }
}
