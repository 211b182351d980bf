//! The frames of a file in the viewer: a thread reads them before they are wanted.
//!
//! The thread reads a few frames ahead, fewer of large ones, and keeps one behind; the rest is read again when it is
//! wanted. No one waits for the thread: where a frame is not there yet, the picture stays.

mod ahead;
mod told;

use super::worker;
use crate::error::Error;
use crate::scene::Scene;
use crate::scene::frames::Frames;
use ahead::{Ready, Shared, read_ahead};
use std::mem;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Frames a second while it plays, at most.
pub(super) const RATE: u32 = 25;
/// The time between two looks at how many frames have been read, while the picture rests, and for a frame that has not come for long.
const GLANCE: Duration = Duration::from_millis(200);

/// The frames of a file, and which is shown.
#[derive(Debug)]
pub struct Film {
    shared: Arc<Shared>,
    /// The frame that is shown.
    shown: usize,
    /// The frame that is to be shown as soon as it has been read.
    target: usize,
    /// Since when that frame is awaited.
    asked: Instant,
    is_playing: bool,
    last: Instant,
    can_go_back: bool,
    may_have_more: bool,
    /// What is to be told over the picture.
    news: Vec<String>,
    /// Whether it has been told why no frame follows the last one.
    has_told_ending: bool,
    /// Whether it has been told that a frame lacks something.
    has_told_lack: bool,
    /// What the status line says of frames, as far as that has been noticed.
    noticed: Option<String>,
}

impl Film {
    /// A file of which `frame` is shown; `prepare` does to other frames what was done to that one, or says what they do
    /// instead: `keeps ...`.
    ///
    /// # Errors
    /// [`Error::Running`] if there is no thread to read it.
    pub fn new(
        frames: Frames,
        frame: usize,
        prepare: impl Fn(&mut Scene) -> Result<(), String> + Send + 'static,
    ) -> Result<Self, Error> {
        let shared = Arc::new(Shared::default());
        let first = frame + 1;
        shared.lock().want(first);
        let (can_go_back, may_have_more) = (frames.can_go_back(), frames.follows());
        let theirs = Arc::clone(&shared);
        let read = move || read_ahead(frames, first, &theirs, prepare);
        let thread = worker::begin("frames", read);
        thread.map_err(|error| Error::Running(format!("cannot start a thread: {error}")))?;
        let now = Instant::now();
        Ok(Self {
            shared,
            shown: frame,
            target: frame,
            asked: now,
            is_playing: false,
            last: now,
            can_go_back,
            may_have_more,
            news: Vec::new(),
            has_told_ending: false,
            has_told_lack: false,
            noticed: None,
        })
    }

    /// Plays, or stops. At the end it begins again.
    pub(super) fn play(&mut self) {
        self.is_playing = !self.is_playing;
        self.has_told_ending = false;
        // A pipe may have passed over what is before the frame that it is asked for.
        if self.can_go_back {
            self.target = self.shown;
        }
    }

    /// Whether there may be a frame besides the one that is shown.
    pub(super) fn has_more(&self) -> bool {
        self.may_have_more || self.shown > 0 || {
            let state = self.shared.lock();
            state.count.is_none_or(|count| count > 1)
        }
    }

    /// Whether there is something to say of frames: how many there are, or why no other comes.
    fn has_status(&self) -> bool {
        self.has_more() || self.shared.lock().ending.is_some()
    }

    /// The frame that is shown.
    pub(super) fn shown(&self) -> usize {
        self.shown
    }

    /// Steps one frame on or back; of a pipe, back only to frames that are kept.
    pub(super) fn step(&mut self, forward: bool) {
        self.is_playing = false;
        self.has_told_ending &= !forward;
        let state = self.shared.lock();
        let target = match forward {
            true => state.beyond_empty(self.target + 1, true),
            // What a pipe may never bring is not waited for any more.
            false if !self.can_go_back && self.target > self.shown => Some(self.shown),
            false => self.target.checked_sub(1).and_then(|frame| state.beyond_empty(frame, false)),
        };
        let target = target.unwrap_or(self.target);
        let exists = state.count.is_none_or(|count| target < count);
        let is_kept = target == self.shown || state.ready.contains_key(&target);
        let can_come = forward || self.can_go_back || is_kept;
        drop(state);
        if exists && can_come {
            self.want(target);
        }
    }

    fn want(&mut self, target: usize) {
        (self.target, self.asked) = (target, Instant::now());
        let mut state = self.shared.lock();
        state.want(target);
        state.failure = None;
        self.shared.changed.notify_all();
    }

    /// Whether it plays.
    pub(super) fn is_playing(&self) -> bool {
        self.is_playing
    }

    /// Whether a frame is there that is to be shown next.
    pub(super) fn has_next(&self) -> bool {
        let is_next = self.is_playing && self.target == self.shown;
        let next = if is_next { self.shown + 1 } else { self.target };
        next != self.shown && self.shared.lock().ready.contains_key(&next)
    }

