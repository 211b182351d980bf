//! The traversals of a tree.
//!
//! Without optimisation every ray goes by itself: the code for many keeps each of its values in a place of its own, and takes more stack
//! than a thread has.

#[cfg(feature = "std")]
use super::count_of;
#[cfg(not(feature = "std"))]
use super::of_the_build;
use super::{LevelQuery, Traverse};
use crate::Accuracy;
use crate::bvh::StreamMemory;
#[cfg(feature = "std")]
use crate::bvh::traverse::small_tree;
use crate::bvh::tree::Bvh;
#[cfg(feature = "alloc")]
use crate::coherence::Coherence;
#[cfg(feature = "std")]
use crate::coherent::few_rays::{self, Asked, FEW_IN_SMALL_TREE};
use crate::coherent::packet_source::PacketSource;
#[cfg(feature = "alloc")]
use crate::coherent::ray_order::GainByOrder;
#[cfg(feature = "std")]
use crate::coherent::tree_source::Alone;
use crate::coherent::tree_source::{self, Ways};
#[cfg(feature = "std")]
use crate::dispatch::compiled::{Compiled, fill_tiles, leaves_held};
#[cfg(feature = "std")]
use crate::dispatch::{Level, LevelName};
use crate::geometry::camera::tiles::CameraTiles;
use crate::geometry::hit::HitPacket;
#[cfg(feature = "std")]
use crate::geometry::many::ManyRays;
#[cfg(feature = "std")]
use crate::geometry::ray::Ray;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::Spheres;
use crate::lanes::Lanes;
use crate::query::{ClosestHit, Query};
use crate::trace::Trace;
#[cfg(feature = "std")]
use core::ops::Range;

impl Traverse for Bvh<'_> {
    #[inline(always)]
    fn list(&self) -> Spheres<'_> {
        self.spheres()
    }

    #[cfg(feature = "std")]
    #[inline(always)]
    fn goes_one_by_one(&self, trace: &Trace<'_>, rays: &ManyRays<'_>, range: Range<usize>) -> bool {
        let count = range.end.saturating_sub(range.start);
        let leaves_held = |asked: &Asked| leaves_held(trace.level, self, asked);
        cfg!(unoptimised)
            || count <= ONE_BY_ONE
            || (count <= few_rays::few(self) * RayPacket::COUNT
                && !small_tree::is_listed(self)
                && (trace.coherence == Coherence::Incoherent
                    || few_rays::differ(self, rays, range, leaves_held)))
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
        let source = PacketSource::Packets(rays);
        tree_source::traverse::<L, Q>(tier, token, self, ways(trace), source, answers);
    }

    fn in_packets<Q: LevelQuery>(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        rays: &[RayPacket],
        answers: &mut [Q::Packet<[f32; 16]>],
    ) {
        #[cfg(feature = "std")]
        if cfg!(unoptimised) {
            let of_bits = u64::BITS as usize;
            for (rays, answers) in rays.chunks(of_bits).zip(answers.chunks_mut(of_bits)) {
                let (count, none) = (rays.len().min(answers.len()), Q::none::<[f32; 16]>());
                answers.iter_mut().take(count).for_each(|answer| *answer = none);
                one_by_one::<Q>(self, tier, trace, (&[], rays, u64::MAX), answers);
            }
        } else {
            let (mut alone, source) = (0, PacketSource::Packets(rays));
            let level = trace.level;
            let few = of_few::<Q>(self, trace, rays.len(), &mut alone);
            let ways = Ways { alone: few, ..ways(trace) };
            Q::tree(level, tier.tier(), self, ways, source, answers);
            one_by_one::<Q>(self, tier, trace, (&[], rays, alone), answers);
        }
        #[cfg(not(feature = "std"))]
        of_the_build::<Self, Q>(self, tier, trace, rays, answers);
    }

    #[cfg(feature = "std")]
    fn many_in_packets<Q: LevelQuery>(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        rays: &ManyRays<'_>,
        packets: &mut [RayPacket],
        answers: &mut [Q::Packet<[f32; 16]>],
    ) {
        let (level, mut alone) = (trace.level, 0);
        let count = rays.count().div_ceil(RayPacket::COUNT);
        let few = of_few::<Q>(self, trace, count, &mut alone);
        let ways = Ways { alone: few, ..ways(trace) };
        let source = PacketSource::Rays(rays, &mut *packets);
        Q::tree(level, tier.tier(), self, ways, source, answers);
        let slice = if let ManyRays::Slice(rays) = *rays { rays } else { &[] };
        one_by_one::<Q>(self, tier, trace, (slice, packets, alone), answers);
    }

    #[cfg(feature = "alloc")]
    fn gain_by_order<Q: LevelQuery>(&self, trace: &Trace<'_>) -> Option<GainByOrder> {
        // (With memory lent, too, 65,536 rays would go down together.)
        if cfg!(unoptimised) || trace.stream.is_some() {
            return None;
        }
        trace.learnt.gain_by_order::<Q>(self, trace.coherence)
    }

    #[cfg(feature = "std")]
    fn may_gain_by_depth(&self, trace: &Trace<'_>) -> bool {
        let is_asked = trace.stream.is_none() && trace.coherence != Coherence::Incoherent;
        // Rays meet the spheres that no bound sees by each way.
        is_asked && !cfg!(unoptimised) && !small_tree::is_listed(self) && self.outside.is_empty()
    }

    #[cfg(feature = "alloc")]
    fn many_at_once<Q: LevelQuery>(&self, trace: &Trace<'_>, rays: usize) -> Option<usize> {
        // Rays that are said to be incoherent go as a stream in lent memory alone.
        let is_asked = trace.stream.is_none() && trace.coherence != Coherence::Incoherent;
        if is_asked { trace.learnt.many_at_once::<Q>(self, rays) } else { None }
    }

    #[cfg(feature = "std")]
    #[inline]
    fn one<Q: LevelQuery>(&self, tier: impl Accuracy, trace: &mut Trace<'_>, ray: &Ray) -> Q::One {
        Q::one_ray(trace.level, tier.tier(), self, ray)
    }

    #[cfg(feature = "std")]
    #[inline]
    fn one_plainly<Q: LevelQuery>(&self, tier: impl Accuracy, ray: &Ray) -> Q::One {
        Q::one_ray(Level::best(), tier.tier(), self, ray)
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
        let source = PacketSource::Tiles(tiles, rays);
        tree_source::traverse::<L, ClosestHit>(tier, token, self, ways(trace), source, hits);
    }

    #[cfg(feature = "std")]
    fn tiles_in_packets(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        tiles: CameraTiles<'_>,
        rays: &mut [RayPacket],
        hits: &mut [HitPacket],
    ) {
        if cfg!(unoptimised) {
            let count = count_of(&tiles, rays.len(), hits.len());
            let rays = rays.get_mut(..count).unwrap_or_default();
            fill_tiles(trace.level, tiles, rays);
            return self.in_packets::<ClosestHit>(tier, trace, rays, hits);
        }
        let source = PacketSource::Tiles(tiles, rays);
        <ClosestHit as Compiled>::tree(trace.level, tier.tier(), self, ways(trace), source, hits);
    }
}

