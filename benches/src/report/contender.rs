//! The one list of what is compared: every tier in every lane width and at every level of
//! instructions, and behind them the reference forms.
//!
//! Lanes of the crate `wide` have the instructions that the build chose. Those of `fearless_simd`
//! have what the CPU is found to have at run time: `sse2`, `avx2` and `avx512`, where the build
//! itself does not already have as much or more.

use crate::check::Tolerance;
use crate::report::reference;
use crate::workload::packets;
use spherule_kernel::fearless_simd::{self, Level, Simd};
use spherule_kernel::{
    Accuracy, Exact, Fast, Hit, HitPacket, Lanes, Ray, RayPacket, Spheres, Stable, f32x4, f32x8,
    f32x16, nearest,
};

/// Lanes of a width and of a level of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Engine {
    /// `build` where the instructions are fixed at build time, else the level chosen at run time.
    pub level: &'static str,
    /// The type of the lanes.
    pub lanes: &'static str,
    /// How many.
    pub count: usize,
}

impl Engine {
    /// The level of lanes whose instructions are fixed at build time.
    pub const BUILD: &'static str = "build";
}

impl core::fmt::Display for Engine {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.level {
            Self::BUILD => write!(formatter, "{}", self.lanes),
            level => write!(formatter, "{} {level}", self.lanes),
        }
    }
}

/// Nearest hits of rays in a list of spheres, ready to be found again and again.
pub trait Run {
    /// Finds them.
    fn run(&mut self);
    /// What was found.
    fn hits(&self) -> Vec<Option<Hit>>;
}

/// Brings rays and spheres into the memory that a contender wants.
pub type Ready = for<'a> fn(&[Ray], Spheres<'a>) -> Box<dyn Run + 'a>;

/// A tier or a reference form, in lanes.
#[derive(Clone, Copy, Debug)]
pub struct Contender {
    /// The tier's name, or the form's.
    pub name: &'static str,
    /// Whether users can ask for it.
    pub is_tier: bool,
    /// The lanes.
    pub engine: Engine,
    /// How far from the truth it may be on the rays that are timed.
    pub tolerance: Tolerance,
    /// And where the list has a ground.
    pub over_ground: Tolerance,
    /// Makes it ready to run.
    pub ready: Ready,
}

/// All of them; of each name the engine with the fewest lanes first.
#[must_use]
pub fn contenders() -> Vec<Contender> {
    let mut all = Vec::new();
    tier::<Fast>(&mut all, [Tolerance::TEXTBOOK; 2]);
    tier::<Stable>(&mut all, [Tolerance::CLOSEST_POINT, Tolerance::CLOSEST_POINT_OVER_GROUND]);
    tier::<Exact>(&mut all, [Tolerance::EXACT; 2]);
    all.extend(reference::contenders());
    all
}

fn tier<A: Accuracy + 'static>(all: &mut Vec<Contender>, [tolerance, over_ground]: [Tolerance; 2]) {
    let mut add = |level, lanes, count, ready| {
        let engine = Engine { level, lanes, count };
        all.push(Contender { name: A::NAME, is_tier: true, engine, tolerance, over_ground, ready });
    };
    add(Engine::BUILD, "f32", 1, fixed::<A, f32>);
    add(Engine::BUILD, "f32x4", 4, fixed::<A, f32x4>);
    add(Engine::BUILD, "f32x8", 8, fixed::<A, f32x8>);
    add(Engine::BUILD, "f32x16", 16, fixed::<A, f32x16>);
    #[cfg(target_arch = "x86_64")]
    {
        let level = Level::new();
        if !cfg!(target_feature = "avx2") {
            add("sse2", "f32x4", 4, dispatched::sse2_x4::<A>);
            if level.as_avx2().is_some() {
                add("avx2", "f32x8", 8, dispatched::avx2_x8::<A>);
                add("avx2", "f32x16", 16, dispatched::avx2_x16::<A>);
            }
        }
        if level.as_avx512().is_some() {
            add("avx512", "f32x16", 16, dispatched::avx512_x16::<A>);
        }
    }
}

/// Packets, spheres, and the function that brings them together.
struct Packets<'a, L: Lanes, N> {
    rays: Vec<RayPacket<L>>,
    spheres: Spheres<'a>,
    hits: Vec<HitPacket<L>>,
    count: usize,
    nearest: N,
}

impl<L: Lanes, N: Fn(&[RayPacket<L>], Spheres<'_>, &mut [HitPacket<L>])> Run for Packets<'_, L, N> {
    fn run(&mut self) {
        (self.nearest)(&self.rays, self.spheres, &mut self.hits);
        std::hint::black_box(&self.hits);
    }

    fn hits(&self) -> Vec<Option<Hit>> {
        let all = self.hits.iter().flat_map(|packet| (0..L::COUNT).map(|lane| packet.hit(lane)));
        all.take(self.count).collect()
    }
}

fn ready<'a, L: Lanes + 'static>(
    rays: &[Ray],
    spheres: Spheres<'a>,
    nearest: impl Fn(&[RayPacket<L>], Spheres<'_>, &mut [HitPacket<L>]) + 'a,
) -> Box<dyn Run + 'a> {
    let count = rays.len();
    let rays = packets::<L>(rays);
    let hits = vec![HitPacket::<L>::none(); rays.len()];
    Box::new(Packets::<L, _> { rays, spheres, hits, count, nearest })
}

fn fixed<'a, A: Accuracy + 'static, L: Lanes<Token = ()> + 'static>(
    rays: &[Ray],
    spheres: Spheres<'a>,
) -> Box<dyn Run + 'a> {
    ready::<L>(rays, spheres, |rays, spheres, hits| nearest::<A, L>((), rays, spheres, hits))
}

/// The tiers in lanes whose instructions are chosen at run time.
#[cfg(target_arch = "x86_64")]
mod dispatched {
    use super::*;

    /// `nearest` must be inlined into what `vectorize` calls: a call would not have its
    /// instructions.
    fn entered<'a, A: Accuracy + 'static, S: Simd + 'static, L: Lanes<Token = S> + 'static>(
        simd: S,
        rays: &[Ray],
        spheres: Spheres<'a>,
    ) -> Box<dyn Run + 'a> {
        ready::<L>(rays, spheres, move |rays, spheres, hits| {
            simd.vectorize(
                #[inline(always)]
                || nearest::<A, L>(simd, rays, spheres, hits),
            );
        })
    }

    macro_rules! level {
        ($name:ident, $token:ident, $lanes:ident) => {
            pub(super) fn $name<'a, A: Accuracy + 'static>(
                rays: &[Ray],
                spheres: Spheres<'a>,
            ) -> Box<dyn Run + 'a> {
                let simd = Level::new().$token().expect("listed only where the CPU has it");
                entered::<A, _, fearless_simd::$lanes<_>>(simd, rays, spheres)
            }
        };
    }

    level!(sse2_x4, as_sse2, f32x4);
    level!(avx2_x8, as_avx2, f32x8);
    level!(avx2_x16, as_avx2, f32x16);
    level!(avx512_x16, as_avx512, f32x16);
}
