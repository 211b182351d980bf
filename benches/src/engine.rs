//! What is compared: an engine finds what rays meet. It is the kernel in one of its ways, the tree of another crate,
//! or a loop that stands here as a mark.

mod blocks;
#[cfg(feature = "embree")]
pub(crate) mod embree;
pub(crate) mod kernel;
pub(crate) mod marks;
pub(crate) mod peers;
pub(crate) mod probes;

use crate::rounds::{Sampler, timed};
use spherule_kernel::{Hit, Ray, RayPacket};
use std::cell::OnceCell;
use std::fmt;
use std::rc::Rc;

/// The most rays of an engine that takes single rays where packets are meant: enough for a time.
const SOME_RAYS: usize = 1 << 15;
/// What stands in place of answers to any-hit queries that are forgotten: every second ray hits, as in no scene.
pub(crate) const EVERY_SECOND: u32 = 0x5555_5555;
/// Rays of a block: it is brought into the cache, then traced with the clock running. The kernel and Embree share the
/// size.
pub(crate) const BLOCK: usize = 4096;

/// What rays want to know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Query {
    ClosestHit,
    AnyHit,
}

impl Query {
    pub(crate) const ALL: [Self; 2] = [Self::ClosestHit, Self::AnyHit];
}

/// Finds what rays meet in a list of spheres.
pub(crate) struct Engine {
    pub(crate) label: Label,
    pub(crate) promise: Promise,
    /// How many rays a sample takes: fewer than all if all would take too long; none if the engine is checked and not
    /// timed.
    pub(crate) most_rays: usize,
    pub(crate) ready: Ready,
}

impl Engine {
    /// Takes nanoseconds a ray, of all rays once.
    pub(crate) fn sampler(&self, rays: &Rays, query: Query) -> Sampler<'static> {
        let (mut run, count) = ((self.ready)(rays), rays.list.len() as f64);
        Box::new(move || run.time(query, 1) / count)
    }
}

/// Brings rays into the memory that an engine wants.
pub(crate) type Ready = Box<dyn Fn(&Rays) -> Box<dyn Run>>;

/// An engine with rays.
pub(crate) trait Run {
    /// Answers for every ray. An engine without code of its own for any hit finds the closest.
    fn run(&mut self, query: Query);
    /// The answers of the last run. After an any-hit query, the sphere and t mean nothing.
    fn hits(&self) -> Vec<Option<Hit>>;
    /// Overwrites the answers in memory, its own or another engine's, with wrong ones, so that a run that writes none is seen. There is
    /// nothing to do if memory is shared neither with another engine nor by queries.
    fn forget(&mut self) {}
    /// The nanoseconds that `runs` runs take.
    fn time(&mut self, query: Query, runs: usize) -> f64 {
        timed(|| (0..runs).for_each(|_| self.run(query)))
    }
}

/// What the name of every version of Embree starts with, among builds and engines.
pub(crate) const EMBREE: &str = "Embree";

/// What an engine is called; engines that are compared have different labels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Label {
    /// The way to the hits, or a version of Embree; empty if the name says it.
    pub(crate) way: &'static str,
    /// A tier, a mark, a crate, or rays a call.
    pub(crate) name: &'static str,
    /// Lanes, or the level of instructions; may be empty.
    pub(crate) lanes: &'static str,
}

impl Label {
    pub(crate) fn is_embree(&self) -> bool {
        self.way.starts_with(EMBREE)
    }
}

impl fmt::Display for Label {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [self.way, self.name, self.lanes];
        let parts: Vec<_> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        formatter.write_str(&parts.join(", "))
    }
}

/// What an engine's answers must be like before it is timed.
pub(crate) enum Promise {
    /// Probes answer nothing; brute force in a large scene is what the other ways are held to.
    Nothing,
    /// The answers must be another engine's, bit for bit.
    SameBits(Ready),
    /// The same, except on rays on which the other engine answers a hit that is none.
    SameButFalseHits(Ready),
    /// The answers must be those of `Exact`, except for a share of the rays, and with t off by at most so many ulp.
    Near(f64, u64),
    /// Another program: its answers must be those of `Exact`, except for a share of the rays. t may be off by
    /// [`OTHERS_ULP`], or by [`OTHERS_PART`] of the distance and size of the sphere.
    #[cfg_attr(not(feature = "peers"), expect(dead_code, reason = "only peers are held to it"))]
    Other(f64),
}

/// The share of rays on which Embree may decide otherwise. At AVX2 it does so on 2.02 % of the diffuse rays of "long lens".
pub(crate) const EMBREE_DIFFERS: f64 = 4e-2;
/// Another program may decide otherwise on a ray that starts on a surface, and where digits cancel.
pub(crate) const OTHERS_ULP: u64 = 1 << 14;
/// A ray that starts between two of thousands of nested spheres: the next surface is near, and its centre far.
pub(crate) const OTHERS_PART: f32 = 1.0 / (1 << 20) as f32;

impl Promise {
    /// The textbook form in single precision: p.p - r^2 cancels some thousandfold in the small scenes.
    pub(crate) const TEXTBOOK: Self = Self::Near(8.0 / 1024.0, 1 << 14);
    /// The geometric form over a ground: r^2 = 1e6 is known to some 0.1, which is some 1e-4 of length, and some of
    /// the rays start as near to the ground as 0.1.
    pub(crate) const GEOMETRIC_ON_GROUND: Self = Self::Near(8.0 / 1024.0, 1 << 17);
    /// For grazed spheres, and for which sphere is in front from 10^4 scene sizes away.
    #[cfg(feature = "peers")]
    pub(crate) const OTHERS: Self = Self::Other(2e-2);
    #[cfg(feature = "embree")]
    pub(crate) const EMBREE: Self = Self::Other(EMBREE_DIFFERS);
}

/// Rays, and the same rays in packets. All levels of the kernel share them, so that they are as warm in the cache for
/// each level.
pub(crate) struct Rays {
    pub(crate) list: Rc<[Ray]>,
    packets: OnceCell<Rc<[RayPacket]>>,
}

impl Rays {
    pub(crate) fn new(list: &[Ray]) -> Self {
        Self { list: list.into(), packets: OnceCell::new() }
    }

    pub(crate) fn packets(&self) -> Rc<[RayPacket]> {
        let packets = || self.list.chunks(RayPacket::COUNT).map(RayPacket::new).collect();
        Rc::clone(self.packets.get_or_init(packets))
    }
}
