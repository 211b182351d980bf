//! One ray on its way: what it knows, the stack, and what it does with nodes and leaves.
//!
//! # The stack
//!
//! A step takes one entry and adds sixteen at most, so a ray on its way down a tree of nine
//! nodes, one below the other, has 15 * 9 + 1 = 136 at most, whatever its numbers are; 256 are
//! there, so that a mask can stand for a bounds check, and never acts. Spheres that are not in the
//! order of their s cost time, no memory: a full list is settled (`LIST`).

use super::bracket::{Probe, part_of};
use super::resolve::{List, settle_one, take};
use super::slabs::{Slabs, raised};
use super::{Bvh, BvhLeaf, BvhNode, DEPTH, WIDTH};
use crate::axes::axes;
use crate::{Accuracy, HitPacket, LaneMask, Lanes, RayPacket};

/// How deep a stack can be.
const STACK: usize = 256;
const _: () = assert!(STACK >= (WIDTH - 1) * DEPTH + WIDTH);

/// Puts lanes where [`part_of`] would take them from.
#[inline(always)]
pub(super) fn put_part<L: Lanes>(numbers: &mut [f32; WIDTH], part: usize, lanes: L) {
    let array = lanes.store();
    let places = numbers.iter_mut().skip(part * L::COUNT % WIDTH);
    for (place, number) in places.zip(array.as_ref()) {
        *place = *number;
    }
}

/// Takes lanes from a stack.
#[inline(always)]
fn get<L: Lanes>(token: L::Token, stack: &[f32; STACK + WIDTH], at: usize) -> L {
    let mut array = L::Array::default();
    if let Some(places) = stack.get(at..at + L::COUNT) {
        array.as_mut().copy_from_slice(places);
    }
    L::load(token, &array)
}

/// Lays lanes onto a stack.
#[inline(always)]
fn put<L: Lanes>(stack: &mut [f32; STACK + WIDTH], at: usize, lanes: L) {
    let array = lanes.store();
    if let Some(places) = stack.get_mut(at..at + L::COUNT) {
        places.copy_from_slice(array.as_ref());
    }
}

/// What a ray meets in a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    children: u32,
    entries: [f32; WIDTH],
}

impl Met {
    pub(super) const NOTHING: Self = Self { children: 0, entries: [0.0; WIDTH] };
}

/// One ray under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Walk {
    origin: [f32; 3],
    direction: [f32; 3],
    inverse: [f32; 3],
    near: [f32; 3],
    far: [f32; 3],
    start: [f32; 2],
    /// Some answer, or the end of the interval, is not above.
    pub(super) best: f32,
    /// The end of the interval, from below.
    end: f32,
    spread: f32,
    /// |d|.
    length: f32,
    pub(super) lane: usize,
    pub(super) list: List,
    /// Something is surely met.
    pub(super) met: bool,
    entries: [f32; STACK + WIDTH],
    /// As bits: numbers that are moved, never computed with.
    children: [f32; STACK + WIDTH],
    top: usize,
}

impl Walk {
    pub(super) const NEW: Self = Self {
        origin: [0.0; 3],
        direction: [0.0; 3],
        inverse: [0.0; 3],
        near: [0.0; 3],
        far: [0.0; 3],
        start: [0.0; 2],
        best: 0.0,
        end: 0.0,
        spread: 0.0,
        length: 0.0,
        lane: 0,
        list: List::EMPTY,
        met: false,
        entries: [0.0; STACK + WIDTH],
        children: [0.0; STACK + WIDTH],
        top: 0,
    };

    #[inline(always)]
    pub(super) fn begin<L: Lanes>(&mut self, slabs: &Slabs<L>, lane: usize, root: u32) {
        #[inline(always)]
        fn at<A: AsRef<[f32]>>(array: &A, lane: usize) -> f32 {
            match array.as_ref().get(lane) {
                Some(value) => *value,
                None => f32::NAN,
            }
        }
        self.origin = axes!(i => at(&slabs.origin[i], lane));
        self.direction = axes!(i => at(&slabs.direction[i], lane));
        self.inverse = axes!(i => at(&slabs.inverse[i], lane));
        self.near = axes!(i => at(&slabs.near[i], lane));
        self.far = axes!(i => at(&slabs.far[i], lane));
        self.start = [at(&slabs.start[0], lane), at(&slabs.start[1], lane)];
        self.end = at(&slabs.end[0], lane);
        self.best = at(&slabs.end[1], lane);
        self.spread = at(&slabs.spread, lane);
        self.length = at(&slabs.length, lane);
        self.lane = lane;
        self.list.count = 0;
        self.met = false;
        self.entries[0] = f32::NEG_INFINITY;
        self.children[0] = f32::from_bits(root);
        self.top = 1;
    }

    /// Takes a box from the stack.
    #[inline(always)]
    pub(super) fn next(&mut self) -> Option<u32> {
        self.top = self.top.checked_sub(1)?;
        Some(self.children[self.top & (STACK - 1)].to_bits())
    }

