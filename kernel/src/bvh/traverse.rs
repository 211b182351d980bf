//! One ray's way through the tree: `wavefront` -> `in_flight` -> `prepared_ray` -> `ray_state` ->
//! `root_interval` -> `deferred`, whence the tier.

pub(crate) mod boxes;
mod deferred;
pub(crate) mod few;
mod in_flight;
#[cfg(feature = "std")]
pub(crate) mod one_ray;
pub(crate) mod packet_set;
pub(crate) mod prefetch;
pub(crate) mod prepared_ray;
mod ray_state;
pub(crate) mod root_interval;
pub(crate) mod source;
mod stack;
pub(crate) mod stream;
pub(crate) mod wavefront;

#[cfg(test)]
mod toy;
