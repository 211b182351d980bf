//! WebAssembly: text is left in memory, where the host of the module reads it. The module imports
//! nothing.

// Unsafe code: symbols for the host.
#![allow(unsafe_code)]

use core::sync::atomic::{AtomicU8, AtomicUsize, Ordering::Relaxed};

static TEXT: [AtomicU8; 1 << 14] = [const { AtomicU8::new(0) }; 1 << 14];
static LENGTH: AtomicUsize = AtomicUsize::new(0);

/// Prints bytes.
pub fn print(text: &[u8]) {
    for &byte in text {
        if let Some(place) = TEXT.get(LENGTH.fetch_add(1, Relaxed)) {
            place.store(byte, Relaxed);
        }
    }
}

/// Returns the program's result to its host.
pub fn exit(is_success: bool) -> bool {
    is_success
}

/// Where the text is.
#[unsafe(no_mangle)]
pub extern "C" fn text() -> *const u8 {
    TEXT.as_ptr().cast()
}

/// The length of the text.
#[unsafe(no_mangle)]
pub extern "C" fn length() -> usize {
    LENGTH.load(Relaxed).min(TEXT.len())
}
