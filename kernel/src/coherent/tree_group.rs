//! A group of packets down the tree.
//!
//! # Method
//!
//! Up to four packets - 64 rays of 16 lanes - go down the tree as one group. A node's children are
//! tested against the group's [frustum](super::frustum), not against rays, and entered nearest first. So are the
//! spheres of a leaf tested; those inside are tested against the narrower planes of each packet, and those still
//! left against the packet's rays, a ray a lane (`packet_state.rs`). The depth beyond which nothing
//! matters shrinks with every hit. A group that does more than its rays would have done apart gives up
//! (`giving_up.rs`), at the root already if its rays meet few of the children that it enters (`root_overlap.rs`).
//!
//! A group is traced so if its rays start at t >= 0, run the same way along an axis, and are
//! narrow (`fit.rs`).

use super::box_sample::BoxSample;
use super::effort::Effort;
use super::fit::Fit;
use super::frustum::{Inside, Outline};
use super::giving_up::{Allowance, LEAST_RAYS, live_rays};
use super::packet_group::{GROUP, approach, meet_block};
use super::packet_source::PacketSource;
use super::packet_state::PacketState;
use super::root_overlap;
use crate::Accuracy;
use crate::accuracy::RayLanes;
use crate::bvh::leaf::Leaf;
use crate::bvh::node::{DEPTH, LEAF, WIDTH};
use crate::bvh::prefetch;
use crate::bvh::traverse::small_tree;
use crate::bvh::tree::Bvh;
use crate::count::count;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::{LaneMask, Lanes};
use crate::query::Query;
use crate::scale::rays::ScaledRays;
use core::hint::black_box;
use core::ops::Range;

/// The widest range of slopes that is traced as one.
pub(super) const NARROW: f32 = 0.5;
/// How many boxes can wait: fifteen a node on the way, and the last node's.
const STACK: usize = 256;
const _: () = assert!(STACK >= (WIDTH - 1) * DEPTH + WIDTH);

/// Returns the packets of a group; those past its end are `inactive`. (With a loop, or a function of its own, the kernel takes
/// a twentieth less to compile, and a tenth longer on u10k.)
#[inline(always)]
pub(super) fn states_of<'a, L: Lanes>(
    token: L::Token,
    rays: &'a [RayPacket<L::Array>],
    inactive: &'a RayPacket<L::Array>,
    factor: f32,
) -> [PacketState<'a, L>; GROUP] {
    let [a, b, c, d] = match *rays {
        [ref a, ref b, ref c, ref d] => [a, b, c, d],
        [ref a, ref b, ref c] => [a, b, c, inactive],
        [ref a, ref b] => [a, b, inactive, inactive],
        [ref a] => [a, inactive, inactive, inactive],
        _ => [inactive; GROUP],
    };
    [
        state_of(token, a, factor),
        state_of(token, b, factor),
        state_of(token, c, factor),
        state_of(token, d, factor),
    ]
}

#[inline(always)]
fn state_of<L: Lanes>(
    token: L::Token,
    packet: &RayPacket<L::Array>,
    factor: f32,
) -> PacketState<'_, L> {
    PacketState::new(packet, &ScaledRays::new(&RayLanes::load(token, packet), factor))
}

/// The place of the root, as long as it waits: no child has this place.
const ROOT: u32 = u32::MAX;

/// How a group ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ended {
    /// All of its rays are answered.
    Through,
    /// All of its rays are answered, but by more work than they would have done apart.
    AtALoss,
    /// It did, or would have done, more than its rays apart: the hits so far may not be the closest.
    GaveUp,
    /// Its rays do not look the same way, or are too few: nothing was done.
    Unfit,
}

impl Ended {
    /// Returns whether all rays are answered.
    #[inline(always)]
    pub(super) fn is_answered(self) -> bool {
        matches!(self, Self::Through | Self::AtALoss)
    }

    /// Returns whether the group did more than its rays would have done apart.
    #[inline(always)]
    pub(super) fn is_in_vain(self) -> bool {
        matches!(self, Self::AtALoss | Self::GaveUp)
    }
}

/// The boxes that are yet to be looked into, the nearest on top.
pub(super) struct Boxes {
    depths: [f32; STACK],
    /// The number of a node, and the slot of one of its children.
    places: [u32; STACK],
    top: usize,
    /// Of groups on trial: what they did, and what their rays would have done apart. `None` if they are not on trial.
    pub(super) efforts: Option<[u64; 2]>,
}

impl Boxes {
    #[inline(always)]
    pub(super) fn new(efforts: Option<[u64; 2]>) -> Self {
        Self { depths: [0.0; STACK], places: [ROOT; STACK], top: 0, efforts }
    }

