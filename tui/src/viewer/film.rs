//! The frames of a file in the viewer: a thread reads them before they are wanted.
//!
//! The thread reads a few frames ahead, fewer of large ones, and keeps one behind; the rest is read again when it is
//! wanted. No one waits for the thread: where a frame is not there yet, the picture stays.

mod ahead;

use super::printable::in_cells;
use crate::error::Error;
use crate::scene::Scene;
use crate::scene::frames::Frames;
use ahead::{Shared, read_ahead};
use std::sync::Arc;
use std::thread::Builder;
use std::time::{Duration, Instant};

/// Frames a second while it plays, at most.
pub(super) const RATE: u32 = 25;

/// The frames of a file, and which is shown.
#[derive(Debug)]
pub struct Film {
    shared: Arc<Shared>,
    /// The frame that is shown.
    shown: usize,
    /// The one that is to be shown as soon as it is there.
    target: usize,
    is_playing: bool,
    last: Instant,
    can_go_back: bool,
    may_have_more: bool,
    /// Whether there is a failure to tell of: no frame comes that would be drawn with it.
    has_news: bool,
}

impl Film {
    /// A file of which `frame` is shown; `prepare` does to other frames what was done to that one.
    ///
    /// # Errors
    /// [`Error::Running`] if there is no thread to read it.
    pub fn new(
        frames: Frames,
        frame: usize,
        prepare: impl Fn(&mut Scene) + Send + 'static,
    ) -> Result<Self, Error> {
        let shared = Arc::new(Shared::default());
        let first = frame + 1;
        shared.lock().wanted = first;
        let (can_go_back, may_have_more) = (frames.can_go_back(), frames.follows());
        let theirs = Arc::clone(&shared);
        let read = move || read_ahead(frames, first, &theirs, prepare);
        let thread = Builder::new().name("frames".to_owned()).spawn(read);
        thread.map_err(|error| Error::Running(format!("a thread: {error}")))?;
        let (shown, target, last) = (frame, frame, Instant::now());
        Ok(Self {
            shared,
            shown,
            target,
            is_playing: false,
            last,
            can_go_back,
            may_have_more,
            has_news: false,
        })
    }

    /// Plays, or stops. At the end it begins again.
    pub(super) fn play(&mut self) {
        self.is_playing = !self.is_playing;
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
    pub(super) fn has_status(&self) -> bool {
        self.has_more() || self.shared.lock().ending.is_some()
    }

    /// The frame that is shown.
    pub(super) fn shown(&self) -> usize {
        self.shown
    }

    /// One frame on or back; of a pipe, back only to what is kept.
    pub(super) fn step(&mut self, forward: bool) {
        self.is_playing = false;
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
        self.has_news |= !exists && state.ending.is_some();
        drop(state);
        if exists && can_come {
            self.want(target);
        }
    }

    fn want(&mut self, target: usize) {
        self.target = target;
        let mut state = self.shared.lock();
        state.wanted = target;
        state.failure = None;
        self.shared.changed.notify_all();
    }

    /// How long until it should be asked for a frame; `None` if nothing is to come.
    pub(super) fn wait(&self) -> Option<Duration> {
        /// Between two looks for a frame that is still being read.
        const LOOK: Duration = Duration::from_millis(5);
        if self.is_playing {
            let next = Duration::from_secs(1) / RATE;
            return Some(next.saturating_sub(self.last.elapsed()).max(LOOK));
        }
        (self.target != self.shown).then_some(LOOK)
    }

    /// The next frame, if it is time for one and it is there.
    pub(super) fn next(&mut self) -> Option<Arc<Scene>> {
        let is_due = self.last.elapsed() >= Duration::from_secs(1) / RATE;
        if self.is_playing && is_due && self.target == self.shown {
            let count = self.shared.lock().count;
            let next = self.shown + 1;
            let ends = count.is_some_and(|count| next >= count);
            // A file that is followed ends only at a frame that is wrong: whoever plays it is told.
            let begins_again = self.can_go_back && !self.may_have_more;
            let next = match (ends, begins_again) {
                (false, _) => next,
                (true, true) => 0,
                (true, false) => {
                    self.is_playing = false;
                    self.has_news = true;
                    self.shown
                }
            };
            if next != self.target {
                self.want(next);
            }
        }
        if self.target == self.shown {
            return None;
        }
        let mut state = self.shared.lock();
        if let Some(unwritten) = state.unwritten.filter(|&unwritten| self.target > unwritten) {
            // Steps went past the end of a file that grows: they wait for its next frame.
            (self.target, state.wanted) = (unwritten, unwritten);
            self.shared.changed.notify_all();
        }
        if state.empty.contains(&self.target) {
            // Whoever plays goes on, also from the end to the beginning.
            let forward = self.is_playing || self.target > self.shown;
            self.target = state.beyond_empty(self.target, forward).unwrap_or(self.shown);
            state.wanted = self.target;
            self.shared.changed.notify_all();
            if self.target == self.shown {
                return None;
            }
        }
        let is_lost = state.failure.as_ref().is_some_and(|(index, _)| *index == self.target);
        if let Some(count) = state.count.filter(|&count| self.target >= count) {
            // Steps went past an end that had not been seen: they lead to the last frame, but not back.
            self.target = count.saturating_sub(1).max(self.shown);
            if self.target == self.shown {
                self.has_news = state.ending.is_some();
                return None;
            }
            state.wanted = self.target;
            self.shared.changed.notify_all();
        } else if is_lost {
            // A frame that was there, and no longer is, would be asked for again and again.
            self.is_playing = false;
            self.target = self.shown;
            self.has_news = true;
            return None;
        }
        let scene = state.ready.get(&self.target).cloned()?;
        self.shown = self.target;
        // What follows is read while this one is drawn.
        state.wanted = self.shown + 1;
        drop(state);
        self.shared.changed.notify_all();
        self.last = Instant::now();
        Some(scene)
    }

    /// Whether the status line tells of a failure since the last call.
    pub(super) fn take_news(&mut self) -> bool {
        std::mem::take(&mut self.has_news)
    }

    /// For the status line: which frame of how many, or why there is none.
    pub(super) fn status(&self) -> String {
        let state = self.shared.lock();
        // What ends the film is read long before it would be shown, and is told of where it would be next.
        let is_at_end = !self.is_playing && state.count == Some(self.shown + 1);
        let ending = state.ending.as_ref().filter(|_| is_at_end);
        if let Some((index, why)) = state.failure.as_ref().or(ending) {
            return format!("frame {index}: {}", in_cells(why));
        }
        let mark = if self.is_playing { ">" } else { "" };
        let more = if state.count.is_none() { "+" } else { "" };
        let of = state.count.or_else(|| state.ready.keys().last().map(|last| last + 1));
        let of = of.unwrap_or(0).max(self.shown + 1);
        format!("{mark}{}/{of}{more}", self.shown)
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
