//! Rays that have nothing in common, traced as a stream: queues of them go down the tree together.
//!
//! # Method
//!
//! Sort the rays by the octant of their directions; then all rays of a queue meet the children of a node in the same
//! order, and compare the same corners of boxes. A node is looked into once for all rays that wait at it:
//!
//! ```text
//!     rays at the node          its sixteen boxes       rays at each child, nearest child first
//!   +---+---+---+---+---+      +--+--+--+-   -+--+      +---+---+
//!   | a | b | c | d | e |  ->  |  |  |  | ... |  |  ->  | a | d |           down first; then those who have found
//!   +---+---+---+---+---+      +--+--+--+-   -+--+      +---+---+---+       nothing before they would enter
//!     one after the other,      all at once for          | b | c | d |       go on to the next
//!     all lanes for one ray     each of the rays         +---+---+---+
//! ```
//!
//! A node's boxes and the order of its children are looked up once for all of these rays. No ray has a stack, as it has
//! ray by ray ([`wavefront`](super::wavefront)): a ray that enters a box is appended to that box's queue.
//!
//! A ray makes the same comparisons as ray by ray, in the same arithmetic: the margins are those of
//! `docs/traversal-margins.md`. A ray keeps one sphere that may be its closest; where a second may be, the first goes
//! among the deferred tests of the tier.
//!
//! # Memory
//!
//! A ray in the stream takes 128 bytes and some places in queues, of 8 bytes each. Every ray that waits at a node could
//! enter every child of it. So at most half of the free memory becomes sixteen queues of equal length, and as many of
//! the node's rays as one of these queues holds go down before the others are looked at. Sixteen places for each node
//! on the way are enough, for one ray after the other.

#[cfg(feature = "alloc")]
mod kept;
mod leaves;
mod likeness;
mod memory;
mod nodes;
mod queue;
mod ray;
mod seen;
mod sharing;

#[cfg(feature = "alloc")]
pub(crate) use kept::KeptMemory;
pub use memory::StreamMemory;
pub use queue::QueuedRay;
pub use ray::StreamRay;
pub(crate) use sharing::Sharing;

use self::queue::Frame;
use self::seen::Seen;
use self::sharing::{StreamStrategy, TOGETHER};
use super::deferred::DeferredTests;
use super::in_flight::begin;
use super::packet_set::PacketSet;
use super::prepared_packet::PreparedPacket;
use super::wavefront;
use crate::Accuracy;
use crate::bvh::node::FRAMES;
use crate::bvh::tree::Bvh;
use crate::count::count;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::Lanes;
use crate::query::Query;

/// Answers every ray: as a stream where so many rays meet that it pays, else ray by ray. The memory is as large as
/// [`StreamMemory::new`] checks.
#[inline(always)]
pub(crate) fn traverse<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    bvh: &Bvh<'_>,
    (memory, sharing): (&mut StreamMemory<'_>, &mut Sharing),
    (rays, waiting): (&[RayPacket<L::Array>], Option<&PacketSet>),
    answers: &mut [Q::Packet<L::Array>],
) {
    let count = rays.len().min(answers.len());
    let mut from = 0;
    while from < count {
        let left = rays.get(from..count).unwrap_or_default();
        let (strategy, next) = sharing.next::<L::Array, Q>(bvh, memory, left);
        let to = count.min(from + next.div_ceil(L::COUNT).max(1));
        let (Some(rays), Some(answers)) = (rays.get(from..to), answers.get_mut(from..to)) else {
            break;
        };
        let waiting = waiting.map(
            #[inline(always)]
            |waiting| waiting.after(from),
        );
        from = to;
        if strategy == StreamStrategy::RayByRay {
            let rays = (rays, waiting.as_ref());
            let entered = wavefront::traverse::<L, Q>(tier, token, bvh, rays, answers);
            sharing.take_alone(entered);
            continue;
        }
        L::out_of_line(
            token,
            #[inline(always)]
            || {
                count!(RayRun);
                let count = rays.len();
                let waiting = waiting.as_ref();
                let tests = DeferredTests::<_, L, Q>::new(tier, token, bvh, rays, answers, waiting);
                let StreamMemory { rays, queues, .. } = &mut *memory;
                let together = rays.len().min(TOGETHER) / L::COUNT;
                let mut stream = Stream {
                    tests,
                    rays,
                    queues,
                    together,
                    first: 0,
                    frames: [Frame::EMPTY; FRAMES],
                    seen: Seen::default(),
                };
                stream.all(count);
                stream.tests.test();
                sharing.take::<Q>(bvh, stream.seen);
            },
        );
    }
}

