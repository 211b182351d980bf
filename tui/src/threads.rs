//! Work for all cores: tasks handed out one by one, so that a thread whose tasks are short takes
//! more of them.

use crate::error::{Error, cause};
use rayon::iter::{ParallelBridge, ParallelIterator};
use rayon::{ThreadPool, ThreadPoolBuilder, current_thread_index};
use spherule_kernel::Join;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};
use std::thread::{available_parallelism, sleep};
use std::time::Duration;
use std::{io, iter};

/// The most threads that there can be.
pub const MOST_THREADS: u16 = 1024;

/// The fewest and the most packets of a task: enough that brute force prepares its spheres for many at a time, few
/// enough that they stay in the cache.
const PACKETS: (usize, usize) = (16, 1024);
/// The number of tasks, if there are packets for them: so many that threads end at about the same time.
const TASKS: usize = 128;

/// Returns how many of `packets` packets a task should have.
///
/// The result does not depend on the number of threads, so that the packets that go through a structure together are
/// always the same ones.
#[must_use]
pub fn packets_a_task(packets: usize) -> usize {
    (packets / TASKS).next_multiple_of(PACKETS.0).clamp(PACKETS.0, PACKETS.1)
}

/// As [`packets_a_task`], for rays that go through a tree. A task then has at least as many rays as the tree sorts if
/// they are shuffled, or an eighth of all if that is less.
#[must_use]
pub fn packets_a_tree_task(packets: usize) -> usize {
    /// 32,768 rays; of fewer than 24,000 the kernel sorts none.
    const SORTED: usize = 2048;
    let wanted = SORTED.min(packets / 8);
    packets_a_task(packets).max(wanted.next_multiple_of(PACKETS.0))
}

/// A number of threads. A single thread is the caller's own, unless it is [apart](Threads::apart): then there is no pool.
#[derive(Debug, Default)]
pub struct Threads {
    pool: Option<ThreadPool>,
    /// Whether no one waits any more for what is shared.
    are_stopped: AtomicBool,
}

impl Threads {
    /// Makes `count` threads. If that is `None`, it makes as many as the machine has cores, or fewer if the system does not
    /// give so many.
    ///
    /// # Errors
    /// [`Error::Running`] if the system does not give `count` threads.
    pub fn new(count: Option<u16>) -> Result<Self, Error> {
        let build = |count| ThreadPoolBuilder::new().num_threads(count).build();
        let pool = match count {
            Some(0 | 1) => None,
            Some(count) => Some(build(count.into()).map_err(|error| {
                Error::Running(format!("{count} threads: {}", cause(&io::Error::other(error))))
            })?),
            None => as_many(available_parallelism().map_or(1, NonZeroUsize::get), build),
        };
        Ok(Self { pool, ..Self::default() })
    }

    /// The same threads, except that a single one is not the caller's own if the system gives another. What a thread keeps, such as the
    /// kernel's memory, then outlives its callers.
    #[must_use]
    pub fn apart(self) -> Self {
        let single = || ThreadPoolBuilder::new().num_threads(1).build().ok();
        Self { pool: self.pool.or_else(single), ..self }
    }

    /// How many.
    #[must_use]
    pub fn count(&self) -> usize {
        self.pool.as_ref().map_or(1, ThreadPool::current_num_threads)
    }

    /// Tells, from another thread, that no one waits any more for what is shared: tasks that have not begun are left out,
    /// and long ones end when they [ask](Threads::are_stopped). Whoever stops them must throw the results away.
    pub fn stop(&self) {
        self.are_stopped.store(true, Relaxed);
    }

    /// Lets the next tasks be done again.
    pub fn go_on(&self) {
        self.are_stopped.store(false, Relaxed);
    }

    /// Whether no one waits any more.
    #[must_use]
    pub fn are_stopped(&self) -> bool {
        self.are_stopped.load(Relaxed)
    }

    /// Calls `work` with every task, on all threads at once, unless they are [stopped](Threads::stop). Each thread has one
    /// of the `memories`, which grow to the number of threads.
    ///
    /// The thread that gets a task is left to chance: the result of a task must not depend on the
    /// contents of the memory.
    pub fn share<M: Default + Send, T: Send>(
        &self,
        memories: &mut Vec<M>,
        tasks: impl Iterator<Item = T> + Send,
        work: impl Fn(&mut M, T) + Sync,
    ) {
        memories.resize_with(self.count(), M::default);
        // Not `for_each_init`, which makes a memory for each piece of work: these memories outlive a picture.
        let memories: Vec<_> = memories.iter_mut().map(Mutex::new).collect();
        let work = |task| {
            if self.are_stopped() {
                return;
            }
            // Never waits: no two threads have the same index, and one does a task at a time.
            let own = &memories[current_thread_index().unwrap_or(0)];
            work(&mut own.lock().unwrap_or_else(PoisonError::into_inner), task);
        };
        // (A scope whose jobs call one trait object compiles rayon's code once, but saves only a hundredth of the program's code.)
        match &self.pool {
            Some(pool) => pool.install(|| tasks.par_bridge().for_each(work)),
            None => tasks.for_each(work),
        }
    }
}

