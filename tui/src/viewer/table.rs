//! The table over the picture: measured by a thread of its own, which is told to end when the table is closed.
//!
//! No one waits for that thread, whatever it is doing; it ends by itself after the pass that it is in. Of two
//! measurements the later begins when the earlier has ended, so that they neither disturb each other's times nor add
//! up.

use super::shown::Shown;
use super::worker;
use crate::choice::Auto;
use crate::error::Error;
use crate::scene::Scene;
use crate::structure::scene::SceneStructures;
use crate::structure::{Order, Structure};
use crate::style::Style;
use crate::threads::Threads;
use crate::tradeoff::chart::Standing;
use crate::tradeoff::{Question, Step};
use crate::view::View;
use spherule_kernel::{Level, SphereTree};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// The time between two looks at how far a measurement is.
const TICK: Duration = Duration::from_millis(100);
/// A measurement begins so long after the last frame of a movement.
const REST: Duration = Duration::from_millis(100);

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Subject {
    view: View,
    structure: Auto<Structure>,
    size: (u16, u16),
}

impl Subject {
    /// The rays of this picture.
    pub(super) fn new(shown: &Shown, size: (u16, u16)) -> Self {
        Self { view: shown.view, structure: shown.structure, size }
    }
}

/// What a measurement needs; it is owned, since no one waits for the end.
pub(super) struct Means {
    pub(super) scene: Arc<Scene>,
    pub(super) style: Style,
    /// The tree of the pictures, so that there are not two.
    pub(super) tree: Option<Arc<SphereTree>>,
    pub(super) order: Order,
    pub(super) level: Level,
}

/// A measurement that is wanted.
#[derive(Debug)]
struct Measurement {
    subject: Subject,
    shared: Arc<Shared>,
    /// Whether its end has been seen.
    is_over: bool,
}

#[derive(Debug)]
struct Shared {
    is_unwanted: AtomicBool,
    standing: Mutex<Standing>,
}

impl Shared {
    fn tell(&self, standing: Standing) {
        *self.standing.lock().unwrap_or_else(PoisonError::into_inner) = standing;
    }

    /// Measures on this thread alone: the threads of the pictures stay free.
    fn measure(&self, subject: Subject, means: &Means) {
        let Subject { view, structure, size } = subject;
        let Means { scene, style, tree, order, level } = means;
        let threads = Threads::default();
        let structures = SceneStructures::new(scene.list(), &threads).in_order(*order);
        let machine = (*level, &threads);
        let question = Question { scene, view, style: *style, size, structure, machine };
        let found =
            question.measure(&mut structures.with_tree(tree.clone()), &mut |step, share| {
                let is_wanted = !self.is_unwanted.load(Relaxed);
                if is_wanted {
                    self.tell(Standing::Underway(step, share));
                }
                is_wanted
            });
        match found {
            Ok(Some(report)) => self.tell(Standing::Done(report)),
            Err(Error::Running(why) | Error::Input(why)) => self.tell(Standing::Failed(why)),
            Ok(None) | Err(Error::ReaderGone) => {}
        }
    }
}

impl Drop for Measurement {
    fn drop(&mut self) {
        self.shared.is_unwanted.store(true, Relaxed);
    }
}

/// The measurement of the moment, if the table is open.
#[derive(Debug, Default)]
pub(super) struct Table {
    measurement: Option<Measurement>,
    /// The last that was begun.
    thread: Option<JoinHandle<()>>,
}

impl Table {
    /// How long until there is something to do, `since_last` frame began; `None` while the table is closed or done, or
    /// waits for a picture that never rests.
    pub(super) fn wait(
        &self,
        shown: &Shown,
        size: (u16, u16),
        since_last: Option<Duration>,
    ) -> Option<Duration> {
        if !shown.table || shown.spinning {
            return None;
        }
        let subject = Subject::new(shown, size);
        let from_last = match self.measurement.as_ref().filter(|of| of.subject == subject) {
            Some(Measurement { is_over: true, .. }) => return None,
            Some(_) => TICK,
            None => REST,
        };
        Some(since_last.map_or(Duration::ZERO, |since| from_last.saturating_sub(since)))
    }

    /// Ends what is measured, if anything is.
    pub(super) fn close(&mut self) {
        self.measurement = None;
    }

    /// How the measurement of `subject` stands. A measurement of another subject ends. One of this subject begins, by
    /// `means`, if there are any: if the picture rests.
    pub(super) fn standing(&mut self, subject: Subject, means: Option<Means>) -> Standing {
        self.measurement.take_if(|of| of.subject != subject);
        if let Some(means) = means.filter(|_| self.measurement.is_none()) {
            match self.begin(subject, means) {
                Ok(begun) => self.measurement = Some(begun),
                Err(error) => return Standing::Failed(format!("cannot start a thread: {error}")),
            }
        }
        let Some(measurement) = &mut self.measurement else { return Standing::Waiting };
        let standing = measurement.shared.standing.lock();
        let standing = standing.unwrap_or_else(PoisonError::into_inner).clone();
        measurement.is_over = matches!(standing, Standing::Done(_) | Standing::Failed(_));
        standing
    }

    fn begin(&mut self, subject: Subject, means: Means) -> std::io::Result<Measurement> {
        let standing = Mutex::new(Standing::Underway(Step::Rays, 0.0));
        let shared = Arc::new(Shared { is_unwanted: AtomicBool::new(false), standing });
        let (theirs, earlier) = (Arc::clone(&shared), self.thread.take());
        let work = move || {
            let _ = earlier.map(JoinHandle::join);
            theirs.measure(subject, &means);
        };
        self.thread = Some(worker::begin("table", work)?);
        Ok(Measurement { subject, shared, is_over: false })
    }
}
