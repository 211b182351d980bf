//! The groups and packets of a run of packets that go down the tree together.

use super::learnt::{Learnt, kind_of};
use super::packet_group::GROUP;
use super::packet_source::PacketSource;
use super::patience::Places;
use super::tree_group::{Boxes, Ended, states_of};
use crate::Accuracy;
use crate::bvh::traverse::packet_set::PacketSet;
use crate::bvh::tree::Bvh;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::Lanes;
use crate::query::Query;
use core::ops::Range;

/// Packets of a run that go ray by ray.
pub(super) struct Apart {
    pub(super) packets: PacketSet,
    /// Whether all packets do, and nothing is known of any.
    pub(super) are_all: bool,
}

/// Packets that go down together.
pub(super) struct Together<'a> {
    pub(super) boxes: &'a mut Boxes,
    pub(super) learnt: &'a mut Learnt,
    /// How many groups are passed over after a try in vain, at first and at most.
    pub(super) gaps: [u8; 2],
}

impl Together<'_> {
    /// Answers the groups and packets of a run that pay; puts the other packets into `apart`, with the answers so far.
    #[inline(always)]
    pub(super) fn answer<L: Lanes, Q: Query>(
        &mut self,
        tier: impl Accuracy,
        token: L::Token,
        bvh: &Bvh<'_>,
        (source, run): (&mut PacketSource<'_, L::Array>, Range<usize>),
        answers: &mut [Q::Packet<L::Array>],
        apart: &mut Apart,
    ) {
        let inactive = RayPacket::inactive();
        let kind = kind_of::<Q>();
        let mut at = run.start;
        while at < run.end {
            let end = run.end.min(at + GROUP);
            let are_tiles = source.make::<L>(token, at..end);
            let tries_group = self.learnt.groups[kind].tries();
            let (tried_apart, first) = self.learnt.packets[kind].tries();
            let mut ends = [Ended::Unfit; GROUP];
            if tries_group | (tried_apart != 0) {
                let packets = source.packets(at..end);
                let mut states = states_of::<L>(token, packets, &inactive, bvh.scale.factor);
                let states = states.get_mut(..packets.len()).unwrap_or_default();
                let count = states.len();
                // Four together, then each alone: by one call, since each call is compiled anew.
                let (mut alone, mut waiting) =
                    (!tries_group, tried_apart & !(Places::MAX << count));
                let (mut tried, mut paid, mut in_vain) = (0, 0, 0);
                loop {
                    let mut these = 0..count;
                    if alone {
                        if waiting == 0 {
                            break;
                        }
                        let ahead = waiting & (Places::MAX << first);
                        let next = if ahead != 0 { ahead } else { waiting };
                        let place = next.trailing_zeros() as usize % GROUP;
                        waiting &= !(1 << place);
                        these = place..place + 1;
                    }
                    // Packets whose group gave up have taken what was known.
                    let is_new = ends[these.start % GROUP] == Ended::Unfit;
                    let known = if is_new { at + these.start..at + these.end } else { 0..0 };
                    let known = answers.get(known).unwrap_or_default();
                    let group = states.get_mut(these.clone()).unwrap_or_default();
                    let tiles = if are_tiles & !alone { Some((&*source, at..end)) } else { None };
                    let boxes = &mut *self.boxes;
                    let is_trusted = if alone {
                        self.learnt.packets[kind].has_paid()
                    } else {
                        self.learnt.groups[kind].has_paid()
                    };
                    // Out of line: when it was compiled into this function, changes that do not concern its loops moved them
                    // (baseline, a scanner's rays among nested spheres: 0.57 to 0.80 of the speed of ray by ray).
                    let ended = L::out_of_line(
                        token,
                        #[inline(always)]
                        || boxes.trace::<L, Q>(tier, token, (group, is_trusted), known, bvh, tiles),
                    );
                    for packet in these.clone() {
                        let before = &mut ends[packet % GROUP];
                        if ended != Ended::Unfit {
                            *before = ended;
                        }
                    }
                    if !alone {
                        let outcome = (ended == Ended::Through, ended.is_in_vain());
                        self.learnt.groups[kind].take(outcome, self.gaps);
                        // Each half of a group of two that gave up would give up, too.
                        let are_few = count < 2 || (count == 2 && ended == Ended::GaveUp);
                        if ended.is_answered() || are_few {
                            break;
                        }
                        alone = true;
                    } else {
                        let place: Places = 1 << these.start;
                        tried |= place;
                        paid |= if ended == Ended::Through { place } else { 0 };
                        in_vain |= if ended.is_in_vain() { place } else { 0 };
                        // If the first packet is too wide, most are.
                        if ended.is_in_vain() && tried == place {
                            break;
                        }
                    }
                }
                if tried != 0 {
                    self.learnt.packets[kind].take([tried, paid, in_vain], self.gaps);
                }
                for place in 0..states.len() {
                    if let (Some(state), Some(answer)) =
                        (states.get_mut(place), answers.get_mut(at + place))
                        && ends[place % GROUP] != Ended::Unfit
                    {
                        *answer = state.finish::<Q>(tier, bvh);
                    }
                }
            }
            for place in at..end {
                let ended = ends[(place - at) % GROUP];
                apart.are_all &= ended == Ended::Unfit;
                if !ended.is_answered() {
                    apart.packets.insert(place - run.start);
                }
                if ended == Ended::Unfit
                    && bvh.outside.is_empty()
                    && let Some(answer) = answers.get_mut(place)
                {
                    *answer = Q::none::<L::Array>();
                }
            }
            at = end;
        }
    }
}
