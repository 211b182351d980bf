//! Trees of so few leaves that a ray looks into all of them.
//!
//! Boxes would spare a ray some leaves, and cost it more. All leaves are tested one behind the other, which
//! depends on nothing; what is left of them is seldom more than a sphere or two, and goes
//! among the questions to the tier. Where it is more, the brackets tell first which may be the nearest,
//! as in a tree.

use super::answers::Answers;
use super::ray_walk::Walk;
use super::resolve::{Questions, RayPlace};
use super::slabs::Slabs;
use super::under_way::begin;
use super::{Bvh, WIDTH};
use crate::{Accuracy, Lanes, RayPacket, Spheres};

/// How many leaves are few: as many as have their spheres in the bits of a number.
const FEW: usize = u64::BITS as usize / WIDTH;
/// So many spheres are asked about at once.
const AT_ONCE: u32 = 2;

/// Whether a tree has few leaves.
#[inline(always)]
pub(super) fn is_few(bvh: &Bvh<'_>) -> bool {
    bvh.leaves.len() <= FEW
}

/// Meets all rays with all spheres of such a tree.
#[inline(always)]
pub(super) fn look<A: Accuracy, L: Lanes, N: Answers<L>>(
    token: L::Token,
    packets: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    answers: &mut N,
) {
    let mut slabs = Slabs::none();
    let mut walk = Walk::NEW;
    let mut questions = Questions::<L>::none();
    for (packet, rays) in packets.iter().enumerate() {
        begin::<A, L>(token, (rays, packet), (spheres, bvh), &mut slabs, answers);
        let mut waiting = slabs.judged;
        while waiting != 0 {
            let ray = RayPlace { packet, lane: waiting.trailing_zeros() as usize };
            waiting &= waiting - 1;
            walk.begin(&slabs, 0, ray, bvh.root);

            let mut candidates = 0;
            for (number, leaf) in bvh.leaves.iter().enumerate().take(FEW) {
                let here = walk.filter::<A, L>(token, &slabs, leaf);
                candidates |= u64::from(here) << (number * WIDTH);
            }
            if candidates.count_ones() <= AT_ONCE {
                while candidates != 0 {
                    let place = candidates.trailing_zeros();
                    candidates &= candidates - 1;
                    questions.add::<A>(token, (packets, ray), (bvh.leaves, place), answers);
                }
                continue;
            }
            for (number, leaf) in bvh.leaves.iter().enumerate().take(FEW) {
                let first = number * WIDTH;
                if candidates >> first & 0xffff != 0 {
                    let leaf = (leaf, first as u32);
                    walk.meet::<A, L, N>(
                        token,
                        &slabs,
                        (packets, bvh),
                        leaf,
                        &mut questions,
                        answers,
                    );
                }
            }
            walk.end::<A, L, N>(token, packets, bvh, &mut questions, answers);
        }
    }
    questions.ask::<A>(token, answers);
}
