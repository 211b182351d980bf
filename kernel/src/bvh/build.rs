//! From a list of spheres to a tree: `top_down` -> `children` -> `sah_split` -> `sah_bins` and
//! `partition`, then `lay_down`, and at last the `child_order` of every node.

pub(crate) mod bounds;
pub(crate) mod budget;
mod child_order;
mod children;
pub(crate) mod join;
mod lay_down;
mod partition;
mod run;
mod sah_bins;
mod sah_split;
pub(crate) mod top_down;
