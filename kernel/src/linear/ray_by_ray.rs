//! Rays one by one, in one lane, with no filter prepared.
//!
//! Many packets share the cost of a block of prepared spheres. A ray alone would pay for 128 spheres, in 2 KiB of
//! stack; so the tier tests it against each.

use super::one_sphere::meet_sphere;
use crate::accuracy::{RayLanes, TierFormula, TierWork};
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere_run::SphereRun;
use crate::lanes::{LaneMask, Lanes};
use crate::query::Query;

/// Whether so many packets are answered ray by ray: without `std` all of one lane are, since firmware has little stack.
pub(crate) const fn is_for<L: Lanes>(packets: usize) -> bool {
    L::COUNT == 1 && (packets == 1 || !cfg!(feature = "std"))
}

/// Takes hits that are closer than the answers so far.
pub(super) struct RayByRay<'a, L: Lanes, Q: Query, S: SphereRun + ?Sized> {
    pub(super) token: L::Token,
    pub(super) spheres: &'a S,
    pub(super) rays: &'a [RayPacket<L::Array>],
    pub(super) answers: &'a mut [Q::Packet<L::Array>],
}

impl<L: Lanes, Q: Query, S: SphereRun + ?Sized> TierWork for RayByRay<'_, L, Q, S> {
    type Output = ();

    #[inline(always)]
    fn run<F: TierFormula>(self) {
        let Self { token, spheres, rays, answers } = self;
        let list = spheres.list();
        for place in 0..rays.len() {
            let (Some(packet), Some(answer)) = (rays.get(place), answers.get_mut(place)) else {
                break;
            };
            let rays = RayLanes::<L>::load(token, packet);
            if !rays.live.any() {
                continue;
            }
            let prepared = F::prepare(&rays);
            let mut limits = Q::limits::<L>(token, answer);
            for number in 0..spheres.count() {
                let index = spheres.index(number);
                let active = rays.live & !Q::done::<L>(token, answer);
                if !active.any() {
                    break;
                }
                if let Some(sphere) = list.get(index as usize)
                    && sphere.is_valid()
                {
                    let (rays, sphere) = ((packet, &rays, &prepared), (sphere, index));
                    limits =
                        meet_sphere::<F, L, Q, true>(rays, &list, sphere, active, limits, answer);
                }
            }
        }
    }
}
