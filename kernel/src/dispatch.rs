//! The widest code that the CPU has, chosen at run time.
//!
//! A plain build is compiled for the oldest CPU of its target. With feature `std` every traversal is
//! compiled once more for each level, and a [`Level`] is the proof that the CPU has it. Without `std` the
//! CPU cannot be asked, and there is one level, the build's own. The bits of an answer are the same at every
//! level.

#[cfg(not(feature = "std"))]
mod build_target;
#[cfg(feature = "std")]
pub(crate) mod compiled;

use crate::unknown_name::UnknownName;
#[cfg(not(feature = "std"))]
pub(crate) use build_target::{BuildLanes, fill};
use core::fmt;
use core::str::FromStr;

/// An instruction set that the CPU has.
#[derive(Clone, Copy, Debug)]
pub struct Level(
    #[cfg(feature = "std")] pub(crate) fearless_simd::Level,
    #[cfg(not(feature = "std"))] (),
);

/// The name of a [`Level`], whether or not the CPU has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum LevelName {
    /// What the build's target guarantees: SSE2 on x86-64.
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
    ///
    /// ```
    /// use spherule_kernel::LevelName;
    ///
    /// assert_eq!(LevelName::ALL.map(LevelName::as_str), ["baseline", "avx2", "avx512"]);
    /// ```
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }
}

/// Its name, padded as a string is.
impl fmt::Display for LevelName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(self.as_str())
    }
}

/// ```
/// use spherule_kernel::LevelName;
///
/// assert_eq!("avx2".parse(), Ok(LevelName::Avx2));
/// assert!("avx".parse::<LevelName>().is_err());
/// ```
impl FromStr for LevelName {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        const NAMES: [&str; 3] =
            [LevelName::Baseline.as_str(), LevelName::Avx2.as_str(), LevelName::Avx512.as_str()];
        let error = UnknownName { kind: "level", names: &NAMES };
        Self::ALL.into_iter().find(|level| level.as_str() == name).ok_or(error)
    }
}

/// Levels are equal if their names are.
impl PartialEq for Level {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for Level {}

impl Level {
    /// Returns the best level that the CPU has; without `std` the build's own. Cost: the first call asks the
    /// CPU.
    ///
    /// ```
    /// use spherule_kernel::{Level, LevelName};
    ///
    /// assert!(Level::best().name() >= LevelName::Baseline);
    /// ```
    #[must_use]
    #[cfg(feature = "std")]
    pub fn best() -> Self {
        static BEST: std::sync::OnceLock<fearless_simd::Level> = std::sync::OnceLock::new();
        Self(*BEST.get_or_init(|| {
            fearless_simd::Level::try_detect().unwrap_or(fearless_simd::Level::baseline())
        }))
    }

    /// Returns the build's own level, the only one without `std`. (Not `const`, which it cannot be with `std`.)
    ///
    /// ```
    /// use spherule_kernel::{Level, LevelName};
    ///
    /// assert_eq!(Level::best().name(), LevelName::Baseline);
    /// ```
    #[must_use]
    #[cfg(not(feature = "std"))]
    pub fn best() -> Self {
        Self(())
    }

    /// Returns the level of that name; `None` if the CPU does not have it. [`Baseline`](LevelName::Baseline) is what the build's target
    /// guarantees; if that is more, `name` returns another.
    ///
    /// ```
    /// use spherule_kernel::{Level, LevelName};
    ///
    /// assert!(Level::named(Level::best().name()).is_some());
    /// ```
    #[must_use]
    pub fn named(name: LevelName) -> Option<Self> {
        let best = Self::best();
        if name == best.name() {
            return Some(best);
        }
        match name {
            #[cfg(feature = "std")]
            LevelName::Baseline => Some(Self(fearless_simd::Level::baseline())),
            #[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
            LevelName::Avx2 => best.0.as_avx2().map(|avx2| Self(fearless_simd::Level::Avx2(avx2))),
            _ => None,
        }
    }

    /// Returns the level's name.
    ///
    /// ```
    /// use spherule_kernel::{Level, LevelName};
    ///
    /// let level = Level::named(LevelName::Avx2).unwrap_or(Level::best());
    /// assert!(LevelName::ALL.contains(&level.name()));
    /// ```
    #[must_use]
    pub fn name(self) -> LevelName {
        #[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
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
