//! Other crates, with the feature `peers`: their trees, and their loops.

#[cfg(feature = "peers")]
mod bvh;
#[cfg(feature = "peers")]
mod obvhs;
#[cfg(feature = "peers")]
mod one_by_one;
#[cfg(feature = "peers")]
mod parry;
#[cfg(feature = "peers")]
mod ultraviolet;

use super::Engine;
use spherule_kernel::Spheres;

/// What builds the engine of another crate.
pub(crate) type Build = fn(Spheres<'_>) -> Engine;

#[cfg(feature = "peers")]
pub(crate) const TREES: &[(&str, Build)] =
    &[("obvhs, cwbvh", obvhs::build), ("bvh", bvh::build), ("parry3d, Bvh", parry::build)];
#[cfg(feature = "peers")]
pub(crate) const LOOPS: &[Build] = &[ultraviolet::ultraviolet];

#[cfg(not(feature = "peers"))]
pub(crate) const TREES: &[(&str, Build)] = &[];
#[cfg(not(feature = "peers"))]
pub(crate) const LOOPS: &[Build] = &[];
