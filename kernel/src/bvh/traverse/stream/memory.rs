//! The memory of a stream, which the caller provides.

use super::queue::QueuedRay;
use super::ray::StreamRay;
use crate::bvh::node::{FRAMES, WIDTH};
use crate::memory::TooSmall;

/// Memory for a stream of rays, checked to be large enough.
#[derive(Debug)]
pub struct StreamMemory<'m> {
    pub(super) rays: &'m mut [StreamRay],
    pub(super) queues: &'m mut [QueuedRay],
    /// Whether rays go as a stream even where ray by ray is faster.
    pub(super) everywhere: bool,
}

impl<'m> StreamMemory<'m> {
    /// Returns how many places in queues a stream of so many rays needs at least: one a ray, and 256.
    ///
    /// At most 8,192 rays go down together. With memory for fewer than 1,024, or with fewer than 8 places in queues for each that
    /// goes down, rays go alone, except with [`everywhere`](Self::everywhere); with 32 places, few queues are cut short.
    ///
    /// ```
    /// use spherule_kernel::StreamMemory;
    ///
    /// assert_eq!(StreamMemory::queues_needed(1024), 1280);
    /// ```
    #[must_use]
    pub const fn queues_needed(rays: usize) -> usize {
        rays.saturating_add(WIDTH * FRAMES)
    }

    /// Returns memory for as many rays as `rays` has places.
    ///
    /// # Errors
    /// [`TooSmall`] if there is no place for a packet of sixteen rays, or if the queues are shorter than
    /// [`queues_needed`](Self::queues_needed).
    ///
    /// ```
    /// use spherule_kernel::{QueuedRay, StreamMemory, StreamRay, Trace};
    ///
    /// let mut rays = vec![StreamRay::EMPTY; 1024];
    /// let mut queues = vec![QueuedRay::EMPTY; 32 * 1024];
    /// let trace = Trace::new().with_stream(StreamMemory::new(&mut rays, &mut queues)?);
    /// assert!(trace.stream.is_some());
    /// # Ok::<(), spherule_kernel::TooSmall>(())
    /// ```
    pub fn new(rays: &'m mut [StreamRay], queues: &'m mut [QueuedRay]) -> Result<Self, TooSmall> {
        TooSmall::check("rays", WIDTH, rays.len())?;
        TooSmall::check("queues", Self::queues_needed(rays.len()), queues.len())?;
        Ok(Self { rays, queues, everywhere: false })
    }

    /// Lets rays go as a stream even where ray by ray is faster: for measurements and tests. (With `std`, calls of few rays go one by
    /// one all the same.)
    ///
    /// ```
    /// use spherule_kernel::{
    ///     Exact, Intersect, QueuedRay, Ray, SphereTree, StreamMemory, StreamRay, Trace, Vec3,
    /// };
    ///
    /// let mut rays = vec![StreamRay::EMPTY; 1024];
    /// let mut queues = vec![QueuedRay::EMPTY; 32 * 1024];
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// let memory = StreamMemory::new(&mut rays, &mut queues)?.everywhere();
    /// let mut hits = [None; 64];
    /// let all = [Ray::new(Vec3::ZERO, Vec3::Z); 64];
    /// tree.closest_hits_with(Exact, &mut Trace::new().with_stream(memory), &all, &mut hits);
    /// assert!(hits.iter().flatten().all(|hit| hit.t == 4.0));
    /// # Ok::<(), spherule_kernel::TooSmall>(())
    /// ```
    #[must_use]
    pub fn everywhere(self) -> Self {
        Self { everywhere: true, ..self }
    }

    /// Borrows the same memory for a while.
    pub(crate) fn again(&mut self) -> StreamMemory<'_> {
        StreamMemory { rays: self.rays, queues: self.queues, everywhere: self.everywhere }
    }
}
