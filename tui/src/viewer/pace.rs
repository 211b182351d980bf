//! When a frame is drawn, and what it may cost: coarse while something moves if need be, full soon after.
//!
//! It has no clock: durations come in.

use crate::draw::{Effort, Spending};
use std::time::Duration;

/// A movement is over so long after its last frame. If that frame was not full, a full one follows: most are drawn
/// within the rest of 150 ms. Keys that are held down come closer together.
const REST: Duration = Duration::from_millis(100);
/// After so long the status line says that a picture is drawn. One of a movement is not given up before: else a key that
/// is held down would leave nothing to be seen of pictures that take longer than its repetition.
pub(super) const PATIENCE: Duration = Duration::from_millis(300);
/// The part of an interval that is for drawing. The rest is for the bytes, and for what a slow frame takes more.
const DRAWING: f64 = 0.4;
/// The weight of what the last frame says of the rate, against all before it.
const WEIGHT: f64 = 0.5;

/// The pace of the frames.
#[derive(Clone, Debug)]
pub(super) struct Pace {
    /// From one frame to the next, at least.
    interval: Duration,
    /// Samples a second, as far as is known.
    rate: Option<f64>,
    /// How long the last picture took to draw.
    drawing: Duration,
    /// Whether what was drawn last is all there is to see.
    is_full: bool,
    /// Whether the last picture was given up before it was drawn.
    gave_up: bool,
    /// What the terminal does not show yet of what was drawn last.
    debt: Debt,
}

/// What the terminal does not show yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Debt {
    /// It shows all.
    None,
    /// What merely looks alike while something moves: it is made good at rest.
    AtRest,
    /// What was too much for one frame at rest.
    Now,
}

impl Pace {
    /// The pace before the first frame.
    pub(super) fn new(interval: Duration) -> Self {
        let drawing = Duration::ZERO;
        Self { interval, rate: None, drawing, is_full: true, gave_up: false, debt: Debt::None }
    }

    /// How long it takes until a frame is due, `since_last` one began; `None` if all is shown and nothing moves.
    pub(super) fn wait(&self, moving: bool, since_last: Option<Duration>) -> Option<Duration> {
        let from_last = match (moving, self.is_full, self.debt) {
            (true, ..) => self.interval,
            (false, true, Debt::None) => return None,
            (false, true, Debt::Now) => Duration::ZERO,
            (false, ..) => REST,
        };
        Some(since_last.map_or(Duration::ZERO, |since| from_last.saturating_sub(since)))
    }

    /// What the next frame may cost. Before the first, it is not known how long samples take; without a movement, there
    /// is time.
    pub(super) fn spending(&self, moving: bool) -> Spending {
        let time = DRAWING * self.interval.as_secs_f64();
        match self.rate {
            Some(rate) if moving => Spending::AtMost((rate * time) as u64),
            _ => Spending::ByNeed,
        }
    }

    /// Whether a picture that takes `time` so far may be given up because what it shows has moved on. One that tells how long samples take is drawn to
    /// its end, and so is every other: else a key that is held down would leave nothing to be seen of pictures that take long.
    /// Where the last, or this one so far, took little longer than [`PATIENCE`], all are drawn: by the time that one is given up, most of
    /// it is done.
    pub(super) fn may_give_up(&self, time: Duration) -> bool {
        let is_slow = time >= PATIENCE && self.drawing.max(time) > 2 * PATIENCE;
        self.rate.is_some() && !self.gave_up && is_slow
    }

    /// Takes note that a picture was given up.
    pub(super) fn gave_up(&mut self) {
        self.gave_up = true;
    }

    /// Takes note of what is left to be sent.
    pub(super) fn owes(&mut self, debt: Debt) {
        self.debt = debt;
    }

    /// Takes note that there is nothing to draw on: nothing is left to be shown.
    pub(super) fn rest(&mut self) {
        (self.is_full, self.debt) = (true, Debt::None);
    }

