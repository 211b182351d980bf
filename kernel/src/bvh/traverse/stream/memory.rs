//! The memory of a stream, of the caller's.

use super::queue::{FRAMES, QueuedRay};
use super::ray::StreamRay;
use crate::bvh::node::WIDTH;
use crate::memory::TooSmall;

/// Memory for a stream of rays, checked.
#[derive(Debug)]
pub struct StreamMemory<'m> {
    pub(super) rays: &'m mut [StreamRay],
    pub(super) queues: &'m mut [QueuedRay],
}

impl<'m> StreamMemory<'m> {
    /// How many places in queues a stream of so many rays needs at least: one a ray, and 256.
    ///
    /// With 32 a ray few queues are cut short.
    #[must_use]
    pub const fn queues_needed(rays: usize) -> usize {
        rays.saturating_add(WIDTH * FRAMES)
    }

    /// Memory for as many rays as `rays` has places.
    ///
    /// # Errors
    /// [`TooSmall`] if there is no place for a packet of sixteen rays, or if the queues are shorter than
    /// [`queues_needed`](Self::queues_needed).
    pub fn new(rays: &'m mut [StreamRay], queues: &'m mut [QueuedRay]) -> Result<Self, TooSmall> {
        TooSmall::check(WIDTH, rays.len())?;
        TooSmall::check(Self::queues_needed(rays.len()), queues.len())?;
        Ok(Self { rays, queues })
    }

    /// The same memory, for a while.
    pub(crate) fn again(&mut self) -> StreamMemory<'_> {
        StreamMemory { rays: self.rays, queues: self.queues }
    }
}
