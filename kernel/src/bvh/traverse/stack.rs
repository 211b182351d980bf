//! The boxes that a ray has yet to look into.
//!
//! What a ray meets in a node is one frame: up to sixteen boxes, the next on top. Frames lie one on the
//! other as the nodes do in the tree, nine at most (`docs/traversal-margins.md`), whatever a ray's numbers are; sixteen
//! are there, so that a mask can stand for a bounds check, and never acts. (All boxes one behind
//! the other: as fast, with a proof of its length that says more than that there are nine.)

use crate::bvh::node::{DEPTH, WIDTH};
use crate::lanes::{LaneArray, LaneMask, Lanes};

/// How many frames there are.
const FRAMES: usize = 16;
const _: () = assert!(FRAMES > DEPTH);

/// Boxes of one node, and the s at which the ray enters each.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Frame {
    entries: [f32; WIDTH],
    /// As bits: numbers that are moved, never computed with.
    children: [f32; WIDTH],
}

/// Boxes, and the s at which the ray enters each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stack {
    frames: [Frame; FRAMES],
    /// How many boxes a frame holds: one at least.
    counts: [u32; FRAMES],
    top: usize,
}

impl Stack {
    pub(crate) const EMPTY: Self = Self {
        frames: [Frame { entries: [0.0; WIDTH], children: [0.0; WIDTH] }; FRAMES],
        counts: [0; FRAMES],
        top: 0,
    };

    /// Nothing but the root.
    #[inline(always)]
    pub(crate) fn begin(&mut self, root: u32) {
        self.frames[0].entries[0] = f32::NEG_INFINITY;
        self.frames[0].children[0] = f32::from_bits(root);
        self.counts[0] = 1;
        self.top = 1;
    }

    pub(crate) fn clear(&mut self) {
        self.top = 0;
    }

    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.top == 0
    }

    /// Takes a box from the stack; where it is empty, any, and it stays so.
    #[inline(always)]
    pub(crate) fn pop(&mut self) -> u32 {
        let below = self.top.saturating_sub(1) % FRAMES;
        let left = self.counts[below].wrapping_sub(1);
        self.counts[below] = left;
        self.top = if left == 0 { below } else { self.top };
        self.frames[below].children[left as usize % WIDTH].to_bits()
    }

    /// Lays the boxes of the lanes `met` onto the stack as a frame, the last on top; for sixteen
    /// lanes.
    #[inline(always)]
    pub(crate) fn push<L: Lanes>(&mut self, met: L::Mask, entries: L, children: L) {
        let top = self.top % FRAMES;
        let frame = &mut self.frames[top];
        entries.compress(met).store().put_part(&mut frame.entries, 0);
        children.compress(met).store().put_part(&mut frame.children, 0);
        self.count(met.bits().count_ones());
    }

    /// The same for all that is in a node, `met` a bit a slot, in the order of an octant.
    #[inline(always)]
    pub(crate) fn push_in_order(
        &mut self,
        met: u32,
        order: u64,
        entries: &[f32; WIDTH],
        children: &[f32; WIDTH],
    ) {
        let frame = &mut self.frames[self.top % FRAMES];
        let mut count = 0;
        for place in 0..WIDTH {
            let slot = (order >> (4 * place)) as usize % WIDTH;
            frame.entries[count % WIDTH] = entries[slot];
            frame.children[count % WIDTH] = children[slot];
            count += (met >> slot & 1) as usize;
        }
        self.count(count as u32);
    }

    /// Takes the frame above the top, which holds so many, as the top.
    #[inline(always)]
    fn count(&mut self, count: u32) {
        self.counts[self.top % FRAMES] = count;
        self.top = self.top % FRAMES + usize::from(count > 0);
    }

    /// Drops what is entered past `limit`.
    #[inline(always)]
    pub(crate) fn cull<L: Lanes>(&mut self, token: L::Token, limit: f32) {
        let top = self.top % FRAMES;
        self.top = 0;
        for from in 0..top {
            let Frame { entries, children } = self.frames[from];
            let there = (1_u32 << (self.counts[from] % 32)) - 1;
            if L::COUNT == WIDTH {
                let entries = L::load_part(token, &entries, 0);
                let stays = entries.le(L::splat(token, limit)) & L::mask(token, there);
                self.push(stays, entries, L::load_part(token, &children, 0));
            } else {
                let mut stays = 0;
                for place in 0..WIDTH {
                    stays |= u32::from(entries[place] <= limit) << place;
                }
                self.push_in_order(stays & there, AS_THEY_ARE, &entries, &children);
            }
        }
    }
}

/// The order that leaves all where it is.
const AS_THEY_ARE: u64 = 0xfedc_ba98_7654_3210;
