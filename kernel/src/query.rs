//! What is computed for a ray: its closest hit, or whether there is any.
//!
//! Every traversal is generic over its query. So a new query is an implementation of [`Answers`] here, and what it changes
//! in each traversal.

use crate::geometry::hit::{Hit, HitPacket};
use crate::geometry::many_answers::{ManyAnswers, ManyHits, ManyOccluded};
use crate::lanes::{LaneArray, LaneMask, Lanes};
use core::fmt::Debug;

/// A query: [`ClosestHit`] or [`AnyHit`]. Sealed.
pub trait Query: Answers {}

/// The closest hit of every ray: the smallest accepted root, and among equals the lowest index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClosestHit;

/// Whether each ray hits anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AnyHit;

impl Query for ClosestHit {}
impl Query for AnyHit {}

mod sealed {
    use super::*;

    /// The answers of a query, and how a traversal fills them in.
    pub trait Answers: Copy + Debug {
        /// Whether a ray that has hit something is done.
        const ANY: bool;
        /// What a packet is answered with.
        type Packet<A: LaneArray>: Copy + Debug;
        /// What one ray is answered with.
        type One: Copy;
        /// Where the answers of many rays go.
        type Many<'a>: ManyAnswers<Packet = Self::Packet<[f32; 16]>, One = Self::One>;

        /// No hit in any lane.
        fn none<A: LaneArray>() -> Self::Packet<A>;
        /// The answer of one lane.
        fn one<A: LaneArray>(packet: &Self::Packet<A>, lane: usize) -> Self::One;
        /// Puts the answer of one ray into a lane that has no hit yet.
        fn put<A: LaneArray>(packet: &mut Self::Packet<A>, lane: usize, one: Self::One);
        /// The lanes that are done.
        fn done<L: Lanes>(token: L::Token, packet: &Self::Packet<L::Array>) -> L::Mask;
        /// In every lane the t above which nothing matters any more.
        fn limits<L: Lanes>(token: L::Token, packet: &Self::Packet<L::Array>) -> L;
        /// Takes the t of one sphere in every lane, `+inf` if there is no hit, where it is below the limit; returns the
        /// new limits.
        fn accept<L: Lanes>(packet: &mut Self::Packet<L::Array>, index: u32, t: L, limits: L) -> L;
        /// Takes a hit if it is closer than the one known; if both have the same t, `is_closer` says whether it is, by the
        /// index of the known one.
        fn take<A: LaneArray>(
            packet: &mut Self::Packet<A>,
            lane: usize,
            hit: Hit,
            is_closer: impl FnOnce(u32) -> bool,
        );

        /// The t above which nothing matters any more in a lane: `-inf` if it is done.
        fn limit<A: LaneArray>(packet: &Self::Packet<A>, lane: usize) -> f32;
        /// Makes answers of t, `+inf` if there is no hit, and of indices, as bits.
        fn from_lanes<L: Lanes>(t: L, sphere: L) -> Self::Packet<L::Array>;
        /// t and the index, as bits, in every lane: what [`from_lanes`](Answers::from_lanes) makes answers of.
        fn lanes<L: Lanes>(token: L::Token, packet: &Self::Packet<L::Array>) -> [L; 2];
        /// Returns room for as many answers as the packets have lanes.
        #[cfg(feature = "alloc")]
        fn of_packets(packets: &mut [Self::Packet<[f32; 16]>]) -> Self::Many<'_>;
    }
}

pub(crate) use sealed::Answers;

impl Answers for ClosestHit {
    const ANY: bool = false;
    type Packet<A: LaneArray> = HitPacket<A>;
    type One = Option<Hit>;
    type Many<'a> = ManyHits<'a>;

    #[inline(always)]
    fn none<A: LaneArray>() -> HitPacket<A> {
        HitPacket::none()
    }

    #[inline(always)]
    fn one<A: LaneArray>(packet: &HitPacket<A>, lane: usize) -> Option<Hit> {
        packet.hit(lane)
    }

    #[inline(always)]
    fn put<A: LaneArray>(packet: &mut HitPacket<A>, lane: usize, one: Option<Hit>) {
        if let Some(hit) = one {
            packet.take(lane, hit, |_| false);
        }
    }

    #[inline(always)]
    fn done<L: Lanes>(token: L::Token, _: &HitPacket<L::Array>) -> L::Mask {
        L::mask(token, 0)
    }

    #[inline(always)]
    fn limits<L: Lanes>(token: L::Token, packet: &HitPacket<L::Array>) -> L {
        L::load(token, &packet.t)
    }

