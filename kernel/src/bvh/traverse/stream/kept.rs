//! The memory of streams that a trace takes by itself, and keeps for its next call.

use super::sharing::{Sharing, together};
use super::{QueuedRay, StreamMemory, StreamRay};
use crate::bvh::tree::Bvh;
use crate::memory::lengthen;
use crate::query::Query;
use alloc::vec::Vec;

/// Places in queues for a ray: with 32 as fast, and half a megabyte more to clear; with 4 at 0.87 of the speed.
const QUEUES: usize = 16;
/// The most rays that are sorted together.
pub(crate) const MOST_SORTED: usize = 1 << 16;

/// Memory of streams: nothing until it is used, at most 3 MB.
#[derive(Debug, Default)]
pub(crate) struct KeptMemory {
    rays: Vec<StreamRay>,
    queues: Vec<QueuedRay>,
    order: Vec<u64>,
}

impl KeptMemory {
    /// Nothing.
    pub(crate) const NONE: Self = Self { rays: Vec::new(), queues: Vec::new(), order: Vec::new() };

    /// Memory for so many rays that go by themselves otherwise, of so many in all; `None` if it would not be used, or there
    /// is none.
    #[inline(always)]
    pub(crate) fn lend<Q: Query>(
        &mut self,
        bvh: &Bvh<'_>,
        sharing: &Sharing,
        (rays, in_all): (usize, usize),
    ) -> Option<StreamMemory<'_>> {
        if !sharing.may_pay::<Q>(bvh, rays, in_all) {
            return None;
        }
        let sorted = if sharing.may_sort::<Q>(bvh, rays) { rays.min(MOST_SORTED) } else { 0 };
        self.take(together(in_all), sorted)
    }

    /// Memory for streams of so many rays, and to sort so many.
    #[inline(never)]
    fn take(&mut self, rays: usize, sorted: usize) -> Option<StreamMemory<'_>> {
        lengthen(&mut self.rays, StreamRay::EMPTY, rays)?;
        let queues = StreamMemory::queues_needed(self.rays.len()).max(QUEUES * self.rays.len());
        lengthen(&mut self.queues, QueuedRay::EMPTY, queues)?;
        lengthen(&mut self.order, 0, 2 * sorted)?;
        let memory = StreamMemory::new(&mut self.rays, &mut self.queues).ok()?;
        Some(memory.sorting(self.order.get_mut(..2 * sorted).unwrap_or_default()))
    }
}
