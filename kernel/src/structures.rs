//! The scene structures, by the traversals that they have.

pub(crate) mod lend;
#[cfg(feature = "alloc")]
mod owned;
mod tree;

use crate::Accuracy;
use crate::bvh4::{Bvh4, walk};
use crate::coherent::depth_list::DepthList;
use crate::coherent::list_source;
#[cfg(feature = "alloc")]
use crate::coherent::ray_order::GainByOrder;
#[cfg(not(feature = "std"))]
use crate::dispatch::BuildLanes;
#[cfg(feature = "std")]
use crate::dispatch::compiled::Compiled;
use crate::geometry::camera::tiles::CameraTiles;
use crate::geometry::hit::HitPacket;
use crate::geometry::many::ManyRays;
use crate::geometry::ray::Ray;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::Spheres;
use crate::lanes::Lanes;
use crate::linear;
use crate::query::{ClosestHit, Query};
use crate::trace::Trace;
#[cfg(feature = "std")]
use core::ops::Range;

/// The traversals of a structure.
pub trait Traverse {
    /// The list that hits name spheres of.
    fn list(&self) -> Spheres<'_>;

    /// Whether some rays of a call go one by one, since they are few, and are faster so than together.
    #[cfg(feature = "std")]
    #[inline(always)]
    fn goes_one_by_one(&self, _: &Trace<'_>, _: &ManyRays<'_>, _: Range<usize>) -> bool {
        false
    }

    /// Answers packets in lanes of any kind; compiled where it is called.
    fn in_lanes<L: Lanes, Q: Query>(
        &self,
        tier: impl Accuracy,
        token: L::Token,
        trace: &mut Trace<'_>,
        rays: &[RayPacket<L::Array>],
        answers: &mut [Q::Packet<L::Array>],
    );

    /// Answers packets in sixteen lanes at a level; compiled with this crate, without `std` where it is called.
    fn in_packets<Q: LevelQuery>(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        rays: &[RayPacket],
        answers: &mut [Q::Packet<[f32; 16]>],
    );

    /// Answers rays in sixteen lanes at a level. On the way they fill `packets`, whose contents do not matter.
    fn many_in_packets<Q: LevelQuery>(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        rays: &ManyRays<'_>,
        packets: &mut [RayPacket],
        answers: &mut [Q::Packet<[f32; 16]>],
    ) {
        let count = rays.count().div_ceil(RayPacket::COUNT).min(packets.len());
        let packets = packets.get_mut(..count).unwrap_or_default();
        #[cfg(feature = "std")]
        crate::dispatch::compiled::fill(trace.level, rays, packets);
        #[cfg(not(feature = "std"))]
        crate::dispatch::fill(rays, packets);
        self.in_packets::<Q>(tier, trace, packets, answers);
    }

    /// What the next rays would gain by another order, from what the trace has learnt; `None` if nothing.
    #[cfg(feature = "alloc")]
    fn gain_by_order<Q: LevelQuery>(&self, _: &Trace<'_>) -> Option<GainByOrder> {
        None
    }

    /// Whether rays of one viewpoint may be faster in a depth list.
    #[cfg(feature = "std")]
    fn may_gain_by_depth(&self, _: &Trace<'_>) -> bool {
        false
    }

    /// How many of the next rays are better answered all at once than some at a time, from what the trace has learnt; `None` where it
    /// makes no difference.
    #[cfg(feature = "alloc")]
    fn many_at_once<Q: LevelQuery>(&self, _: &Trace<'_>, _: usize) -> Option<usize> {
        None
    }

    /// Answers one ray at a level; without `std` in one lane, since firmware seldom has more lanes, and has little memory.
    fn one<Q: LevelQuery>(&self, tier: impl Accuracy, trace: &mut Trace<'_>, ray: &Ray) -> Q::One {
        let rays = core::slice::from_ref(ray);
        #[cfg(feature = "std")]
        {
            let mut answers = [Q::none::<[f32; 16]>()];
            self.in_packets::<Q>(tier, trace, &[RayPacket::new(rays)], &mut answers);
            Q::one(&answers[0], 0)
        }
        #[cfg(not(feature = "std"))]
        {
            let mut answers = [Q::none::<[f32; 1]>()];
            self.in_lanes::<f32, Q>(tier, (), trace, &[RayPacket::new(rays)], &mut answers);
            Q::one(&answers[0], 0)
        }
    }

    /// Answers one ray of which the caller says nothing. A tree makes no [`Trace`] for it, since to make and to drop a trace takes a
    /// twentieth of a ray's time.
    #[inline]
    fn one_plainly<Q: LevelQuery>(&self, tier: impl Accuracy, ray: &Ray) -> Q::One {
        self.one::<Q>(tier, &mut Trace::new(), ray)
    }

