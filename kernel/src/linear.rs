//! Rays against a list of spheres, from end to end.

mod line;
mod object;
mod one_sphere;
mod pairs;
mod ray_by_ray;

use crate::Accuracy;
use crate::accuracy::{RayLanes, TierFormula, TierWork, Underflow};
use crate::count::count;
use crate::filter::block::{FilterBlock, FilterGroup};
use crate::filter::rays::FilterRays;
use crate::filter::{BLOCK_SPHERES, GROUP};
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::geometry::sphere_run::SphereRun;
use crate::lanes::{LaneMask, Lanes};
use crate::query::Query;
use ray_by_ray::RayByRay;
pub(crate) use ray_by_ray::is_for as goes_ray_by_ray;

pub use line::{compare_hits, discriminant, roots};
pub(crate) use object::one_object;
pub use object::{Writes, object_lanes};
pub(crate) use one_sphere::meet_sphere;
pub(crate) use pairs::each_pair;
pub use pairs::pair_lanes;

/// Answers every ray by testing it against all spheres.
///
/// Preparing 128 spheres costs as much as testing one packet against them: pass many packets in one
/// call. Stack: some 5 KiB; a ray by itself in one lane has no filter, and takes an eighth of that.
#[inline(always)]
pub(crate) fn traverse<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    spheres: Spheres<'_>,
    rays: &[RayPacket<L::Array>],
    answers: &mut [Q::Packet<L::Array>],
) {
    L::out_of_line(
        token,
        #[inline(always)]
        || {
            let count = rays.len().min(answers.len());
            let answers = answers.get_mut(..count).unwrap_or_default();
            for answer in answers.iter_mut() {
                *answer = Q::none::<L::Array>();
            }
            meet::<L, Q, Spheres<'_>>(tier, token, &spheres, rays, answers);
        },
    );
}

/// Answers every ray by some spheres of a list alone, as [`traverse`] does by all. (It is compiled once for all kinds of runs,
/// and the test of a group once for runs and whole lists. Else the kernel takes half as long again to compile.)
#[inline(always)]
pub(crate) fn traverse_some<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    spheres: &dyn SphereRun,
    rays: &[RayPacket<L::Array>],
    answers: &mut [Q::Packet<L::Array>],
) {
    L::out_of_line(
        token,
        #[inline(always)]
        || {
            for answer in answers.iter_mut() {
                *answer = Q::none::<L::Array>();
            }
            meet::<L, Q, dyn SphereRun + '_>(tier, token, spheres, rays, answers);
        },
    );
}

/// Takes hits that are closer than the answers so far.
#[inline(always)]
fn meet<L: Lanes, Q: Query, S: SphereRun + ?Sized>(
    tier: impl Accuracy,
    token: L::Token,
    spheres: &S,
    rays: &[RayPacket<L::Array>],
    answers: &mut [Q::Packet<L::Array>],
) {
    if goes_ray_by_ray::<L>(rays.len()) {
        tier.with_formula(RayByRay::<L, Q, S> { token, spheres, rays, answers });
        return;
    }
    meet_filtered::<L, Q, S>(tier, token, (spheres, &mut FilterBlock::empty()), rays, answers);
}

/// Takes hits that are closer than the answers so far. The block is kept for the next rays that meet the same spheres.
#[inline(always)]
pub(crate) fn meet_filtered<L: Lanes, Q: Query, S: SphereRun + ?Sized>(
    tier: impl Accuracy,
    token: L::Token,
    spheres: (&S, &mut FilterBlock),
    rays: &[RayPacket<L::Array>],
    answers: &mut [Q::Packet<L::Array>],
) {
    for_candidates(
        token,
        rays,
        answers,
        spheres,
        tier.underflow(),
        #[inline(always)]
        |answer| Q::done::<L>(token, answer),
        #[inline(always)]
        |answer, candidates| {
            tier.with_formula(GroupTest::<L, Q> { token, candidates, answer });
        },
    );
}

/// A packet, and a group of spheres that the filter could not rule out for it.
#[derive(Clone, Copy)]
pub(crate) struct Candidates<'a, L: Lanes> {
    pub(crate) packet: &'a RayPacket<L::Array>,
    pub(crate) rays: &'a RayLanes<L>,
    pub(crate) filter: &'a FilterRays<L>,
    pub(crate) group: &'a FilterGroup,
    /// The list that the spheres are of: a copy would take half of a test's time by `Fast`.
    pub(crate) spheres: &'a Spheres<'a>,
    /// The indices of the spheres; an index of no sphere where there is none.
    pub(crate) indices: [u32; GROUP],
}

