//! The table of variants: tier, structure and layer of the door, each as a plain function from rays to answers. So a
//! test can ask all of them in one loop, and each is compiled only once, here.
//!
//! `Exact` gives the same bits in all of them, and so does `Stable` in its domain. `Fast` and `Geometric` give the same
//! bits in all lists of spheres, but a depth list or a tree may lose their false hits.

mod answers;
mod ask;
mod difference;
mod memory;
mod packing;
mod pairs;
mod refitted;
mod surfaces;
mod table;
mod tiles;

pub use answers::Answers;
pub use difference::{assert_hits, assert_same, assert_same_from, bits};
pub use memory::{Memory, Structures, viewpoint_of};
pub use pairs::{pair_layers, pairs_of};
pub use surfaces::{shadow_rays_of, surface_layers, surfaces_of};
pub use table::{Layer, Structure, Variant, brute, levels, lists, reference, variants};
pub use tiles::{Frame, assert_same_tiles};
