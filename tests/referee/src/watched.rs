//! An intersector in a thread of its own, since it may panic, hang, or answer too few rays.

use crate::answer::Answer;
use crate::intersector::Intersector;
use spherule_kernel::{Ray, Sphere};
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

/// Why there are no answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mishap {
    /// It panicked, with this message.
    Panicked(String),
    /// It has not returned in time.
    Hung(Duration),
    /// The number of answers is not that of rays.
    Count {
        /// Answers.
        answers: usize,
        /// Rays.
        rays: usize,
    },
    /// There is no thread for it.
    NoThread,
}

impl fmt::Display for Mishap {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Panicked(message) => write!(formatter, "panicked: {message}"),
            Self::Hung(time) => write!(formatter, "has not returned in {} s", time.as_secs_f64()),
            Self::Count { answers, rays } => write!(formatter, "{answers} answers to {rays} rays"),
            Self::NoThread => formatter.write_str("no thread for it"),
        }
    }
}

/// A question to an intersector.
#[derive(Clone, Debug)]
pub struct Question {
    /// The spheres.
    pub spheres: Vec<Sphere>,
    /// The rays.
    pub rays: Vec<Ray>,
    /// Whether ray i is asked against sphere i alone.
    pub pairs: bool,
}

type Reply = Result<Vec<Option<Answer>>, String>;
type Worker = (Sender<Question>, Receiver<Reply>);

/// An intersector, and another to go on with after a mishap.
#[derive(Debug)]
pub struct Watched<I> {
    spare: I,
    patience: Duration,
    worker: Option<Worker>,
}

impl<I: Intersector + Clone + Send + 'static> Watched<I> {
    /// Waits as long as `patience` for every answer.
    #[must_use]
    pub fn new(intersector: &I, patience: Duration) -> Self {
        Self { spare: intersector.clone(), patience, worker: None }
    }

    /// Asks.
    ///
    /// # Errors
    /// What went wrong; the next question goes to a new clone. A thread that hangs is left behind.
    pub fn ask(&mut self, question: &Question) -> Result<Vec<Option<Answer>>, Mishap> {
        let rays = question.rays.len();
        let (questions, replies) = match self.worker.take() {
            Some(worker) => worker,
            None => start(self.spare.clone()).ok_or(Mishap::NoThread)?,
        };
        if questions.send(question.clone()).is_err() {
            return Err(Mishap::NoThread);
        }
        match replies.recv_timeout(self.patience) {
            Ok(Ok(answers)) if answers.len() == rays => {
                self.worker = Some((questions, replies));
                Ok(answers)
            }
            Ok(Ok(answers)) => Err(Mishap::Count { answers: answers.len(), rays }),
            Ok(Err(message)) => Err(Mishap::Panicked(message)),
            Err(RecvTimeoutError::Timeout) => Err(Mishap::Hung(self.patience)),
            Err(RecvTimeoutError::Disconnected) => Err(Mishap::NoThread),
        }
    }
}

fn start<I: Intersector + Send + 'static>(mut intersector: I) -> Option<Worker> {
    let (questions, inbox) = channel::<Question>();
    let (outbox, replies) = channel();
    let work = move || {
        for Question { spheres, rays, pairs } in inbox {
            let answer = || {
                if pairs {
                    intersector.pairs(&spheres, &rays)
                } else {
                    intersector.closest_hits(&spheres, &rays)
                }
            };
            // After a panic this thread ends, and the intersector with it.
            let reply = catch_unwind(AssertUnwindSafe(answer)).map_err(|panic| {
                let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
                let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
                text.unwrap_or_else(|| "without a message".to_owned())
            });
            if outbox.send(reply).is_err() {
                return;
            }
        }
    };
    thread::Builder::new().name("judged".to_owned()).spawn(work).ok()?;
    Some((questions, replies))
}
