//! The memory of streams that calls take by themselves, and keep.
//!
//! Memory that is new is as slow as a tenth of the way, or a third where rays are few, since the system hands it out page by
//! page. So with `std` a thread keeps what its calls have taken, for the next; without, a trace does.

use super::sharing::Sharing;
use super::{QueuedRay, StreamMemory, StreamRay};
use crate::bvh::tree::Bvh;
use crate::geometry::ray::RayPacket;
use crate::memory::lengthen;
use crate::query::Query;
use alloc::vec::Vec;
#[cfg(feature = "std")]
use std::cell::Cell;

/// Places in queues for a ray: with 64 as fast; among 100,000 spheres with 16 at 0.9 of the speed, with 4 at 0.8.
const QUEUES: usize = 32;
/// The most rays that are sorted together.
pub(crate) const MOST_SORTED: usize = 1 << 16;

/// Memory of streams: nothing until it is used, then at most 3 MB; where rays are sorted, 4. Beside it the packets of long calls
/// by slices: half a megabyte, or 2.
#[derive(Debug, Default)]
struct Memory {
    rays: Vec<StreamRay>,
    queues: Vec<QueuedRay>,
    order: Vec<u64>,
    packets: Vec<RayPacket>,
}

impl Memory {
    const NONE: Self =
        Self { rays: Vec::new(), queues: Vec::new(), order: Vec::new(), packets: Vec::new() };

    #[cfg(feature = "std")]
    fn is_nothing(&self) -> bool {
        self.rays.is_empty() & self.packets.is_empty()
    }
}

#[cfg(feature = "std")]
std::thread_local! {
    /// What no call of this thread uses at the moment.
    static OF_THREAD: Cell<Memory> = const { Cell::new(Memory::NONE) };
}

/// Memory that a trace has taken.
#[derive(Debug)]
pub(crate) struct KeptMemory(Memory);

impl KeptMemory {
    /// Nothing.
    pub(crate) const NONE: Self = Self(Memory::NONE);

    /// Takes what the thread has kept, if there is nothing yet.
    fn find(&mut self) {
        #[cfg(feature = "std")]
        if self.0.is_nothing() {
            // (Not where the thread is ending.)
            self.0 = OF_THREAD.try_with(Cell::take).unwrap_or_default();
        }
    }

    /// Packets, whose contents do not matter, to be put back.
    pub(crate) fn take_packets(&mut self) -> Vec<RayPacket> {
        self.find();
        core::mem::take(&mut self.0.packets)
    }

    pub(crate) fn put_packets(&mut self, packets: Vec<RayPacket>) {
        self.0.packets = packets;
    }

    /// Memory for so many rays that go by themselves otherwise; `None` if it would not be used, or there is none.
    #[inline(always)]
    pub(crate) fn lend<Q: Query>(
        &mut self,
        bvh: &Bvh<'_>,
        sharing: &Sharing,
        rays: usize,
    ) -> Option<StreamMemory<'_>> {
        if !sharing.may_pay::<Q>(bvh, rays) {
            return None;
        }
        let sorted = if sharing.may_sort::<Q>(bvh, rays) { rays.min(MOST_SORTED) } else { 0 };
        self.take(Sharing::together(rays), sorted)
    }

    /// Memory for streams of so many rays, and to sort so many.
    #[inline(never)]
    fn take(&mut self, rays: usize, sorted: usize) -> Option<StreamMemory<'_>> {
        self.find();
        let Memory { rays: places, queues, order: sorting, .. } = &mut self.0;
        lengthen(places, StreamRay::EMPTY, rays)?;
        let needed = StreamMemory::queues_needed(places.len()).max(QUEUES * places.len());
        lengthen(queues, QueuedRay::EMPTY, needed)?;
        lengthen(sorting, 0, 2 * sorted)?;
        let memory = StreamMemory::new(places, queues).ok()?;
        Some(memory.sorting(sorting.get_mut(..2 * sorted).unwrap_or_default()))
    }
}

#[cfg(feature = "std")]
impl Drop for KeptMemory {
    fn drop(&mut self) {
        if !self.0.is_nothing() {
            let memory = core::mem::take(&mut self.0);
            // Of two the last is kept; of a thread that is ending none.
            let _ = OF_THREAD.try_with(|of_thread| of_thread.set(memory));
        }
    }
}
