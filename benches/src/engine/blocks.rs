//! Rays for the kernel in blocks that are in the cache, as Embree gets them.
//!
//! Many rays do not stay in the cache from one pass to the next. A program that makes rays makes some, traces them, and makes the next. So
//! a block is copied, then searched with the clock running, then its answers are copied out. Rays that fill no more than one block stay in
//! the cache anyway: they are searched where they are, and the caller keeps the time.

use super::{EVERY_SECOND, Query, Run};
use crate::rounds::{thread_time, timed};
use spherule_kernel::{Hit, HitPacket, LaneArray, RayPacket};
use std::cell::RefCell;
use std::rc::Rc;

/// Hits, and bits of any hit.
type Answers<A> = (Vec<HitPacket<A>>, Vec<u32>);

/// Memory for answers, and for a block.
pub(super) struct Memory<A: LaneArray = [f32; 16]> {
    answers: Answers<A>,
    rays: Vec<RayPacket<A>>,
    block_answers: Answers<A>,
}

impl<A: LaneArray> Default for Memory<A> {
    fn default() -> Self {
        Self { answers: Default::default(), rays: Vec::new(), block_answers: Default::default() }
    }
}

impl<A: LaneArray> Memory<A> {
    /// Makes room for the answers of `packets` packets, and for a block of `block` packets.
    fn reserve(&mut self, packets: usize, block: usize) {
        let room = |(hits, occluded): &mut Answers<A>, count: usize| {
            hits.resize(count.max(hits.len()), HitPacket::none());
            occluded.resize(count.max(occluded.len()), 0);
        };
        room(&mut self.answers, packets);
        room(&mut self.block_answers, block);
        self.rays.resize(block.max(self.rays.len()), RayPacket::inactive());
    }

    fn forget(&mut self) {
        for (hits, occluded) in [&mut self.answers, &mut self.block_answers] {
            hits.fill(HitPacket::none());
            occluded.fill(EVERY_SECOND);
        }
    }
}

/// One pass over rays.
pub(super) struct Blocks<'a, A: LaneArray = [f32; 16]> {
    rays: &'a [RayPacket<A>],
    memory: &'a mut Memory<A>,
    /// Packets of a block.
    size: usize,
    /// How long the clock ran. Stays zero for a single block.
    nanoseconds: u64,
}

impl<A: LaneArray> Blocks<'_, A> {
    fn is_single(&self) -> bool {
        self.rays.len() <= self.size
    }

    /// Does, with the clock running, the work that a pass needs once.
    pub(super) fn once<T>(&mut self, work: impl FnOnce() -> T) -> T {
        if self.is_single() {
            return work();
        }
        let start = thread_time();
        let made = work();
        self.nanoseconds += thread_time() - start;
        made
    }

    /// Searches block by block.
    pub(super) fn each(
        &mut self,
        mut search: impl FnMut(&[RayPacket<A>], &mut [HitPacket<A>], &mut [u32]),
    ) {
        let count = self.rays.len();
        if self.is_single() {
            let (hits, occluded) = &mut self.memory.answers;
            return search(self.rays, &mut hits[..count], &mut occluded[..count]);
        }
        for from in (0..count).step_by(self.size) {
            let here = from..count.min(from + self.size);
            let count = here.len();
            self.memory.rays[..count].copy_from_slice(&self.rays[here.clone()]);
            let Memory { answers, rays, block_answers: (hits, occluded) } = &mut *self.memory;
            let (rays, hits, occluded) =
                (&rays[..count], &mut hits[..count], &mut occluded[..count]);
            let start = thread_time();
            search(rays, hits, occluded);
            self.nanoseconds += thread_time() - start;
            answers.0[here.clone()].copy_from_slice(hits);
            answers.1[here].copy_from_slice(occluded);
        }
    }
}

/// Packets of rays, and the function that searches for their hits.
pub(super) struct InPackets<A: LaneArray, S> {
    packets: Rc<[RayPacket<A>]>,
    /// The number of rays.
    count: usize,
    /// Packets of a block.
    block: usize,
    search: S,
    memory: Rc<RefCell<Memory<A>>>,
    /// Whether the last run was for any hit.
    any_hit: bool,
}

