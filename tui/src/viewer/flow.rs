//! How frames follow each other over a link: none begins while two are under way, as far as the terminal tells.
//!
//! After every frame the terminal is asked how far it has come. While two frames are unanswered, none is drawn. The
//! next one shows what is wanted then: frames are left out, never queued. So a key is seen after two frames at most,
//! however much the link would take. (A third may be under way: what is shown while a picture is drawn.) Without answers nothing is known,
//! and nothing is held back.
//!
//! It has no clock: instants come in.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// While so many frames are under way, none is begun.
const MOST: usize = 2;
/// An answer that has not come for so long never will: longer than links stall.
const LOST: Duration = Duration::from_secs(15);
/// The same once the terminal has told its size. A session that is shown again tells it; while it was not shown, it swallowed answers.
const LOST_BEFORE_RESIZE: Duration = Duration::from_secs(2);
/// The weight of what the last frame says of the link, against all before it.
const WEIGHT: f64 = 0.3;
/// Seconds that a frame may take on the link. A key waits for three frames: two under way, and the next one.
const FRAME_TIME: f64 = 0.06;
/// Tolerances in `OKLab`: no one sees the first; few see the last while something moves.
const TOLERANCES: [f32; 3] = [0.01, 0.02, 0.03];
/// The fewest bytes of a frame that say something of the link: a smaller frame is answered at once, whatever the link.
const TELLING: usize = 4096;

/// The frames that were sent and not answered yet, and what answers tell of the link.
#[derive(Debug, Default)]
pub(super) struct Flow {
    under_way: VecDeque<Sent>,
    /// How long the last answer took, from the end of its frame.
    round_trip: Option<Duration>,
    /// Bytes a second, as far as is known.
    rate: Option<f64>,
    /// When the last answer came.
    answered: Option<Instant>,
    /// Which tolerance frames get.
    step: usize,
}

#[derive(Clone, Copy, Debug)]
struct Sent {
    at: Instant,
    bytes: usize,
}

impl Flow {
    /// How long until a frame may be sent; `None` if it may be sent now.
    pub(super) fn wait(&self, now: Instant) -> Option<Duration> {
        let oldest = self.under_way.front().filter(|_| self.under_way.len() >= MOST)?;
        let left = LOST.saturating_sub(now.saturating_duration_since(oldest.at));
        (!left.is_zero()).then_some(left)
    }

    /// Takes note that a frame of so many bytes was sent, whose answer is awaited.
    pub(super) fn sent(&mut self, bytes: usize, now: Instant) {
        self.give_up(LOST, now);
        self.under_way.push_back(Sent { at: now, bytes });
    }

    /// Takes note that the terminal has answered the oldest frame.
    pub(super) fn answered(&mut self, now: Instant) {
        // What was sent so long ago never was answered: this answer is to a later one.
        self.give_up(LOST, now);
        let Some(Sent { at, bytes }) = self.under_way.pop_front() else { return };
        self.round_trip = Some(now.saturating_duration_since(at));
        // The link began with this frame when it was done with the one before.
        let since = self.answered.map_or(at, |answered| answered.max(at));
        self.answered = Some(now);
        let seconds = now.saturating_duration_since(since).as_secs_f64();
        if bytes < TELLING || seconds <= 0.0 {
            return;
        }
        let rate = bytes as f64 / seconds;
        self.rate = Some(self.rate.map_or(rate, |before| before + WEIGHT * (rate - before)));
        if seconds > FRAME_TIME {
            self.step = (self.step + 1).min(TOLERANCES.len() - 1);
        } else if seconds < FRAME_TIME / 2.0 {
            self.step = self.step.saturating_sub(1);
        }
    }

    /// Takes note that the terminal has told its size. Returns whether that gives up answers, which may have been lost.
    pub(super) fn resized(&mut self, now: Instant) -> bool {
        let before = self.open();
        self.give_up(LOST_BEFORE_RESIZE, now);
        self.open() < before
    }

    /// Gives up answers to what was sent so long ago.
    fn give_up(&mut self, after: Duration, now: Instant) {
        let is_lost = |sent: &Sent| now.saturating_duration_since(sent.at) >= after;
        while self.under_way.front().is_some_and(is_lost) {
            self.under_way.pop_front();
        }
    }

    /// How many answers are awaited.
    pub(super) fn open(&self) -> u32 {
        self.under_way.len() as u32
    }

    /// Gives up all answers.
    pub(super) fn forget(&mut self) {
        self.under_way.clear();
        self.answered = None;
    }

    /// How long the last answer took, from the end of its frame.
    pub(super) fn round_trip(&self) -> Option<Duration> {
        self.round_trip
    }

    /// How far colours of a passing frame may be from the wanted ones: the slower the link, the farther.
    pub(super) fn tolerance(&self) -> f32 {
        TOLERANCES[self.step]
    }

