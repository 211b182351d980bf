//! What a caller says of the rays, and of how they are traced.

use crate::bvh::StreamMemory;
#[cfg(feature = "alloc")]
use crate::bvh::traverse::stream::KeptMemory;
use crate::coherence::Coherence;
use crate::coherent::learnt::Learnt;
use crate::dispatch::Level;

/// How rays are traced: at which level, with what working memory, and what is known of them. No answer depends on it, except which false
/// hits of `Fast` and `Geometric` a [`DepthList`](crate::DepthList) loses, and what a [`Bvh`](crate::Bvh) or `DepthList` sees where a
/// tier's squares underflow.
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
    /// Working memory for a [`DepthList`](crate::DepthList), as [`scratch`](crate::DepthList::scratch) says; other structures need none.
    pub scratch: &'m mut [f32],
    /// The caller's working memory for a tree's streams. If it is `None`, a call with feature `alloc` allocates memory where it gains
    /// by a stream, or by sorting rays: at most 4.5 MB. The trace keeps this memory for its next call; with `std`, the thread
    /// keeps it when the trace is dropped. With `std`, a call may take 2.4 MB more, until it ends, to sort spheres for rays of one point. If
    /// an allocation fails, the call goes on without the memory.
    pub stream: Option<StreamMemory<'m>>,
    /// What calls have allocated for streams.
    #[cfg(feature = "alloc")]
    pub(crate) kept: KeptMemory,
    /// What calls have learnt of their rays.
    pub(crate) learnt: Learnt,
}

impl<'m> Trace<'m> {
    /// Traces at the best level that the CPU has, detects coherence, and has no scratch memory.
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

    /// Traces at `level`.
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

    /// Takes rays to be as `coherence` says.
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

    /// Takes rays to be coherent.
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

    /// Takes rays to be incoherent.
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

    /// Lends working memory for a depth list.
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

    /// Lends memory for streams, also of rays that are said to be incoherent. A tree then allocates nothing, and sorts neither rays nor
    /// spheres. Rays that have nothing in common are traced as a stream as long as enough of them meet at the same boxes. With
    /// too little memory ([`queues_needed`](StreamMemory::queues_needed)) all go ray by ray.
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
