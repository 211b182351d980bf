//! The command of `--again`: it runs with its children as a group of processes, which ends as a whole.

use crate::error::Error;
use crate::error::signal::{end_by, heard, watch};
use rustix::process::{Pid, Signal, kill_process_group};
use std::io;
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// The group that runs now.
static GROUP: Mutex<Option<Pid>> = Mutex::new(None);

fn group() -> MutexGuard<'static, Option<Pid>> {
    GROUP.lock().unwrap_or_else(PoisonError::into_inner)
}

fn kill_group() {
    if let Some(pid) = *group() {
        // It may have ended by itself.
        let _ = kill_process_group(pid, Signal::KILL);
    }
}

/// Runs a shell's command with three more arguments. What it says on standard error is seen.
///
/// # Errors
/// [`Error::Running`] if it cannot be run, fails, or takes longer than `patience`.
pub(super) fn run(command: &str, files: [&Path; 3], patience: Duration) -> Result<(), Error> {
    static WATCHED: Once = Once::new();
    WATCHED.call_once(|| {
        // The keys of a terminal reach only our own group. Where nothing can wait for signals, the command runs all the same.
        let _ = watch(heard(), |signal| {
            kill_group();
            end_by(signal);
        });
    });
    let wrong = |what: String| Error::Running(format!("--again: {what}"));
    let failed = |error: io::Error| Error::of_output("--again", &error);
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("{command} \"$@\""), "sh"]).args(files);
    shell.stdin(Stdio::null()).stdout(Stdio::null()).process_group(0);
    let mut child = {
        // A signal that comes now waits until the group is known.
        let mut group = group();
        let child = shell.spawn().map_err(failed)?;
        *group = Some(Pid::from_child(&child));
        child
    };
    let start = Instant::now();
    let ended = loop {
        match child.try_wait() {
            Ok(None) if start.elapsed() < patience => sleep(Duration::from_millis(2)),
            ended => break ended,
        }
    };
    if matches!(ended, Ok(None)) {
        kill_group();
        let _ = child.wait();
    }
    *group() = None;
    match ended.map_err(failed)? {
        Some(status) if status.success() => Ok(()),
        Some(status) => Err(wrong(format!("the command ends with {status}"))),
        None => Err(wrong(format!("the command has not ended in {} s", patience.as_secs_f32()))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn children_of_a_command_that_hangs_end_with_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("written by a child");
        let asked = run("(sleep 1; : >\"$1\"); :", [&file; 3], Duration::from_millis(100));
        let expected = "--again: the command has not ended in 0.1 s";
        assert_eq!(asked, Err(Error::Running(expected.to_owned())));
        sleep(Duration::from_millis(1500));
        assert!(!file.exists());
    }
}