    /// Takes note of how long a frame took to draw.
    pub(super) fn drawn(&mut self, effort: Effort, drawing: Duration) {
        (self.drawing, self.is_full, self.gave_up) = (drawing, effort.is_full, false);
        let rate = effort.samples as f64 / drawing.as_secs_f64();
        // No samples, or a clock that stood.
        if rate > 0.0 && rate.is_finite() {
            self.rate = Some(self.rate.map_or(rate, |before| before + WEIGHT * (rate - before)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);
    const INTERVAL: Duration = Duration::from_millis(20);

    fn effort(samples: u64, is_full: bool) -> Effort {
        Effort { samples, rays: 2 * samples, is_full }
    }

    /// A thousand samples a millisecond.
    fn pace() -> Pace {
        let mut pace = Pace::new(INTERVAL);
        pace.drawn(effort(20_000, true), 20 * MS);
        pace
    }

    #[test]
    fn the_first_frame_is_full_and_comes_at_once() {
        let pace = Pace::new(INTERVAL);
        assert_eq!(pace.wait(true, None), Some(Duration::ZERO));
        assert_eq!(pace.spending(true), Spending::ByNeed);
    }

    #[test]
    fn a_movement_gets_what_its_time_allows() {
        let mut pace = pace();
        assert_eq!(pace.wait(true, Some(14 * MS)), Some(6 * MS));
        assert_eq!(pace.wait(true, Some(21 * MS)), Some(Duration::ZERO));
        assert_eq!(pace.spending(true), Spending::AtMost(8000));
        pace.drawn(effort(8000, false), 4 * MS);
        assert_eq!(pace.spending(true), Spending::AtMost(12_000));
    }

    #[test]
    fn rest_after_a_coarse_frame_brings_a_full_one_and_then_peace() {
        let mut pace = pace();
        assert_eq!(pace.wait(false, Some(Duration::ZERO)), None);
        pace.drawn(effort(8000, false), 8 * MS);
        assert_eq!(pace.wait(false, Some(30 * MS)), Some(70 * MS));
        // Another key in between.
        assert_eq!(pace.wait(true, Some(30 * MS)), Some(Duration::ZERO));
        pace.drawn(effort(8000, false), 8 * MS);
        assert_eq!(pace.wait(false, Some(100 * MS)), Some(Duration::ZERO));
        assert_eq!(pace.spending(false), Spending::ByNeed);
        pace.drawn(effort(30_000, true), 30 * MS);
        for since in [0, 100, 1000] {
            assert_eq!(pace.wait(false, Some(since * MS)), None);
        }
    }

    #[test]
    fn a_movement_gives_up_no_first_picture_and_no_two_in_a_row() {
        let mut pace = Pace::new(INTERVAL);
        assert!(!pace.may_give_up(PATIENCE));
        pace.gave_up();
        pace.drawn(effort(0, true), MS);
        assert!(!pace.may_give_up(PATIENCE));
        pace.drawn(effort(20_000, true), 900 * MS);
        assert!(pace.may_give_up(PATIENCE));
        pace.gave_up();
        assert!(!pace.may_give_up(PATIENCE));
        pace.drawn(effort(20_000, true), 900 * MS);
        assert!(pace.may_give_up(PATIENCE));
    }

    /// Else half of the pictures would not be seen.
    #[test]
    fn a_movement_gives_up_nothing_that_is_soon_drawn() {
        let mut pace = pace();
        assert!(!pace.may_give_up(PATIENCE));
        assert!(pace.may_give_up(3 * PATIENCE), "a slow one after a quick one");
        for (drawing, expected) in [(320, false), (900, true), (600, false)] {
            pace.drawn(effort(20_000, true), drawing * MS);
            assert_eq!(pace.may_give_up(PATIENCE), expected, "{drawing} ms");
        }
    }

    #[test]
    fn what_only_looks_alike_is_made_good_at_rest() {
        let mut pace = pace();
        pace.owes(Debt::AtRest);
        assert_eq!(pace.wait(true, Some(MS)), Some(19 * MS));
        assert_eq!(pace.wait(false, Some(30 * MS)), Some(70 * MS));
        pace.owes(Debt::Now);
        assert_eq!(pace.wait(false, Some(MS)), Some(Duration::ZERO));
        // A coarse picture is no time sooner.
        pace.drawn(effort(8000, false), 8 * MS);
        assert_eq!(pace.wait(false, Some(30 * MS)), Some(70 * MS));
        pace.drawn(effort(20_000, true), 20 * MS);
        pace.owes(Debt::None);
        assert_eq!(pace.wait(false, Some(MS)), None);
    }

    /// Else a terminal that has become 0x0 would be looked at again and again.
    #[test]
    fn what_is_owed_is_not_owed_to_a_terminal_without_a_cell() {
        let mut pace = pace();
        pace.drawn(effort(8000, false), 8 * MS);
        pace.owes(Debt::Now);
        pace.rest();
        assert_eq!(pace.wait(false, Some(MS)), None);
        assert_eq!(pace.wait(true, Some(MS)), Some(19 * MS));
    }

    #[test]
    fn a_frame_of_nothing_says_nothing() {
        let mut pace = pace();
        let before = pace.spending(true);
        pace.drawn(effort(0, true), Duration::ZERO);
        pace.drawn(effort(0, true), MS);
        pace.drawn(effort(10, true), Duration::ZERO);
        assert_eq!(pace.spending(true), before);
    }

    /// Every frame takes the time of its cells and its samples, and the next gets what it says: they settle.
    #[test]
    fn frames_settle_where_time_allows() {
        let (few, needed) = (40_000_u64, 200_000_u64);
        let milliseconds = |samples: u64| 1.0 + few as f64 / 20e3 + (samples - few) as f64 / 10e3;
        let mut pace = Pace::new(INTERVAL);
        let mut samples = needed;
        for _ in 0..30 {
            pace.drawn(effort(samples, samples == needed), MS.mul_f64(milliseconds(samples)));
            let Spending::AtMost(most) = pace.spending(true) else { panic!("a rate is known") };
            samples = most.clamp(few, needed);
        }
        assert!((milliseconds(samples) - 8.0).abs() < 0.1, "{samples}");
    }
}
