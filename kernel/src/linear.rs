//! Rays against a list of spheres, from end to end; pairs; and both roots of one line.

use crate::Accuracy;
use crate::accuracy::{RayLanes, TierFormula, TierWork, all_finite, is_closer};
use crate::filter::{BLOCK_SPHERES, FilterBlock, FilterGroup, FilterRays, GROUP};
use crate::geometry::hit::{Hit, HitPacket};
use crate::geometry::ray::{Ray, RayPacket};
use crate::geometry::sphere::{Sphere, SpherePacket, Spheres};
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::query::Query;
use core::cmp::Ordering;

/// Answers every ray by testing it against all spheres.
///
/// Preparing 128 spheres costs as much as testing one packet against them: pass many packets in one
/// call. Stack: some 3 KiB.
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
            for_candidates(
                token,
                rays,
                answers,
                &spheres,
                #[inline(always)]
                |answer| Q::done::<L>(token, answer),
                #[inline(always)]
                |answer, candidates| {
                    tier.with_formula(GroupTest::<L, Q> { token, candidates, answer });
                },
            );
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
    pub(crate) spheres: &'a Spheres<'a>,
    /// The index of the group's first sphere.
    pub(crate) first: usize,
}

/// Calls `test` for each packet and group of spheres that the filter does not rule out, until
/// all of the packet's live lanes are `done`.
#[inline(always)]
pub(crate) fn for_candidates<L: Lanes, R>(
    token: L::Token,
    rays: &[RayPacket<L::Array>],
    results: &mut [R],
    spheres: &Spheres<'_>,
    done: impl Fn(&R) -> L::Mask,
    test: impl Fn(&mut R, Candidates<'_, L>),
) {
    // Nothing is prepared for nobody: a depth list comes here with every run of packets that do not fit, most of them empty.
    let spheres_to_meet = if rays.is_empty() { 0 } else { spheres.len() };
    for first in (0..spheres_to_meet).step_by(BLOCK_SPHERES) {
        // The spheres are prepared once for all packets.
        let block = FilterBlock::new(spheres, first);
        for (packet, result) in rays.iter().zip(results.iter_mut()) {
            let mut rays = RayLanes::<L>::load(token, packet);
            rays.live = rays.live & !done(result);
            let mut filter = FilterRays::new(token, &rays, &block);
            let mut first = first;
            for group in block.groups() {
                if filter.may_meet_any(group) {
                    test(
                        result,
                        Candidates { packet, rays: &rays, filter: &filter, group, spheres, first },
                    );
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

/// Tests the spheres of a group that the filter does not rule out one by one.
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
        let Candidates { packet, rays, filter, group, spheres, first } = candidates;
        let infinity = L::splat(token, f32::INFINITY);
        let mut limits = Q::limits::<L>(token, answer);
        // Keeping this from one group to the next costs Fast 6 % and gains the others 2 %.
        let prepared = F::prepare(rays);
        for slot in 0..GROUP {
            let Some(sphere) = spheres.get(first + slot) else { return };
            let asked = rays.live & filter.may_meet(group, slot);
            if sphere.is_valid() && asked.any() {
                let center = axes!(i => L::splat(token, sphere.center[i]));
                let radius = L::splat(token, sphere.radius);
                let t = F::first_root(rays, &prepared, center, radius, asked, limits);
                let t = L::select(asked, t, infinity);
                let index = (first + slot) as u32;
                if F::ORDERS_ROOTS && !Q::ANY {
                    let tied = (t.le(limits) & limits.le(t) & t.lt(infinity)).bits();
                    if tied != 0 {
                        take_closer::<F, L, Q>(packet, *spheres, index, tied, &t.store(), answer);
                    }
                }
                limits = Q::accept::<L>(answer, index, t, limits);
            }
        }
    }
}

/// Takes sphere `index` in those of the lanes `tied`, where it is hit at the t that is known, in which it is closer.
#[cold]
#[inline(never)]
fn take_closer<F: TierFormula, L: Lanes, Q: Query>(
    packet: &RayPacket<L::Array>,
    spheres: Spheres<'_>,
    index: u32,
    mut tied: u32,
    t: &L::Array,
    answer: &mut Q::Packet<L::Array>,
) {
    while tied != 0 {
        let lane = tied.trailing_zeros() as usize;
        tied &= tied - 1;
        let t = t.get(lane);
        let is_closer = |old| is_closer(F::THIS, spheres, &packet.ray(lane), t, [index, old]);
        Q::take::<L::Array>(answer, lane, Hit { t, sphere: index }, is_closer);
    }
}

/// Ray `i` against sphere `i` alone; the sphere index of a hit is its lane.
///
/// Returns bit for bit what [`Intersect::closest_hit_lanes`](crate::Intersect::closest_hit_lanes)
/// finds for that ray in a list of that sphere. Cost: no filter; the tier's price for every packet.
///
/// ```
/// use spherule_kernel::{Exact, Ray, RayPacket, SpherePacket, Vec3, f32x8, pair_lanes};
///
/// let rays = RayPacket::<[f32; 8]>::new(&[Ray::new(Vec3::ZERO, Vec3::Z)]);
/// let spheres = SpherePacket::<[f32; 8]>::new(&[[0.0, 0.0, 5.0, 1.0].into()]);
/// assert_eq!(pair_lanes::<f32x8>(Exact, (), &rays, &spheres).t()[0], 4.0);
/// ```
#[must_use]
#[inline(always)]
pub fn pair_lanes<L: Lanes>(
    tier: impl Accuracy,
    token: L::Token,
    rays: &RayPacket<L::Array>,
    spheres: &SpherePacket<L::Array>,
) -> HitPacket<L::Array> {
    tier.with_formula(PairTest::<L> { token, rays, spheres })
}

/// [`pair_lanes`], packet by packet.
#[inline(always)]
pub(crate) fn each_pair<L: Lanes>(
    tier: impl Accuracy,
    token: L::Token,
    rays: &[RayPacket<L::Array>],
    spheres: &[SpherePacket<L::Array>],
    hits: &mut [HitPacket<L::Array>],
) {
    let count = rays.len().min(spheres.len()).min(hits.len());
    for place in 0..count {
        if let (Some(rays), Some(spheres), Some(hits)) =
            (rays.get(place), spheres.get(place), hits.get_mut(place))
        {
            *hits = pair_lanes::<L>(tier, token, rays, spheres);
        }
    }
}

/// The arguments of [`pair_lanes`].
struct PairTest<'a, L: Lanes> {
    token: L::Token,
    rays: &'a RayPacket<L::Array>,
    spheres: &'a SpherePacket<L::Array>,
}

impl<L: Lanes> TierWork for PairTest<'_, L> {
    type Output = HitPacket<L::Array>;

    #[inline(always)]
    fn run<F: TierFormula>(self) -> HitPacket<L::Array> {
        let Self { token, rays, spheres } = self;
        let rays = RayLanes::<L>::load(token, rays);
        let center = axes!(i => L::load(token, &spheres.center[i]));
        let radius = L::load(token, &spheres.radius);
        let (zero, infinity) = (radius.like(0.0), radius.like(f32::INFINITY));
        let asked = rays.live & all_finite(center) & zero.le(radius) & radius.lt(infinity);
        let t = F::first_root(&rays, &F::prepare(&rays), center, radius, asked, infinity);
        let t = L::select(asked, t, infinity);
        let mut hits = HitPacket::none();
        hits.t = t.store();
        let (met, indices) = (t.lt(infinity).bits(), hits.sphere.as_mut());
        for lane in 0..L::COUNT {
            if met >> lane & 1 == 1
                && let Some(index) = indices.get_mut(lane)
            {
                *index = lane as u32;
            }
        }
        hits
    }
}

/// Entry and exit of the whole line, whatever the ray's interval: the smaller root first.
///
/// Returns `None` if the line misses the sphere, or if either is invalid. A root that is too large for a number is an
/// infinity of its sign. t counts in multiples of the ray's direction.
///
/// ```
/// use spherule_kernel::{Exact, Ray, Sphere, Vec3, roots};
///
/// let sphere = Sphere::from([0.0, 0.0, 5.0, 1.0]);
/// assert_eq!(roots(Exact, &Ray::new(Vec3::ZERO, Vec3::Z), &sphere), Some([4.0, 6.0]));
/// ```
#[must_use]
pub fn roots(tier: impl Accuracy, ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]> {
    let line = Ray { t_min: f32::NEG_INFINITY, t_max: f32::INFINITY, ..*ray };
    if !line.is_live() || !sphere.is_valid() {
        return None;
    }
    tier.with_formula(LineRoots { line: &line, sphere })
}

/// The arguments of [`roots`].
struct LineRoots<'a> {
    line: &'a Ray,
    sphere: &'a Sphere,
}

impl TierWork for LineRoots<'_> {
    type Output = Option<[f32; 2]>;

    #[inline(always)]
    fn run<F: TierFormula>(self) -> Option<[f32; 2]> {
        F::line_roots(self.line, self.sphere)
    }
}