/// What `build` makes of `count` threads, or of the half if it cannot, and so on; `None` if only the caller's own is left.
fn as_many<P, E>(count: usize, build: impl Fn(usize) -> Result<P, E>) -> Option<P> {
    let counts = iter::successors(Some(count), |count| Some(count / 2));
    // Threads of the last try must have ended: they count, too.
    let rest = |_| sleep(Duration::from_millis(20));
    counts.take_while(|&count| count > 1).find_map(|count| build(count).map_err(rest).ok())
}

impl Join for Threads {
    fn join<A: Send, B: Send>(
        &self,
        one: impl FnOnce() -> A + Send,
        other: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        match &self.pool {
            Some(pool) => pool.join(one, other),
            None => (one(), other()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Barrier;
    use std::thread;

    fn threads(count: u16) -> Threads {
        Threads::new(Some(count)).expect("threads")
    }

    #[test]
    fn a_tree_has_as_many_as_it_sorts() {
        let lengths = [0, 128, 4096, 16_384, 1 << 20, 1 << 24];
        let expected = [16, 16, 512, 2048, 2048, 2048];
        assert_eq!(lengths.map(packets_a_tree_task), expected);
    }

    #[test]
    fn every_task_is_done_once() {
        for count in [1, 2, 5] {
            let (threads, mut done) = (threads(count), Vec::new());
            assert_eq!(threads.count(), usize::from(count));
            threads.share(&mut done, 0..1000, |done: &mut Vec<i32>, task| done.push(task));
            assert_eq!(done.len(), threads.count());
            let mut all = done.concat();
            all.sort_unstable();
            assert!(all.into_iter().eq(0..1000), "{count}");
        }
    }

    #[test]
    fn stopped_threads_leave_out_what_has_not_begun() {
        for count in [1, 2] {
            let (threads, mut done) = (threads(count), Vec::new());
            threads.share(&mut done, 0..1000, |done: &mut usize, _| {
                threads.stop();
                *done += 1;
            });
            // Each thread may have begun with one.
            let sum = done.iter().sum::<usize>();
            assert!((1..=usize::from(count)).contains(&sum) && threads.are_stopped(), "{done:?}");
            threads.go_on();
            // The memories stay.
            threads.share(&mut done, 0..1000, |done: &mut usize, _| *done += 1);
            assert_eq!(done.iter().sum::<usize>(), sum + 1000);
        }
    }

    #[test]
    fn where_the_system_gives_few_threads_there_are_few() {
        for (count, most, expected) in
            [(128, 128, Some(128)), (128, 100, Some(64)), (7, 3, Some(3)), (128, 1, None)]
        {
            let build = |count: usize| if count <= most { Ok(count) } else { Err(()) };
            assert_eq!(as_many(count, build), expected, "{count} of {most}");
        }
        assert_eq!(as_many(1, Ok::<_, ()>), None);
    }

    #[test]
    fn two_pieces_of_work_are_joined() {
        for count in [1, 2] {
            assert_eq!(threads(count).join(|| 1, || "one"), (1, "one"));
        }
    }

    /// Both tasks wait for each other: on fewer than two threads this does not end.
    #[test]
    fn threads_work_at_the_same_time() {
        let meeting = Barrier::new(2);
        threads(2).share(&mut Vec::new(), 0..2, |(), _| {
            meeting.wait();
        });
    }

    /// Else what it keeps would be lost with every picture.
    #[test]
    fn a_thread_apart_is_the_same_for_all_callers() {
        let threads = threads(1).apart();
        let id = || thread::current().id();
        let work = || {
            let mut seen = Vec::new();
            threads.share(&mut seen, 0..1, |seen: &mut Option<_>, _| *seen = Some(id()));
            seen
        };
        let by_another = thread::scope(|scope| scope.spawn(work).join().expect("no panic"));
        assert_eq!((threads.count(), &by_another), (1, &work()));
        assert_ne!(by_another, [Some(id())]);
        assert_eq!(threads.join(|| 1, || "one"), (1, "one"));
    }

    #[test]
    fn one_thread_is_the_caller_s() {
        let here = thread::current().id();
        threads(1).share(&mut Vec::new(), 0..3, |(), _| {
            assert_eq!(thread::current().id(), here);
        });
    }
}