    /// Makes the rays of a camera's tiles in `rays`, and finds what they hit, in lanes of any kind.
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
        let Some(rays) = rays.get_mut(..count_of(&tiles, rays.len(), hits.len())) else { return };
        tiles.fill::<L>(token, tiles.corners, rays);
        self.in_lanes::<L, ClosestHit>(tier, token, trace, rays, hits);
    }

    /// The same in sixteen lanes at a level, compiled as [`in_packets`](Traverse::in_packets) is.
    fn tiles_in_packets(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        tiles: CameraTiles<'_>,
        rays: &mut [RayPacket],
        hits: &mut [HitPacket],
    ) {
        #[cfg(feature = "std")]
        {
            let Some(rays) = rays.get_mut(..count_of(&tiles, rays.len(), hits.len())) else {
                return;
            };
            crate::dispatch::compiled::fill_tiles(trace.level, tiles, rays);
            self.in_packets::<ClosestHit>(tier, trace, rays, hits);
        }
        #[cfg(not(feature = "std"))]
        tiles_of_the_build(self, tier, trace, tiles, rays, hits);
    }
}

/// How many tiles are traced: as far as there are tiles, rays and hits.
fn count_of(tiles: &CameraTiles<'_>, rays: usize, hits: usize) -> usize {
    tiles.corners.len().min(rays).min(hits)
}

/// Without `std`: answers packets in the lanes of the build.
#[cfg(not(feature = "std"))]
fn of_the_build<S: Traverse + ?Sized, Q: Query>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    rays: &[RayPacket],
    answers: &mut [Q::Packet<[f32; 16]>],
) {
    if BuildLanes::COUNT == RayPacket::COUNT {
        structure.in_lanes::<wide::f32x16, Q>(tier, (), trace, rays, answers);
        return;
    }
    for (packet, answer) in rays.iter().zip(answers.iter_mut()) {
        *answer = Q::none::<[f32; 16]>();
        for lane in 0..RayPacket::COUNT {
            let ray = [RayPacket::new(&[packet.ray(lane)])];
            let mut one = [Q::none::<[f32; 1]>()];
            structure.in_lanes::<f32, Q>(tier, (), trace, &ray, &mut one);
            Q::put(answer, lane, Q::one(&one[0], 0));
        }
    }
}

/// Without `std`: what a camera's tiles hit, in the lanes of the build.
#[cfg(not(feature = "std"))]
fn tiles_of_the_build<S: Traverse + ?Sized>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    tiles: CameraTiles<'_>,
    rays: &mut [RayPacket],
    hits: &mut [HitPacket],
) {
    if BuildLanes::COUNT == RayPacket::COUNT {
        return structure.tiles_in_lanes::<wide::f32x16>(tier, (), trace, tiles, rays, hits);
    }
    let Some(rays) = rays.get_mut(..count_of(&tiles, rays.len(), hits.len())) else { return };
    let CameraTiles { camera, size: (width, height), corners } = tiles;
    for (packet, &(x, y)) in rays.iter_mut().zip(corners) {
        *packet = camera.packet(x, y, width, height);
    }
    structure.in_packets::<ClosestHit>(tier, trace, rays, hits);
}

/// A query that is compiled for every level.
#[cfg(feature = "std")]
pub trait LevelQuery: Query + Compiled {}
#[cfg(feature = "std")]
impl<Q: Query + Compiled> LevelQuery for Q {}

/// A query; without `std` there is one level.
#[cfg(not(feature = "std"))]
pub trait LevelQuery: Query {}
#[cfg(not(feature = "std"))]
impl<Q: Query> LevelQuery for Q {}

/// Implements the traversals of a structure: by a function that is generic over lanes, and by the same function compiled for every
/// level.
macro_rules! traverse {
    ($structure:ty, |$this:ident, $trace:ident| $list:expr, $traverse:path = $compiled:ident($($argument:expr),*)) => {
        impl Traverse for $structure {
            #[inline(always)]
            fn list(&self) -> Spheres<'_> {
                let $this = self;
                $list
            }

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
                of_the_build::<Self, Q>(self, tier, $trace, rays, answers);
            }
        }
    };
}

traverse!(Spheres<'_>, |spheres, trace| *spheres, linear::traverse = list(*spheres));
traverse!(
    DepthList<'_>,
    |list, trace| list.spheres(),
    list_source::traverse = depth_list(list, (&mut *trace.scratch, &mut trace.learnt))
);

/// It answers in one lane, whatever the level.
impl Traverse for Bvh4<'_> {
    #[inline(always)]
    fn list(&self) -> Spheres<'_> {
        self.spheres()
    }

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
