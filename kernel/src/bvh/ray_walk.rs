//! One ray on its way: what it knows, and what it does with nodes and leaves.
//!
//! Spheres that are not in the order of their s cost time, no memory: a full list of candidates
//! is settled.

use super::answers::Answers;
use super::bracket::{Probe, part_of};
use super::candidates::Candidates;
use super::octants::octant_of;
use super::resolve::{Questions, RayPlace};
use super::slabs::{Slabs, at};
use super::stack::Stack;
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
    pub(super) ray: RayPlace,
    /// Which packet under way it is of; past all of them where it is of none.
    pub(super) slabs: u32,
    /// The octant of its direction.
    octant: u32,
    /// Some answer, or the end of the interval, is not above.
    best: f32,
    candidates: Candidates,
    pub(super) stack: Stack,
}

impl Walk {
    pub(super) const NEW: Self = Self {
        ray: RayPlace::FIRST,
        slabs: u32::MAX,
        octant: 0,
        best: 0.0,
        candidates: Candidates::NONE,
        stack: Stack::EMPTY,
    };

    /// Begins with ray `ray`, of the packet under way `packet`, whose rays `slabs` are.
    #[inline(always)]
    pub(super) fn begin<L: Lanes>(
        &mut self,
        slabs: &Slabs<L>,
        packet: u32,
        ray: RayPlace,
        root: u32,
    ) {
        self.ray = ray;
        self.slabs = packet;
        self.octant = octant_of(axes!(i => slabs.down[i] >> (ray.lane % 32) & 1 == 1));
        self.best = at(&slabs.end[1], ray.lane);
        self.candidates.clear();
        self.stack.begin(root);
    }

    /// How far boxes matter.
    #[inline(always)]
    fn end_of_boxes<A: Accuracy, L: Lanes>(&self, slabs: &Slabs<L>) -> f32 {
        if A::SPREAD > 0.0 { self.best + at(&slabs.spread, self.ray.lane) } else { self.best }
    }

    /// Lays the children of a node that the ray meets onto its stack; the nearest on top, but
    /// where `ANY` hit will do.
    #[inline(always)]
    pub(super) fn enter<A: Accuracy, L: Lanes, const ANY: bool>(
        &mut self,
        token: L::Token,
        slabs: &Slabs<L>,
        node: &BvhNode,
    ) {
        let lane = self.ray.lane;
        let best = self.end_of_boxes::<A, L>(slabs);
        let start = at(&slabs.start[0], lane);
        let start = if A::SPREAD > 0.0 { start - at(&slabs.spread, lane) } else { start };
        let down = axes!(i => self.octant >> i & 1 == 1);
        let nearer = axes!(i => if down[i] { &node.high[i] } else { &node.low[i] });
        let farther = axes!(i => if down[i] { &node.low[i] } else { &node.high[i] });
        let inverse = axes!(i => L::splat(token, at(&slabs.inverse[i], lane)));
        let minus_inverse = axes!(i => L::splat(token, at(&slabs.minus_inverse[i], lane)));
        let minus_near = axes!(i => L::splat(token, at(&slabs.minus_near[i], lane)));
        let far = axes!(i => L::splat(token, at(&slabs.far[i], lane)));
        let (start, minus_best) = (L::splat(token, start), L::splat(token, -best));
        let order = node.order[self.octant as usize % 8];
        let children = node.child.map(f32::from_bits);

        let (mut met, mut entries) = (0, [0.0; WIDTH]);
        for part in 0..WIDTH / L::COUNT {
            let entry = axes!(i => {
                part_of::<L>(token, nearer[i], part).filter_mul_add(inverse[i], minus_near[i])
            });
            let minus_leave = axes!(i => {
                part_of::<L>(token, farther[i], part).filter_mul_add(minus_inverse[i], far[i])
            });
            let entry = entry[0].filter_max(entry[1]).filter_max(entry[2].filter_max(start));
            let minus_leave = minus_leave[0]
                .filter_max(minus_leave[1])
                .filter_max(minus_leave[2].filter_max(minus_best));
            let child = part_of::<L>(token, &children, part);
            if L::COUNT == WIDTH && ANY {
                self.stack.push::<L>(entry.le(-minus_leave), entry, child);
            } else if L::COUNT == WIDTH {
                let (entry, minus_leave) = (entry.in_order(order), minus_leave.in_order(order));
                self.stack.push::<L>(entry.le(-minus_leave), entry, child.in_order(order));
            } else {
                met |= entry.le(-minus_leave).bits() << (part * L::COUNT);
                put_part(&mut entries, part, entry);
            }
        }
        if L::COUNT != WIDTH {
            self.stack.push_in_order(met, order, &entries, &children);
        }
    }

    #[inline(always)]
    fn probe<L: Lanes>(&self, token: L::Token, slabs: &Slabs<L>) -> Probe<L> {
        let lane = self.ray.lane;
        Probe {
            origin: axes!(i => L::splat(token, at(&slabs.origin[i], lane))),
            direction: axes!(i => L::splat(token, at(&slabs.direction[i], lane))),
            start: [
                L::splat(token, at(&slabs.start[0], lane)),
                L::splat(token, at(&slabs.start[1], lane)),
            ],
            end: [L::splat(token, at(&slabs.end[0], lane)), L::splat(token, self.best)],
            aside: L::splat(token, at(&slabs.aside, lane)),
            blur: L::splat(token, slabs.time(self.ray.lane).blur()),
        }
    }

    /// Which spheres of a leaf to look at.
    #[inline(always)]
    pub(super) fn filter<A: Accuracy, L: Lanes>(
        &self,
        token: L::Token,
        slabs: &Slabs<L>,
        leaf: &BvhLeaf,
    ) -> u32 {
        let probe = self.probe::<L>(token, slabs);
        let mut spheres = 0;
        for part in 0..WIDTH / L::COUNT {
            spheres |= probe.may_meet::<A>(leaf, part) << (part * L::COUNT);
        }
        spheres
    }

    /// Takes a t that the ray surely has as its end.
    #[inline(always)]
    fn shorten<L: Lanes>(&mut self, slabs: &Slabs<L>, t: f32) {
        let best = slabs.time(self.ray.lane).after(t);
        if best < self.best {
            self.best = best;
        }
    }

    /// Looks at the spheres of a leaf, the first of which is at `place`.
    #[inline(always)]
    pub(super) fn meet<A: Accuracy, L: Lanes, N: Answers<L>>(
        &mut self,
        token: L::Token,
        slabs: &Slabs<L>,
        (packets, bvh): (&[RayPacket<L>], &Bvh<'_>),
        (leaf, place): (&BvhLeaf, u32),
        questions: &mut Questions<L>,
        answers: &mut N,
    ) {
        let before = self.best;
        let probe = self.probe::<L>(token, slabs);
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
                    self.settle::<A, L, N>(token, slabs, packets, bvh, questions, answers);
                }
                self.candidates.push(place + (part * L::COUNT + lane) as u32, entry);
            }
        }
        if self.best < before {
            self.stack.cull::<L>(token, self.end_of_boxes::<A, L>(slabs));
        }
    }

    /// Asks the tier about the candidates, which are too many to keep, at once.
    #[inline(always)]
    fn settle<A: Accuracy, L: Lanes, N: Answers<L>>(
        &mut self,
        token: L::Token,
        slabs: &Slabs<L>,
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
        self.shorten(slabs, answers.limit(self.ray.packet, self.ray.lane));
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
