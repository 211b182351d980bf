//! A picture on a terminal that a signal breaks off: the prompt does not get its colours.

use super::signal::{at_last, end_by, heard, watch};
use super::stdout;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

/// So many bytes are written at a time: a slow link takes them while the process ends.
const PIECE: usize = 4096;
/// CAN, which ends a sequence or a string that is broken off, and no colours.
const CLEANING: &[u8] = b"\x18\x1b[m";

/// Held while a piece is written.
static OUTPUT: Mutex<()> = Mutex::new(());
/// Nothing is written any more.
static IS_OVER: AtomicBool = AtomicBool::new(false);

/// From now on a signal that ends the process first takes its colours from standard output, which is a terminal.
pub fn await_signals() {
    // Where nothing can wait for signals, a picture is shown all the same.
    let _ = watch(heard(), |signal| {
        IS_OVER.store(true, SeqCst);
        at_last(|| {
            let _output = output();
            let _ = stdout::write(CLEANING);
        });
        end_by(signal);
    });
}

/// As [`stdout::write`], but does not return once a signal ends the process.
pub(super) fn write(bytes: &[u8]) -> io::Result<()> {
    for piece in bytes.chunks(PIECE) {
        let output = output();
        if IS_OVER.load(SeqCst) {
            drop(output);
            loop {
                thread::park();
            }
        }
        stdout::write(piece)?;
    }
    Ok(())
}

fn output() -> MutexGuard<'static, ()> {
    OUTPUT.lock().unwrap_or_else(PoisonError::into_inner)
}
