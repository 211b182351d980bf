//! Rays through the tree, each on its own way, as many at a time as there are lanes.
//!
//! # Method
//!
//! A ray keeps a stack of boxes that it has yet to look into, the nearest on top, each with the s
//! at which it is entered. A step takes one from the stack: a node's children are tested all at
//! once, and those that are entered go onto the stack; a leaf's spheres are tested all at once, and
//! those that may be the closest go onto a list. When a hit is surely closer than what was known,
//! boxes entered later are dropped from the stack. When a ray is through, its list - one sphere,
//! seldom more - goes among the deferred tests of the tier.
//!
//! As many rays as there are lanes are in flight, and go in rounds: all take a box; those that took a node look into it;
//! those that took a leaf test it; those that have ended make place for others, of the same packet or the next. So there
//! are few branches that depend on one ray, which the processor cannot guess, and the steps of the rays, each a chain of
//! some hundred cycles, overlap. (One ray after the other ran at 0.8 to 0.9 of the speed. Packet by packet, some 5 of 16
//! rays were in flight on 7,381 spheres. Half as many rays in flight ran at 0.97 of the speed; entering the root as a ray
//! begins, at 1.01.)
//!
//! What a packet's rays need is computed once, in lanes, and read where it lies. Trees of up to four leaves are traversed
//! without boxes (`small_tree.rs`).

use super::deferred::DeferredTests;
use super::in_flight::{PacketsInFlight, Round, Step};
use super::packet_set::PacketSet;
use super::ray_state::RayState;
use super::small_tree;
use crate::Accuracy;
use crate::bvh::prefetch;
use crate::bvh::tree::Bvh;
use crate::count::count;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::{LaneArray, Lanes};
use crate::query::Query;
use core::hint::black_box;

/// Answers every ray of the packets that are `waiting`, or of all, and returns what they have entered. Stack: some 4 KiB a
/// lane.
#[inline(always)]
pub(crate) fn traverse<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    bvh: &Bvh<'_>,
    (rays, waiting): (&[RayPacket<L::Array>], Option<&PacketSet>),
    answers: &mut [Q::Packet<L::Array>],
) -> Entered {
    L::out_of_line(
        token,
        #[inline(always)]
        || {
            count!(RayRun);
            let count = rays.len().min(answers.len());
            let (rays, answers) = (rays.get(..count).unwrap_or_default(), answers);
            let mut tests = DeferredTests::<_, L, Q>::new(tier, token, bvh, rays, answers, waiting);
            let entered = if let Some(leaves) = small_tree::leaves(bvh) {
                small_tree::traverse(&mut tests, leaves);
                Entered::default()
            } else {
                by_boxes(&mut tests)
            };
            tests.test();
            entered
        },
    )
}

/// How many boxes some rays have entered: nodes and leaves that they looked into. Zero in a small tree, which is traversed
/// without boxes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Entered {
    pub(crate) rays: u32,
    pub(crate) boxes: u32,
}

#[inline(always)]
fn by_boxes<T: Accuracy, L: Lanes, Q: Query>(tests: &mut DeferredTests<'_, T, L, Q>) -> Entered {
    count!(RayStacks);
    let bvh = tests.bvh;
    let mut states = L::Array::each(RayState::NEW);
    let states = states.as_mut();
    for state in states.iter_mut() {
        state.clear();
    }
    let mut in_flight = PacketsInFlight::<L::Array>::none();
    let mut round = Round::<L::Array>::empty();
    let mut entered = Entered::default();
    let far = !bvh.is_near();
    loop {
        round.clear();
        for number in 0..states.len() {
            round.go_on(bvh.nodes, number as u32, &mut states[number]);
        }
        // The next ray replaces one that has ended.
        for at in 0..round.ended.count {
            let Step { state: number, .. } = round.ended.get(at);
            let Some(state) = states.get_mut(number as usize) else { continue };
            state.end(tests);
            in_flight.end(state);
            if in_flight.begin(tests, state) {
                entered.rays = entered.rays.wrapping_add(1);
                round.go_on(bvh.nodes, number, state);
            }
        }
        let boxes = round.nodes.count + round.leaves.count;
        if boxes == 0 {
            break;
        }
        entered.boxes = entered.boxes.wrapping_add(boxes as u32);

        if far {
            let mut lines = 0;
            for at in 0..round.nodes.count {
                if let Some(node) = bvh.nodes.get(round.nodes.get(at).child as usize) {
                    lines ^= prefetch::node(node);
                }
            }
            for at in 0..round.leaves.count {
                lines ^= prefetch::leaf(bvh.numbers, round.leaves.get(at).child);
            }
            black_box(lines);
        }

        for at in 0..round.nodes.count {
            let step = round.nodes.get(at);
            let Some(state) = states.get_mut(step.state as usize) else { continue };
            let Some(node) = bvh.nodes.get(step.child as usize) else { continue };
            let Some(prepared) = in_flight.prepared(state) else { continue };
            state.enter::<L, Q>(tests.token, prepared, (step.child, node));
        }

        // Tiers with a spread go out of line: a branch within, on a number that is known only at run time, cost the other
        // tiers 7 % on u10k.
        if tests.tier.spread() == 0.0 {
            look_into_leaves::<T, L, Q, false>(tests, states, &in_flight, &mut round);
        } else {
            L::out_of_line(
                tests.token,
                #[inline(always)]
                || look_into_leaves::<T, L, Q, true>(tests, states, &in_flight, &mut round),
            );
        }
    }
    entered
}

/// Tests the spheres of a round's leaves: first which leaves may hold a hit, then where.
#[inline(always)]
fn look_into_leaves<T: Accuracy, L: Lanes, Q: Query, const SPREADS: bool>(
    tests: &mut DeferredTests<'_, T, L, Q>,
    states: &mut [RayState],
    in_flight: &PacketsInFlight<L::Array>,
    round: &mut Round<L::Array>,
) {
    let bvh = tests.bvh;
    // Rays whose leaf may hold a hit move to the front.
    let in_leaves = round.leaves.count;
    round.leaves.count = 0;
    for at in 0..in_leaves {
        let step = round.leaves.get(at);
        let Some(state) = states.get(step.state as usize) else { continue };
        let Some(leaf) = bvh.leaf(step.child) else { continue };
        let Some(prepared) = in_flight.prepared(state) else { continue };
        let spheres = state.may_hit::<T, L, Q, SPREADS>(tests, prepared, &leaf);
        round.leaves.append(step, spheres != 0);
    }
    for at in 0..round.leaves.count {
        let step = round.leaves.get(at);
        let Some(state) = states.get_mut(step.state as usize) else { continue };
        let Some(prepared) = in_flight.prepared(state) else { continue };
        state.meet::<T, L, Q, SPREADS>(tests, prepared, step.child);
    }
}
