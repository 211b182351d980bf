//! Static memory that one function writes to.

use core::cell::UnsafeCell;

/// Memory that one function writes to.
pub(super) struct Memory<T>(UnsafeCell<T>);

// SAFETY: there is one thread.
#[allow(unsafe_code)]
unsafe impl<T> Sync for Memory<T> {}

impl<T> Memory<T> {
    pub(super) const fn new(value: T) -> Self {
        Self(UnsafeCell::new(value))
    }

    /// The memory, to write to.
    #[allow(unsafe_code, clippy::mut_from_ref)]
    pub(super) fn lend(&self) -> &mut T {
        // SAFETY: each memory is lent only once.
        unsafe { &mut *self.0.get() }
    }
}