    /// Traces one group. Its answers from spheres outside of the tree are `known`, if there are any. A group that is not trusted
    /// gives up sooner.
    #[inline(always)]
    pub(super) fn trace<L: Lanes, Q: Query>(
        &mut self,
        tier: impl Accuracy,
        token: L::Token,
        (states, is_trusted): (&mut [PacketState<'_, L>], bool),
        known: &[Q::Packet<L::Array>],
        bvh: &Bvh<'_>,
        tiles: Option<(&PacketSource<'_, L::Array>, Range<usize>)>,
    ) -> Ended {
        if live_rays(states) < LEAST_RAYS.min((states.len() * L::COUNT / 2) as u32) {
            return Ended::Unfit;
        }
        count!(GroupFit);
        approach(tier, states, bvh.scale.factor, bvh.extent);
        let by_corners = match tiles {
            Some((source, at)) => {
                source.enclose(at, states, (bvh.scale.factor, bvh.extent, tier.spread(), NARROW))
            }
            None => None,
        };
        let (fit, mut frustum) = match by_corners {
            Some(both) => both,
            None => {
                let Some(fit) = Fit::of(states, bvh.extent, tier.spread()) else {
                    return Ended::Unfit;
                };
                let Some(frustum) = fit.enclose(states, NARROW) else { return Ended::Unfit };
                (fit, frustum)
            }
        };
        if !bvh.outside.is_empty() {
            for place in 0..states.len().min(known.len()) {
                states[place].take_known::<Q>(&known[place]);
            }
            frustum.end = fit.end(states);
        }

        for state in &mut *states {
            state.depth = if state.live.any() { frustum.end } else { f32::NEG_INFINITY };
        }
        self.depths[0] = f32::NEG_INFINITY;
        self.places[0] = ROOT;
        self.top = 1;
        let mut effort = Effort::of(states.len());
        let mut allowance =
            Allowance::of(states, small_tree::leaf_count(bvh), [Q::ANY, is_trusted]);
        let mut sample = BoxSample::new();
        let is_far = !bvh.is_near();
        let mut inside = Inside { places: 0, depths: [0.0; WIDTH] };
        let mut gave_up = false;
        while self.top > 0 {
            self.top -= 1;
            let at = self.top & (STACK - 1);
            let (depth, place) = (self.depths[at], self.places[at]);
            // At the end itself nothing matters either, since the end is raised by more than an answer is off: `>=` would be as right.
            if depth > frustum.end {
                continue;
            }
            let mut child = bvh.root;
            if place != ROOT {
                let (node, slot) = (place / WIDTH as u32, place as usize % WIDTH);
                let Some(node) = bvh.nodes.get(node as usize) else { continue };
                child = node.child[slot];
                sample.take::<L, Q>(place, states);
                if allowance.is_wasted::<L, Q>(token, &effort, (states, &sample), bvh) {
                    gave_up = true;
                    break;
                }
            }
            if child & LEAF == 0 {
                if let Some(node) = bvh.nodes.get(child as usize) {
                    frustum.enter::<L, Q>(token, node, &mut inside);
                    if place == ROOT && !is_trusted && states.len() > 1 {
                        let pays = root_overlap::pays::<L, Q>(states, inside.places, node);
                        if !pays {
                            return Ended::GaveUp;
                        }
                    }
                    if is_far {
                        let memory = (bvh.nodes, bvh.numbers);
                        black_box(prefetch::children(memory, node, inside.places));
                    }
                    self.push(&inside, child);
                    effort.node();
                }
                continue;
            }
            let number = child & !LEAF;
            let Some(Leaf { columns: spheres, lanes }) = bvh.leaf(number) else { continue };
            effort.leaf();
            let mut end = frustum.end;
            let outline = Outline::in_tree(tier.spread(), fit.absolute_error);
            let places = frustum.look::<L>(token, &spheres, outline) & lanes;
            if places == 0 {
                continue;
            }
            meet_block::<L, Q>(
                tier,
                bvh,
                states,
                (number, &spheres, depth),
                (places, outline),
                #[inline(always)]
                |state| fit.end(core::slice::from_ref(state)),
                (&mut end, &mut effort),
            );
            frustum.end = end;
        }
        if let Some([did, apart]) = &mut self.efforts {
            *did += u64::from(effort.work);
            *apart += allowance.apart::<L, Q>(token, &effort, (states, &sample), bvh);
        }
        if gave_up {
            Ended::GaveUp
        } else if allowance.is_at_a_loss::<L, Q>(token, &effort, (states, &sample), bvh) {
            Ended::AtALoss
        } else {
            Ended::Through
        }
    }

    #[inline(always)]
    fn push(&mut self, inside: &Inside, node: u32) {
        let base = self.top;
        let mut places = inside.places;
        while places != 0 {
            let place = places.trailing_zeros() as usize % WIDTH;
            places &= places - 1;
            let depth = inside.depths[place];
            // The box sinks below nearer ones.
            let mut at = self.top;
            while at > base && self.depths[(at - 1) & (STACK - 1)] < depth {
                self.depths[at & (STACK - 1)] = self.depths[(at - 1) & (STACK - 1)];
                self.places[at & (STACK - 1)] = self.places[(at - 1) & (STACK - 1)];
                at -= 1;
            }
            self.depths[at & (STACK - 1)] = depth;
            self.places[at & (STACK - 1)] = node * WIDTH as u32 + place as u32;
            self.top += 1;
        }
    }
}