impl<A: LaneArray, S: FnMut(Query, &mut Blocks<'_, A>)> InPackets<A, S> {
    /// `count` rays in `packets`, `block` rays a block at most.
    pub(super) fn new(
        packets: Rc<[RayPacket<A>]>,
        count: usize,
        block: usize,
        search: S,
        memory: Rc<RefCell<Memory<A>>>,
    ) -> Self {
        let block = (block / A::COUNT).min(packets.len());
        Self { packets, count, block, search, memory, any_hit: false }
    }

    /// Returns how long the clock ran, in nanoseconds.
    fn pass(&mut self, query: Query) -> u64 {
        let memory = &mut *self.memory.borrow_mut();
        memory.reserve(self.packets.len(), self.block);
        let rays = &self.packets[..];
        let mut blocks = Blocks { rays, memory, size: self.block, nanoseconds: 0 };
        (self.search)(query, &mut blocks);
        self.any_hit = query == Query::AnyHit;
        blocks.nanoseconds
    }
}

impl<A: LaneArray, S: FnMut(Query, &mut Blocks<'_, A>)> Run for InPackets<A, S> {
    fn run(&mut self, query: Query) {
        self.pass(query);
        std::hint::black_box(&self.memory);
    }

    fn hits(&self) -> Vec<Option<Hit>> {
        let (hits, occluded) = &self.memory.borrow().answers;
        let hit = |ray: usize| {
            let (packet, lane) = (ray / A::COUNT, ray % A::COUNT);
            let occluded = || occluded[packet] >> lane & 1 == 1;
            let any = || occluded().then_some(Hit { t: 0.0, sphere: 0 });
            if self.any_hit { any() } else { hits[packet].hit(lane) }
        };
        (0..self.count).map(hit).collect()
    }

    fn forget(&mut self) {
        let memory = &mut *self.memory.borrow_mut();
        memory.reserve(self.packets.len(), self.block);
        memory.forget();
    }

    /// The time of the searches alone.
    fn time(&mut self, query: Query, runs: usize) -> f64 {
        if self.packets.len() <= self.block {
            return timed(|| (0..runs).for_each(|_| self.run(query)));
        }
        (0..runs).map(|_| self.pass(query)).sum::<u64>() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::{Intersect, Ray, Sphere, SphereList, Tier, Trace, Vec3};

    /// The spheres that 77 rays hit, the sizes of the blocks that their packets came in, and whether the clock ran.
    fn searched(block: usize) -> (Vec<u32>, Vec<usize>, bool) {
        let place = |index: usize| Vec3::new(4.0 * index as f32, 0.0, 0.0);
        let sphere = |index| Sphere { center: place(index) + 5.0 * Vec3::Z, radius: 1.0 };
        let list: SphereList = (0..77).map(sphere).collect();
        let rays: Vec<_> = (0..77).map(|index| Ray::new(place(index), Vec3::Z)).collect();
        let sizes = Rc::new(RefCell::new(Vec::new()));
        let seen = Rc::clone(&sizes);
        let search = move |_, blocks: &mut Blocks<'_>| {
            blocks.each(|rays, hits, _| {
                seen.borrow_mut().push(rays.len());
                list.closest_hit_packets(Tier::Stable, &mut Trace::new(), rays, hits);
            });
        };
        let packets = rays.chunks(16).map(RayPacket::new).collect();
        let mut run = InPackets::new(packets, rays.len(), block, search, Rc::default());
        let is_timed = run.pass(Query::ClosestHit) > 0;
        (run.hits().iter().flatten().map(|hit| hit.sphere).collect(), sizes.take(), is_timed)
    }

    #[test]
    fn every_packet_comes_once_and_answers_go_where_they_belong() {
        for (block, sizes) in
            [(32, vec![2, 2, 1]), (16, vec![1; 5]), (80, vec![5]), (4096, vec![5])]
        {
            let (spheres, seen, is_timed) = searched(block);
            assert_eq!(spheres, (0..77).collect::<Vec<_>>());
            assert_eq!((seen.len() > 1, seen), (is_timed, sizes));
        }
    }
}
