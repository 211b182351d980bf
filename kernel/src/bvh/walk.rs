//! Rays through the tree, each on its own way.
//!
//! # Method
//!
//! A ray keeps a stack of boxes that it has yet to look into, the nearest on top, each with the s
//! at which it is entered. A step takes one from the stack: a node's children are tested all at
//! once, and those that are met go onto the stack; a leaf's spheres are tested all at once, and
//! those that may be the nearest go onto a list. When a hit is surely nearer than what was known,
//! boxes entered later are dropped from the stack. When a ray is through, its list - one sphere,
//! seldom more - goes among the questions to the tier (`bvh/resolve.rs`).
//!
//! As many rays as there are lanes are under way, and go in rounds: all take a box; those that took
//! a node look into it; those that took a leaf test it; those that have ended make place for others, of
//! the same packet or the next. So few branches depend on one ray, which the processor cannot guess,
//! and the chains of some hundred cycles that a step is overlap. (One ray after the other: 0.8 to
//! 0.9 of the rate. Packet by packet: of 16 rays some 5 were under way on 7,381 spheres. Half as many
//! under way: 0.97.)
//!
//! What a packet's rays need is worked out once, in lanes, and read where it lies.

use super::answers::{Answers, Any, Nearest};
use super::ray_walk::Walk;
use super::resolve::Questions;
use super::round::{Round, Step};
use super::under_way::Packets;
use super::{Bvh, WIDTH, few, touch};
use crate::{Accuracy, HitPacket, LaneArray, Lanes, RayPacket, Spheres};
use core::hint::black_box;

/// The nearest hit of every ray: what [`nearest`](crate::nearest) returns, from a tree.
///
/// `hits[i]` is overwritten with what `rays[i]` meets; packets past the end of the shorter slice
/// are left alone. `spheres` is the list that `bvh` was built from; what happens with another
/// stands at [`Bvh`].
///
/// Domain and guarantee: see the [module](crate::bvh). Cost: by the logarithm of the number of
/// spheres, where they do not overlap much; rays that the bounds do not cover, and spheres above
/// 2^40, cost as without a tree. Stack: some 4 KiB a lane.
#[inline(always)]
pub fn nearest<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    hits: &mut [HitPacket<L>],
) {
    if bvh.count != spheres.len() {
        return crate::nearest::<A, L>(token, rays, spheres, hits);
    }
    let rays = rays.get(..hits.len()).unwrap_or(rays);
    L::out_of_line(
        token,
        #[inline(always)]
        || walk::<A, L, _>(token, rays, spheres, bvh, &mut Nearest::<L>(hits)),
    );
}

/// Whether every ray meets anything: what [`any`](crate::any) returns, from a tree.
///
/// Lane `i` in bit `i` of `met[k]` for `rays[k]`. True exactly where [`nearest`] finds a hit;
/// cheaper, since a ray that has surely met something is done. Otherwise as `nearest`.
#[inline(always)]
pub fn any<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    met: &mut [u32],
) {
    if bvh.count != spheres.len() {
        return crate::any::<A, L>(token, rays, spheres, met);
    }
    let rays = rays.get(..met.len()).unwrap_or(rays);
    L::out_of_line(
        token,
        #[inline(always)]
        || walk::<A, L, _>(token, rays, spheres, bvh, &mut Any(met)),
    );
}

/// Meets all rays with all spheres.
#[inline(always)]
fn walk<A: Accuracy, L: Lanes, N: Answers<L>>(
    token: L::Token,
    packets: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    answers: &mut N,
) {
    if few::is_few(bvh) {
        return few::look::<A, L, N>(token, packets, spheres, bvh, answers);
    }
    let mut walks = L::Array::each(Walk::NEW);
    let walks = walks.as_mut();
    let mut questions = Questions::<L>::none();
    let mut under_way = Packets::<L>::none();
    let mut round = Round::<L>::empty();
    let far = touch::is_far(bvh);
    loop {
        round.clear();
        for (number, walk) in walks.iter_mut().enumerate() {
            round.go_on(number as u32, walk);
        }
        // In the place of a ray that has ended another begins.
        for at in 0..round.ended.count {
            let Step { walk: number, .. } = round.ended.get(at);
            let Some(walk) = walks.get_mut(number as usize) else { continue };
            walk.end::<A, L, _>(token, packets, bvh, &mut questions, answers);
            under_way.end(walk);
            if under_way.begin::<A>(token, (packets, spheres, bvh), walk, answers) {
                round.go_on(number, walk);
            }
        }
        if round.nodes.count + round.leaves.count == 0 {
            break;
        }

        if far {
            let mut lines = 0;
            for at in 0..round.nodes.count {
                if let Some(node) = bvh.nodes.get(round.nodes.get(at).child as usize) {
                    lines ^= touch::node(node);
                }
            }
            for at in 0..round.leaves.count {
                if let Some(leaf) = bvh.leaves.get(round.leaves.get(at).child as usize) {
                    lines ^= touch::leaf(leaf);
                }
            }
            black_box(lines);
        }

        for at in 0..round.nodes.count {
            let step = round.nodes.get(at);
            let Some(walk) = walks.get_mut(step.walk as usize) else { continue };
            let Some(node) = bvh.nodes.get(step.child as usize) else { continue };
            let Some(slabs) = under_way.slabs(walk) else { continue };
            if N::ANY {
                walk.enter::<A, L, true>(token, slabs, node);
            } else {
                walk.enter::<A, L, false>(token, slabs, node);
            }
        }

        // Those whose leaf may hold a hit move to the front.
        let in_leaves = round.leaves.count;
        round.leaves.count = 0;
        for at in 0..in_leaves {
            let step = round.leaves.get(at);
            let Some(walk) = walks.get(step.walk as usize) else { continue };
            let Some(leaf) = bvh.leaves.get(step.child as usize) else { continue };
            let Some(slabs) = under_way.slabs(walk) else { continue };
            let spheres = walk.filter::<A, L>(token, slabs, leaf);
            round.leaves.append(step, spheres != 0);
        }
        for at in 0..round.leaves.count {
            let step = round.leaves.get(at);
            let Some(walk) = walks.get_mut(step.walk as usize) else { continue };
            let Some(leaf) = bvh.leaves.get(step.child as usize) else { continue };
            let leaf = (leaf, step.child * WIDTH as u32);
            let Some(slabs) = under_way.slabs(walk) else { continue };
            walk.meet::<A, L, _>(token, slabs, (packets, bvh), leaf, &mut questions, answers);
        }
    }
    questions.ask::<A>(token, answers);
}
