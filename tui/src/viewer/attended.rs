//! Work during which the waiting thread still handles input, and may cancel it.

use crate::error::Error;
use crate::threads::Threads;
use std::panic::resume_unwind;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread::{Builder, scope};
use std::time::Duration;

/// The time between two calls of `look`; work that ends sooner gets none.
const LOOK: Duration = Duration::from_millis(20);

/// Stops the threads when it is dropped: after an error and a panic, too.
struct Attendance<'a>(&'a Threads);

impl Drop for Attendance<'_> {
    fn drop(&mut self) {
        self.0.stop();
    }
}

/// Does `work`, which `threads` share, on a thread of its own, and calls `look` every now and then until it has ended.
/// When a look returns that the work is not wanted, the threads are stopped, and nothing is returned. If the system gives no
/// thread, the work is done on this one, and there is no look.
///
/// # Errors
/// The first error of `look`.
pub(super) fn attend<T: Send>(
    threads: &Threads,
    work: impl FnOnce() -> T + Send,
    look: impl FnMut() -> Result<bool, Error>,
) -> Result<Option<T>, Error> {
    attend_on(Builder::new().name("picture".to_owned()), threads, work, look)
}

/// The same, on a thread that `builder` makes.
fn attend_on<T: Send>(
    builder: Builder,
    threads: &Threads,
    work: impl FnOnce() -> T + Send,
    mut look: impl FnMut() -> Result<bool, Error>,
) -> Result<Option<T>, Error> {
    let (working, ended) = channel::<()>();
    // A thread that cannot be made would take the work with it.
    let work = Mutex::new(Some(work));
    let run = || {
        let work = work.lock().unwrap_or_else(PoisonError::into_inner).take();
        work.map(|work| work())
    };
    let done: Result<Option<T>, Error> = scope(|scope| {
        let thread = builder.spawn_scoped(scope, move || {
            // Dropped at the end, whether it is an end or a panic.
            let _working = working;
            run()
        });
        let Ok(thread) = thread else { return Ok(run()) };
        let attendance = Attendance(threads);
        let mut is_wanted = true;
        while is_wanted && ended.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
            is_wanted = look()?;
        }
        drop(attendance);
        match thread.join() {
            Ok(done) => Ok(done.filter(|_| is_wanted)),
            Err(panic) => resume_unwind(panic),
        }
    });
    threads.go_on();
    done
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::thread::{current, sleep};
    use std::time::Instant;

    const SOON: Duration = Duration::from_secs(2);

    /// Work that takes a minute, if it is not ended.
    fn attend_to_slow_work(
        threads: &Threads,
        look: impl FnMut() -> Result<bool, Error>,
    ) -> Result<Option<usize>, Error> {
        let work = || {
            let mut done = Vec::new();
            threads.share(&mut done, 0..12_000, |done: &mut usize, _| {
                sleep(Duration::from_millis(10));
                *done += 1;
            });
            done.into_iter().sum::<usize>()
        };
        attend(threads, work, look)
    }

    #[test]
    fn work_that_is_not_wanted_ends_soon() {
        for count in [1, 2] {
            let (threads, began) = (Threads::new(Some(count)).expect("threads"), Instant::now());
            let mut looks = 0;
            let found = attend_to_slow_work(&threads, || {
                looks += 1;
                Ok(looks < 3)
            });
            assert_eq!((found, looks), (Ok(None), 3));
            let failure = || Error::Running("the terminal is gone".to_owned());
            assert_eq!(attend_to_slow_work(&threads, || Err(failure())), Err(failure()));
            assert!(began.elapsed() < SOON && !threads.are_stopped());
        }
    }

    #[test]
    fn without_another_thread_it_is_done_on_this_one() {
        // No system has memory for such a stack.
        let builder = Builder::new().stack_size(1 << (usize::BITS - 1));
        let (threads, work) = (Threads::default(), || current().id());
        let done = attend_on(builder, &threads, work, || panic!("there is no look"));
        assert_eq!(done, Ok(Some(current().id())));
    }

    #[test]
    fn a_panic_of_whoever_looks_ends_it_too() {
        let (threads, began) = (Threads::default(), Instant::now());
        let looked = || attend_to_slow_work(&threads, || panic!("while it works"));
        assert!(catch_unwind(AssertUnwindSafe(looked)).is_err());
        assert!(began.elapsed() < SOON);
    }

    #[test]
    fn what_is_done_is_returned_and_a_panic_of_it_is_one_here() {
        let threads = Threads::default();
        let mut looks = 0;
        let slow = || {
            sleep(5 * LOOK);
            "done"
        };
        let look = || {
            looks += 1;
            Ok(true)
        };
        assert_eq!(attend(&threads, slow, look), Ok(Some("done")));
        assert!(looks > 0);
        let work = || -> bool { panic!("while it is looked at") };
        let panicking = || attend(&threads, work, || Ok(true));
        assert!(catch_unwind(AssertUnwindSafe(panicking)).is_err());
    }
}
