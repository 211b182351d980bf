//! The scene structures, by the traversals that they have.

use crate::Accuracy;
use crate::bvh::StreamMemory;
use crate::bvh::tree::Bvh;
use crate::bvh4::{Bvh4, walk};
use crate::coherent::depth_list::DepthList;
use crate::coherent::{list_source, tree_source};
use crate::geometry::ray::RayPacket;
use crate::geometry::sphere::Spheres;
use crate::lanes::Lanes;
use crate::linear;
use crate::query::Query;
use crate::trace::Trace;

/// The traversals of a structure.
pub trait Traverse {
    /// In lanes of any kind, compiled where it is called.
    fn in_lanes<L: Lanes, Q: Query>(
        &self,
        tier: impl Accuracy,
        token: L::Token,
        trace: &mut Trace<'_>,
        rays: &[RayPacket<L::Array>],
        answers: &mut [Q::Packet<L::Array>],
    );

    /// In sixteen lanes at a level, compiled with this crate.
    fn in_packets<Q: LevelQuery>(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        rays: &[RayPacket],
        answers: &mut [Q::Packet<[f32; 16]>],
    );
}

/// A query that is compiled for every level.
#[cfg(feature = "std")]
pub trait LevelQuery: Query + crate::dispatch::compiled::Compiled {}
#[cfg(feature = "std")]
impl<Q: Query + crate::dispatch::compiled::Compiled> LevelQuery for Q {}

/// A query: there is one level.
#[cfg(not(feature = "std"))]
pub trait LevelQuery: Query {}
#[cfg(not(feature = "std"))]
impl<Q: Query> LevelQuery for Q {}

/// The traversals of a structure: by a function that is generic over lanes, and by the same compiled for
/// every level.
macro_rules! traverse {
    ($structure:ty, |$this:ident, $trace:ident| $traverse:path = $compiled:ident($($argument:expr),*)) => {
        impl Traverse for $structure {
            #[inline(always)]
            fn in_lanes<L: Lanes, Q: Query>(
                &self,
                tier: impl Accuracy,
                token: L::Token,
                $trace: &mut Trace<'_>,
                rays: &[RayPacket<L::Array>],
                answers: &mut [Q::Packet<L::Array>],
            ) {
                use $traverse as traverse;
                let ($this, _) = (self, &$trace);
                traverse::<L, Q>(tier, token, $($argument,)* rays, answers);
            }

            fn in_packets<Q: LevelQuery>(
                &self,
                tier: impl Accuracy,
                $trace: &mut Trace<'_>,
                rays: &[RayPacket],
                answers: &mut [Q::Packet<[f32; 16]>],
            ) {
                #[cfg(feature = "std")]
                let $this = self;
                #[cfg(feature = "std")]
                Q::$compiled($trace.level, tier.tier(), $($argument,)* rays, answers);
                #[cfg(not(feature = "std"))]
                crate::dispatch::of_the_build::<Self, Q>(self, tier, $trace, rays, answers);
            }
        }
    };
}

traverse!(Spheres<'_>, |spheres, trace| linear::traverse = list(*spheres));
traverse!(Bvh<'_>, |bvh, trace| tree_source::traverse =
    tree(bvh, (trace.coherence, trace.stream.as_mut().map(StreamMemory::again))));
traverse!(DepthList<'_>, |list, trace| list_source::traverse = depth_list(list, trace.scratch));

/// In one lane, whatever the level.
impl Traverse for Bvh4<'_> {
    #[inline(always)]
    fn in_lanes<L: Lanes, Q: Query>(
        &self,
        tier: impl Accuracy,
        token: L::Token,
        _: &mut Trace<'_>,
        rays: &[RayPacket<L::Array>],
        answers: &mut [Q::Packet<L::Array>],
    ) {
        walk::traverse::<L, Q>(tier, token, self, rays, answers);
    }

    fn in_packets<Q: LevelQuery>(
        &self,
        tier: impl Accuracy,
        _: &mut Trace<'_>,
        rays: &[RayPacket],
        answers: &mut [Q::Packet<[f32; 16]>],
    ) {
        walk::lane_by_lane::<[f32; 16], Q>(tier, self, rays, answers);
    }
}

/// An owned structure, by what it lends.
#[cfg(feature = "alloc")]
macro_rules! traverse_as {
    ($owned:ty, $lend:ident) => {
        impl Traverse for $owned {
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
        }
    };
}

#[cfg(feature = "alloc")]
traverse_as!(crate::geometry::sphere_list::SphereList, spheres);
#[cfg(feature = "alloc")]
traverse_as!(crate::bvh::owned::SphereTree, bvh);
