//! Trees of so few leaves that a ray looks into all of them.
//!
//! Boxes would spare a ray some leaves, and cost it more. All leaves are tested one behind the other, which
//! depends on nothing; what is left of them is seldom more than a sphere or two, and goes
//! among the deferred tests. Where it is more, the root intervals tell first which may be the closest,
//! as in a tree.

use super::deferred::{DeferredTests, RayPlace};
use super::in_flight::begin;
use super::prepared_ray::PreparedPacket;
use super::ray_state::RayState;
use crate::Accuracy;
use crate::bvh::node::WIDTH;
use crate::bvh::tree::Bvh;
use crate::lanes::Lanes;
use crate::query::Query;

/// How many leaves are few: as many as have their spheres in the bits of a number.
const FEW: usize = u64::BITS as usize / WIDTH;
/// So many spheres are deferred at once.
const AT_ONCE: u32 = 2;

/// Whether a tree has few leaves.
#[inline(always)]
pub(crate) fn is_few(bvh: &Bvh<'_>) -> bool {
    bvh.leaves.len() <= FEW
}

/// Answers every ray by testing it against all spheres of such a tree.
#[inline(always)]
pub(crate) fn traverse<T: Accuracy, L: Lanes, Q: Query>(tests: &mut DeferredTests<'_, T, L, Q>) {
    let (mut prepared, mut state) = (PreparedPacket::none(), RayState::NEW);
    for packet in 0..tests.packets.len() {
        begin(tests, packet, &mut prepared);
        if tests.tier.spread() == 0.0 {
            all_leaves::<T, L, Q, false>(tests, packet, &prepared, &mut state);
        } else {
            L::out_of_line(
                tests.token,
                #[inline(always)]
                || all_leaves::<T, L, Q, true>(tests, packet, &prepared, &mut state),
            );
        }
    }
}

/// Answers the rays of a packet. `state` is what the last one left: a new one of 2 KB costs 3 to 5 % on one sphere.
#[inline(always)]
fn all_leaves<T: Accuracy, L: Lanes, Q: Query, const SPREADS: bool>(
    tests: &mut DeferredTests<'_, T, L, Q>,
    packet: usize,
    prepared: &PreparedPacket<L::Array>,
    state: &mut RayState,
) {
    let bvh = tests.bvh;
    let mut waiting = prepared.covered;
    while waiting != 0 {
        let ray = RayPlace { packet, lane: waiting.trailing_zeros() as usize };
        waiting &= waiting - 1;
        state.begin(prepared, 0, ray, bvh.root);

        let mut candidates = 0;
        for number in 0..bvh.leaves.len().min(FEW) {
            let here = state.may_hit::<T, L, Q, SPREADS>(tests, prepared, &bvh.leaves[number]);
            candidates |= u64::from(here) << (number * WIDTH);
        }
        if candidates.count_ones() <= AT_ONCE {
            while candidates != 0 {
                tests.add(ray, candidates.trailing_zeros());
                candidates &= candidates - 1;
            }
            continue;
        }
        for number in 0..bvh.leaves.len().min(FEW) {
            let first = number * WIDTH;
            if candidates >> first & 0xffff != 0 {
                let leaf = (&bvh.leaves[number], first as u32);
                state.meet::<T, L, Q, SPREADS>(tests, prepared, leaf);
            }
        }
        state.end(tests);
    }
}