/// Packets whose rays go down the tree.
struct Stream<'a, 'm, T, L: Lanes, Q: Query> {
    tests: DeferredTests<'a, T, L, Q>,
    /// A ray a lane.
    rays: &'m mut [StreamRay],
    queues: &'m mut [QueuedRay],
    /// How many packets go down together.
    together: usize,
    /// The packet that the first of the numbered rays is of.
    first: usize,
    frames: [Frame; FRAMES],
    seen: Seen,
}

impl<T: Accuracy, L: Lanes, Q: Query> Stream<'_, '_, T, L, Q> {
    /// Answers all packets, as many at a time as go down together.
    #[inline(always)]
    fn all(&mut self, count: usize) {
        let mut prepared = PreparedPacket::NONE;
        while self.first < count {
            let packets = self.together.max(1).min(count - self.first);
            for packet in 0..packets {
                begin(&mut self.tests, self.first + packet, &mut prepared);
                for lane in 0..L::COUNT {
                    self.begin(&prepared, (packet, lane));
                }
            }
            self.through(packets * L::COUNT);
            self.first += packets;
        }
    }

    /// Takes lane `lane` of a prepared packet, the `packet`th that goes down now.
    #[inline(always)]
    fn begin(&mut self, prepared: &PreparedPacket<L::Array>, (packet, lane): (usize, usize)) {
        let number = packet * L::COUNT + lane;
        let Some(ray) = self.rays.get_mut(number) else { return };
        if prepared.covered >> lane & 1 == 1 {
            ray.begin(prepared, lane, number as u32);
        } else {
            ray.leave_out();
        }
    }

    /// Takes the first `count` rays through the tree, octant by octant.
    #[inline(always)]
    fn through(&mut self, count: usize) {
        let mut ends = [0; 8];
        for number in 0..count {
            let Some(ray) = self.rays.get(number) else { break };
            if let Some(count) = ends.get_mut(ray.octant() as usize) {
                *count += 1;
            }
        }
        let mut before = 0;
        for end in &mut ends {
            (*end, before) = (before, before + *end);
        }
        for number in 0..count {
            let Some(ray) = self.rays.get(number) else { break };
            if let Some(end) = ends.get_mut(ray.octant() as usize)
                && let Some(place) = self.queues.get_mut(*end)
            {
                *place = QueuedRay { ray: number as u32, entry: f32::NEG_INFINITY };
                *end += 1;
            }
        }
        self.seen.streams = self.seen.streams.wrapping_add(1);
        self.seen.rays = self.seen.rays.wrapping_add(before as u32);
        let mut from = 0;
        for octant in 0..8 {
            let to = ends[octant];
            if from < to {
                self.down(octant as u32, from, to);
            }
            from = to;
        }
        self.end(count);
    }

    /// Hands the spheres that may be the closest of each ray to the tier.
    #[inline(always)]
    fn end(&mut self, count: usize) {
        for number in 0..count {
            let Some(ray) = self.rays.get_mut(number) else { break };
            if ray.entry <= ray.best {
                let whose = ray.whose::<L::Array>(self.first);
                ray.take_answer(self.tests.limit(whose));
                if ray.entry <= ray.best {
                    self.tests.add(whose, ray.place);
                }
            }
        }
    }
}
