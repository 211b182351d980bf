//! The boxes that a ray has yet to look into.
//!
//! A frame holds a node, the s at which the ray enters each of its sixteen boxes, and which boxes are left, in the
//! order in which the ray takes them. A frame that held only the boxes that the ray meets would move them together,
//! which a CPU without AVX-512 cannot do for sixteen lanes. Frames lie one on the other as the nodes do in the tree,
//! ten at most (`docs/traversal-margins.md`), whatever a ray's numbers are. There is room for sixteen, so that a
//! mask can stand for a bounds check; the mask never changes a number. (A stack of all boxes, one behind the other,
//! is as fast, but a proof of its length must say more than that there are ten frames.)

use crate::bvh::node::{BvhNode, FRAMES, NO_CHILD, WIDTH};
use crate::lanes::{LaneMask, Lanes};

/// Boxes of one node, and the s at which the ray enters each.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Frame {
    entries: [f32; WIDTH],
    /// The order in which the boxes are taken, the last first: four bits each.
    order: u64,
    /// Which boxes are left, in that order.
    left: u32,
    node: u32,
}

/// Boxes, and the s at which the ray enters each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stack {
    frames: [Frame; FRAMES],
    top: usize,
    /// The root, as long as it is all there is.
    root: u32,
}

impl Stack {
    /// All zeros: [cleared](Self::clear), or [begun](Self::begin) with, before it is used.
    pub(crate) const EMPTY: Self = Self {
        frames: [Frame { entries: [0.0; WIDTH], order: 0, left: 0, node: 0 }; FRAMES],
        top: 0,
        root: 0,
    };

    /// Nothing but the root.
    #[inline(always)]
    pub(crate) fn begin(&mut self, root: u32) {
        (self.root, self.top) = (root, 0);
    }

    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        (self.root, self.top) = (NO_CHILD, 0);
    }

    /// Takes a box from the stack; [`NO_CHILD`] if there is none.
    #[inline(always)]
    pub(crate) fn pop(&mut self, nodes: &[BvhNode]) -> u32 {
        if self.top == 0 {
            return core::mem::replace(&mut self.root, NO_CHILD);
        }
        let below = (self.top - 1) % FRAMES;
        let Frame { order, left, node, .. } = &mut self.frames[below];
        let place = u32::BITS - 1 - (*left | 1).leading_zeros();
        *left &= !(1 << place);
        self.top = if *left == 0 { below } else { self.top };
        let slot = (*order >> (4 * place)) as usize % WIDTH;
        match nodes.get(*node as usize) {
            Some(node) => node.child[slot],
            None => NO_CHILD,
        }
    }

    /// Lays the boxes of a node that are `met`, a bit a slot, onto the stack as a frame, in the order given, or in
    /// that of their slots if it is `None`.
    #[inline(always)]
    pub(crate) fn push<L: Lanes>(
        &mut self,
        token: L::Token,
        (node, order): (u32, Option<u64>),
        met: u32,
        entries: &[f32; WIDTH],
    ) {
        let (left, order) = match order {
            Some(order) => (L::bits_in_order(token, met, order), order),
            None => (met, AS_THEY_ARE),
        };
        self.frames[self.top % FRAMES] = Frame { entries: *entries, order, left, node };
        self.top = self.top % FRAMES + usize::from(left != 0);
    }

    /// Drops boxes that the ray enters past `limit`.
    #[inline(always)]
    pub(crate) fn cull<L: Lanes>(&mut self, token: L::Token, limit: f32) {
        let limit = L::splat(token, limit);
        let top = self.top % FRAMES;
        self.top = 0;
        for from in 0..top {
            let frame = self.frames[from];
            let mut stays = 0;
            for part in 0..WIDTH / L::COUNT {
                let entries = L::load_part(token, &frame.entries, part);
                stays |= entries.le(limit).bits() << (part * L::COUNT);
            }
            let left = frame.left & L::bits_in_order(token, stays, frame.order);
            self.frames[self.top % FRAMES] = Frame { left, ..frame };
            self.top += usize::from(left != 0);
        }
    }
}

/// The order of the slots.
const AS_THEY_ARE: u64 = 0xfedc_ba98_7654_3210;
