//! The widest code that the CPU has, chosen at run time: [`nearest`](crate::nearest), and its
//! companions, for packets of 16.
//!
//! A plain build is compiled for the oldest CPU of its target; here the same source is compiled
//! once more for each level, and a [`Level`] is the proof that the CPU has it. The bits of an
//! answer are the same at every level, and the same as those of the lanes of `wide`.
//!
//! Compile this crate in one piece (`codegen-units = 1`): the standard library's iterators are inlined
//! from the same piece alone, and a call in an inner loop is a call of code for the oldest CPU. In sixteen
//! pieces, the default, the walk of a tree took twenty times as long, and was right.

pub mod bvh;
mod compiled;
pub mod tiles;

pub(crate) use compiled::Compiled;

use crate::{Accuracy, HitPacket, RayPacket, SpherePacket, Spheres};

/// What packets here are laid out for: 16 lanes.
pub type Packet = crate::f32x16;

/// An instruction set that the CPU has.
#[derive(Clone, Copy, Debug)]
pub struct Level(fearless_simd::Level);

/// The name of a [`Level`], whether or not the CPU has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LevelName {
    /// What the target guarantees: SSE2 on x86-64.
    Baseline,
    /// AVX2 and FMA.
    Avx2,
    /// AVX-512 as in Ice Lake.
    Avx512,
}

impl LevelName {
    /// Every name, the narrowest first.
    pub const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// The name on the command line and in reports.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }
}

impl Level {
    /// The best that the CPU has; where that cannot be asked (no `std`), what the build allows.
    #[must_use]
    pub fn best() -> Self {
        Self(fearless_simd::Level::try_detect().unwrap_or(fearless_simd::Level::baseline()))
    }

    /// The level of that name, or nothing where the CPU has it not.
    #[must_use]
    pub fn named(name: LevelName) -> Option<Self> {
        let best = Self::best();
        if name == best.name() {
            return Some(best);
        }
        match name {
            LevelName::Baseline => Some(Self(fearless_simd::Level::baseline())),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            LevelName::Avx2 => best.0.as_avx2().map(|avx2| Self(fearless_simd::Level::Avx2(avx2))),
            _ => None,
        }
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> LevelName {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            if self.0.as_avx512().is_some() {
                return LevelName::Avx512;
            }
            if self.0.as_avx2().is_some() {
                return LevelName::Avx2;
            }
        }
        LevelName::Baseline
    }
}

/// [`crate::nearest`] at `level`.
pub fn nearest<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    hits: &mut [HitPacket<Packet>],
) {
    A::nearest(level, rays, spheres, hits);
}

/// [`crate::any`] at `level`.
pub fn any<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: Spheres<'_>,
    met: &mut [u32],
) {
    A::any(level, rays, spheres, met);
}

/// [`crate::pairs`] at `level`, packet by packet; packets past the end of the shortest slice are
/// left alone.
pub fn pairs<A: Accuracy>(
    level: Level,
    rays: &[RayPacket<Packet>],
    spheres: &[SpherePacket<Packet>],
    hits: &mut [HitPacket<Packet>],
) {
    A::pairs(level, rays, spheres, hits);
}
