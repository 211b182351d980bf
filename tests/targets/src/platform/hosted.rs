//! An operating system, and the standard library.

use std::io::Write as _;

/// Prints bytes.
///
/// # Panics
/// If standard output is closed.
pub fn print(text: &[u8]) {
    std::io::stdout().write_all(text).expect("standard output");
}

/// Ends the program.
pub fn exit(is_success: bool) {
    std::process::exit(i32::from(!is_success));
}
