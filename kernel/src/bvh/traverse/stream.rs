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
//! A node's boxes and the order of its children are looked up once for all of these rays, and no ray has a stack, as on
//! its own way ([`wavefront`](super::wavefront)): a ray that enters a box is written behind that box's queue.
//!
//! What a ray compares is what it compares on its own way, in the same arithmetic: the margins are those of
//! `docs/traversal-margins.md`. A ray keeps one sphere that may be its closest; where a second may be, the first
//! goes among the deferred tests of the tier.
//!
//! # Memory
//!
//! A ray in the stream takes 128 bytes and some places in queues, of 8 bytes. A node's children could each be entered
//! by every ray that waits at it. So at most half of the memory that is free is handed to sixteen queues that are as
//! long as the first of the node's rays are many; those go down before the others are looked at. Sixteen places a
//! level are enough, for one ray after the other.

mod memory;
mod queue;
mod ray;

pub use memory::StreamMemory;
pub use queue::QueuedRay;
pub use ray::StreamRay;

use self::queue::{FRAMES, Frame, still_waiting};
use super::deferred::{DeferredTests, RayPlace};
use super::in_flight::begin;
use super::prepared_ray::PreparedPacket;
use crate::Accuracy;
use crate::bvh::leaf::{Leaf, place_of};
use crate::bvh::node::{LEAF, NO_CHILD, WIDTH};
use crate::bvh::tree::Bvh;
use crate::geometry::hit::Hit;
use crate::geometry::ray::RayPacket;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::query::Query;

/// So many rays enter a node before they are queued at its children.
const AT_ONCE: usize = u64::BITS as usize / WIDTH;

/// Answers every ray. The memory is as large as [`StreamMemory::new`] checks.
#[inline(always)]
pub(crate) fn traverse<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    bvh: &Bvh<'_>,
    memory: &mut StreamMemory<'_>,
    rays: &[RayPacket<L::Array>],
    answers: &mut [Q::Packet<L::Array>],
) {
    L::out_of_line(
        token,
        #[inline(always)]
        || {
            let count = rays.len().min(answers.len());
            let rays = rays.get(..count).unwrap_or_default();
            let tests = DeferredTests::<_, L, Q>::new(tier, token, bvh, rays, answers);
            let StreamMemory { rays, queues } = memory;
            let mut stream =
                Stream { tests, rays, queues, first: 0, frames: [Frame::EMPTY; FRAMES] };
            stream.all(count);
        },
    );
}

/// Packets whose rays go down the tree.
struct Stream<'a, 'm, T, L: Lanes, Q: Query> {
    tests: DeferredTests<'a, T, L, Q>,
    /// A ray a lane.
    rays: &'m mut [StreamRay],
    queues: &'m mut [QueuedRay],
    /// The packet that the first rays are of.
    first: usize,
    frames: [Frame; FRAMES],
}

impl<T: Accuracy, L: Lanes, Q: Query> Stream<'_, '_, T, L, Q> {
    /// As many packets at a time as there is memory for.
    #[inline(always)]
    fn all(&mut self, count: usize) {
        // As many as a number of 32 bits can tell apart.
        let at_once = (self.rays.len().min(1 << 31) / L::COUNT).max(1);
        let mut prepared = PreparedPacket::none();
        while self.first < count {
            let packets = at_once.min(count - self.first);
            let mut ends = self.begin(packets, &mut prepared);
            self.sort(packets * L::COUNT, &mut ends);
            let mut from = 0;
            for octant in 0..8 {
                let to = ends[octant];
                if from < to {
                    self.down(octant as u32, from, to);
                }
                from = to;
            }
            self.end(packets * L::COUNT);
            self.first += packets;
        }
        self.tests.test();
    }

    /// Prepares packets; returns how many rays there are of each octant.
    #[inline(always)]
    fn begin(&mut self, packets: usize, prepared: &mut PreparedPacket<L::Array>) -> [usize; 8] {
        let mut counts = [0; 8];
        for packet in 0..packets {
            begin(&mut self.tests, self.first + packet, prepared);
            for lane in 0..L::COUNT {
                let Some(ray) = self.rays.get_mut(packet * L::COUNT + lane) else { break };
                if prepared.covered >> lane & 1 == 1 {
                    ray.begin(self.tests.tier, prepared, lane);
                    counts[ray.octant as usize % 8] += 1;
                } else {
                    (ray.octant, ray.entry) = (StreamRay::NO_OCTANT, f32::NAN);
                }
            }
        }
        counts
    }

