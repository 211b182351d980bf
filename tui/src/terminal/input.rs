//! From the bytes of the terminal to what the user does and what the terminal answers.
//!
//! This is not crossterm's reader. That one waits for edges, and of a key and a resize that come together it takes one
//! and never hears of the other again. It reads the end of its input for ever. It hands on no answers, but takes those
//! that it does not know for keys.

mod parse;

use super::signals::die_by;
use super::tty;
use crossterm::event::Event;
pub use parse::Incoming;
use parse::{Parsed, is_string, may_be_a_key, parse};
use rustix::event::{PollFd, PollFlags, Timespec};
use rustix::io::Errno;
use signal_hook::SigId;
use signal_hook::consts::{SIGHUP, SIGWINCH};
use signal_hook::low_level;
use std::collections::VecDeque;
use std::fs::File;
use std::io::{self, Read};
use std::os::unix::net::UnixStream;
use std::time::{Duration, Instant};

/// An escape that nothing follows for so long is the key, unless an answer is awaited.
const KEY_GAP: Duration = Duration::from_millis(50);
/// How long the rest of an answer may take. After that, the part that has come is dropped: keys act again.
const ANSWER_GAP: Duration = Duration::from_millis(500);
/// How long a question is open, whatever the terminal does.
const ANSWER_TIME: Duration = Duration::from_secs(5);
/// How much of a string is kept: more than any that is understood, so that a part of a long one is no answer.
const LONGEST_STRING: usize = 1024;

/// The terminal's input and the news of its size.
#[derive(Debug)]
pub(super) struct Input {
    tty: File,
    /// Readable after SIGWINCH.
    resized: UnixStream,
    resize_handler: SigId,
    incoming: VecDeque<Incoming>,
    /// The beginning of a sequence, and when the last byte of it came.
    unfinished: Vec<u8>,
    last_byte: Instant,
    /// Until then an escape may be the beginning of an answer.
    awaits_answers: Option<Instant>,
}

impl Input {
    /// Listens to the terminal, and from now on also to SIGWINCH: ask for the size afterwards.
    pub(super) fn open() -> io::Result<Self> {
        Self::reading(tty::open()?)
    }

    fn reading(tty: File) -> io::Result<Self> {
        let (resized, told) = UnixStream::pair()?;
        resized.set_nonblocking(true)?;
        Ok(Self {
            tty,
            resized,
            resize_handler: low_level::pipe::register(SIGWINCH, told)?,
            incoming: VecDeque::new(),
            unfinished: Vec::new(),
            last_byte: Instant::now(),
            awaits_answers: None,
        })
    }

    /// Tells that the terminal has been asked something, or that it has answered everything.
    pub(super) fn await_answers(&mut self, are_open: bool) {
        self.awaits_answers = are_open.then(|| Instant::now() + ANSWER_TIME);
    }

    /// The next thing that comes; `None` if nothing comes within `wait`. Without `wait`, it waits for ever.
    pub(super) fn next(&mut self, wait: Option<Duration>) -> io::Result<Option<Incoming>> {
        let deadline = wait.map(|wait| Instant::now() + wait);
        loop {
            if let Some(incoming) = self.incoming.pop_front() {
                return Ok(Some(incoming));
            }
            let now = Instant::now();
            let given_up = self.given_up_at();
            let until = deadline.into_iter().chain(given_up).min();
            let [tty, resized] =
                self.ready(until.map(|until| until.saturating_duration_since(now)))?;
            if resized {
                // Many signals are one resize.
                while matches!((&self.resized).read(&mut [0; 64]), Ok(1..)) {}
                self.incoming.push_back(Incoming::User(Event::Resize(0, 0)));
            }
            // What has come while no one listened is read before anything is given up.
            if tty {
                self.read()?;
            } else if given_up.is_some_and(|at| Instant::now() >= at) {
                self.take_incoming(false);
            }
            if self.incoming.is_empty() && deadline.is_some_and(|at| Instant::now() >= at) {
                return Ok(None);
            }
        }
    }

    /// When the beginning of a sequence is given up, since no more of it will come.
    fn given_up_at(&self) -> Option<Instant> {
        let is_awaited = self.awaits_answers.is_some_and(|until| self.last_byte < until);
        let gap = if may_be_a_key(&self.unfinished) && !is_awaited { KEY_GAP } else { ANSWER_GAP };
        (!self.unfinished.is_empty()).then(|| self.last_byte + gap)
    }

    /// Whether there is input, and whether there is news of the size.
    fn ready(&self, wait: Option<Duration>) -> io::Result<[bool; 2]> {
        let mut watched =
            [PollFd::new(&self.tty, PollFlags::IN), PollFd::new(&self.resized, PollFlags::IN)];
        let wait = wait.and_then(|wait| Timespec::try_from(wait).ok());
        match rustix::event::poll(&mut watched, wait.as_ref()) {
            // A hang-up is found by reading.
            Ok(_) => Ok([0, 1].map(|i| !watched[i].revents().is_empty())),
            Err(Errno::INTR) => Ok([false; 2]),
            Err(error) => Err(error.into()),
        }
    }

    fn read(&mut self) -> io::Result<()> {
        let mut bytes = [0; 4096];
        match self.tty.read(&mut bytes) {
            Ok(0) => return Err(hung_up()),
            Ok(count) => {
                self.last_byte = Instant::now();
                self.unfinished.extend_from_slice(&bytes[..count]);
                self.take_incoming(true);
            }
            Err(error)
                if matches!(
                    error.kind(),
                    io::ErrorKind::Interrupted | io::ErrorKind::WouldBlock
                ) => {}
            Err(error) => return Err(or_hung_up(error)),
        }
        Ok(())
    }