    /// How many bytes a frame that can wait may have: as many as the link takes in [`FRAME_TIME`].
    pub(super) fn most_bytes(&self) -> usize {
        let bytes = |rate: f64| ((rate * FRAME_TIME) as usize).max(TELLING);
        self.rate.map_or(usize::MAX, bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);

    #[test]
    fn two_are_under_way_and_the_third_waits_for_an_answer() {
        let (mut flow, start) = (Flow::default(), Instant::now());
        for _ in 0..2 {
            assert_eq!(flow.wait(start), None);
            flow.sent(10_000, start);
        }
        assert_eq!(flow.wait(start + MS), Some(LOST - MS));
        flow.answered(start + 20 * MS);
        assert_eq!(flow.wait(start + 20 * MS), None);
        assert_eq!(flow.round_trip(), Some(20 * MS));
    }

    /// What is shown while a picture is drawn may be under way beside it.
    #[test]
    fn every_answer_is_to_the_frame_that_it_was_asked_with() {
        let (mut flow, start) = (Flow::default(), Instant::now());
        for at in 0..3 {
            flow.sent(10_000, start + at * MS);
        }
        assert_eq!(flow.open(), 3);
        for (at, round_trip, has_room) in [(20, 20, false), (23, 22, true), (26, 24, true)] {
            let now = start + at * MS;
            flow.answered(now);
            assert_eq!(flow.round_trip(), Some(round_trip * MS));
            assert_eq!(flow.wait(now).is_none(), has_room);
        }
        assert_eq!(flow.open(), 0);
    }

    #[test]
    fn an_answer_that_never_comes_is_given_up() {
        let (mut flow, start) = (Flow::default(), Instant::now());
        flow.sent(10_000, start);
        flow.sent(10_000, start);
        assert!(flow.wait(start + 10_000 * MS).is_some(), "a link may stall");
        assert_eq!(flow.wait(start + LOST), None);
        flow.sent(10_000, start + LOST);
        assert_eq!(flow.open(), 1);
        flow.forget();
        assert_eq!(flow.wait(start), None);
        // One that no one asked for.
        flow.answered(start + LOST);
        assert_eq!(flow.wait(start), None);
    }

    #[test]
    fn a_lost_answer_does_not_make_later_ones_late() {
        let (mut flow, start) = (Flow::default(), Instant::now());
        flow.sent(10_000, start);
        let later = start + 60_000 * MS;
        flow.sent(10_000, later);
        flow.answered(later + 20 * MS);
        assert_eq!(flow.round_trip(), Some(20 * MS));
        assert!(flow.under_way.is_empty());
        assert!(flow.most_bytes() > 10_000, "no link that takes a minute: {}", flow.most_bytes());
    }

    /// Sizes that come one after the other over a link that answers within two seconds give up nothing.
    #[test]
    fn a_resize_gives_up_what_is_old() {
        let (mut flow, start) = (Flow::default(), Instant::now());
        flow.sent(10_000, start);
        flow.sent(10_000, start + 1500 * MS);
        assert!(!flow.resized(start + 1900 * MS));
        assert!(flow.wait(start + 1900 * MS).is_some());
        assert!(flow.resized(start + LOST_BEFORE_RESIZE));
        assert_eq!((flow.open(), flow.wait(start + LOST_BEFORE_RESIZE)), (1, None));
        assert!(flow.resized(start + 1500 * MS + LOST_BEFORE_RESIZE));
        assert_eq!(flow.open(), 0);
    }

    /// Half a megabyte a second: frames become smaller until the link takes them in time.
    #[test]
    fn a_slow_link_gets_coarser_colours_and_a_fast_one_fine_ones() {
        let (mut flow, mut now) = (Flow::default(), Instant::now());
        let mut frame = |flow: &mut Flow, bytes: u32, rate: f64| {
            flow.sent(bytes as usize, now);
            now += Duration::from_secs_f64(f64::from(bytes) / rate);
            flow.answered(now);
        };
        assert_eq!((flow.tolerance(), flow.most_bytes()), (TOLERANCES[0], usize::MAX));
        for _ in 0..3 {
            frame(&mut flow, 50_000, 0.5e6);
        }
        assert_eq!(flow.tolerance(), TOLERANCES[2]);
        assert!(flow.most_bytes().abs_diff(30_000) < 10, "{}", flow.most_bytes());
        // A little says nothing.
        frame(&mut flow, 100, 1e3);
        assert!(flow.most_bytes().abs_diff(30_000) < 10);
        for _ in 0..30 {
            frame(&mut flow, 50_000, 50e6);
        }
        assert_eq!(flow.tolerance(), TOLERANCES[0]);
        assert!(flow.most_bytes() > 1_000_000);
    }
}
