//! Signals that end the process: a thread of its own waits for them, so that what must be done before is done.

use signal_hook::consts::{
    SIGALRM, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU, SIGXFSZ,
};
use signal_hook::flag;
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, mpsc};
use std::time::Duration;
use std::{fs, io, process, thread};

/// Those that come from the user, other processes and the system, and end a process without a handler.
pub const ENDING: [i32; 8] = [SIGTERM, SIGHUP, SIGINT, SIGQUIT, SIGXCPU, SIGUSR1, SIGUSR2, SIGALRM];

/// How long a terminal that takes no output may hold up the end of the process.
const GRACE: Duration = Duration::from_secs(1);

/// Those of [`ENDING`] that are not ignored. Whoever started the process may want them to do nothing, as `nohup` does with
/// SIGHUP, and a script with SIGINT for what it starts in the background: a handler would undo that. Linux tells; on other
/// systems it is assumed of SIGHUP alone.
#[must_use]
pub fn heard() -> Vec<i32> {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    let is_heard =
        |signal: i32| mask.map_or(signal != SIGHUP, |ignored| ignored >> (signal - 1) & 1 == 0);
    ENDING.into_iter().filter(|&signal| is_heard(signal)).collect()
}

/// Calls `act` with every signal of `signals` that comes from now on, in a thread of its own. From now on a file that may
/// not grow is an error for whoever writes it, too, and does not end the process.
///
/// # Errors
/// If nothing can wait for them.
pub fn watch(
    signals: impl IntoIterator<Item = i32>,
    mut act: impl FnMut(i32) + Send + 'static,
) -> io::Result<()> {
    flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)))?;
    let signals: Vec<i32> = signals.into_iter().collect();
    let (tell, told) = mpsc::channel();
    thread::Builder::new().name("signals".into()).spawn(move || {
        // Not before there is a thread: signals that no one took would do nothing at all.
        let mut signals = match Signals::new(signals) {
            Ok(signals) => signals,
            Err(error) => {
                let _ = tell.send(Err(error));
                return;
            }
        };
        let _ = tell.send(Ok(()));
        for signal in signals.forever() {
            act(signal);
        }
    })?;
    told.recv().unwrap_or_else(|_| Err(io::ErrorKind::Other.into()))
}

/// Does `work` before the end, in a thread of its own, and waits for it a second at most.
pub fn at_last(work: impl FnOnce() + Send + 'static) {
    within(GRACE, work);
}

/// The same, and waits for it for `limit` at most.
pub fn within(limit: Duration, work: impl FnOnce() + Send + 'static) {
    let (done, has_ended) = mpsc::channel();
    let working = thread::Builder::new().spawn(move || {
        work();
        let _ = done.send(());
    });
    if working.is_ok() {
        let _ = has_ended.recv_timeout(limit);
    }
}

/// Lets `signal` do what it does to a process without a handler, so that whoever waits for us learns of it.
pub fn end_by(signal: i32) {
    // The system spares an init such signals: it ends with the exit code that shells give.
    if rustix::process::getpid().is_init() {
        process::exit(128 + signal);
    }
    let _ = emulate_default_handler(signal);
}
