//! One ray's way through the tree: `wavefront` -> `in_flight` -> `prepared_packet` -> `ray_state`
//! -> `root_interval` -> `deferred`, which calls the tier.

pub(crate) mod boxes;
pub(crate) mod deferred;
mod in_flight;
#[cfg(feature = "std")]
pub(crate) mod one_ray;
mod overflow;
pub(crate) mod packet_set;
pub(crate) mod prepared_packet;
pub(crate) mod prepared_ray;
pub(crate) mod ray_state;
pub(crate) mod ray_time;
pub(crate) mod root_interval;
pub(crate) mod small_tree;
mod stack;
pub(crate) mod stream;
pub(crate) mod wavefront;
