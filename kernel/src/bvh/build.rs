//! From a list of spheres to a tree: `top_down` -> `children` -> `sah_split` -> `sah_bins` and `partition`,
//! then `lay_down`, and at last the `child_order` of every node. `refit` is for spheres that have moved.

pub(crate) mod bounds;
pub(crate) mod budget;
mod child_order;
mod children;
mod dropped;
pub(crate) mod join;
mod lay_down;
mod partition;
pub(crate) mod refit;
mod run;
mod sah_bins;
mod sah_split;
pub(crate) mod top_down;
