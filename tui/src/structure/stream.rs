//! Memory for rays that go through a tree as a stream.

use spherule_kernel::{QueuedRay, RayPacket, StreamMemory, StreamRay};

/// Packets whose rays go down together, as far as the kernel goes: a megabyte.
const TOGETHER: usize = 512;
/// Fewer packets are not worth the memory.
const FEWEST: usize = 64;
/// Places in queues for each ray: with 4 a stream takes 1.15 times as long as with 64.
const PLACES: usize = 32;

/// The memory that one thread lends to streams: three megabytes, and 16 bytes for each ray that is sorted.
#[derive(Clone, Debug, Default)]
pub(super) struct StreamScratch {
    rays: Vec<StreamRay>,
    queues: Vec<QueuedRay>,
    order: Vec<u64>,
}

impl StreamScratch {
    /// For so many packets; `None` if they are too few, or there is no memory.
    pub(super) fn of(&mut self, packets: usize) -> Option<StreamMemory<'_>> {
        let Self { rays, queues, order } = self;
        if packets < FEWEST {
            return None;
        }
        let together = packets.min(TOGETHER) * RayPacket::COUNT;
        let sorted = if packets > TOGETHER { packets * RayPacket::COUNT } else { 0 };
        let places = StreamMemory::queues_needed(together * PLACES);
        lengthen(rays, together, StreamRay::EMPTY)?;
        lengthen(queues, places, QueuedRay::EMPTY)?;
        lengthen(order, 2 * sorted, 0)?;
        let memory = StreamMemory::new(rays, queues).ok()?;
        Some(memory.sorting(order))
    }
}

/// Makes memory at least so long; `None` if there is none.
fn lengthen<T: Clone>(memory: &mut Vec<T>, length: usize, filler: T) -> Option<()> {
    let missing = length.saturating_sub(memory.len());
    memory.try_reserve_exact(missing).ok()?;
    memory.resize(memory.len() + missing, filler);
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_kept_and_grows() {
        let mut scratch = StreamScratch::default();
        assert!(scratch.of(FEWEST - 1).is_none());
        assert!(scratch.rays.is_empty());
        for (packets, rays, order) in [(64, 1024, 0), (5000, 8192, 160_000), (100, 8192, 160_000)] {
            assert!(scratch.of(packets).is_some());
            assert_eq!((scratch.rays.len(), scratch.order.len()), (rays, order), "{packets}");
        }
    }
}
