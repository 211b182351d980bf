//! The terminal on which keys are typed.

use rustix::termios::tcgetpgrp;
use std::fs::File;
use std::io::{self, IsTerminal};
use std::os::fd::AsFd;

/// A name for any terminal that controls the process. macOS's poll does not know it by that.
const CONTROLLING: &str = "/dev/tty";

/// Standard input if that is a terminal, else the one that controls the process.
///
/// # Errors
/// If there is none.
pub(super) fn open() -> io::Result<File> {
    let stdin = io::stdin();
    if stdin.is_terminal() {
        return Ok(File::from(stdin.as_fd().try_clone_to_owned()?));
    }
    let outputs = [
        ("/dev/fd/1", controls_process(io::stdout())),
        ("/dev/fd/2", controls_process(io::stderr())),
    ];
    // One that is another user's cannot be opened so.
    let by_output = outputs.into_iter().filter(|&(_, controls)| controls);
    let opened = by_output.map(|(name, _)| File::open(name)).find_map(Result::ok);
    opened.map_or_else(|| File::open(CONTROLLING), Ok)
}

/// Whether an output goes to the terminal that controls the process.
fn controls_process(output: impl AsFd) -> bool {
    // Of another one the system does not tell which group is in front.
    tcgetpgrp(output).is_ok()
}
