//! Boxes that a group has looked into: what its rays would have done there apart.
//!
//! Some are kept, and held against rays when it is asked, which is seldom. What a ray has hit since then mostly lies
//! beyond; what had ended by then is kept, too.

use super::packet_group::GROUP;
use super::packet_state::PacketState;
use crate::bvh::node::{LEAF as IS_LEAF, WIDTH};
use crate::bvh::traverse::boxes::enter_about;
use crate::bvh::tree::Bvh;
use crate::lanes::{LaneMask, Lanes};

/// How many boxes are kept at most.
const KEPT: usize = 16;

/// Boxes that a group has looked into: some of them, evenly spaced.
pub(super) struct BoxSample {
    /// Of a box: the number of its node, and its slot there.
    places: [u32; KEPT],
    /// The packet whose rays it is held against, and those that had not ended then, a bit each.
    packets: [usize; KEPT],
    live: [u32; KEPT],
    kept: usize,
    /// How many there were, and of how many, less one, the last is kept.
    boxes: u32,
    skipped: u32,
}

impl BoxSample {
    /// Of no boxes. At first each fourth is kept. (Each second: a camera's rays take 1.02 of the time.)
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self {
            places: [0; KEPT],
            packets: [0; KEPT],
            live: [0; KEPT],
            kept: 0,
            boxes: 0,
            skipped: 3,
        }
    }

    /// Takes the next box.
    #[inline(always)]
    pub(super) fn take<L: Lanes>(&mut self, place: u32, states: &[PacketState<'_, L>]) {
        self.boxes = self.boxes.wrapping_add(1);
        if self.boxes & self.skipped != 0 {
            return;
        }
        let at = self.kept % KEPT;
        let packet = if states.len() == GROUP { at % GROUP } else { 0 };
        let live = states.get(packet).map_or(0, |state| state.live.bits());
        (self.places[at], self.packets[at], self.live[at]) = (place, packet, live);
        self.kept += 1;
        if self.kept == KEPT {
            for number in 0..KEPT / 2 {
                let other = 2 * number + 1;
                self.places[number] = self.places[other];
                self.packets[number] = self.packets[other];
                self.live[number] = self.live[other];
            }
            (self.kept, self.skipped) = (KEPT / 2, 2 * self.skipped + 1);
        }
    }

    /// What rays apart would have done in all boxes, if one looks into a node or a leaf by so much work.
    #[inline(always)]
    pub(super) fn apart<L: Lanes>(
        &self,
        states: &[PacketState<'_, L>],
        bvh: &Bvh<'_>,
        [of_node, of_leaf]: [u32; 2],
    ) -> u64 {
        let mut work = 0;
        for number in 0..self.kept.min(KEPT) {
            let place = self.places[number];
            let (Some(node), Some(state)) =
                (bvh.nodes.get(place as usize / WIDTH), states.get(self.packets[number]))
            else {
                continue;
            };
            // What was hit since then mostly lies beyond.
            let end = L::select(state.live, state.best, state.rays.end[1]);
            let slot = place as usize % WIDTH;
            let enter = enter_about(&state.rays, end, node, slot).bits() & self.live[number];
            let each = if node.child[slot] & IS_LEAF != 0 { of_leaf } else { of_node };
            work += each * enter.count_ones();
        }
        let of_one_packet = u64::from(work) * u64::from(self.boxes) / self.kept.max(1) as u64;
        states.len() as u64 * of_one_packet
    }
}
