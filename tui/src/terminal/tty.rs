//! The terminal on which keys are typed.

use std::fs::File;
use std::io::{self, IsTerminal};
use std::os::fd::AsFd;

/// Standard input if that is a terminal, else the one that controls the process.
///
/// # Errors
/// If there is none.
pub(super) fn open() -> io::Result<File> {
    let stdin = io::stdin();
    if stdin.is_terminal() {
        Ok(File::from(stdin.as_fd().try_clone_to_owned()?))
    } else {
        File::open("/dev/tty")
    }
}
