//! Long runs, which a test makes only on request.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::thread::{available_parallelism, scope};

/// Calls `work` with each number below `count`, on all cores, and prints its progress.
///
/// # Panics
/// If `work` does.
pub fn on_all_cores(count: u64, work: impl Fn(u64) + Sync) {
    let next = AtomicU64::new(0);
    let worker = || {
        loop {
            let number = next.fetch_add(1, Relaxed);
            if number >= count {
                return;
            }
            work(number);
            if number.is_multiple_of(count.div_ceil(100)) {
                println!("{number} of {count}");
            }
        }
    };
    let threads = available_parallelism().map_or(1, usize::from);
    scope(|scope| (0..threads).for_each(|_| drop(scope.spawn(worker))));
}
