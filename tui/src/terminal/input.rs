//! Bytes from the terminal to events.
//!
//! Not crossterm's reader: it waits for edges, and of two that come together, a key and a resize,
//! it takes one and never hears of the other again; and it reads the end of its input for ever.

mod parse;

use super::signals::die_by;
use crossterm::event::Event;
use parse::{Parsed, parse};
use rustix::event::{PollFd, PollFlags, Timespec};
use rustix::io::Errno;
use signal_hook::SigId;
use signal_hook::consts::{SIGHUP, SIGWINCH};
use signal_hook::low_level;
use std::collections::VecDeque;
use std::fs::File;
use std::io::{self, IsTerminal, Read};
use std::os::fd::AsFd;
use std::os::unix::net::UnixStream;
use std::time::{Duration, Instant};

/// How long the rest of a sequence may take. An escape without a rest is the key.
const SEQUENCE_GAP: Duration = Duration::from_millis(50);

/// The terminal's input and the news of its size.
#[derive(Debug)]
pub(super) struct Input {
    tty: File,
    /// Readable after SIGWINCH.
    resized: UnixStream,
    resize_handler: SigId,
    events: VecDeque<Event>,
    /// The beginning of a sequence.
    unfinished: Vec<u8>,
}

impl Input {
    /// Listens, from now on also to SIGWINCH: ask for the size afterwards.
    pub(super) fn open() -> io::Result<Self> {
        let stdin = io::stdin();
        let tty = if stdin.is_terminal() {
            File::from(stdin.as_fd().try_clone_to_owned()?)
        } else {
            File::open("/dev/tty")?
        };
        let (resized, told) = UnixStream::pair()?;
        resized.set_nonblocking(true)?;
        Ok(Self {
            tty,
            resized,
            resize_handler: low_level::pipe::register(SIGWINCH, told)?,
            events: VecDeque::new(),
            unfinished: Vec::new(),
        })
    }

    /// The next event; none after `wait`, or never none without it.
    pub(super) fn next(&mut self, wait: Option<Duration>) -> io::Result<Option<Event>> {
        let deadline = wait.map(|wait| Instant::now() + wait);
        loop {
            if let Some(event) = self.events.pop_front() {
                return Ok(Some(event));
            }
            let left = deadline.map(|deadline| deadline.saturating_duration_since(Instant::now()));
            let in_sequence = !self.unfinished.is_empty();
            // Neither shorter nor longer, whatever else is waited for.
            let left = if in_sequence { Some(SEQUENCE_GAP) } else { left };
            let [tty, resized] = self.ready(left)?;
            if resized {
                // Many signals are one resize.
                while matches!((&self.resized).read(&mut [0; 64]), Ok(1..)) {}
                self.events.push_back(Event::Resize(0, 0));
            }
            if tty {
                self.read()?;
            } else if in_sequence && !resized {
                self.take_events(false);
            }
            if self.events.is_empty()
                && deadline.is_some_and(|deadline| Instant::now() >= deadline)
                && self.unfinished.is_empty()
            {
                return Ok(None);
            }
        }
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
                self.unfinished.extend_from_slice(&bytes[..count]);
                self.take_events(true);
            }
            Err(error) if error.raw_os_error() == Some(Errno::IO.raw_os_error()) => {
                return Err(hung_up());
            }
            Err(error)
                if matches!(
                    error.kind(),
                    io::ErrorKind::Interrupted | io::ErrorKind::WouldBlock
                ) => {}
            Err(error) => return Err(error),
        }
        Ok(())
    }

    fn take_events(&mut self, more_may_come: bool) {
        let mut start = 0;
        while let Parsed::Taken(count, event) = parse(&self.unfinished[start..], more_may_come) {
            start += count;
            self.events.extend(event);
        }
        self.unfinished.drain(..start);
    }
}

/// Ends the process as SIGHUP does: only the controlling terminal sends one when it goes.
fn hung_up() -> io::Error {
    die_by(SIGHUP);
    io::ErrorKind::UnexpectedEof.into()
}

impl Drop for Input {
    fn drop(&mut self) {
        low_level::unregister(self.resize_handler);
    }
}