    #[inline(always)]
    fn accept<L: Lanes>(packet: &mut HitPacket<L::Array>, index: u32, t: L, limits: L) -> L {
        let closer = t.lt(limits);
        let best = L::select(closer, t, limits);
        packet.t = best.store();
        let mut closer = closer.bits();
        while closer != 0 {
            if let Some(sphere) = packet.sphere.as_mut().get_mut(closer.trailing_zeros() as usize) {
                *sphere = index;
            }
            closer &= closer - 1;
        }
        best
    }

    #[inline(always)]
    fn take<A: LaneArray>(
        packet: &mut HitPacket<A>,
        lane: usize,
        hit: Hit,
        is_closer: impl FnOnce(u32) -> bool,
    ) {
        packet.take(lane, hit, is_closer);
    }

    #[inline(always)]
    fn limit<A: LaneArray>(packet: &HitPacket<A>, lane: usize) -> f32 {
        packet.t.get(lane)
    }

    #[inline(always)]
    fn from_lanes<L: Lanes>(t: L, sphere: L) -> HitPacket<L::Array> {
        let mut hits = HitPacket::none();
        hits.t = t.store();
        let bits = sphere.store();
        let indices = hits.sphere.as_mut();
        for lane in 0..L::COUNT {
            if let Some(index) = indices.get_mut(lane) {
                *index = bits.get(lane).to_bits();
            }
        }
        hits
    }

    #[inline(always)]
    fn lanes<L: Lanes>(token: L::Token, packet: &HitPacket<L::Array>) -> [L; 2] {
        let mut bits = L::Array::filled(0.0);
        let indices = packet.sphere.as_ref();
        for lane in 0..L::COUNT {
            if let Some(&index) = indices.get(lane) {
                bits.set(lane, f32::from_bits(index));
            }
        }
        [L::load(token, &packet.t), L::load(token, &bits)]
    }

    #[cfg(feature = "alloc")]
    #[inline(always)]
    fn of_packets(packets: &mut [HitPacket]) -> ManyHits<'_> {
        ManyHits::Packets(packets)
    }
}

impl Answers for AnyHit {
    const ANY: bool = true;
    type Packet<A: LaneArray> = u32;
    type One = bool;
    type Many<'a> = ManyOccluded<'a>;

    #[inline(always)]
    fn none<A: LaneArray>() -> u32 {
        0
    }

    #[inline(always)]
    fn one<A: LaneArray>(packet: &u32, lane: usize) -> bool {
        lane < A::COUNT && packet >> lane & 1 == 1
    }

    #[inline(always)]
    fn put<A: LaneArray>(packet: &mut u32, lane: usize, one: bool) {
        *packet |= u32::from(one) << (lane % 32);
    }

    #[inline(always)]
    fn done<L: Lanes>(token: L::Token, packet: &u32) -> L::Mask {
        L::mask(token, *packet)
    }

    #[inline(always)]
    fn limits<L: Lanes>(token: L::Token, _: &u32) -> L {
        L::splat(token, f32::INFINITY)
    }

    #[inline(always)]
    fn accept<L: Lanes>(packet: &mut u32, _: u32, t: L, limits: L) -> L {
        *packet |= t.lt(t.like(f32::INFINITY)).bits();
        limits
    }

    #[inline(always)]
    fn take<A: LaneArray>(packet: &mut u32, lane: usize, _: Hit, _: impl FnOnce(u32) -> bool) {
        *packet |= 1 << (lane % 32);
    }

    #[inline(always)]
    fn limit<A: LaneArray>(packet: &u32, lane: usize) -> f32 {
        if packet >> (lane % 32) & 1 == 1 { f32::NEG_INFINITY } else { f32::INFINITY }
    }

    #[inline(always)]
    fn from_lanes<L: Lanes>(t: L, _: L) -> u32 {
        t.lt(t.like(f32::INFINITY)).bits()
    }

    #[inline(always)]
    fn lanes<L: Lanes>(token: L::Token, packet: &u32) -> [L; 2] {
        let (zero, infinity) = (L::splat(token, 0.0), L::splat(token, f32::INFINITY));
        [L::select(L::mask(token, *packet), zero, infinity), zero]
    }

    #[cfg(feature = "alloc")]
    #[inline(always)]
    fn of_packets(packets: &mut [u32]) -> ManyOccluded<'_> {
        ManyOccluded::Packets(packets)
    }
}