    /// Queues the rays at the root, octant by octant; makes the number of each octant the end of its queue.
    #[inline(always)]
    fn sort(&mut self, count: usize, ends: &mut [usize; 8]) {
        let mut from = 0;
        for end in ends.iter_mut() {
            (*end, from) = (from, from + *end);
        }
        for number in 0..count {
            let Some(ray) = self.rays.get(number) else { break };
            if let Some(end) = ends.get_mut(ray.octant as usize)
                && let Some(place) = self.queues.get_mut(*end)
            {
                *place = QueuedRay { ray: number as u32, entry: f32::NEG_INFINITY };
                *end += 1;
            }
        }
    }

    /// Takes the queue `from..to`, of rays of an octant, through the tree.
    #[inline(always)]
    fn down(&mut self, octant: u32, from: usize, to: usize) {
        let root = self.tests.bvh.root;
        if root & LEAF != 0 {
            if root != NO_CHILD {
                self.look_into(root & !LEAF, from, to);
            }
            return;
        }
        // Behind the queues of all octants.
        let all = self.rays.len();
        self.frames[0] = Frame { node: root, next: from, end: to, base: all, ..Frame::EMPTY };
        let mut depth = 0;
        loop {
            let frame = &mut self.frames[depth % FRAMES];
            let Some(node) = self.tests.bvh.nodes.get(frame.node as usize) else { break };
            // The nearest child that rays wait at.
            let order = node.order[octant as usize % 8];
            let mut slot = 0;
            let mut waiting = 0;
            while frame.left > 0 {
                frame.left -= 1;
                slot = (order >> (4 * frame.left)) as usize % WIDTH;
                waiting = frame.counts[slot];
                if waiting > 0 {
                    break;
                }
            }
            if waiting > 0 {
                let (from, room) = (frame.base + slot * frame.room, frame.room);
                let base = frame.base;
                let child = node.child[slot];
                let to = still_waiting(self.queues, self.rays, from, from + waiting as usize);
                if from == to {
                    continue;
                }
                if child & LEAF != 0 {
                    self.look_into(child & !LEAF, from, to);
                } else {
                    let base = base + WIDTH * room;
                    depth += 1;
                    self.frames[depth % FRAMES] =
                        Frame { node: child, next: from, end: to, base, ..Frame::EMPTY };
                }
            } else if frame.next < frame.end {
                self.enter(depth, octant);
            } else if depth == 0 {
                break;
            } else {
                depth -= 1;
            }
        }
    }

    /// Lets the next rays that wait at the node of a frame enter it, as many as there is memory for.
    #[inline(always)]
    fn enter(&mut self, depth: usize, octant: u32) {
        let frame = &mut self.frames[depth % FRAMES];
        let Some(node) = self.tests.bvh.nodes.get(frame.node as usize) else { return };
        // What the levels below need at least stays free.
        let free = self.queues.len().saturating_sub(frame.base);
        let below = WIDTH * (FRAMES - depth % FRAMES);
        let room = (free.saturating_sub(below) / (2 * WIDTH)).max(1);
        let room = room.min(frame.end - frame.next);
        let (from, base) = (frame.next, frame.base);
        (frame.next, frame.room, frame.left) = (from + room, room, WIDTH as u32);

        let down = axes!(i => octant >> i & 1 == 1);
        let nearer = axes!(i => if down[i] { &node.high[i] } else { &node.low[i] });
        let farther = axes!(i => if down[i] { &node.low[i] } else { &node.high[i] });
        let mut ends = [0; WIDTH];
        for slot in 0..WIDTH {
            ends[slot] = base + slot * room;
        }
        // Which children four rays enter, a bit each: one loop over all of them has an end that cannot be guessed,
        // where a loop a ray would have four.
        let mut entries = [[0.0; WIDTH]; AT_ONCE];
        let mut whose = [0_u32; AT_ONCE];
        let mut at = from;
        while at < from + room {
            let mut all = 0_u64;
            for place in 0..AT_ONCE.min(from + room - at) {
                let Some(&QueuedRay { ray: number, .. }) = self.queues.get(at + place) else {
                    break;
                };
                let Some(ray) = self.rays.get(number as usize) else { break };
                let (met, these) = ray.enter::<L>(self.tests.token, nearer, farther);
                (entries[place % AT_ONCE], whose[place % AT_ONCE]) = (these, number);
                all |= u64::from(met) << (WIDTH * (place % AT_ONCE));
            }
            at += AT_ONCE;
            while all != 0 {
                let bit = all.trailing_zeros() as usize;
                all &= all - 1;
                let (place, slot) = (bit / WIDTH % AT_ONCE, bit % WIDTH);
                let end = ends[slot];
                ends[slot] = end + 1;
                if let Some(queued) = self.queues.get_mut(end) {
                    *queued = QueuedRay { ray: whose[place], entry: entries[place][slot] };
                }
            }
        }
        for slot in 0..WIDTH {
            frame.counts[slot] = (ends[slot] - base - slot * room) as u32;
        }
    }

