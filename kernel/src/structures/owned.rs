//! Structures that own their memory: every traversal is that of the structure that they lend.

use super::{LevelQuery, Traverse};
use crate::Accuracy;
use crate::bvh::owned::SphereTree;
use crate::coherent::ray_order::GainByOrder;
use crate::geometry::camera::tiles::CameraTiles;
use crate::geometry::hit::HitPacket;
use crate::geometry::many::ManyRays;
use crate::geometry::ray::{Ray, RayPacket};
use crate::geometry::sphere_list::SphereList;
use crate::lanes::Lanes;
use crate::query::Query;
use crate::trace::Trace;
#[cfg(feature = "std")]
use core::ops::Range;

/// The traversals of an owned structure, by what it lends.
macro_rules! traverse_as {
    ($owned:ty, $lend:ident -> $lent:ty) => {
        impl Traverse for $owned {
            #[cfg(feature = "std")]
            #[inline(always)]
            fn goes_one_by_one(
                &self,
                trace: &Trace<'_>,
                rays: &ManyRays<'_>,
                range: Range<usize>,
            ) -> bool {
                self.$lend().goes_one_by_one(trace, rays, range)
            }

            #[inline(always)]
            fn in_lanes<L: Lanes, Q: Query>(
                &self,
                tier: impl Accuracy,
                token: L::Token,
                trace: &mut Trace<'_>,
                rays: &[RayPacket<L::Array>],
                answers: &mut [Q::Packet<L::Array>],
            ) {
                self.$lend().in_lanes::<L, Q>(tier, token, trace, rays, answers);
            }

            fn in_packets<Q: LevelQuery>(
                &self,
                tier: impl Accuracy,
                trace: &mut Trace<'_>,
                rays: &[RayPacket],
                answers: &mut [Q::Packet<[f32; 16]>],
            ) {
                self.$lend().in_packets::<Q>(tier, trace, rays, answers);
            }

            fn many_in_packets<Q: LevelQuery>(
                &self,
                tier: impl Accuracy,
                trace: &mut Trace<'_>,
                rays: ManyRays<'_>,
                packets: &mut [RayPacket],
                answers: &mut [Q::Packet<[f32; 16]>],
            ) {
                self.$lend().many_in_packets::<Q>(tier, trace, rays, packets, answers);
            }

            fn gain_by_order<Q: LevelQuery>(&self, trace: &Trace<'_>) -> Option<GainByOrder> {
                self.$lend().gain_by_order::<Q>(trace)
            }

            fn many_at_once<Q: LevelQuery>(&self, trace: &Trace<'_>, rays: usize) -> Option<usize> {
                self.$lend().many_at_once::<Q>(trace, rays)
            }

            #[inline]
            fn one<Q: LevelQuery>(
                &self,
                tier: impl Accuracy,
                trace: &mut Trace<'_>,
                ray: &Ray,
            ) -> Q::One {
                self.$lend().one::<Q>(tier, trace, ray)
            }

            #[inline]
            fn one_plainly<Q: LevelQuery>(&self, tier: impl Accuracy, ray: &Ray) -> Q::One {
                self.$lend().one_plainly::<Q>(tier, ray)
            }

            #[inline(always)]
            fn tiles_in_lanes<L: Lanes>(
                &self,
                tier: impl Accuracy,
                token: L::Token,
                trace: &mut Trace<'_>,
                tiles: CameraTiles<'_>,
                rays: &mut [RayPacket<L::Array>],
                hits: &mut [HitPacket<L::Array>],
            ) {
                self.$lend().tiles_in_lanes::<L>(tier, token, trace, tiles, rays, hits);
            }

            fn tiles_in_packets(
                &self,
                tier: impl Accuracy,
                trace: &mut Trace<'_>,
                tiles: CameraTiles<'_>,
                rays: &mut [RayPacket],
                hits: &mut [HitPacket],
            ) {
                self.$lend().tiles_in_packets(tier, trace, tiles, rays, hits);
            }
        }
    };
}

traverse_as!(SphereList, spheres -> crate::geometry::sphere::Spheres<'_>);
traverse_as!(SphereTree, bvh -> crate::bvh::tree::Bvh<'_>);