/// Up to so many rays go one by one, whatever they are: the code for more rays clears 64 KiB first. (Through that code, on a Zen 3, a
/// call of one ray took 3 to 43 times as long as [`one`](Traverse::one), and a call of eight 1.2 to 4 times; by way of a packet 1.1 to
/// 3.3, and 1.0 to 1.3; now 0.7 to 1.5, and 0.7 to 1.2. With a limit of 12 by AVX-512, 24 by AVX2 and 32 at the baseline, a camera's rays
/// took 1.4 to 3.3 times as long on a Zen 5.)
#[cfg(feature = "std")]
const ONE_BY_ONE: usize = 8;

/// What a tree asks of a trace.
#[inline(always)]
fn ways<'t>(trace: &'t mut Trace<'_>) -> Ways<'t> {
    Ways {
        coherence: trace.coherence,
        lent: trace.stream.as_mut().map(StreamMemory::again),
        #[cfg(feature = "alloc")]
        kept: &mut trace.kept,
        learnt: &mut trace.learnt,
        #[cfg(feature = "std")]
        alone: None,
    }
}

/// Returns where packets that do not go together are noted if they are few; `None` if the call has too many packets to note.
///
/// In registers of four lanes a wavefront gains little, and for any hits nothing, except that it prefetches a tree that is far from the
/// core. (Six scenes, seven orders. With four packets at all levels, 65 to 256 rays ran at 0.90 to 0.98 of the speed, and any hits of a
/// shuffled picture among nested spheres at 0.6. With sixteen, AVX-512 ran at 0.97, and 300 to 8,192 any hits at the baseline at 0.93.
/// With 64 at the baseline, closest hits of 4,096 diffuse rays among 10,000 spheres ran at 0.94, and any hits in a tree that is far at
/// 0.9.)
#[cfg(feature = "std")]
fn of_few<'a, Q: Query>(
    bvh: &Bvh<'_>,
    trace: &Trace<'_>,
    packets: usize,
    alone: &'a mut u64,
) -> Option<Alone<'a>> {
    // What they do by themselves is not counted.
    if trace.learnt.work.is_some() {
        return None;
    }
    let most = if small_tree::leaves(bvh).is_some() {
        FEW_IN_SMALL_TREE
    } else if trace.level.name() != LevelName::Baseline {
        8
    } else if Q::ANY && bvh.is_near() {
        64
    } else {
        16
    };
    (packets <= u64::BITS as usize).then_some(Alone { packets: alone, most })
}

/// Answers the rays of the packets in `alone`, a bit a packet. Rays of a slice are read where they lie.
///
/// An any hit that a group has found is kept. (When it was looked for anew, 65 rays of scan lines among 200,000 spheres ran at 0.7 of the
/// speed. Closest hits that were bounded by the hits that a group had found ran as fast as without.)
#[cfg(feature = "std")]
fn one_by_one<Q: LevelQuery>(
    bvh: &Bvh<'_>,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (slice, packets, mut alone): (&[Ray], &[RayPacket], u64),
    answers: &mut [Q::Packet<[f32; 16]>],
) {
    while alone != 0 {
        let number = alone.trailing_zeros() as usize;
        alone &= alone - 1;
        let (Some(packet), Some(answer)) = (packets.get(number), answers.get_mut(number)) else {
            return;
        };
        let known = *answer;
        *answer = Q::none::<[f32; 16]>();
        // All are copied before the first is read: a ray that is read as soon as it is written waits for memory. (Copied one by one from
        // a slice, rays ran at 0.93 to 0.97 of the speed.)
        let copies: [Ray; RayPacket::COUNT];
        let mut rays = slice.get(number * RayPacket::COUNT..).unwrap_or_default();
        if rays.is_empty() {
            copies = core::array::from_fn(|lane| packet.ray(lane));
            rays = &copies;
        }
        for (lane, ray) in rays.iter().take(RayPacket::COUNT).enumerate() {
            let is_done = Q::limit(&known, lane) == f32::NEG_INFINITY;
            let one = if is_done { Q::one(&known, lane) } else { bvh.one::<Q>(tier, trace, ray) };
            Q::put(answer, lane, one);
        }
    }
}

#[cfg(all(test, proofs))]
#[cfg(feature = "std")]
mod tests;
