#![doc = include_str!("lib.md")]
#![no_std]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]
// Loops over lanes count an index: an iterator or closure of the standard library is a call in a build of many
// codegen units without link-time optimisation (`lanes/array.rs`).
#![allow(clippy::needless_range_loop, clippy::manual_map)]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

pub mod accuracy;
pub mod bvh;
pub mod bvh4;
mod coherence;
mod coherent;
mod count;
mod dispatch;
mod exact;
mod filter;
mod geometry;
mod intersect;
mod lanes;
mod linear;
mod memory;
mod numeric;
mod packets;
mod query;
mod scale;
mod slices;
mod spawn_ray;
#[cfg(feature = "stages")]
mod stages;
mod structures;
mod surface;
mod trace;
mod unknown_name;

pub use accuracy::{Accuracy, Exact, Fast, Geometric, Stable, Tier};
#[cfg(feature = "alloc")]
pub use bvh::SphereTree;
pub use bvh::{
    Bvh, BvhMemory, BvhNode, BvhSize, InTurn, Join, QueuedRay, RefitError, StreamMemory, StreamRay,
};
pub use bvh4::{Bvh4, Bvh4Error};
pub use coherence::Coherence;
pub use coherent::{DepthList, Viewpoint};
pub use dispatch::{Level, LevelName};
pub use geometry::camera::tiles::CameraTiles;
pub use geometry::camera::{Camera, Projection};
pub use geometry::columns::{HitColumns, RayColumns};
pub use geometry::hit::{Hit, HitPacket};
#[cfg(feature = "alloc")]
pub use geometry::moved_spheres::MovedSpheres;
pub use geometry::ray::Ray;
pub use geometry::ray_packet::RayPacket;
pub use geometry::sphere::{Sphere, SpherePacket, Spheres, SpheresError};
#[cfg(feature = "alloc")]
pub use geometry::sphere_list::SphereList;
pub use geometry::surface::{Surface, SurfacePacket};
pub use glam::{Vec3, Vec4};
pub use intersect::Intersect;
pub use lanes::{DoubleLanes, LaneArray, LaneMask, Lanes};
pub use linear::{Writes, compare_hits, discriminant, object_lanes, pair_lanes, roots};
pub use memory::TooSmall;
pub use numeric::float_environment::float_environment_is_sound;
pub use packets::{
    object_packets, pair_packets, pairs, shadow_packets, surface_packets, tile_rays,
};
pub use query::{AnyHit, ClosestHit, Query};
pub use spawn_ray::packets::{SurfaceHit, SurfaceHits, Towards, shadow_lanes};
pub use spawn_ray::side::{Side, side};
#[cfg(feature = "stages")]
pub use stages::{Stages, stages};
pub use surface::{surface, surface_lanes};
pub use trace::Trace;
pub use unknown_name::UnknownName;
pub use wide::{f32x4, f32x8, f32x16};

/// Proofs and tests of what is private. They are no part of this package: `tests/proofs` compiles this source with
/// them, and sets `proofs`.
#[cfg(all(test, proofs))]
#[path = "../../tests/proofs/src/proofs.rs"]
mod proofs;

/// The README's examples are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
