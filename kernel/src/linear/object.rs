//! Object order: one sphere after the other, each against the rays that may meet it.

use super::one_sphere::take_closer;
use crate::Accuracy;
use crate::accuracy::{RayLanes, TierFormula, TierWork};
use crate::geometry::hit::HitPacket;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::lanes::{LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::query::{Answers, ClosestHit};
use core::ops::AddAssign;

/// How many hits were stored, by [`object_lanes`] and [`object_packets`](crate::object_packets).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Writes {
    /// All hits that were stored.
    pub stored: u64,
    /// Those that replaced a hit that was known before.
    pub overwritten: u64,
}

impl AddAssign for Writes {
    fn add_assign(&mut self, other: Self) {
        self.stored += other.stored;
        self.overwritten += other.overwritten;
    }
}

/// Tests sphere `index` of a list against the rays of one packet, whose closest hits so far are `hits`. The sphere is
/// taken where it is the closer one, by rule 5 of the contract. Returns how many hits were stored.
///
/// If `hits` begins as [`HitPacket::none`], then all spheres of the list, in any order, leave in it bit for bit what
/// [`Intersect::closest_hit_lanes`](crate::Intersect::closest_hit_lanes) finds. So a renderer may go from object to
/// object, and test each only against the rays that may meet it. An index that no sphere has, or that of an invalid
/// sphere, changes nothing. Cost: no filter; the tier's price for every packet, less where all rays have hit something
/// in front of the sphere.
///
/// ```
/// use spherule_kernel::{Exact, HitPacket, Ray, RayPacket, SphereList, Vec3, Writes, f32x8, object_lanes};
///
/// let list = SphereList::from([[0.0, 0.0, 9.0, 1.0], [0.0, 0.0, 5.0, 1.0]]);
/// let rays = RayPacket::<[f32; 8]>::new(&[Ray::new(Vec3::ZERO, Vec3::Z)]);
/// let mut hits = HitPacket::none();
/// let mut writes = Writes::default();
/// for index in 0..2 {
///     writes += object_lanes::<f32x8>(Exact, (), list.spheres(), index, &rays, &mut hits);
/// }
/// assert_eq!(hits.hit(0).map(|hit| (hit.t, hit.sphere)), Some((4.0, 1)));
/// assert_eq!(writes, Writes { stored: 2, overwritten: 1 });
/// ```
#[inline(always)]
pub fn object_lanes<L: Lanes>(
    tier: impl Accuracy,
    token: L::Token,
    spheres: Spheres<'_>,
    index: u32,
    rays: &RayPacket<L::Array>,
    hits: &mut HitPacket<L::Array>,
) -> Writes {
    let (rays, hits) = (core::slice::from_ref(rays), core::slice::from_mut(hits));
    one_object::<L>(tier, token, (spheres, index), &[0], rays, hits)
}

/// [`object_lanes`] for those packets that `numbers` names.
#[inline(always)]
pub(crate) fn one_object<L: Lanes>(
    tier: impl Accuracy,
    token: L::Token,
    (spheres, index): (Spheres<'_>, u32),
    numbers: &[u32],
    rays: &[RayPacket<L::Array>],
    hits: &mut [HitPacket<L::Array>],
) -> Writes {
    match spheres.get(index as usize) {
        Some(sphere) if sphere.is_valid() => {
            let object = Object { sphere, index, spheres: &spheres };
            tier.with_formula(ObjectTest::<L> { token, object, numbers, rays, hits })
        }
        _ => Writes::default(),
    }
}

/// A valid sphere, and the list that it is of.
#[derive(Clone, Copy)]
struct Object<'a> {
    sphere: Sphere,
    index: u32,
    spheres: &'a Spheres<'a>,
}

/// The arguments of [`one_object`].
struct ObjectTest<'a, L: Lanes> {
    token: L::Token,
    object: Object<'a>,
    numbers: &'a [u32],
    rays: &'a [RayPacket<L::Array>],
    hits: &'a mut [HitPacket<L::Array>],
}

impl<L: Lanes> TierWork for ObjectTest<'_, L> {
    type Output = Writes;

    #[inline(always)]
    fn run<F: TierFormula>(self) -> Writes {
        let Self { token, object, numbers, rays, hits } = self;
        L::out_of_line(
            token,
            #[inline(always)]
            || {
                let mut writes = Writes::default();
                for place in 0..numbers.len() {
                    if let Some(&number) = numbers.get(place)
                        && let Some(rays) = rays.get(number as usize)
                        && let Some(hits) = hits.get_mut(number as usize)
                    {
                        writes += test::<F, L>(token, object, rays, hits);
                    }
                }
                writes
            },
        )
    }
}

/// Takes the sphere where it is closer than what is known.
#[inline(always)]
fn test<F: TierFormula, L: Lanes>(
    token: L::Token,
    Object { sphere, index, spheres }: Object<'_>,
    packet: &RayPacket<L::Array>,
    hits: &mut HitPacket<L::Array>,
) -> Writes {
    let rays = RayLanes::<L>::load(token, packet);
    let limits = L::load(token, &hits.t);
    let infinity = L::splat(token, f32::INFINITY);
    let center = sphere.center();
    let center = axes!(i => L::splat(token, center[i]));
    let radius = L::splat(token, sphere.radius);
    let t = F::first_root(&rays, &F::prepare(&rays), center, radius, rays.live, limits, false);
    let t = L::select(rays.live, t, infinity);
    let closer = t.lt(limits);
    let mut overwrites = (closer & limits.lt(infinity)).bits();
    // Spheres may come in any order, so every tier looks for the lowest index.
    let tied = (t.le(limits) & limits.le(t) & t.lt(infinity)).bits();
    if tied != 0 {
        let before = *hits;
        take_closer::<F, L, ClosestHit>(packet, spheres, index, tied, &t.store(), hits);
        for lane in 0..L::COUNT {
            if hits.spheres().get(lane) != before.spheres().get(lane) {
                overwrites |= 1 << lane;
            }
        }
    }
    let stored = closer.bits() | overwrites;
    if closer.any() {
        ClosestHit::accept::<L>(hits, index, t, limits);
    }
    Writes { stored: stored.count_ones().into(), overwritten: overwrites.count_ones().into() }
}
