//! One sphere against the rays of a packet.

use crate::accuracy::{RayLanes, TierFormula, is_closer};
use crate::count::count;
use crate::geometry::hit::Hit;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::query::Query;

/// Takes a valid sphere where it is closer; returns the new limits. Of equals the first stays, except where spheres
/// do not come in the order of their indices: there they are compared.
#[inline(always)]
pub(crate) fn meet_sphere<F: TierFormula, L: Lanes, Q: Query, const IN_ORDER: bool>(
    (packet, rays, prepared): (&RayPacket<L::Array>, &RayLanes<L>, &F::Prepared<L>),
    spheres: &Spheres<'_>,
    (sphere, index): (Sphere, u32),
    active: L::Mask,
    limits: L,
    answer: &mut Q::Packet<L::Array>,
) -> L {
    count!(TierLanes);
    let infinity = limits.like(f32::INFINITY);
    let center = sphere.center();
    let center = axes!(i => limits.like(center[i]));
    let radius = limits.like(sphere.radius);
    let t = F::first_root(rays, prepared, center, radius, active, limits, Q::ANY);
    let t = L::select(active, t, infinity);
    if (F::ORDERS_ROOTS || !IN_ORDER) && !Q::ANY {
        let tied = (t.le(limits) & limits.le(t) & t.lt(infinity)).bits();
        if tied != 0 {
            take_closer::<F, L, Q>(packet, spheres, index, tied, &t.store(), answer);
        }
    }
    Q::accept::<L>(answer, index, t, limits)
}

/// In the lanes `tied` sphere `index` is hit at the t that is known. Takes it in those of them in which it is closer.
#[cold]
#[inline(never)]
pub(super) fn take_closer<F: TierFormula, L: Lanes, Q: Query>(
    packet: &RayPacket<L::Array>,
    spheres: &Spheres<'_>,
    index: u32,
    tied: u32,
    t: &L::Array,
    answer: &mut Q::Packet<L::Array>,
) {
    // One lane needs no loop.
    let mut tied = if L::COUNT == 1 { 1 } else { tied };
    while tied != 0 {
        let lane = tied.trailing_zeros() as usize;
        tied &= tied - 1;
        let t = t.get(lane);
        Q::take::<L::Array>(
            answer,
            lane,
            Hit { t, sphere: index },
            #[inline(always)]
            |old| is_closer(F::THIS, spheres, &packet.ray(lane), t, [index, old]),
        );
    }
}
