//! What a caller says of the rays, and of the way in which they are traced.

use crate::bvh::StreamMemory;
#[cfg(feature = "alloc")]
use crate::bvh::traverse::stream::KeptMemory;
use crate::coherence::Coherence;
use crate::coherent::learnt::Learnt;
use crate::dispatch::Level;

/// How rays are traced: at which level, what is known of them, and with what working memory. No answer
/// depends on it.
///
/// ```
/// use spherule_kernel::{Level, LevelName, Trace};
///
/// let mut memory = [0.0; 1536];
/// let trace = Trace::new().incoherent().with_scratch(&mut memory);
/// let baseline = Trace::new().at(Level::named(LevelName::Baseline).unwrap_or(trace.level));
/// assert!(baseline.level.name() <= trace.level.name());
/// ```
#[derive(Debug)]
#[non_exhaustive]
pub struct Trace<'m> {
    /// The instruction set.
    pub level: Level,
    /// What the rays have in common, if it is known.
    pub coherence: Coherence,
    /// Working memory of a [`DepthList`](crate::DepthList), as long as its `scratch` says; others need
    /// none.
    pub scratch: &'m mut [f32],
    /// Working memory of a tree's streams, of the caller's. Without, and with feature `alloc`, a call takes it by itself where
    /// it gains by it: at most 3.5 MB, and 6 where the rays of a large tree are sorted; the thread keeps it for its next call (without
    /// `std` the trace does). If there is none a call does without.
    pub stream: Option<StreamMemory<'m>>,
    /// What calls have taken for streams.
    #[cfg(feature = "alloc")]
    pub(crate) kept: KeptMemory,
    /// What calls have learnt of their rays.
    pub(crate) learnt: Learnt,
}

impl<'m> Trace<'m> {
    /// At the best level that the CPU has; coherence is detected; no scratch memory.
    ///
    /// ```
    /// use spherule_kernel::{Coherence, Level, Trace};
    ///
    /// let trace = Trace::new();
    /// assert_eq!(trace.coherence, Coherence::Detect);
    /// assert_eq!(trace.level.name(), Level::best().name());
    /// ```
    #[must_use]
    #[inline]
    pub fn new() -> Self {
        Self {
            level: Level::best(),
            coherence: Coherence::Detect,
            scratch: &mut [],
            stream: None,
            #[cfg(feature = "alloc")]
            kept: KeptMemory::NONE,
            learnt: Learnt::NOTHING,
        }
    }

    /// At `level`.
    ///
    /// ```
    /// use spherule_kernel::{Level, LevelName, Trace};
    ///
    /// let baseline = Level::named(LevelName::Baseline).unwrap_or(Level::best());
    /// assert_eq!(Trace::new().at(baseline).level.name(), baseline.name());
    /// ```
    #[must_use]
    pub fn at(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// For rays of that coherence.
    ///
    /// ```
    /// use spherule_kernel::{Coherence, Trace};
    ///
    /// assert_eq!(Trace::new().with(Coherence::Coherent).coherence, Coherence::Coherent);
    /// ```
    #[must_use]
    pub fn with(self, coherence: Coherence) -> Self {
        Self { coherence, ..self }
    }

    /// For coherent rays.
    ///
    /// ```
    /// use spherule_kernel::{Coherence, Trace};
    ///
    /// assert_eq!(Trace::new().coherent().coherence, Coherence::Coherent);
    /// ```
    #[must_use]
    pub fn coherent(self) -> Self {
        Self { coherence: Coherence::Coherent, ..self }
    }

    /// For incoherent rays.
    ///
    /// ```
    /// use spherule_kernel::{Coherence, Trace};
    ///
    /// assert_eq!(Trace::new().incoherent().coherence, Coherence::Incoherent);
    /// ```
    #[must_use]
    pub fn incoherent(self) -> Self {
        Self { coherence: Coherence::Incoherent, ..self }
    }

    /// With working memory.
    ///
    /// ```
    /// use spherule_kernel::{DepthList, Trace};
    ///
    /// let mut memory = vec![0.0; DepthList::scratch(100)];
    /// assert_eq!(Trace::new().with_scratch(&mut memory).scratch.len(), 1536);
    /// ```
    #[must_use]
    pub fn with_scratch(self, scratch: &'m mut [f32]) -> Self {
        Self { scratch, ..self }
    }

    /// With memory for streams, in place of what a tree takes by itself, and for rays that are said to be incoherent, too.
    /// Rays that have nothing in common go so where enough of them meet, which is seen as they go; with less than 8 places in
    /// queues a ray they never do.
    ///
    /// ```
    /// use spherule_kernel::{QueuedRay, StreamMemory, StreamRay, Trace};
    ///
    /// let mut rays = vec![StreamRay::EMPTY; 1024];
    /// let mut queues = vec![QueuedRay::EMPTY; 32 * 1024];
    /// let trace = Trace::new().incoherent().with_stream(StreamMemory::new(&mut rays, &mut queues)?);
    /// assert!(trace.stream.is_some());
    /// # Ok::<(), spherule_kernel::TooSmall>(())
    /// ```
    #[must_use]
    pub fn with_stream(self, memory: StreamMemory<'m>) -> Self {
        Self { stream: Some(memory), ..self }
    }
}

impl Default for Trace<'_> {
    fn default() -> Self {
        Self::new()
    }
}
