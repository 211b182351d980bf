//! Panics of other people's code that are errors here: the program goes on, so no one is told of them.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe, catch_unwind};
use std::sync::Once;

thread_local! {
    static IS_CAUGHT: Cell<bool> = const { Cell::new(false) };
}

/// Whether a panic of this thread is caught.
fn is_caught() -> bool {
    IS_CAUGHT.get()
}

/// From now on `act` is called before a panic is told of. Of one that is caught no one is told.
pub(crate) fn before_message(act: impl Fn() + Send + Sync + 'static) {
    let print = panic::take_hook();
    panic::set_hook(Box::new(move |panic| {
        if !is_caught() {
            act();
            print(panic);
        }
    }));
}

/// What `run` returns; `None` if it panics, which is not reported.
pub fn catch<T>(run: impl FnOnce() -> T) -> Option<T> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| before_message(|| {}));
    IS_CAUGHT.set(true);
    let returned = catch_unwind(AssertUnwindSafe(run));
    IS_CAUGHT.set(false);
    returned.ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_caught_as_long_as_it_runs_and_no_longer() {
        assert_eq!((catch(is_caught), is_caught()), (Some(true), false));
        assert_eq!(catch::<i32>(|| panic!("its bits run out")), None);
        assert!(!is_caught());
    }
}
