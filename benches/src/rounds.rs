//! Times of several things that are to be compared, taken in turns.
//!
//! On a shared machine the clock and the neighbours change from second to second. So the time is
//! the thread's own, which stands still while others use the CPU; everything runs once a round, and what is reported is the median over the rounds, of times and of ratios
//! within a round; the quartiles beside it say how far to trust it.

use rustix::time::{ClockId, clock_gettime};
use std::ops::RangeInclusive;
use std::time::{Duration, Instant};

/// Something to time: a name, and what takes a sample of nanoseconds a unit of work.
pub struct Subject<'a> {
    name: String,
    sample: Box<dyn FnMut() -> f64 + 'a>,
}

impl core::fmt::Debug for Subject<'_> {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        formatter.debug_struct("Subject").field("name", &self.name).finish_non_exhaustive()
    }
}

impl<'a> Subject<'a> {
    /// A subject; `run` does some work, is timed, and answers how many units of work that was.
    pub fn new(name: impl Into<String>, mut run: impl FnMut() -> usize + 'a) -> Self {
        Self::timing_itself(name, move || {
            let start = busy();
            let units = run();
            (busy() - start) / units as f64
        })
    }

    /// A subject of whose work not all is to be timed; `sample` answers nanoseconds a unit.
    pub fn timing_itself(name: impl Into<String>, sample: impl FnMut() -> f64 + 'a) -> Self {
        Self { name: name.into(), sample: Box::new(sample) }
    }
}

/// Nanoseconds a unit of every subject, a round each.
#[derive(Clone, Debug)]
pub struct Samples {
    names: Vec<String>,
    by_subject: Vec<Vec<f64>>,
}

/// A median and the quartiles around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Median {
    /// The lower quartile.
    pub low: f64,
    /// The median.
    pub middle: f64,
    /// The upper quartile.
    pub high: f64,
}

/// Times every subject once a round, after one round that is thrown away.
pub fn take(subjects: &mut [Subject<'_>], rounds: usize) -> Samples {
    take_within(subjects, Duration::MAX, rounds..=rounds)
}

/// The same, with as many rounds as fit into `time`, by what the first one took, of those allowed.
pub fn take_within(
    subjects: &mut [Subject<'_>],
    time: Duration,
    rounds: RangeInclusive<usize>,
) -> Samples {
    let mut round =
        || -> Vec<f64> { subjects.iter_mut().map(|subject| (subject.sample)()).collect() };
    let start = Instant::now();
    round();
    let fit = (time.as_secs_f64() / start.elapsed().as_secs_f64()) as usize;
    let rounds = fit.clamp(*rounds.start(), *rounds.end());
    let by_round: Vec<_> = (0..rounds).map(|_| round()).collect();
    let of_subject = |index: usize| by_round.iter().map(|round| round[index]).collect();
    Samples {
        names: subjects.iter().map(|subject| subject.name.clone()).collect(),
        by_subject: (0..subjects.len()).map(of_subject).collect(),
    }
}

/// For how many nanoseconds this thread has had a CPU.
#[must_use]
pub fn busy() -> f64 {
    busy_nanoseconds() as f64
}

/// The same, whole.
#[must_use]
pub fn busy_nanoseconds() -> u64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as u64 * 1_000_000_000 + time.tv_nsec as u64
}

impl Samples {
    /// How often every subject was timed.
    #[must_use]
    pub fn rounds(&self) -> usize {
        self.by_subject.first().map_or(0, Vec::len)
    }

    /// Every sample of a subject.
    ///
    /// # Panics
    /// Where there is no such subject.
    #[must_use]
    pub fn of(&self, name: &str) -> &[f64] {
        let index = self.names.iter().position(|n| n == name);
        &self.by_subject[index.unwrap_or_else(|| panic!("no subject {name}"))]
    }

    /// Nanoseconds a unit.
    #[must_use]
    pub fn median(&self, name: &str) -> Median {
        median(self.of(name).to_vec())
    }

    /// How many times the time of `other` is that of `name`, round by round.
    #[must_use]
    pub fn ratio(&self, name: &str, other: &str) -> Median {
        let pairs = self.of(name).iter().zip(self.of(other));
        median(pairs.map(|(name, other)| name / other).collect())
    }

    /// The shortest time: what neighbours disturb least.
    #[must_use]
    pub fn least(&self, name: &str) -> f64 {
        self.of(name).iter().copied().fold(f64::INFINITY, f64::min)
    }
}

fn median(mut values: Vec<f64>) -> Median {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| values[((values.len() - 1) as f64 * share).round() as usize];
    Median { low: at(0.25), middle: at(0.5), high: at(0.75) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_and_quartiles() {
        let of = |values: &[f64]| median(values.to_vec());
        assert_eq!(of(&[3.0]), Median { low: 3.0, middle: 3.0, high: 3.0 });
        assert_eq!(of(&[5.0, 1.0, 2.0, 4.0, 3.0]), Median { low: 2.0, middle: 3.0, high: 4.0 });
    }

    #[test]
    fn subjects_take_turns_and_the_first_round_does_not_count() {
        let order = std::cell::RefCell::new(Vec::new());
        let subject = |name: &'static str| {
            let order = &order;
            Subject::new(name, move || {
                order.borrow_mut().push(name);
                1
            })
        };
        let samples = take(&mut [subject("a"), subject("b")], 2);
        assert_eq!(*order.borrow(), ["a", "b", "a", "b", "a", "b"]);
        assert_eq!(samples.of("a").len(), 2);
        assert!(samples.least("b") <= samples.median("b").middle);
        let mut sleeper = [Subject::timing_itself("c", || 1.0)];
        assert_eq!(take_within(&mut sleeper, Duration::ZERO, 3..=9).rounds(), 3);
        assert_eq!(take_within(&mut sleeper, Duration::MAX, 3..=9).rounds(), 9);
    }
}
