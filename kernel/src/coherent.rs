//! Packets that look the same way, traced together: down a tree (`tree_source`), or through spheres in the
//! order of their depth (`list_source`).
//!
//! Both share their parts: `packet_state` holds what a packet knows, `packet_group` what four do together,
//! `fit` lays planes around a group of packets, `frustum` tells which boxes and spheres are between the
//! planes. One proof of the margins serves both: `docs/traversal-margins.md`.

mod box_sample;
pub(crate) mod depth_list;
mod depth_sort;
mod effort;
#[cfg(feature = "std")]
pub(crate) mod few_rays;
mod fit;
pub(crate) mod frustum;
mod giving_up;
pub(crate) mod learnt;
mod list_group;
pub(crate) mod list_source;
mod listed;
mod packet_group;
pub(crate) mod packet_source;
mod packet_state;
mod patience;
#[cfg(feature = "alloc")]
pub(crate) mod ray_order;
mod root_overlap;
mod survey;
pub(crate) mod tile_fit;
mod together;
mod tree_group;
pub(crate) mod tree_source;
pub(crate) mod view;

pub use depth_list::DepthList;
pub use view::Viewpoint;