    fn take_incoming(&mut self, more_may_come: bool) {
        let mut start = 0;
        while let Parsed::Taken(count, incoming) = parse(&self.unfinished[start..], more_may_come) {
            start += count;
            self.incoming.extend(incoming);
        }
        self.unfinished.drain(..start);
        if is_string(&self.unfinished) && self.unfinished.len() > LONGEST_STRING {
            // An escape at the end may be that of the terminator.
            let last = self.unfinished.last().filter(|&&byte| byte == 0x1b).copied();
            self.unfinished.truncate(LONGEST_STRING);
            self.unfinished.extend(last);
        }
    }
}

/// Ends the process as SIGHUP does, since only the controlling terminal sends that when it goes.
fn hung_up() -> io::Error {
    die_by(SIGHUP);
    io::ErrorKind::UnexpectedEof.into()
}

/// A terminal that goes away in the middle of a frame is treated as one that is found gone when it is read.
pub(super) fn or_hung_up(error: io::Error) -> io::Error {
    let is_gone = error.raw_os_error() == Some(Errno::IO.raw_os_error());
    if is_gone { hung_up() } else { error }
}

impl Drop for Input {
    fn drop(&mut self) {
        low_level::unregister(self.resize_handler);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crossterm::event::KeyCode;
    use std::io::Write;
    use std::os::fd::OwnedFd;
    use std::thread;

    fn input() -> (Input, UnixStream) {
        let (ours, theirs) = UnixStream::pair().expect("a socket");
        (Input::reading(OwnedFd::from(ours).into()).expect("signals"), theirs)
    }

    /// The keys that act, of all that comes until there is silence for twice as long as anything is waited for.
    fn keys(input: &mut Input) -> Vec<KeyCode> {
        let mut keys = Vec::new();
        while let Some(incoming) = input.next(Some(2 * ANSWER_GAP)).expect("it listens") {
            if let Incoming::User(Event::Key(key)) = incoming {
                keys.push(key.code);
            }
        }
        keys
    }

    /// With pauses that are longer than an escape takes to be a key.
    #[test]
    fn an_answer_that_comes_in_two_parts_is_no_key() {
        let answers = [
            "\x1bP>|tmux 3.3a q\x1b\\",
            "\x1b]11;rgb:2828/2c2c/3434\x1b\\",
            "\x1b_Gi=1;OK q\x1b\\",
            "\x1b[?62;4;22c",
            "\x1b[?2026;2$y",
            "\x1b[6;20;10t",
            "\x1b[0n",
        ];
        let cases =
            answers.into_iter().flat_map(|answer| (1..answer.len()).map(move |at| (answer, at)));
        let threads: Vec<_> = cases
            .map(|(answer, at)| {
                thread::spawn(move || {
                    let (mut input, mut terminal) = input();
                    input.await_answers(true);
                    let (first, second) = answer.split_at(at);
                    let writer = thread::spawn(move || {
                        terminal.write_all(first.as_bytes()).expect("it listens");
                        thread::sleep(3 * KEY_GAP);
                        write!(terminal, "{second}k").expect("it listens");
                        terminal
                    });
                    let keys = keys(&mut input);
                    drop(writer.join());
                    assert_eq!(keys, [KeyCode::Char('k')], "{answer:?} at {at}");
                })
            })
            .collect();
        for thread in threads {
            thread.join().expect("no key of an answer");
        }
    }

    #[test]
    fn a_string_that_never_ends_is_dropped_and_keys_act_again() {
        let (mut input, mut terminal) = input();
        terminal.write_all(b"\x1b]11;rgb:q").expect("it listens");
        assert_eq!(keys(&mut input), []);
        terminal.write_all(b"q").expect("it listens");
        assert_eq!(keys(&mut input), [KeyCode::Char('q')]);
        // One that goes on for ever takes no memory, and no time of whoever waits for something else.
        terminal.write_all(b"\x1b]").expect("it listens");
        for _ in 0..100 {
            terminal.write_all(&[b'q'; 1000]).expect("it listens");
            let since = Instant::now();
            assert_eq!(input.next(Some(Duration::from_millis(1))).expect("it listens"), None);
            assert!(since.elapsed() < ANSWER_GAP);
            assert!(input.unfinished.len() <= LONGEST_STRING + 1);
        }
        terminal.write_all(b"\x1b\\k").expect("it listens");
        assert_eq!(keys(&mut input), [KeyCode::Char('k')]);
        // Whoever types Ctrl-C into one is heard.
        terminal.write_all(b"\x1b]11;q\x03").expect("it listens");
        assert_eq!(keys(&mut input), [KeyCode::Char('c')]);
    }

    #[test]
    fn an_escape_is_a_key_soon_and_while_answers_are_awaited_later() {
        let (mut input, mut terminal) = input();
        for (awaited, soon) in [(false, true), (true, false), (false, true)] {
            input.await_answers(awaited);
            terminal.write_all(b"\x1b").expect("it listens");
            let key = input.next(Some(3 * KEY_GAP)).expect("it listens");
            assert_eq!(key.is_some(), soon);
            assert_eq!(keys(&mut input).len(), usize::from(!soon));
        }
        // The answer that comes next tells at once that it was the key.
        input.await_answers(true);
        terminal.write_all(b"\x1b\x1b[0n").expect("it listens");
        let key = input.next(Some(Duration::ZERO)).expect("it listens");
        assert!(matches!(key, Some(Incoming::User(Event::Key(key))) if key.code == KeyCode::Esc));
    }
}
