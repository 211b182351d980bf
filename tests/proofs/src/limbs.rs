//! How many limbs exact sums have touched: what they cost.

use core::cell::Cell;
use std::thread_local;

thread_local! {
    static COUNT: Cell<u32> = const { Cell::new(0) };
}

/// Counts a limb.
pub(crate) fn touch() {
    COUNT.set(COUNT.get().wrapping_add(1));
}

/// How many limbs `work` touches, and what it returns.
pub(crate) fn touched<R>(work: impl FnOnce() -> R) -> (u32, R) {
    let before = COUNT.get();
    let result = work();
    (COUNT.get().wrapping_sub(before), result)
}
