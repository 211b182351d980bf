//! The memory of streams that calls take by themselves, and keep.
//!
//! New memory takes a tenth of a traversal's time, or a third where rays are few, since the system hands it out page by page. So
//! with `std` a thread keeps the memory of its calls for the next ones; without `std` a trace does.

use super::sharing::Sharing;
use super::{QueuedRay, StreamMemory, StreamRay};
use crate::bvh::tree::Bvh;
use crate::geometry::ray_packet::RayPacket;
use crate::memory::lengthen;
use crate::query::Query;
use alloc::vec::Vec;
#[cfg(feature = "std")]
use std::cell::Cell;

/// Places in queues for a ray. With 64 streams are as fast; among 100,000 spheres they run at 0.9 of the speed with 16, and at 0.8
/// with 4.
const QUEUES: usize = 32;

/// Memory of streams: nothing until it is used, then 384 bytes a ray that goes down with others, 3.2 MB at most. Also that of long
/// calls: 32 bytes a ray that is in a packet, of calls by slices, and 8 a ray that is sorted, half a megabyte each at most.
#[derive(Debug, Default)]
struct Memory {
    rays: Vec<StreamRay>,
    queues: Vec<QueuedRay>,
    packets: Vec<RayPacket>,
    numbers: Vec<u32>,
}

impl Memory {
    const NONE: Self =
        Self { rays: Vec::new(), queues: Vec::new(), packets: Vec::new(), numbers: Vec::new() };

    #[cfg(feature = "std")]
    fn is_nothing(&self) -> bool {
        self.rays.is_empty() & self.packets.is_empty() & self.numbers.is_empty()
    }
}

#[cfg(feature = "std")]
std::thread_local! {
    /// The memory that no call of this thread uses at the moment.
    static OF_THREAD: Cell<Memory> = const { Cell::new(Memory::NONE) };
}

/// Memory that a trace has taken.
#[derive(Debug)]
pub(crate) struct KeptMemory(Memory);

impl KeptMemory {
    /// No memory.
    pub(crate) const NONE: Self = Self(Memory::NONE);

    /// Takes the memory that the thread has kept, if there is none yet.
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

    /// Numbers, whose values do not matter, to be put back.
    pub(crate) fn take_numbers(&mut self) -> Vec<u32> {
        self.find();
        core::mem::take(&mut self.0.numbers)
    }

    pub(crate) fn put_numbers(&mut self, numbers: Vec<u32>) {
        self.0.numbers = numbers;
    }

    /// Memory for so many rays that would otherwise go by themselves; `None` if it would not be used, or if there is none.
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
        self.take(Sharing::together(rays))
    }

    /// Memory for streams of so many rays.
    #[inline(never)]
    fn take(&mut self, rays: usize) -> Option<StreamMemory<'_>> {
        self.find();
        let Memory { rays: places, queues, .. } = &mut self.0;
        lengthen(places, StreamRay::EMPTY, rays).ok()?;
        let needed = StreamMemory::queues_needed(places.len()).max(QUEUES * places.len());
        lengthen(queues, QueuedRay::EMPTY, needed).ok()?;
        StreamMemory::new(places, queues).ok()
    }
}

#[cfg(feature = "std")]
impl Drop for KeptMemory {
    fn drop(&mut self) {
        if !self.0.is_nothing() {
            let memory = core::mem::take(&mut self.0);
            // The thread keeps the last memory that it is given; a thread that is ending keeps none.
            let _ = OF_THREAD.try_with(|of_thread| of_thread.set(memory));
        }
    }
}

#[cfg(all(test, proofs))]
#[cfg(feature = "std")]
mod tests {
    extern crate std;

    use super::*;
    use crate::proofs::climb::Random;
    use crate::{Exact, HitPacket, Intersect, Ray, SphereList, SphereTree, Trace, Vec3, f32x8};
    use std::vec;

    impl KeptMemory {
        /// How many bytes there are, and how many of them are to sort by.
        fn bytes(&self) -> [usize; 2] {
            let Memory { rays, queues, packets, numbers } = &self.0;
            let numbers = size_of_val(&numbers[..]);
            let in_streams = size_of_val(&rays[..]) + size_of_val(&queues[..]);
            [in_streams + size_of_val(&packets[..]) + numbers, numbers]
        }
    }

    /// Calls take the memory that `closest_hits`, `closest_hit_lanes` and `Trace::stream` promise.
    #[test]
    fn calls_take_the_memory_that_is_promised() {
        let mut random = Random(59);
        let mut point = || Vec3::from_array([(); 3].map(|()| random.below(1 << 20) as f32));
        let mut tree = |spheres: usize| {
            SphereTree::new((0..spheres).map(|_| (point(), 3000.0)).collect::<SphereList>())
        };
        let trees = [tree(20_000), tree(500_000)];
        let middle = Vec3::splat(524_288.0);
        let mut ray = |is_beam| {
            let (origin, towards) = (point(), point() - middle);
            let beam = Ray::new(Vec3 { z: -1e6, ..origin }, Vec3::new(0.1, 0.2, 1.0));
            if is_beam { beam } else { Ray::new(origin, towards) }
        };
        let rays = [true, false].map(|is_beam| Vec::from_iter((0..100_000).map(|_| ray(is_beam))));
        for (tree, count, sorts) in [
            (0, 1008, false),
            (0, 1009, false),
            (0, 1500, false),
            (0, 4000, false),
            (0, 16_384, false),
            (0, 100_000, true),
            (1, 1500, false),
            (1, 4000, true),
            (1, 100_000, true),
        ] {
            let mut hits = vec![None; count];
            let mut trace = Trace::new();
            trees[tree].closest_hits_with(Exact, &mut trace, &rays[tree][..count], &mut hits);
            let [taken, numbers] = trace.kept.bytes();
            // The packets of hits are given back at once.
            let answers = count.min(1 << 14).div_ceil(16) * size_of::<HitPacket>();
            let most = if count < 1009 { 0 } else { (430 * count.max(1024)).min(4_500_000) };
            assert_eq!((taken > 0, numbers > 0), (count > 1008, sorts), "{count} rays");
            assert!(taken == 0 || taken + answers <= most, "{count} rays: {taken} and {answers}");
            // The next trace of this thread begins with none.
            trace.kept.0 = Memory::NONE;
        }
        // By lanes, rays that have nothing in common take memory for streams alone, and none if they are said to have nothing in common.
        let packets = Vec::from_iter(rays[1].chunks(8).take(2048).map(RayPacket::<[f32; 8]>::new));
        for (mut trace, takes) in [(Trace::new(), true), (Trace::new().incoherent(), false)] {
            let mut hits = vec![HitPacket::<[f32; 8]>::none(); packets.len()];
            trees[0].closest_hit_lanes::<f32x8>(Exact, (), &mut trace, &packets, &mut hits);
            let [taken, numbers] = trace.kept.bytes();
            assert_eq!((taken > 0, numbers), (takes, 0));
            assert!(taken <= 3_200_000, "{taken}");
        }
    }
}
