//! What a test waits for.
//!
//! Nothing here sleeps for a fixed time, except to see that nothing happens. Every wait looks until its condition
//! holds, and a test fails if that takes longer than [`PATIENCE`].

use super::Session;
use crate::pty::output::Output;
use portable_pty::ExitStatus;
use rustix::io::Errno;
use rustix::process::{WaitId, WaitIdOptions, waitid};
use std::fs;
use std::thread;
use std::time::{Duration, Instant};

/// Far longer than anything takes on a loaded machine.
const PATIENCE: Duration = Duration::from_secs(60);
/// The time between two looks at something that does not report changes.
const GLANCE: Duration = Duration::from_millis(2);
/// Far longer than the viewer delays anything: if nothing happens for so long, nothing will.
const STILLNESS: Duration = Duration::from_millis(400);
/// The test itself writes this into the terminal: all output of the program comes before it. No terminal knows this
/// sequence, so none shows it.
const END_MARK: &[u8] = b"\x1b]7777;all has been read\x07";

impl Session {
    /// Waits until `found` finds something in the output, and returns that.
    pub(crate) fn wait_for<T>(&self, what: &str, found: impl Fn(&Output) -> Option<T>) -> T {
        let deadline = Instant::now() + PATIENCE;
        let mut output = self.output();
        loop {
            if let Some(result) = found(&output) {
                return result;
            }
            let left = deadline.saturating_duration_since(Instant::now());
            if left.is_zero() {
                let shown = output.contents();
                drop(output);
                panic!("waited in vain for {what}; the screen shows:\n{shown}");
            }
            output = self.output.1.wait_timeout(output, left).expect("the reader lives").0;
        }
    }

    /// Waits until something is so.
    pub(crate) fn wait_until(&self, what: &str, is_so: impl Fn(&Output) -> bool) {
        self.wait_for(what, |output| is_so(output).then_some(()));
    }

    /// Waits until the screen shows these words.
    pub(crate) fn wait_for_words(&self, words: &str) {
        self.wait_until(words, |output| output.contents().contains(words));
    }

    /// Waits until the viewer's status line has these words.
    pub(crate) fn wait_for_status(&self, words: &str) {
        self.wait_until(words, |output| output.status().contains(words));
    }

    /// Waits until this has been sent.
    pub(crate) fn wait_for_text(&self, text: &str) {
        self.wait_until(&format!("{text:?}"), |output| output.text().contains(text));
    }

    /// Waits until the program neither sends anything nor wakes up for a while.
    pub(crate) fn wait_for_peace(&self) {
        poll("peace", || (!self.stirs()).then_some(()));
    }

    /// Whether the program sends anything or wakes up within a while.
    pub(crate) fn stirs(&self) -> bool {
        let signs = || (self.output().sent.len(), self.sleeps());
        let before = signs();
        thread::sleep(STILLNESS);
        signs() != before
    }

    /// How often the program's threads went to sleep, which is how often they woke up. Only Linux tells.
    fn sleeps(&self) -> u64 {
        let tasks = format!("/proc/{}/task", self.pid);
        let statuses = fs::read_dir(tasks).expect("it runs").filter_map(|task| {
            let status = fs::read_to_string(task.expect("a thread").path().join("status"));
            // A thread that ends meanwhile changes the sum.
            let has_ended =
                |error| matches!(Errno::from_io_error(error), Some(Errno::NOENT | Errno::SRCH));
            if status.as_ref().is_err_and(has_ended) {
                None
            } else {
                Some(status.expect("a status"))
            }
        });
        let sleeps = statuses.map(|status| {
            let line =
                status.lines().find_map(|line| line.strip_prefix("voluntary_ctxt_switches:"));
            line.and_then(|count| count.trim().parse::<u64>().ok()).expect("a count")
        });
        sleeps.sum()
    }

    /// Waits until the program is stopped, as a shell does.
    pub(crate) fn wait_until_stopped(&self) {
        poll("a stop", || {
            let options = WaitIdOptions::STOPPED | WaitIdOptions::NOHANG;
            waitid(WaitId::Pid(self.pid), options).expect("it is our child")
        });
    }

    /// Waits for the program's end, and until all that it has sent is read.
    pub(crate) fn wait_for_end(&mut self) -> ExitStatus {
        let status = self.wait_for_exit();
        rustix::io::write(&self.line, END_MARK).expect("the terminal takes the mark");
        self.wait_until("the last bytes", |output| output.sent.ends_with(END_MARK));
        status
    }

    /// Waits for the program's end, but not for its output.
    pub(crate) fn wait_for_exit(&mut self) -> ExitStatus {
        poll("the end of the program", || self.child.try_wait().expect("it is our child"))
    }

    /// Sees that the program ends, well, and leaves nothing behind.
    pub(crate) fn ends_well(&mut self) {
        let status = self.wait_for_end();
        assert!(status.success(), "{status}");
        assert_eq!(self.left_behind(), [""; 0]);
    }

    /// Sees that a signal of this name ends the program, which leaves nothing behind.
    pub(crate) fn ends_by(&mut self, signal: &str) {
        let status = self.wait_for_end();
        assert_eq!(status.signal(), Some(signal), "{status}");
        assert_eq!(self.left_behind(), [""; 0], "{signal}");
    }

    /// Sees that the program ends well by this key.
    pub(crate) fn quit(&mut self, key: &str) {
        self.type_in(key);
        self.ends_well();
    }
}

fn poll<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let deadline = Instant::now() + PATIENCE;
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(Instant::now() < deadline, "waited in vain for {what}");
        thread::sleep(GLANCE);
    }
}
