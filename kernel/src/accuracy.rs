//! The tiers: how far to trust an answer, as a type or as a value.
//!
//! | tier | promise |
//! |---|---|
//! | [`Fast`] | the lecture's algebraic form in single precision; wrong where that is wrong |
//! | [`Geometric`] | the lecture's geometric form, likewise |
//! | [`Stable`] | the best form that plain single precision allows |
//! | [`Exact`] | decided as in real arithmetic, t correctly rounded, for every input |
//!
//! A tier says where a line meets a sphere; the code for validity, interval, order and ties is the
//! same for all tiers. Name a tier at build time by its type, `Exact`, or at run time by [`Tier`]:
//! the answers are the same bits.

pub(crate) mod constants;
pub(crate) mod exact;
pub(crate) mod fast;
mod formula;
pub(crate) mod geometric;
pub(crate) mod range_limits;
mod roots;
pub(crate) mod stable;
mod surface;
mod tier;

pub use exact::Exact;
pub use fast::Fast;
pub use formula::Tier;
pub use geometric::Geometric;
pub use stable::Stable;
pub use tier::Accuracy;

pub(crate) use formula::{Squares, TierFormula, TierWork, Underflow};
pub(crate) use roots::{RayLanes, all_finite};
#[cfg(feature = "std")]
pub(crate) use tier::test_one;
pub(crate) use tier::{is_closer, test_lanes};
