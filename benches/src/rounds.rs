//! Times of several things to compare, taken in turns.
//!
//! On a shared machine the clock and the neighbours' load change from second to second. So the time is the thread's
//! own, everything runs once a round, and the results are medians of times, and of ratios within a round.

use rustix::time::{ClockId, clock_gettime};
use std::fmt;
use std::ops::RangeInclusive;
use std::time::{Duration, Instant};

/// Takes a sample: nanoseconds a unit of work.
pub(crate) type Sampler<'a> = Box<dyn FnMut() -> f64 + 'a>;

/// How many nanoseconds this thread has run on a CPU.
pub(crate) fn thread_time() -> u64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as u64 * 1_000_000_000 + time.tv_nsec as u64
}

/// How many nanoseconds of this thread's time `work` takes.
pub(crate) fn timed(work: impl FnOnce()) -> f64 {
    let start = thread_time();
    work();
    (thread_time() - start) as f64
}

/// A median and the quartiles around it; `{:.2}` prints `1.50 [1.25, 1.75]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Median {
    pub(crate) low: f64,
    pub(crate) middle: f64,
    pub(crate) high: f64,
}

/// Samples, one a round, of each thing named by a `K`.
pub(crate) struct Samples<K> {
    pub(crate) names: Vec<K>,
    rounds: Vec<Vec<f64>>,
}

impl<K: PartialEq> Samples<K> {
    /// Takes a sample of each in every round, after one round that does not count. As many rounds are taken as fit into
    /// `time`, judged by that first round, but within `rounds`.
    ///
    /// # Panics
    /// If two have the same name.
    pub(crate) fn take(
        all: Vec<(K, Sampler<'_>)>,
        time: Duration,
        rounds: RangeInclusive<usize>,
    ) -> Self {
        let (names, mut samplers): (Vec<_>, Vec<_>) = all.into_iter().unzip();
        let is_new = |(index, name): (usize, &K)| !names[..index].contains(name);
        assert!(names.iter().enumerate().all(is_new), "two have the same name");
        let mut round = || -> Vec<f64> { samplers.iter_mut().map(|sampler| sampler()).collect() };
        let start = Instant::now();
        round();
        let fit = (time.as_secs_f64() / start.elapsed().as_secs_f64()) as usize;
        let count = fit.clamp(*rounds.start(), *rounds.end());
        Self { names, rounds: (0..count).map(|_| round()).collect() }
    }

    pub(crate) fn rounds(&self) -> usize {
        self.rounds.len()
    }

    fn index(&self, name: &K) -> Option<usize> {
        self.names.iter().position(|other| other == name)
    }

    /// Nanoseconds a unit; `None` if `name` did not take part.
    pub(crate) fn median(&self, name: &K) -> Option<Median> {
        let index = self.index(name)?;
        Some(Median::of(self.rounds.iter().map(|round| round[index]).collect()))
    }

    /// Of the names that `is_it` keeps, that of what takes the least time.
    pub(crate) fn quickest(&self, is_it: impl Fn(&K) -> bool) -> Option<&K> {
        let time = |name: &&K| self.median(name).map_or(f64::INFINITY, |time| time.middle);
        self.names.iter().filter(|name| is_it(name)).min_by(|a, b| time(a).total_cmp(&time(b)))
    }

    /// The time of `name`, divided by the time of `other`, round by round.
    pub(crate) fn ratio(&self, name: &K, other: &K) -> Option<Median> {
        let (own, other) = (self.index(name)?, self.index(other)?);
        Some(Median::of(self.rounds.iter().map(|round| round[own] / round[other]).collect()))
    }
}

impl Median {
    /// Between two values the result is interpolated.
    fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let place = (values.len() - 1) as f64 * share;
            let [below, above] = [place.floor(), place.ceil()].map(|place| values[place as usize]);
            below + (above - below) * place.fract()
        };
        Self { low: at(0.25), middle: at(0.5), high: at(0.75) }
    }

    pub(crate) fn times(self, factor: f64) -> Self {
        let Self { low, middle, high } = self;
        Self { low: low * factor, middle: middle * factor, high: high * factor }
    }
}

impl fmt::Display for Median {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = formatter.precision().unwrap_or(2);
        let Self { low, middle, high } = self;
        write!(formatter, "{middle:.digits$} [{low:.digits$}, {high:.digits$}]")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;

    #[test]
    fn medians_and_quartiles() {
        let of = |values: &[f64]| Median::of(values.to_vec());
        assert_eq!(of(&[3.0]), Median { low: 3.0, middle: 3.0, high: 3.0 });
        assert_eq!(of(&[5.0, 1.0, 2.0, 4.0, 3.0]), Median { low: 2.0, middle: 3.0, high: 4.0 });
        assert_eq!(of(&[5.0, 1.0, 3.0]), Median { low: 2.0, middle: 3.0, high: 4.0 });
        assert_eq!(of(&[1.0, 4.0, 2.0, 3.0]), Median { low: 1.75, middle: 2.5, high: 3.25 });
        assert_eq!(format!("{:.1}", of(&[5.0, 1.0, 3.0]).times(2.0)), "6.0 [4.0, 8.0]");
    }

    #[test]
    #[should_panic(expected = "the same name")]
    fn two_of_the_same_name_are_refused() {
        let sampler = || -> (&'static str, Sampler<'static>) { ("avx512", Box::new(|| 1.0)) };
        drop(Samples::take(vec![sampler(), sampler()], Duration::ZERO, 1..=1));
    }

    #[test]
    fn samplers_take_turns_and_the_first_round_does_not_count() {
        let order = RefCell::new(Vec::new());
        let sampler = |name: usize| -> (usize, Sampler<'_>) {
            let order = &order;
            let sample = move || {
                order.borrow_mut().push(name);
                name as f64
            };
            (name, Box::new(sample))
        };
        let samples = Samples::take(vec![sampler(1), sampler(2)], Duration::ZERO, 2..=9);
        assert_eq!(*order.borrow(), [1, 2, 1, 2, 1, 2]);
        assert_eq!((samples.rounds(), samples.ratio(&2, &1).map(|m| m.middle)), (2, Some(2.0)));
        assert_eq!(samples.median(&3), None);
        assert_eq!(Samples::take(vec![sampler(1)], Duration::MAX, 3..=9).rounds(), 9);
    }
}
