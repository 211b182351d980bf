//! What one ray has found: which spheres may be its closest, and what the tier has said of them.

use crate::Accuracy;
use crate::accuracy::{RayLanes, Squares, is_closer, test_one};
use crate::bvh::leaf::place_of;
use crate::bvh::node::{LEAF, WIDTH};
use crate::bvh::source::SphereSource;
use crate::bvh::traverse::in_flight::test_from_afar;
use crate::bvh::traverse::ray_time::RayTime;
use crate::bvh::traverse::root_interval::RayProbe;
use crate::bvh::traverse::small_tree::{self, MOST_LEAVES};
use crate::bvh::tree::Bvh;
use crate::geometry::hit::Hit;
use crate::geometry::ray::Ray;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::Spheres;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::linear;
use crate::numeric::rounding::least;
use crate::query::Query;

/// How many candidates are kept.
pub(super) const MOST: usize = 8;

/// 2^-40: from this radius on, no squares of `Stable` underflow so far that it sees a sphere otherwise than bounds do.
const LEAST_RADIUS: f32 = 1.0 / (1_u64 << 40) as f32;

/// Returns whether one ray goes through the list of a tree, as many rays do in a tree of few spheres: if the tier may see a sphere
/// otherwise than bounds do, because it spreads, or because its squares underflow.
#[inline(always)]
pub(super) fn goes_by_list(bvh: &Bvh<'_>, spreads: bool, squares: Squares) -> bool {
    small_tree::is_listed(bvh) && (spreads || (squares != Squares::None && has_tiny(&bvh.spheres)))
}

/// Returns whether a sphere has a radius below [`LEAST_RADIUS`].
#[inline(always)]
fn has_tiny(spheres: &Spheres<'_>) -> bool {
    let [_, _, _, radii] = spheres.columns();
    for &radius in radii {
        if radius < LEAST_RADIUS {
            return true;
        }
    }
    false
}

/// A ray, and what it has found.
pub(super) struct Search<'a, T, Q: Query> {
    pub(super) tier: T,
    pub(super) bvh: &'a Bvh<'a>,
    pub(super) ray: &'a Ray,
    pub(super) answer: Q::Packet<[f32; 1]>,
    pub(super) places: [u32; MOST],
    pub(super) entries: [f32; MOST],
    pub(super) count: usize,
    pub(super) best: f32,
}

