//! What the rays of a queue do with a leaf. Its spheres are loaded for each ray: loading them once for all is as fast (0.97
//! to 1.02).

use super::Stream;
use super::queue::QueuedRay;
use crate::Accuracy;
use crate::bvh::leaf::{Leaf, place_of};
use crate::bvh::node::WIDTH;
use crate::count::count;
use crate::geometry::hit::Hit;
use crate::lanes::{LaneArray, Lanes};
use crate::query::Query;

impl<T: Accuracy, L: Lanes, Q: Query> Stream<'_, '_, T, L, Q> {
    /// Tests the spheres of a leaf against the rays that wait at it.
    #[inline(always)]
    pub(super) fn look_into(&mut self, number: u32, from: usize, to: usize) {
        let Some(leaf) = self.tests.bvh.leaf(number) else { return };
        self.seen.count_leaf(self.queues, from, to);
        if self.tests.tier.spread() == 0.0 {
            self.meet::<false>((&leaf, number), from, to);
        } else {
            L::out_of_line(
                self.tests.token,
                #[inline(always)]
                || self.meet::<true>((&leaf, number), from, to),
            );
        }
    }

    /// Finds first which rays may hit any of the spheres, then where.
    #[inline(always)]
    fn meet<const SPREADS: bool>(
        &mut self,
        (leaf, number): (&Leaf<'_>, u32),
        from: usize,
        to: usize,
    ) {
        let (token, tier) = (self.tests.token, self.tests.tier);
        let mut kept = from;
        for at in from..to {
            let Some(&QueuedRay { ray: number, .. }) = self.queues.get(at) else { break };
            let Some(ray) = self.rays.get(number as usize) else { break };
            let spheres = ray.may_hit::<L, SPREADS>(token, tier, leaf);
            if let Some(place) = self.queues.get_mut(kept) {
                *place = QueuedRay { ray: number, entry: f32::from_bits(spheres) };
            }
            kept += usize::from(spheres != 0);
        }
        for at in from..kept {
            let Some(&QueuedRay { ray, .. }) = self.queues.get(at) else { break };
            self.meet_one::<SPREADS>((leaf, number), ray);
        }
    }

    /// Looks at the spheres of a leaf that ray `number` may hit.
    #[inline(always)]
    fn meet_one<const SPREADS: bool>(
        &mut self,
        (leaf, leaf_number): (&Leaf<'_>, u32),
        number: u32,
    ) {
        let Self { tests, rays, .. } = self;
        let Some(ray) = rays.get_mut(number as usize) else { return };
        let whose = ray.whose::<L::Array>(self.first);
        count!(StreamRoots);
        let probe = ray.probe::<L>(tests.token, tests.tier);
        for part in 0..WIDTH / L::COUNT {
            let interval = probe.root_interval::<SPREADS>(&leaf.columns, part);
            let (entries, bounds) = (interval.entry.store(), interval.bound.store());
            let mut candidates =
                interval.candidates::<Q>(leaf.lanes >> (part * L::COUNT), ray.best);
            while candidates != 0 {
                let lane = candidates.trailing_zeros() as usize;
                candidates &= candidates - 1;
                let (entry, bound) = (entries.get(lane), bounds.get(lane));
                if Q::ANY && bound < f32::INFINITY {
                    if let Some(answer) = tests.answers.get_mut(whose.packet) {
                        let any = Hit { t: 0.0, sphere: 0 };
                        Q::take::<L::Array>(answer, whose.lane, any, |_| false);
                    }
                    ray.shorten(f32::NEG_INFINITY);
                    ray.entry = f32::NAN;
                    return;
                }
                if entry > ray.best {
                    continue;
                }
                ray.shorten(bound);
                // The sphere kept so far may be the closest, too. The tier's answers for earlier spheres may rule it out:
                // along a row of spheres that a ray touches, each would else be decided by exact sums.
                if ray.entry <= ray.best {
                    ray.take_answer(tests.limit(whose));
                    if ray.entry <= ray.best {
                        tests.add(whose, ray.place);
                    }
                    if entry > ray.best {
                        ray.entry = f32::NAN;
                        continue;
                    }
                }
                ray.place = place_of(leaf_number, (part * L::COUNT + lane) as u32);
                ray.entry = entry;
            }
        }
    }
}
