//! The table of variants, and what is asked of all of them.

mod difference;
mod pairs;
mod refitted;
mod surfaces;
mod table;
mod tiles;

pub use difference::{assert_same, assert_same_from, bits, difference};
pub use pairs::{pair_layers, pairs_of};
pub use surfaces::{shadow_rays_of, surface_layers, surfaces_of};
pub use table::{
    Answers, Layer, Memory, Structure, Structures, Variant, brute, levels, lists, reference,
    variants, viewpoint_of,
};
pub use tiles::{Frame, assert_same_tiles, tile_difference};