    #[inline(always)]
    pub(super) fn enter<A: Accuracy, L: Lanes>(
        &self,
        token: L::Token,
        node: &BvhNode,
        met: &mut Met,
    ) {
        let best = if A::SPREAD > 0.0 { self.best + self.spread } else { self.best };
        let start = if A::SPREAD > 0.0 { self.start[0] - self.spread } else { self.start[0] };
        let forward = axes!(i => self.inverse[i] >= 0.0);
        let nearer = axes!(i => if forward[i] { &node.low[i] } else { &node.high[i] });
        let farther = axes!(i => if forward[i] { &node.high[i] } else { &node.low[i] });
        let inverse = axes!(i => L::splat(token, self.inverse[i]));
        let near = axes!(i => L::splat(token, -self.near[i]));
        let far = axes!(i => L::splat(token, self.far[i]));
        let (start, minus_best) = (L::splat(token, start), L::splat(token, -best));
        met.children = 0;
        for part in 0..WIDTH / L::COUNT {
            let entry = axes!(i => {
                part_of::<L>(token, nearer[i], part).filter_mul_add(inverse[i], near[i])
            });
            let minus_leave = axes!(i => {
                part_of::<L>(token, farther[i], part).filter_mul_add(-inverse[i], far[i])
            });
            let entry = entry[0].filter_max(entry[1]).filter_max(entry[2].filter_max(start));
            let minus_leave = minus_leave[0]
                .filter_max(minus_leave[1])
                .filter_max(minus_leave[2].filter_max(minus_best));
            met.children |= entry.le(-minus_leave).bits() << (part * L::COUNT);
            put_part(&mut met.entries, part, entry);
        }
    }

    /// Lays the children that are `met` onto the stack, the nearest on top.
    ///
    /// A child's place is the number of those entered later, counted by a comparison with all:
    /// most nodes have one or two, and loops of a sort would be guessed wrong by the processor.
    #[inline(always)]
    pub(super) fn push_sorted<L: Lanes>(
        &mut self,
        token: L::Token,
        Met { children: met, entries }: &Met,
        children: &[u32; WIDTH],
    ) {
        let met = *met;
        let base = self.top;
        let mut left = met;
        while left != 0 {
            let lane = left.trailing_zeros() as usize % WIDTH;
            let below = left & left.wrapping_neg();
            left &= left - 1;
            let entry = L::splat(token, entries[lane]);
            let (mut later, mut earlier) = (0, 0);
            for part in 0..WIDTH / L::COUNT {
                let others = part_of::<L>(token, entries, part);
                later |= entry.lt(others).bits() << (part * L::COUNT);
                earlier |= others.lt(entry).bits() << (part * L::COUNT);
            }
            let equal_before = !(later | earlier) & (below - 1);
            let rank = ((later | equal_before) & met).count_ones() as usize;
            let at = (base + rank) & (STACK - 1);
            self.entries[at] = entries[lane];
            self.children[at] = f32::from_bits(children[lane]);
            self.top += 1;
        }
    }

    /// Drops what is entered past the best.
    #[inline(always)]
    fn cull<A: Accuracy, L: Lanes>(&mut self, token: L::Token) {
        let best = if A::SPREAD > 0.0 { self.best + self.spread } else { self.best };
        let limit = L::splat(token, best);
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

    #[inline(always)]
    fn probe<L: Lanes>(&self, token: L::Token) -> Probe<L> {
        Probe {
            origin: axes!(i => L::splat(token, self.origin[i])),
            direction: axes!(i => L::splat(token, self.direction[i])),
            start: [L::splat(token, self.start[0]), L::splat(token, self.start[1])],
            end: [L::splat(token, self.end), L::splat(token, self.best)],
        }
    }

    /// Which spheres of a leaf to look at.
    #[inline(always)]
    pub(super) fn filter<A: Accuracy, L: Lanes>(&self, token: L::Token, leaf: &BvhLeaf) -> u32 {
        let probe = self.probe::<L>(token);
        let mut spheres = 0;
        for part in 0..WIDTH / L::COUNT {
            spheres |= probe.may_meet::<A>(leaf, part) << (part * L::COUNT);
        }
        spheres
    }

    #[inline(always)]
    pub(super) fn meet<A: Accuracy, L: Lanes, const ANY: bool>(
        &mut self,
        token: L::Token,
        packet: &RayPacket<L>,
        bvh: &Bvh<'_>,
        leaf: &BvhLeaf,
        place: u32,
        hits: &mut HitPacket<L>,
    ) {
        let before = self.best;
        let probe = self.probe::<L>(token);
        for part in 0..WIDTH / L::COUNT {
            let bracket = probe.meet::<A>(leaf, part);
            let (entries, bounds) = (bracket.entry.store(), bracket.bound.store());
            let mut candidates = bracket.candidates.bits();
            while candidates != 0 {
                let lane = candidates.trailing_zeros() as usize;
                candidates &= candidates - 1;
                let (Some(&entry), Some(&bound)) =
                    (entries.as_ref().get(lane), bounds.as_ref().get(lane))
                else {
                    continue;
                };
                if ANY && bound < f32::INFINITY {
                    self.met = true;
                    self.top = 0;
                    return;
                }
                if entry > self.best {
                    continue;
                }
                if bound < self.best {
                    self.best = bound;
                }
                if self.list.is_full(self.best) {
                    self.flush::<A, L, ANY>(token, packet, bvh, hits);
                }
                self.list.push(place + (part * L::COUNT + lane) as u32, entry);
            }
        }
        if self.best < before {
            self.cull::<A, L>(token);
        }
    }

    /// Asks the tier about the list, which is full.
    #[inline(always)]
    fn flush<A: Accuracy, L: Lanes, const ANY: bool>(
        &mut self,
        token: L::Token,
        packet: &RayPacket<L>,
        bvh: &Bvh<'_>,
        hits: &mut HitPacket<L>,
    ) {
        let (lane, list) = (self.lane, self.list);
        self.list.count = 0;
        let nearest = L::out_of_line(
            token,
            #[inline(always)]
            || settle_one::<A, L>(token, packet, lane, bvh.leaves, &list),
        );
        let Some(hit) = nearest else { return };
        take(hits, lane, hit.t, hit.sphere);
        if ANY {
            self.met = true;
            self.top = 0;
        }
        let best = raised(hit.t * self.length);
        if best < self.best {
            self.best = best;
        }
    }
}
