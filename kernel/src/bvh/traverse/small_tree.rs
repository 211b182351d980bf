//! Small trees have so few leaves that a ray looks into all of them.
//!
//! Boxes would spare a ray some leaves, and cost it more. All leaves are tested one behind the other, and no leaf
//! waits for the one before. Seldom more than a sphere or two may be hit; those go among the deferred tests. Where
//! there are more, the root intervals tell first which may be the closest, as in a larger tree.

use super::deferred::{DeferredTests, RayPlace};
use super::in_flight::begin;
use super::prepared_packet::PreparedPacket;
use super::ray_state::RayState;
use crate::Accuracy;
use crate::bvh::leaf::{Leaf, place_of};
use crate::bvh::node::{BvhNode, LEAF, NO_CHILD, WIDTH};
use crate::bvh::tree::Bvh;
use crate::lanes::Lanes;
use crate::query::Query;

/// How many leaves a small tree has at most: as many as a number has bits for, one for each sphere.
pub(super) const MOST_LEAVES: usize = u64::BITS as usize / WIDTH;
/// At most so many spheres are deferred at once, without their root intervals.
pub(super) const AT_ONCE: u32 = 2;

/// A tree of at most so many spheres is traced as a list, except ray by ray. (Rays that have nothing in common, AVX-512 and AVX2: as a
/// list, one sphere takes 0.35 of the time, two take 0.7, four 0.8 to 1.0, eight 1.2.)
const LISTED: usize = 4;

/// Returns whether a tree is traced as a list.
#[inline(always)]
pub(crate) fn is_listed(bvh: &Bvh<'_>) -> bool {
    bvh.spheres.len() <= LISTED
}

/// The leaves of a small tree, all in one node; `None` of a larger one.
#[inline(always)]
pub(crate) fn leaves(bvh: &Bvh<'_>) -> Option<[u32; MOST_LEAVES]> {
    match bvh.nodes {
        [] => Some([bvh.root, NO_CHILD, NO_CHILD, NO_CHILD]),
        [BvhNode { child: [a, b, c, d, NO_CHILD, ..], .. }] => Some([*a, *b, *c, *d]),
        _ => None,
    }
}

/// How many leaves a small tree has; `None` of a larger one.
#[inline(always)]
pub(crate) fn leaf_count(bvh: &Bvh<'_>) -> Option<u32> {
    let (leaves, mut count) = (leaves(bvh)?, 0);
    for number in 0..MOST_LEAVES {
        count += u32::from(leaves[number] != NO_CHILD);
    }
    Some(count)
}

/// Answers every ray by testing it against all spheres of a small tree.
#[inline(always)]
pub(crate) fn traverse<T: Accuracy, L: Lanes, Q: Query>(
    tests: &mut DeferredTests<'_, T, L, Q>,
    leaves: [u32; MOST_LEAVES],
) {
    // The leaves are found once: to look for them costs as much as to test them.
    let bvh = tests.bvh;
    let leaves = leaves.map(
        #[inline(always)]
        |child| (child & !LEAF, bvh.leaf(child & !LEAF)),
    );
    let leaves = &leaves;
    let (mut prepared, mut state) = (PreparedPacket::NONE, RayState::NEW);
    for packet in 0..tests.packets.len() {
        begin(tests, packet, &mut prepared);
        if tests.tier.spread() == 0.0 {
            all_leaves::<T, L, Q, false>(tests, leaves, packet, &prepared, &mut state);
        } else {
            L::out_of_line(
                tests.token,
                #[inline(always)]
                || all_leaves::<T, L, Q, true>(tests, leaves, packet, &prepared, &mut state),
            );
        }
    }
}

/// Answers the rays of a packet. `state` is as the last ray left it: a new one, of 2 KB, costs 3 to 5 % on one
/// sphere.
#[inline(always)]
fn all_leaves<T: Accuracy, L: Lanes, Q: Query, const SPREADS: bool>(
    tests: &mut DeferredTests<'_, T, L, Q>,
    leaves: &[(u32, Option<Leaf<'_>>); MOST_LEAVES],
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
        for number in 0..MOST_LEAVES {
            let Some(leaf) = &leaves[number].1 else { break };
            let here = state.may_hit::<T, L, Q, SPREADS>(tests, prepared, leaf);
            candidates |= u64::from(here) << (number * WIDTH);
        }
        // (The intervals tell false hits by their boxes.)
        if !SPREADS && candidates.count_ones() <= AT_ONCE {
            while candidates != 0 {
                let bit = candidates.trailing_zeros();
                tests.add(
                    ray,
                    place_of(leaves[bit as usize / WIDTH % MOST_LEAVES].0, bit % WIDTH as u32),
                );
                candidates &= candidates - 1;
            }
            continue;
        }
        for number in 0..MOST_LEAVES {
            if candidates >> (number * WIDTH) & 0xffff != 0 {
                state.meet::<T, L, Q, SPREADS>(tests, prepared, leaves[number].0);
            }
        }
        state.end(tests);
    }
}
