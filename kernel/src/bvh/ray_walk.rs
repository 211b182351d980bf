//! One ray on its way: what it knows, and what it does with nodes and leaves.
//!
//! Spheres that are not in the order of their s cost time, no memory: a full list of candidates
//! is settled.

use super::answers::Answers;
use super::approach::RayTime;
use super::bracket::{Probe, part_of};
use super::candidates::Candidates;
use super::resolve::{Questions, RayPlace};
use super::slabs::Slabs;
use super::stack::{Met, Stack};
use super::{Bvh, BvhLeaf, BvhNode, WIDTH};
use crate::axes::axes;
use crate::{Accuracy, Hit, LaneMask, Lanes, RayPacket};

/// Puts lanes where [`part_of`] would take them from.
#[inline(always)]
pub(super) fn put_part<L: Lanes>(numbers: &mut [f32; WIDTH], part: usize, lanes: L) {
    let array = lanes.store();
    let places = numbers.iter_mut().skip(part * L::COUNT % WIDTH);
    for (place, number) in places.zip(array.as_ref()) {
        *place = *number;
    }
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
    aside: f32,
    time: RayTime<f32>,
    pub(super) ray: RayPlace,
    candidates: Candidates,
    pub(super) stack: Stack,
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
        aside: 0.0,
        time: RayTime { shift: 0.0, length: 0.0 },
        ray: RayPlace::FIRST,
        candidates: Candidates::NONE,
        stack: Stack::EMPTY,
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
        self.aside = at(&slabs.aside, lane);
        self.time = RayTime { shift: at(&slabs.shift, lane), length: at(&slabs.length, lane) };
        if limit < f32::INFINITY {
            self.shorten(limit);
        }
        self.ray = ray;
        self.candidates.clear();
        self.stack.begin(root);
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

    #[inline(always)]
    fn probe<L: Lanes>(&self, token: L::Token) -> Probe<L> {
        Probe {
            origin: axes!(i => L::splat(token, self.origin[i])),
            direction: axes!(i => L::splat(token, self.direction[i])),
            start: [L::splat(token, self.start[0]), L::splat(token, self.start[1])],
            end: [L::splat(token, self.end), L::splat(token, self.best)],
            aside: L::splat(token, self.aside),
            blur: L::splat(token, self.time.blur()),
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
        let best = self.time.after(t);
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
                    self.stack.clear();
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
            let best = if A::SPREAD > 0.0 { self.best + self.spread } else { self.best };
            self.stack.cull::<L>(token, best);
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
