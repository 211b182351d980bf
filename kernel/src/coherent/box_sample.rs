//! Boxes that a group has looked into: what its rays would have done in them apart.
//!
//! Some boxes are kept, and tested against rays when a group's work is checked, which is seldom. The spheres that a ray has hit
//! since then mostly lie beyond the boxes; which rays had ended by then is kept, too. (When rays were counted in half of the boxes
//! instead, any hits of a beam among nested spheres ran at a tenth of the speed of ray by ray.)

use super::packet_group::GROUP;
use super::packet_state::PacketState;
use crate::bvh::node::{LEAF as IS_LEAF, WIDTH};
use crate::bvh::traverse::boxes::enter_about;
use crate::bvh::tree::Bvh;
use crate::lanes::{LaneMask, Lanes};
use crate::query::Query;

/// How many boxes are kept at most, and about how often a check tests a packet against a box.
const KEPT: usize = 16;
/// How many bits of `BoxSample::live` a packet has.
const LANES: usize = u64::BITS as usize / GROUP;

/// Boxes that a group has looked into: some of them, evenly spaced.
pub(super) struct BoxSample {
    /// Of a box: the number of its node, and its slot there.
    places: [u32; KEPT],
    /// Of any hit: the rays that had not ended then, a bit each.
    live: [u64; KEPT],
    kept: usize,
    /// How many boxes there were; and of how many, less one, the last is kept.
    boxes: u32,
    skipped: u32,
}

impl BoxSample {
    /// Of no boxes. At first each second is kept. (With each fourth, any hit of ground takes 0.99 of the time.)
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { places: [0; KEPT], live: [0; KEPT], kept: 0, boxes: 0, skipped: 1 }
    }

    /// Takes the next box.
    #[inline(always)]
    pub(super) fn take<L: Lanes, Q: Query>(&mut self, place: u32, states: &[PacketState<'_, L>]) {
        self.boxes = self.boxes.wrapping_add(1);
        if self.boxes & self.skipped != 0 {
            return;
        }
        let at = self.kept % KEPT;
        self.places[at] = place;
        if Q::ANY {
            self.live[at] = live_bits(states);
        }
        self.kept += 1;
        if self.kept == KEPT {
            for number in 0..KEPT / 2 {
                let other = 2 * number + 1;
                self.places[number] = self.places[other];
                self.live[number] = self.live[other];
            }
            (self.kept, self.skipped) = (KEPT / 2, 2 * self.skipped + 1);
        }
    }

    /// About what rays would have done apart in all boxes, if a ray takes so much work for a node, and for a leaf.
    #[inline(always)]
    pub(super) fn apart<L: Lanes, Q: Query>(
        &self,
        states: &[PacketState<'_, L>],
        bvh: &Bvh<'_>,
        [of_node, of_leaf]: [u32; 2],
    ) -> u64 {
        let (packets, kept) = (states.len().min(GROUP), self.kept.min(KEPT));
        let at_once = (KEPT / kept.max(1)).clamp(1, packets.max(1));
        let (mut work, mut packet) = (0, 0);
        for number in 0..kept {
            let place = self.places[number];
            let Some(node) = bvh.nodes.get(place as usize / WIDTH) else { continue };
            let slot = place as usize % WIDTH;
            let each = if node.child[slot] & IS_LEAF != 0 { of_leaf } else { of_node };
            for _ in 0..at_once {
                let Some(state) = states.get(packet) else { continue };
                // Spheres that were hit since then mostly lie beyond the box.
                let end = L::select(state.live, state.best, state.rays.end[1]);
                let enter = enter_about(&state.rays, end, node, slot).bits();
                let live = if Q::ANY {
                    (self.live[number] >> (LANES * packet)) as u32
                } else {
                    state.live.bits()
                };
                work += each * (enter & live).count_ones();
                packet = if packet + 1 < packets { packet + 1 } else { 0 };
            }
        }
        let of_all = u64::from(work) * u64::from(self.boxes) * packets as u64;
        of_all / (kept * at_once).max(1) as u64
    }
}

/// The rays that have not ended, a bit each, packet after packet.
#[inline(always)]
fn live_bits<L: Lanes>(states: &[PacketState<'_, L>]) -> u64 {
    let mut bits = 0;
    for (packet, state) in states.iter().enumerate() {
        bits |= u64::from(state.live.bits()) << (LANES * (packet % GROUP));
    }
    bits
}