    /// Tests the spheres of a leaf against the rays that wait at it.
    #[inline(always)]
    fn look_into(&mut self, number: u32, from: usize, to: usize) {
        let Some(leaf) = self.tests.bvh.leaf(number) else { return };
        if self.tests.tier.spread() == 0.0 {
            self.meet::<false>((&leaf, number), from, to);
        } else {
            L::out_of_line(
                self.tests.token,
                #[inline(always)]
                || self.meet::<true>((&leaf, number), from, to),
            );
        }
    }

    /// First which rays may hit any of the spheres, then where.
    #[inline(always)]
    fn meet<const SPREADS: bool>(
        &mut self,
        (leaf, number): (&Leaf<'_>, u32),
        from: usize,
        to: usize,
    ) {
        let (token, spread) = (self.tests.token, self.tests.tier.spread());
        let mut kept = from;
        for at in from..to {
            let Some(&QueuedRay { ray: number, .. }) = self.queues.get(at) else { break };
            let Some(ray) = self.rays.get(number as usize) else { break };
            let spheres = ray.may_hit::<L, SPREADS>(token, spread, leaf);
            if let Some(place) = self.queues.get_mut(kept) {
                *place = QueuedRay { ray: number, entry: f32::from_bits(spheres) };
            }
            kept += usize::from(spheres != 0);
        }
        for at in from..kept {
            let Some(&QueuedRay { ray, .. }) = self.queues.get(at) else { break };
            self.meet_one::<SPREADS>((leaf, number), ray);
        }
    }

    /// Looks at the spheres of a leaf that ray `number` may hit.
    #[inline(always)]
    fn meet_one<const SPREADS: bool>(
        &mut self,
        (leaf, leaf_number): (&Leaf<'_>, u32),
        number: u32,
    ) {
        let Self { tests, rays, .. } = self;
        let Some(ray) = rays.get_mut(number as usize) else { return };
        let whose = RayPlace {
            packet: self.first + number as usize / L::COUNT,
            lane: number as usize % L::COUNT,
        };
        let probe = ray.probe::<L>(tests.token, tests.tier.spread());
        for part in 0..WIDTH / L::COUNT {
            let interval = probe.root_interval::<SPREADS>(&leaf.columns, part);
            let (entries, bounds) = (interval.entry.store(), interval.bound.store());
            let mut candidates = interval.candidates.bits() & leaf.lanes >> (part * L::COUNT);
            while candidates != 0 {
                let lane = candidates.trailing_zeros() as usize;
                candidates &= candidates - 1;
                let (entry, bound) = (entries.get(lane), bounds.get(lane));
                if Q::ANY && bound < f32::INFINITY {
                    if let Some(answer) = tests.answers.get_mut(whose.packet) {
                        let any = Hit { t: 0.0, sphere: 0 };
                        Q::take::<L::Array>(answer, whose.lane, any, |_| false);
                    }
                    ray.shorten(f32::NEG_INFINITY);
                    ray.entry = f32::NAN;
                    return;
                }
                if entry > ray.best {
                    continue;
                }
                ray.shorten(bound);
                // The one before may be the closest, too.
                if ray.entry <= ray.best {
                    tests.add(whose, ray.place);
                }
                ray.place = place_of(leaf_number, (part * L::COUNT + lane) as u32);
                ray.entry = entry;
            }
        }
    }

    /// Hands the spheres that may be the closest of each ray to the tier.
    #[inline(always)]
    fn end(&mut self, count: usize) {
        for number in 0..count {
            let Some(ray) = self.rays.get(number) else { break };
            if ray.entry <= ray.best {
                let packet = self.first + number / L::COUNT;
                self.tests.add(RayPlace { packet, lane: number % L::COUNT }, ray.place);
            }
        }
    }
}
