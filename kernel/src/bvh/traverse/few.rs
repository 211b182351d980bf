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
use crate::geometry::ray::RayPacket;
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
pub(crate) fn traverse<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    bvh: &Bvh<'_>,
    packets: &[RayPacket<L::Array>],
    answers: &mut [Q::Packet<L::Array>],
) {
    let spread = tier.spread();
    let leaves = bvh.leaves;
    let mut prepared = PreparedPacket::none();
    let mut state = RayState::NEW;
    let mut deferred = DeferredTests::<L>::none();
    for packet in 0..packets.len() {
        let (Some(rays), Some(answer)) = (packets.get(packet), answers.get_mut(packet)) else {
            break;
        };
        begin::<L, Q>(tier, token, rays, bvh, &mut prepared, answer);
        let mut waiting = prepared.covered;
        while waiting != 0 {
            let ray = RayPlace { packet, lane: waiting.trailing_zeros() as usize };
            waiting &= waiting - 1;
            state.begin(&prepared, 0, ray, bvh.root);

            let mut candidates = 0;
            for number in 0..leaves.len().min(FEW) {
                let here = state.may_hit::<L>(token, &prepared, spread, &leaves[number]);
                candidates |= u64::from(here) << (number * WIDTH);
            }
            if candidates.count_ones() <= AT_ONCE {
                while candidates != 0 {
                    let place = candidates.trailing_zeros();
                    candidates &= candidates - 1;
                    deferred.add::<Q>(tier, token, (packets, ray), (bvh, place), answers);
                }
                continue;
            }
            for number in 0..leaves.len().min(FEW) {
                let first = number * WIDTH;
                if candidates >> first & 0xffff != 0 {
                    state.meet::<L, Q>(
                        tier,
                        token,
                        &prepared,
                        (packets, bvh),
                        (&leaves[number], first as u32),
                        &mut deferred,
                        answers,
                    );
                }
            }
            state.end::<L, Q>(tier, token, (packets, bvh), &mut deferred, answers);
        }
    }
    deferred.test::<Q>(tier, token, answers);
}
