//! Threads that no one waits for.

use std::io;
use std::process::exit;
use std::thread::{Builder, JoinHandle, panicking};

/// The exit code of a program whose main thread panics.
const PANICKED: i32 = 101;

/// Ends the process when a panic drops it. The hook has told of the panic and given the terminal back by then: a viewer that
/// went on would not be seen.
struct EndsByPanic;

impl Drop for EndsByPanic {
    fn drop(&mut self) {
        if panicking() {
            exit(PANICKED);
        }
    }
}

/// Begins `work` on a thread of its own, which is called `name`. If it panics, the process ends.
///
/// # Errors
/// If the system gives no thread.
pub(super) fn begin(
    name: &str,
    work: impl FnOnce() + Send + 'static,
) -> io::Result<JoinHandle<()>> {
    Builder::new().name(name.to_owned()).spawn(move || {
        let _ends = EndsByPanic;
        work();
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::env;
    use std::process::Command;
    use std::thread::sleep;
    use std::time::Duration;

    /// Set, this program is the one that panics.
    const CHILD: &str = "SPHERULE_TEST_WORKER";

    #[test]
    fn a_panic_ends_the_process() {
        if env::var_os(CHILD).is_some() {
            let _ = begin("worker", || panic!("no one waits for it"));
            sleep(Duration::from_secs(10));
            exit(0);
        }
        let name = "viewer::worker::tests::a_panic_ends_the_process";
        let mut program = Command::new(env::current_exe().expect("a path"));
        let child = program.args([name, "--exact"]).env(CHILD, "1").output().expect("it runs");
        assert_eq!(child.status.code(), Some(PANICKED), "{child:?}");
    }

    #[test]
    fn one_that_does_not_panic_ends_alone() {
        assert!(begin("worker", || {}).expect("a thread").join().is_ok());
    }
}
