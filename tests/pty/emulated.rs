//! A terminal's answers to questions, and the link to it.

use super::session::Keys;
use std::io::Read;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::sync::{Arc, mpsc};
use std::thread;
use std::time::{Duration, Instant};

/// A question, and what is answered.
pub(crate) type Rule = (&'static str, &'static str);

/// The questions.
pub(crate) const ATTRIBUTES: &str = "\x1b[c";
pub(crate) const STATUS: &str = "\x1b[5n";
pub(crate) const SYNCHRONIZED: &str = "\x1b[?2026$p";
pub(crate) const CELL_PIXELS: &str = "\x1b[16t";
pub(crate) const BACKGROUND: &str = "\x1b]11;?\x1b\\";
pub(crate) const PEN: &str = "\x1bP$qm\x1b\\";
pub(crate) const IMAGE: &str = "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\";

/// What the terminal knows, when it answers, and its link.
pub(crate) struct Emulated {
    pub(crate) answers: Manner,
    pub(crate) link: Option<Link>,
}

/// Answers, and the manner in which they come.
#[derive(Clone, Default)]
pub(crate) struct Manner {
    pub(crate) rules: Vec<Rule>,
    /// How late they are.
    pub(crate) delay: Duration,
    /// Whether they come byte by byte.
    pub(crate) is_torn: bool,
}

impl Emulated {
    /// A terminal that draws between brackets, answers how far it has come, and knows nothing else.
    pub(crate) fn good() -> Self {
        Self::with(&[
            (SYNCHRONIZED, "\x1b[?2026;2$y"),
            (STATUS, "\x1b[0n"),
            (ATTRIBUTES, "\x1b[?62;22c"),
        ])
    }

    /// A terminal that answers by these rules, at once.
    pub(crate) fn with(rules: &[Rule]) -> Self {
        let answers = Manner { rules: rules.to_vec(), ..Manner::default() };
        Self { answers, link: None }
    }
}

/// Answers the questions in the output.
pub(crate) struct Answers {
    rules: Vec<Rule>,
    /// How much of the output has been looked at.
    seen: usize,
    queue: mpsc::Sender<(Instant, &'static str)>,
    delay: Duration,
}

impl Answers {
    pub(crate) fn new(manner: Manner, keys: Keys) -> Self {
        let (queue, answers) = mpsc::channel::<(Instant, &'static str)>();
        thread::spawn(move || {
            for (due, answer) in answers {
                thread::sleep(due.saturating_duration_since(Instant::now()));
                let parts = if manner.is_torn { 1 } else { answer.len().max(1) };
                // No key may be typed into the middle of an answer.
                let mut keys = keys.lock().expect("whoever types does not panic");
                for part in answer.as_bytes().chunks(parts) {
                    // The program may be gone.
                    let _ = keys.write_all(part).and_then(|()| keys.flush());
                    if manner.is_torn {
                        thread::sleep(Duration::from_millis(2));
                    }
                }
            }
        });
        Self { rules: manner.rules, seen: 0, queue, delay: manner.delay }
    }

    /// Answers the questions that are new in `sent`.
    pub(crate) fn look(&mut self, sent: &[u8]) {
        while self.seen < sent.len() {
            let rest = &sent[self.seen..];
            let asked =
                self.rules.iter().find(|(question, _)| rest.starts_with(question.as_bytes()));
            if let Some((question, answer)) = asked {
                let _ = self.queue.send((Instant::now() + self.delay, answer));
                self.seen += question.len();
            } else if self.rules.iter().any(|(question, _)| question.as_bytes().starts_with(rest)) {
                // The rest of the question has not come yet.
                return;
            } else {
                self.seen += 1;
            }
        }
    }
}

/// A link that takes a number of bytes at once and carries a number a second.
#[derive(Clone)]
pub(crate) struct Link {
    pub(crate) buffer: usize,
    pub(crate) rate: f64,
    /// While this is set, the link carries nothing.
    pub(crate) is_stalled: Arc<AtomicBool>,
}

/// What a link carries at a time.
const PIECE: usize = 1024;

impl Link {
    pub(crate) fn new(buffer: usize, rate: f64) -> Self {
        Self { buffer, rate, is_stalled: Arc::default() }
    }

    /// Carries what `reader` has to `take`, on threads of its own.
    pub(crate) fn carry(
        self,
        mut reader: Box<dyn Read + Send>,
        mut take: impl FnMut(&[u8]) + Send + 'static,
    ) {
        let (pieces, carried) = mpsc::sync_channel::<Vec<u8>>(self.buffer / PIECE);
        thread::spawn(move || {
            let mut bytes = [0; PIECE];
            while let Ok(count @ 1..) = reader.read(&mut bytes) {
                if pieces.send(bytes[..count].to_vec()).is_err() {
                    return;
                }
            }
        });
        thread::spawn(move || {
            let mut due = Instant::now();
            for piece in carried {
                due = due.max(Instant::now());
                due += Duration::from_secs_f64(piece.len() as f64 / self.rate);
                thread::sleep(due.saturating_duration_since(Instant::now()));
                while self.is_stalled.load(SeqCst) {
                    thread::sleep(Duration::from_millis(1));
                }
                take(&piece);
            }
        });
    }
}
