//! Proofs of the kernel's bounds by machine, and tests of what is private in it: `docs/proofs.md`.

pub(crate) mod climb;
mod climbs;
mod corners;
mod cost;
mod derived;
mod integers;
mod lanes;
mod one_lane;
// Few rays go one by one where there are levels.
#[cfg(feature = "std")]
mod one_trace;
mod polynomial;
mod recorded;
mod rows;
mod running_error;
// Its work is counted at a level.
#[cfg(feature = "std")]
mod scales;
mod toy;
pub(crate) mod work;