impl<T: Accuracy, Q: Query> Search<'_, T, Q> {
    /// Tests the ray if no bound covers it, and the spheres that no bound sees. Returns where the ray ends then; `None`
    /// if it is done.
    #[cold]
    #[inline(never)]
    pub(super) fn unusual(&mut self, covered: bool, time: RayTime<f32>, end: f32) -> Option<f32> {
        let Self { tier, bvh, ray, answer, .. } = self;
        let packet = RayPacket::new(core::slice::from_ref(*ray));
        if !bvh.outside.is_empty() {
            let (rays, answers) = (core::slice::from_ref(&packet), core::slice::from_mut(answer));
            linear::traverse_some::<f32, Q>(*tier, (), &bvh.outside(), rays, answers);
        }
        let limit = Q::limit::<[f32; 1]>(answer, 0);
        if limit == f32::NEG_INFINITY {
            return None;
        }
        if !covered {
            let rays = RayLanes::<f32>::load((), &packet);
            test_from_afar::<f32, Q>(*tier, (), bvh, (&packet, &rays), answer);
            return None;
        }
        Some(least(time.after(limit), end))
    }

    /// Answers as the list of all spheres does.
    #[cold]
    #[inline(never)]
    pub(super) fn of_list(mut self) -> Q::One {
        let Self { tier, bvh, ray, answer, .. } = &mut self;
        let packet = RayPacket::new(core::slice::from_ref(*ray));
        let (rays, answers) = (core::slice::from_ref(&packet), core::slice::from_mut(answer));
        linear::traverse_some::<f32, Q>(*tier, (), &bvh.spheres, rays, answers);
        Q::one(&self.answer, 0)
    }

    /// Which spheres of leaves may be hit, sixteen bits a leaf; none behind the last leaf.
    #[inline(always)]
    pub(super) fn may_hit<L: Lanes, const SPREADS: bool>(
        &self,
        probe: &RayProbe<L>,
        leaves: [u32; MOST_LEAVES],
    ) -> u64 {
        let mut may_hit = 0;
        for number in 0..MOST_LEAVES {
            let Some(leaf) = self.bvh.leaf(leaves[number] & !LEAF) else { break };
            may_hit |= u64::from(probe.may_hit::<SPREADS>(&leaf)) << (number * WIDTH);
        }
        may_hit
    }

    /// Keeps the spheres of a small tree that may be hit.
    #[inline(always)]
    pub(super) fn keep(&mut self, leaves: [u32; MOST_LEAVES], mut may_hit: u64) {
        while may_hit != 0 {
            let bit = may_hit.trailing_zeros();
            may_hit &= may_hit - 1;
            let leaf = leaves[bit as usize / WIDTH % MOST_LEAVES] & !LEAF;
            self.places[self.count % MOST] = place_of(leaf, bit % WIDTH as u32);
            self.entries[self.count % MOST] = f32::NEG_INFINITY;
            self.count = self.count % MOST + 1;
        }
    }

    /// Looks at the leaves with a sphere that may be hit; returns whether the ray is done.
    #[inline(always)]
    pub(super) fn meet<L: Lanes, const SPREADS: bool>(
        &mut self,
        token: L::Token,
        probe: &mut RayProbe<L>,
        time: RayTime<f32>,
        leaves: [u32; MOST_LEAVES],
        mut may_hit: u64,
    ) -> bool {
        while may_hit != 0 {
            let number = may_hit.trailing_zeros() as usize / WIDTH;
            may_hit &= !(0xffff << (number * WIDTH));
            if self.look::<L, SPREADS>(token, probe, time, leaves[number % MOST_LEAVES] & !LEAF) {
                return true;
            }
        }
        false
    }

    /// Looks at the spheres of a leaf; returns whether the ray is done.
    #[inline(always)]
    pub(super) fn look<L: Lanes, const SPREADS: bool>(
        &mut self,
        token: L::Token,
        probe: &mut RayProbe<L>,
        time: RayTime<f32>,
        number: u32,
    ) -> bool {
        let Some(leaf) = self.bvh.leaf(number) else { return false };
        for part in 0..WIDTH / L::COUNT {
            let lanes = leaf.lanes >> (part * L::COUNT);
            let pass = probe.pass(&leaf.columns, part);
            let may_hit = pass.may_hit::<SPREADS>(probe.start[0], probe.end[1], probe.spread);
            if may_hit.bits() & lanes == 0 {
                continue;
            }
            let bits = may_hit.bits() & lanes;
            if Q::ANY && !SPREADS && pass.is_hit(probe.start[1], probe.end[0]).bits() & bits != 0 {
                self.hit();
                return true;
            }
            // (Roots one by one, in one lane, take as long; so does a tier that tests a sphere at once if it is alone in
            // its leaf.)
            let RayProbe { start, end, raise, spread, .. } = *probe;
            let interval = pass.root_interval::<SPREADS>(start, end, raise, spread);
            let mut candidates = interval.candidates.bits();
            if SPREADS {
                candidates &= pass.meets_box().bits();
            }
            let (entries, bounds) = (interval.entry.store(), interval.bound.store());
            // The loop goes by `bits`, so that it does not wait for the roots.
            let mut rest = bits;
            while rest != 0 {
                let lane = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                if candidates >> lane & 1 == 0 {
                    continue;
                }
                let (entry, bound) = (entries.get(lane), bounds.get(lane));
                if Q::ANY && bound < f32::INFINITY {
                    self.hit();
                    return true;
                }
                if entry > self.best {
                    continue;
                }
                self.best = if bound < self.best { bound } else { self.best };
                let place = place_of(number, (part * L::COUNT + lane) as u32);
                self.push::<L>(token, time, place, entry);
            }
            probe.end[1] = L::splat(token, self.best);
        }
        false
    }

    /// Answers that there is a hit.
    #[inline(always)]
    fn hit(&mut self) {
        Q::take::<[f32; 1]>(&mut self.answer, 0, Hit { t: 0.0, sphere: 0 }, |_| false);
    }

    /// Keeps a candidate.
    #[inline(always)]
    fn push<L: Lanes>(&mut self, token: L::Token, time: RayTime<f32>, place: u32, entry: f32) {
        while self.count > 0 && self.entries[(self.count - 1) % MOST] > self.best {
            self.count -= 1;
        }
        if self.count == MOST {
            self.test::<L>(token);
            let t = Q::limit::<[f32; 1]>(&self.answer, 0);
            self.best = least(time.after(t), self.best);
        }
        self.places[self.count % MOST] = place;
        self.entries[self.count % MOST] = entry;
        self.count = self.count % MOST + 1;
    }

    /// Has the tier test what is kept.
    #[inline(always)]
    pub(super) fn test<L: Lanes>(&mut self, token: L::Token) {
        if self.count == 0 {
            return;
        }
        L::out_of_line(
            token,
            #[inline(always)]
            || self.test_here(),
        );
    }

    #[inline(always)]
    fn test_here(&mut self) {
        let Self { tier, bvh, ray, .. } = self;
        for at in 0..self.count {
            if self.entries[at % MOST] > self.best {
                continue;
            }
            let Some((sphere, index)) = bvh.sphere_at(self.places[at % MOST]) else { continue };
            let t = test_one(*tier, ray, &sphere);
            if t < f32::INFINITY {
                Q::take::<[f32; 1]>(
                    &mut self.answer,
                    0,
                    Hit { t, sphere: index },
                    #[inline(always)]
                    |old| is_closer(*tier, &bvh.spheres, ray, t, [index, old]),
                );
                if Q::ANY {
                    break;
                }
            }
        }
        self.count = 0;
    }
}