impl<L: Lanes> Candidates<'_, L> {
    /// A sphere of the group, and its index; `None` where there is none.
    #[inline(always)]
    pub(crate) fn sphere(&self, slot: usize) -> Option<(Sphere, u32)> {
        let index = self.indices[slot];
        Some((self.spheres.get(index as usize)?, index))
    }
}

/// Calls `test` for each packet and group of spheres that the filter does not rule out, until
/// all of the packet's live lanes are `done`.
#[inline(always)]
pub(crate) fn for_candidates<L: Lanes, R, S: SphereRun + ?Sized>(
    token: L::Token,
    rays: &[RayPacket<L::Array>],
    results: &mut [R],
    (spheres, block): (&S, &mut FilterBlock),
    underflow: Underflow,
    done: impl Fn(&R) -> L::Mask,
    test: impl Fn(&mut R, Candidates<'_, L>),
) {
    // Nothing is prepared where there are no rays: a depth list comes here with every run of packets that do not fit, and most
    // runs are empty.
    let spheres_to_meet = if rays.is_empty() { 0 } else { spheres.count() };
    let list = spheres.list();
    for first in (0..spheres_to_meet).step_by(BLOCK_SPHERES) {
        // The spheres are prepared once for all packets.
        if block.first != first {
            block.prepare(spheres, first, underflow);
        }
        for (packet, result) in rays.iter().zip(results.iter_mut()) {
            let mut rays = RayLanes::<L>::load(token, packet);
            rays.live = rays.live & !done(result);
            if !rays.live.any() {
                continue;
            }
            if block.is_elsewhere(&rays) {
                block.see(spheres, first, underflow, &rays);
            }
            let mut filter = FilterRays::new(token, &rays, block);
            let mut first = first;
            for group in block.groups() {
                count!(ListGroup);
                if filter.may_meet_any(group) {
                    let mut indices = [u32::MAX; GROUP];
                    for slot in 0..GROUP {
                        indices[slot] = spheres.index(first + slot);
                    }
                    let candidates = Candidates {
                        packet,
                        rays: &rays,
                        filter: &filter,
                        group,
                        spheres: &list,
                        indices,
                    };
                    test(result, candidates);
                    let live = rays.live & !done(result);
                    if !live.any() {
                        break;
                    }
                    filter.keep(live);
                }
                first += GROUP;
            }
        }
    }
}

/// Tests one by one the spheres of a group that the filter does not rule out.
pub(crate) struct GroupTest<'a, 'b, L: Lanes, Q: Query> {
    pub(crate) token: L::Token,
    pub(crate) candidates: Candidates<'b, L>,
    pub(crate) answer: &'a mut Q::Packet<L::Array>,
}

impl<L: Lanes, Q: Query> TierWork for GroupTest<'_, '_, L, Q> {
    type Output = ();

    #[inline(always)]
    fn run<F: TierFormula>(self) {
        // What candidates need must not press on the registers of the filter's loop.
        L::out_of_line(
            self.token,
            #[inline(always)]
            || self.test::<F>(),
        );
    }
}

impl<L: Lanes, Q: Query> GroupTest<'_, '_, L, Q> {
    #[inline(always)]
    fn test<F: TierFormula>(self) {
        let Self { token, candidates, answer } = self;
        let Candidates { packet, rays, filter, group, spheres, .. } = candidates;
        let mut limits = Q::limits::<L>(token, answer);
        // Keeping this from one group to the next costs Fast 6 % and gains the others 2 %.
        let prepared = F::prepare(rays);
        for slot in 0..GROUP {
            let Some((sphere, index)) = candidates.sphere(slot) else { continue };
            let active = rays.live & filter.may_meet(group, slot);
            if sphere.is_valid() && active.any() {
                let rays = (packet, rays, &prepared);
                let sphere = (sphere, index);
                limits =
                    meet_sphere::<F, L, Q, true>(rays, spheres, sphere, active, limits, answer);
            }
        }
    }
}