    /// How long until it should be asked for a frame; `None` if nothing is to come.
    pub(super) fn wait(&self) -> Option<Duration> {
        /// The time between the first two looks for a frame that is still being read.
        const LOOK: Duration = Duration::from_millis(5);
        let is_awaited = self.target != self.shown;
        // The longer none has come, the longer the wait: a pipe may be silent for ever.
        let seldom = if is_awaited { self.asked.elapsed() / 8 } else { LOOK };
        let look = seldom.clamp(LOOK, GLANCE);
        if self.is_playing {
            let next = Duration::from_secs(1) / RATE;
            return Some(next.saturating_sub(self.last.elapsed()).max(look));
        }
        is_awaited.then_some(look)
    }

    /// How long until it should be asked whether it [has changed](Film::has_changed); `None` if nothing is read.
    pub(super) fn wait_for_status(&self) -> Option<Duration> {
        if self.is_playing {
            return None;
        }
        // First: what is not read any more does not change behind the comparison.
        let is_reading = self.shared.lock().is_reading;
        if self.line() != self.noticed {
            return Some(Duration::ZERO);
        }
        is_reading.then_some(GLANCE)
    }

    /// Whether the status line says something else of frames than at the last call. While it plays, each frame tells.
    pub(super) fn has_changed(&mut self) -> bool {
        if self.is_playing {
            return false;
        }
        let line = self.line();
        let has_changed = line != self.noticed;
        self.noticed = line;
        has_changed
    }

    /// What the status line says of frames.
    pub(super) fn line(&self) -> Option<String> {
        self.has_status().then(|| self.status())
    }

    /// Tells why no more frames come, as soon as the last is shown and that is known; again once a key has asked for more.
    fn tell_ending(&mut self) {
        let state = self.shared.lock();
        let is_news = state.count == Some(self.shown + 1) && !self.has_told_ending;
        if let Some((frame, error)) = state.ending.as_ref().filter(|_| is_news) {
            self.news.push(told::reason(*frame, error));
            self.has_told_ending = true;
        }
    }

    /// The next frame, if it is time for one and it is there.
    pub(super) fn next(&mut self) -> Option<Arc<Scene>> {
        self.tell_ending();
        let is_due = self.last.elapsed() >= Duration::from_secs(1) / RATE;
        if self.is_playing && is_due && self.target == self.shown {
            let count = self.shared.lock().count;
            let next = self.shown + 1;
            let ends = count.is_some_and(|count| next >= count);
            // A file that is followed ends only at a frame that is wrong.
            let begins_again = self.can_go_back && !self.may_have_more;
            let next = match (ends, begins_again) {
                (false, _) => next,
                (true, true) => 0,
                (true, false) => self.shown,
            };
            if next == self.shown {
                self.is_playing = false;
            } else {
                self.want(next);
            }
        }
        if self.target == self.shown {
            return None;
        }
        let mut state = self.shared.lock();
        if let Some(unwritten) = state.unwritten.filter(|&unwritten| self.target > unwritten) {
            // Steps went past the end of a file that grows: they wait for its next frame.
            self.target = unwritten;
            state.want(self.target);
            self.shared.changed.notify_all();
        }
        if state.empty.contains(&self.target) {
            // Whoever plays goes on, also from the end to the beginning.
            let forward = self.is_playing || self.target > self.shown;
            self.target = state.beyond_empty(self.target, forward).unwrap_or(self.shown);
            state.want(self.target);
            self.shared.changed.notify_all();
            if self.target == self.shown {
                // No other frame has particles.
                self.is_playing = false;
                return None;
            }
        }
        let lost = state.failure.as_ref().filter(|(frame, _)| *frame == self.target);
        let lost = lost.map(|(frame, error)| told::reason(*frame, error));
        if let Some(count) = state.count.filter(|&count| self.target >= count) {
            // Steps went past an end that had not been seen: they lead to the last frame, but not back.
            self.target = count.saturating_sub(1).max(self.shown);
            if self.target == self.shown {
                return None;
            }
            state.want(self.target);
            self.shared.changed.notify_all();
        } else if let Some(lost) = lost {
            // A frame that was there, and no longer is, would be asked for again and again.
            self.is_playing = false;
            self.target = self.shown;
            self.news.push(lost);
            return None;
        }
        let Ready { scene, lack } = state.ready.get(&self.target).cloned()?;
        self.shown = self.target;
        // What follows is read while this one is drawn.
        state.want(self.shown + 1);
        drop(state);
        self.shared.changed.notify_all();
        self.last = Instant::now();
        if let Some(lack) = lack
            && !mem::replace(&mut self.has_told_lack, true)
        {
            self.news.push(format!("frame {} {lack}", self.shown));
        }
        Some(scene)
    }

    /// What there is to tell over the picture since the last call: why a frame does not come, or what one lacks.
    pub(super) fn take_news(&mut self) -> Vec<String> {
        mem::take(&mut self.news)
    }

    fn status(&self) -> String {
        told::status(&self.shared.lock(), self.shown, self.is_playing)
    }
}

impl Drop for Film {
    fn drop(&mut self) {
        self.shared.lock().is_over = true;
        self.shared.changed.notify_all();
    }
}

#[cfg(test)]
mod tests;