/// Which of two hits of one ray comes first, for callers who keep their own closest hit: each is the t of a `tier`'s
/// answer, and its sphere.
///
/// By [`Exact`](crate::Exact) the roots are compared as real numbers, which may differ where t are equal; `Equal` means
/// that they are the same number, and the lower index is the closer hit. The other tiers compare t. If t is not the
/// tier's answer for its sphere, the result has no meaning. Cost: nothing if t differ; else some 50 ns, and some
/// microseconds where double precision cannot tell.
///
/// ```
/// use spherule_kernel::{Exact, Ray, Sphere, Vec3, compare_hits, roots};
///
/// // A million away, f32 tells nothing less than 1/16 apart.
/// let ray = Ray::new(Vec3::new(0.0, 0.0, -1e6), Vec3::Z);
/// let spheres = [1.0, 1.015625].map(|radius| Sphere { center: Vec3::ZERO, radius });
/// let [Some([t, _]), Some([u, _])] = spheres.map(|sphere| roots(Exact, &ray, &sphere)) else { panic!() };
/// assert_eq!(t, u);
/// assert!(compare_hits(Exact, &ray, [(t, &spheres[0]), (u, &spheres[1])]).is_gt());
/// ```
#[must_use]
pub fn compare_hits(tier: impl Accuracy, ray: &Ray, hits: [(f32, &Sphere); 2]) -> Ordering {
    let [(t, first), (other, second)] = hits;
    match t.partial_cmp(&other) {
        Some(Ordering::Equal) => tier.compare_at(ray, t, [first, second]),
        order => order.unwrap_or(Ordering::Equal),
    }
}
