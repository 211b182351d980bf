//! The boxes that a ray has yet to look into.
//!
//! A step takes one entry and adds sixteen at most, so a ray on its way down a tree of nine
//! nodes, one below the other, has 15 * 9 + 1 = 136 at most, whatever its numbers are; 256 are
//! there, so that a mask can stand for a bounds check, and never acts.

use super::bracket::part_of;
use super::{DEPTH, WIDTH};
use crate::{LaneMask, Lanes};

/// How deep a stack can be.
const DEEPEST: usize = 256;
const _: () = assert!(DEEPEST >= (WIDTH - 1) * DEPTH + WIDTH);

/// What a ray meets in a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    pub(super) children: u32,
    pub(super) entries: [f32; WIDTH],
}

impl Met {
    pub(super) const NOTHING: Self = Self { children: 0, entries: [0.0; WIDTH] };
}

/// Boxes, and the s at which the ray enters each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stack {
    entries: [f32; DEEPEST + WIDTH],
    /// As bits: numbers that are moved, never computed with.
    children: [f32; DEEPEST + WIDTH],
    top: usize,
}

impl Stack {
    pub(super) const EMPTY: Self =
        Self { entries: [0.0; DEEPEST + WIDTH], children: [0.0; DEEPEST + WIDTH], top: 0 };

    /// Nothing but the root.
    #[inline(always)]
    pub(super) fn begin(&mut self, root: u32) {
        self.entries[0] = f32::NEG_INFINITY;
        self.children[0] = f32::from_bits(root);
        self.top = 1;
    }

    pub(super) fn clear(&mut self) {
        self.top = 0;
    }

    /// Takes a box from the stack, which is not empty.
    #[inline(always)]
    pub(super) fn pop(&mut self) -> u32 {
        self.top = self.top.wrapping_sub(1) & (DEEPEST - 1);
        self.children[self.top].to_bits()
    }

    #[inline(always)]
    pub(super) fn is_empty(&self) -> bool {
        self.top == 0
    }

    /// Lays the children that are `met` onto the stack: the nearest on top, where `SORTED`, the
    /// others in their own order.
    ///
    /// (All in order, by counting for each those entered later: as fast to a tenth slower, since the
    /// processor cannot guess the number of children.)
    #[inline(always)]
    pub(super) fn push<L: Lanes, const SORTED: bool>(
        &mut self,
        token: L::Token,
        met: &Met,
        children: &[u32; WIDTH],
    ) {
        let mut others = met.children;
        let mut nearest = 0;
        if SORTED {
            let mut least = L::splat(token, f32::INFINITY);
            for part in 0..WIDTH / L::COUNT {
                let mask = L::mask(token, met.children >> (part * L::COUNT));
                let entries = part_of::<L>(token, &met.entries, part);
                least = -(-L::select(mask, entries, least)).filter_max(-least);
            }
            let least = L::splat(token, -(-least).filter_greatest());
            let mut first = 0;
            for part in 0..WIDTH / L::COUNT {
                let entries = part_of::<L>(token, &met.entries, part);
                first |= entries.le(least).bits() << (part * L::COUNT);
            }
            first &= others;
            nearest = first.trailing_zeros() as usize % WIDTH;
            others &= !(first & first.wrapping_neg());
        }
        let bits = children.map(f32::from_bits);
        for part in 0..WIDTH / L::COUNT {
            let here = others >> (part * L::COUNT) & ((1_u64 << L::COUNT) - 1) as u32;
            let mask = L::mask(token, here);
            let top = self.top & (DEEPEST - 1);
            let entries = part_of::<L>(token, &met.entries, part);
            put::<L>(&mut self.entries, top, entries.compress(mask));
            put::<L>(&mut self.children, top, part_of::<L>(token, &bits, part).compress(mask));
            self.top = top + here.count_ones() as usize;
        }
        if SORTED {
            let top = self.top & (DEEPEST - 1);
            self.entries[top] = met.entries[nearest];
            self.children[top] = bits[nearest];
            self.top = top + usize::from(met.children != 0);
        }
    }

    /// Drops what is entered past `limit`.
    #[inline(always)]
    pub(super) fn cull<L: Lanes>(&mut self, token: L::Token, limit: f32) {
        let limit = L::splat(token, limit);
        let (top, mut kept) = (self.top, 0);
        for from in (0..top).step_by(L::COUNT) {
            let entries = get::<L>(token, &self.entries, from);
            let children = get::<L>(token, &self.children, from);
            let stays = entries.le(limit);
            put::<L>(&mut self.entries, kept, entries.compress(stays));
            put::<L>(&mut self.children, kept, children.compress(stays));
            let here = stays.bits() & (((1_u64 << (top - from).min(L::COUNT)) - 1) as u32);
            kept += here.count_ones() as usize;
        }
        self.top = kept;
    }
}

/// Takes lanes from a stack.
#[inline(always)]
fn get<L: Lanes>(token: L::Token, stack: &[f32; DEEPEST + WIDTH], at: usize) -> L {
    let mut array = L::Array::default();
    if let Some(places) = stack.get(at..at + L::COUNT) {
        array.as_mut().copy_from_slice(places);
    }
    L::load(token, &array)
}

/// Lays lanes onto a stack.
#[inline(always)]
fn put<L: Lanes>(stack: &mut [f32; DEEPEST + WIDTH], at: usize, lanes: L) {
    let array = lanes.store();
    if let Some(places) = stack.get_mut(at..at + L::COUNT) {
        places.copy_from_slice(array.as_ref());
    }
}
