//! One ray on its way: what it knows, the stack, and what it does with nodes and leaves.
//!
//! # The stack
//!
//! A step takes one entry and adds sixteen at most, so a ray on its way down a tree of nine
//! nodes, one below the other, has 15 * 9 + 1 = 136 at most, whatever its numbers are; 256 are
//! there, so that a mask can stand for a bounds check, and never acts. Spheres that are not in the
//! order of their s cost time, no memory: a full list is settled (`LIST`).

use super::answers::Answers;
use super::bracket::{Probe, part_of};
use super::candidates::Candidates;
use super::resolve::{Questions, RayPlace};
use super::slabs::{Slabs, raised};
use super::{Bvh, BvhLeaf, BvhNode, DEPTH, WIDTH};
use crate::axes::axes;
use crate::{Accuracy, Hit, LaneMask, Lanes, RayPacket};

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
    pub(super) ray: RayPlace,
    candidates: Candidates,
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
        ray: RayPlace::FIRST,
        candidates: Candidates::NONE,
        entries: [0.0; STACK + WIDTH],
        children: [0.0; STACK + WIDTH],
        top: 0,
    };

    #[inline(always)]
    pub(super) fn begin<L: Lanes>(
        &mut self,
        slabs: &Slabs<L>,
        ray: RayPlace,
        limit: f32,
        root: u32,
    ) {
        #[inline(always)]
        fn at<A: AsRef<[f32]>>(array: &A, lane: usize) -> f32 {
            match array.as_ref().get(lane) {
                Some(value) => *value,
                None => f32::NAN,
            }
        }
        let lane = ray.lane;
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
        if limit < f32::INFINITY {
            self.shorten(limit);
        }
        self.ray = ray;
        self.candidates.clear();
        self.entries[0] = f32::NEG_INFINITY;
        self.children[0] = f32::from_bits(root);
        self.top = 1;
    }

    /// Takes a box from the stack, which is not empty.
    #[inline(always)]
    pub(super) fn next(&mut self) -> u32 {
        self.top = self.top.wrapping_sub(1) & (STACK - 1);
        self.children[self.top].to_bits()
    }

    /// Nothing is left on the stack.
    #[inline(always)]
    pub(super) fn has_ended(&self) -> bool {
        self.top == 0
    }

    #[inline(always)]
    pub(super) fn enter<A: Accuracy, L: Lanes>(&self, token: L::Token, node: &BvhNode) -> Met {
        let mut met = Met { children: 0, entries: [0.0; WIDTH] };
        let best = if A::SPREAD > 0.0 { self.best + self.spread } else { self.best };
        let start = if A::SPREAD > 0.0 { self.start[0] - self.spread } else { self.start[0] };
        let forward = axes!(i => self.inverse[i] >= 0.0);
        let nearer = axes!(i => if forward[i] { &node.low[i] } else { &node.high[i] });
        let farther = axes!(i => if forward[i] { &node.high[i] } else { &node.low[i] });
        let inverse = axes!(i => L::splat(token, self.inverse[i]));
        let near = axes!(i => L::splat(token, -self.near[i]));
        let far = axes!(i => L::splat(token, self.far[i]));
        let (start, minus_best) = (L::splat(token, start), L::splat(token, -best));
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
        met
    }

    /// Lays the children that are `met` onto the stack: the nearest on top, where `SORTED`, the
    /// others in their own order.
    ///
    /// (All in order, by counting those entered later or by insertion: a tenth slower for the
    /// nearest hit, since the number of children cannot be guessed.)
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
            let top = self.top & (STACK - 1);
            let entries = part_of::<L>(token, &met.entries, part);
            put::<L>(&mut self.entries, top, entries.compress(mask));
            put::<L>(&mut self.children, top, part_of::<L>(token, &bits, part).compress(mask));
            self.top = top + here.count_ones() as usize;
        }
        if SORTED {
            let top = self.top & (STACK - 1);
            self.entries[top] = met.entries[nearest];
            self.children[top] = bits[nearest];
            self.top = top + usize::from(met.children != 0);
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

    /// Takes a t that the ray surely has as its end.
    #[inline(always)]
    fn shorten(&mut self, t: f32) {
        let best = raised(t * self.length);
        if best < self.best {
            self.best = best;
        }
    }

    /// Looks at the spheres of a leaf, the first of which is at `place`.
    #[inline(always)]
    pub(super) fn meet<A: Accuracy, L: Lanes, N: Answers<L>>(
        &mut self,
        token: L::Token,
        packets: &[RayPacket<L>],
        bvh: &Bvh<'_>,
        (leaf, place): (&BvhLeaf, u32),
        questions: &mut Questions<L>,
        answers: &mut N,
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
                if N::ANY && bound < f32::INFINITY {
                    answers.take(self.ray.packet, self.ray.lane, Hit { t: 0.0, sphere: 0 });
                    self.candidates.clear();
                    self.top = 0;
                    return;
                }
                if entry > self.best {
                    continue;
                }
                if bound < self.best {
                    self.best = bound;
                }
                if self.candidates.is_full(self.best) {
                    self.settle::<A, L, N>(token, packets, bvh, questions, answers);
                }
                self.candidates.push(place + (part * L::COUNT + lane) as u32, entry);
            }
        }
        if self.best < before {
            self.cull::<A, L>(token);
        }
    }

    /// Asks the tier about the candidates, which are too many to keep, at once.
    #[inline(always)]
    fn settle<A: Accuracy, L: Lanes, N: Answers<L>>(
        &mut self,
        token: L::Token,
        packets: &[RayPacket<L>],
        bvh: &Bvh<'_>,
        questions: &mut Questions<L>,
        answers: &mut N,
    ) {
        self.end::<A, L, N>(token, packets, bvh, questions, answers);
        L::out_of_line(
            token,
            #[inline(always)]
            || questions.ask::<A>(token, answers),
        );
        self.shorten(answers.limit(self.ray.packet, self.ray.lane));
    }

    /// Puts the candidates among the questions.
    #[inline(always)]
    pub(super) fn end<A: Accuracy, L: Lanes, N: Answers<L>>(
        &mut self,
        token: L::Token,
        packets: &[RayPacket<L>],
        bvh: &Bvh<'_>,
        questions: &mut Questions<L>,
        answers: &mut N,
    ) {
        for place in self.candidates.places(self.best) {
            questions.add::<A>(token, (packets, self.ray), (bvh.leaves, place), answers);
        }
        self.candidates.clear();
    }
}
