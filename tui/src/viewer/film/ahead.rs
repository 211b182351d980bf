//! The thread that reads frames before they are wanted, and what it shares with the viewer.

use crate::arguments::files::FOLLOW;
use crate::scene::frames::Frames;
use crate::scene::{ReadError, Scene};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// Frames that are read before they are wanted, at most ...
pub(super) const AHEAD: usize = 8;
/// ... and spheres in them.
const MOST_SPHERES: usize = 8_000_000;

/// A frame that has been read.
#[derive(Clone, Debug)]
pub(super) struct Ready {
    pub(super) scene: Arc<Scene>,
    /// What could not be done to it that was done to the first.
    pub(super) lack: Option<String>,
}

/// What the viewer and the reading thread share.
#[derive(Debug, Default)]
pub(super) struct State {
    /// The frame that is wanted next.
    pub(super) wanted: usize,
    /// Whether the thread reads, or is about to see what there is to read. While it does not, nothing here changes.
    pub(super) is_reading: bool,
    pub(super) ready: BTreeMap<usize, Ready>,
    /// How many frames there are, as far as frames have been read.
    pub(super) seen: usize,
    /// The frames without particles, as far as they have been met. They are not shown.
    pub(super) empty: BTreeSet<usize>,
    /// The first frame that is still to be written to a file that is followed.
    pub(super) unwritten: Option<usize>,
    /// How many frames there are, up to the last that can be shown, once that is known.
    pub(super) count: Option<usize>,
    /// A frame that has been read and cannot be read again, and why.
    pub(super) failure: Option<(usize, ReadError)>,
    /// The frame at which the film ends because it is wrong, and why.
    pub(super) ending: Option<(usize, ReadError)>,
    pub(super) is_over: bool,
}

impl State {
    /// Says which frame is wanted next; the thread must be notified.
    pub(super) fn want(&mut self, frame: usize) {
        (self.wanted, self.is_reading) = (frame, true);
    }

    /// The first frame from `frame` on, or back, that is not known to be empty.
    pub(super) fn beyond_empty(&self, mut frame: usize, forward: bool) -> Option<usize> {
        while self.empty.contains(&frame) {
            frame = if forward { frame + 1 } else { frame.checked_sub(1)? };
        }
        Some(frame)
    }

    /// Says that there is no frame from `count` on.
    fn end_at(&mut self, count: usize) {
        let last = count.checked_sub(1).and_then(|last| self.beyond_empty(last, false));
        self.count = Some(last.map_or(0, |last| last + 1));
    }
}

#[derive(Debug, Default)]
pub(super) struct Shared {
    pub(super) state: Mutex<State>,
    pub(super) changed: Condvar,
}

impl Shared {
    pub(super) fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Reads what is wanted and what follows it, until no one looks any more. `first` is the first frame that has not been
/// read; each is prepared, or says what it lacks for that.
pub(super) fn read_ahead(
    mut frames: Frames,
    first: usize,
    shared: &Shared,
    prepare: impl Fn(&mut Scene) -> Result<(), String>,
) {
    let mut unread = first;
    loop {
        let index = {
            let mut state = shared.lock();
            loop {
                if state.is_over {
                    return;
                }
                if let Some(index) = missing(&state) {
                    break index;
                }
                state.is_reading = false;
                state = shared.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
            }
        };
        // What is passed over in a pipe could not be read any more, and the end may come before what is wanted.
        let index = if frames.can_go_back() { index } else { index.min(unread) };
        let read = frames.read(index);
        let prepared = |mut scene: Scene| {
            let lack = prepare(&mut scene).err();
            Ready { scene: Arc::new(scene), lack }
        };
        let read = read.map(|scene| scene.map(prepared));
        let mut state = shared.lock();
        match read {
            Ok(Some(ready)) => {
                state.unwritten = None;
                state.ready.insert(index, ready);
                state.seen = state.seen.max(index + 1);
                unread = unread.max(index + 1);
                // What a pipe has passed cannot be read again, and any frame may be its last.
                let (wanted, is_pipe) = (state.wanted, !frames.can_go_back());
                let farthest = if is_pipe { usize::MAX } else { wanted + AHEAD };
                state.ready.retain(|&index, _| {
                    let is_last = is_pipe && index + 1 == unread;
                    (index + 2 >= wanted || is_last) && index <= farthest
                });
            }
            Ok(None) if frames.follows() => {
                state.unwritten = Some(frames.at());
                let waited = shared.changed.wait_timeout(state, FOLLOW);
                drop(waited.unwrap_or_else(PoisonError::into_inner));
            }
            Ok(None) => {
                let count = frames.count().unwrap_or(index);
                let count = state.count.map_or(count, |known| known.min(count));
                state.end_at(count);
            }
            Err(error) if error.is_empty_frame => {
                state.unwritten = None;
                state.empty.insert(index);
                // It may be the last, or all behind it may be like it.
                if let Some(count) = state.count {
                    state.end_at(count);
                }
                unread = unread.max(index + 1);
            }
            Err(error) => {
                // A frame that has been read exists, even if it cannot be read again. Else the wrong one may be before the one
                // that is wanted.
                if index < unread {
                    state.failure = Some((index, error));
                } else {
                    let failed = frames.at().clamp(unread, index);
                    state.end_at(failed);
                    state.ending = Some((failed, error));
                }
            }
        }
    }
}

/// The next frame to read, if there is one that has not just failed.
fn missing(state: &State) -> Option<usize> {
    let spheres = state.ready.values().map(|ready| ready.scene.spheres().len()).sum::<usize>();
    let is_there = |index: usize| state.ready.contains_key(&index) || state.empty.contains(&index);
    let exists = |index: usize| {
        state.count.is_none_or(|count| index < count)
            && state.failure.as_ref().is_none_or(|(failed, _)| *failed != index)
    };
    if !is_there(state.wanted) {
        return exists(state.wanted).then_some(state.wanted);
    }
    if spheres >= MOST_SPHERES {
        return None;
    }
    (state.wanted..=state.wanted + AHEAD)
        .find(|&index| !is_there(index))
        .filter(|&index| exists(index))
}
