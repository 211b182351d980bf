//! How the rays of an octant go through the nodes.

use super::Stream;
use super::queue::{Frame, QueuedRay, still_waiting};
use crate::Accuracy;
use crate::bvh::node::{FRAMES, LEAF, NO_CHILD, WIDTH};
use crate::bvh::traverse::boxes::Boxes;
use crate::count::count;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::query::Query;

/// So many rays look into a node before they are queued at its children. (With four it is 5 to 9 % slower.)
const AT_ONCE: usize = 16;
/// For so many rays, one number has a bit for each child.
const A_WORD: usize = u64::BITS as usize / WIDTH;

impl<T: Accuracy, L: Lanes, Q: Query> Stream<'_, '_, T, L, Q> {
    /// Takes the queue `from..to`, of rays of an octant, through the tree.
    #[inline(always)]
    pub(super) fn down(&mut self, octant: u32, from: usize, to: usize) {
        let root = self.tests.bvh.root;
        if root & LEAF != 0 {
            if root != NO_CHILD {
                self.look_into(root & !LEAF, from, to);
            }
            return;
        }
        // The queues of children begin behind the queues of all octants, in which no more rays wait than go down together. (Behind
        // places for all rays there may be none left but the least: then each ray enters each node alone.)
        let all = (self.together.max(1) * L::COUNT).min(self.rays.len());
        self.frames[0] = Frame { node: root, next: from, end: to, base: all, ..Frame::EMPTY };
        let mut depth = 0;
        loop {
            let frame = &mut self.frames[depth % FRAMES];
            let Some(node) = self.tests.bvh.nodes.get(frame.node as usize) else { break };
            // The nearest child that rays wait at; for any hit, the last slot that they wait at, since full leaves come
            // last.
            let order = node.order[octant as usize % 8];
            let mut slot = 0;
            let mut waiting = 0;
            while frame.left > 0 {
                frame.left -= 1;
                let place = frame.left as usize % WIDTH;
                slot = if Q::ANY { place } else { (order >> (4 * place)) as usize % WIDTH };
                waiting = frame.counts[slot];
                if waiting > 0 {
                    break;
                }
            }
            if waiting > 0 {
                let (from, room) = (frame.base + slot * frame.room, frame.room);
                let base = frame.base;
                let child = node.child[slot];
                let to = from + waiting as usize;
                if child & LEAF != 0 {
                    let to = still_waiting(self.queues, self.rays, from, to);
                    if from < to {
                        self.look_into(child & !LEAF, from, to);
                    }
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
        // The memory that deeper nodes need at least stays free.
        let free = self.queues.len().saturating_sub(frame.base);
        let below = WIDTH * (FRAMES - depth % FRAMES);
        let room = (free.saturating_sub(below) / (2 * WIDTH)).max(1);
        let room = room.min(frame.end - frame.next);
        let (from, base) = (frame.next, frame.base);
        (frame.next, frame.room, frame.left) = (from + room, room, WIDTH as u32);
        self.seen.count(room);

        let down = axes!(i => octant >> i & 1 == 1);
        let mut ends = [0; WIDTH];
        for slot in 0..WIDTH {
            ends[slot] = base + slot * room;
        }
        let mut entries = [[0.0; WIDTH]; AT_ONCE];
        let mut whose = [0_u32; AT_ONCE];
        let (mut at, end) = (from, from + room);
        while at < end {
            // Rays that have found something before they would enter are left out.
            let mut count = 0;
            while at < end && count < AT_ONCE {
                let queued = self.queues.get(at);
                at += 1;
                let Some(&queued) = queued else { continue };
                let Some(ray) = self.rays.get(queued.ray as usize) else { continue };
                whose[count] = queued.ray;
                count += usize::from(queued.entry <= ray.end_of_boxes);
            }
            // (So the compiler knows the bound, too.)
            let count = count.min(AT_ONCE);
            count!(StreamNode, count);
            // Boxes stay in registers while rays pass.
            let mut met = [0_u64; AT_ONCE / A_WORD];
            for part in 0..WIDTH / L::COUNT {
                let boxes = Boxes::load(self.tests.token, node, down, part);
                for place in 0..count {
                    let Some(ray) = self.rays.get(whose[place] as usize) else { break };
                    let (these, entry) = ray.box_probe::<L>(self.tests.token).enter(&boxes);
                    let shift = WIDTH * (place % A_WORD) + part * L::COUNT;
                    met[place / A_WORD] |= u64::from(these.bits()) << shift;
                    entry.store().put_part(&mut entries[place], part);
                }
            }
            // One loop for the children of four rays has one end that the processor cannot guess; a loop for each ray would
            // have four.
            for word in 0..AT_ONCE / A_WORD {
                let mut left = met[word];
                while left != 0 {
                    let bit = left.trailing_zeros() as usize;
                    left &= left - 1;
                    let (place, slot) = (word * A_WORD + bit / WIDTH % A_WORD, bit % WIDTH);
                    let end = ends[slot];
                    ends[slot] = end + 1;
                    count!(StreamQueued);
                    if let Some(queued) = self.queues.get_mut(end) {
                        *queued = QueuedRay { ray: whose[place], entry: entries[place][slot] };
                    }
                }
            }
        }
        for slot in 0..WIDTH {
            frame.counts[slot] = (ends[slot] - base - slot * room) as u32;
        }
    }
}
