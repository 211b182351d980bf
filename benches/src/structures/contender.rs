//! Who takes part.

#[cfg(feature = "embree")]
use crate::embree::Width;
use spherule_kernel::dispatch::LevelName;
use spherule_kernel::{Accuracy, Exact, Fast, Question, Stable};

/// A tier by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tier {
    /// [`Fast`].
    Fast,
    /// [`Stable`].
    Stable,
    /// [`Exact`].
    Exact,
}

impl Tier {
    /// All three.
    pub const ALL: [Self; 3] = [Self::Fast, Self::Stable, Self::Exact];

    /// As the type is called.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Fast => Fast::NAME,
            Self::Stable => Stable::NAME,
            Self::Exact => Exact::NAME,
        }
    }
}

/// A way of the kernel to the hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Every ray against every sphere.
    Brute,
    /// The tree, ray by ray.
    Single,
    /// The tree, packets of rays together.
    Coherent,
    /// Tile lists, made anew for every pass over the rays.
    Tiles,
}

impl Way {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Brute, Self::Single, Self::Coherent, Self::Tiles];

    /// As it stands in tables.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Brute => "brute force",
            Self::Single => "tree, ray by ray",
            Self::Coherent => "tree, packets",
            Self::Tiles => "tile lists",
        }
    }
}

/// Who finds hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contender {
    /// The kernel.
    Ours(Way, Tier, LevelName),
    /// Another tree, ray by ray.
    Peer(&'static str),
    /// Embree, with so many rays a call.
    #[cfg(feature = "embree")]
    Embree(Width),
}

impl core::fmt::Display for Contender {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Ours(way, tier, level) => {
                write!(formatter, "{}, {}, {}", way.as_str(), tier.as_str(), level.as_str())
            }
            Self::Peer(name) => write!(formatter, "{name}"),
            #[cfg(feature = "embree")]
            Self::Embree(width) => write!(formatter, "Embree, {} rays a call", width.as_str()),
        }
    }
}

impl Contender {
    /// Whether it is Embree.
    #[must_use]
    pub const fn is_embree(self) -> bool {
        #[cfg(feature = "embree")]
        if let Self::Embree(_) = self {
            return true;
        }
        false
    }
}

/// What is asked.
pub const QUESTIONS: [Question; 2] = [Question::Nearest, Question::Any];

/// What is asked, as it stands in tables.
#[must_use]
pub const fn question_name(question: Question) -> &'static str {
    match question {
        Question::Nearest => "nearest",
        Question::Any => "any hit",
    }
}
