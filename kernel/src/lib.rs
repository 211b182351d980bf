#![doc = include_str!("lib.md")]
#![no_std]
#![forbid(unsafe_code)]

pub mod accuracy;
mod axes;
pub mod bvh;
pub mod camera;
#[cfg(feature = "dispatch")]
pub mod dispatch;
mod error_free;
mod exact;
mod filter;
mod float_environment;
mod hit;
mod intersect;
mod lanes;
mod ray;
#[cfg(test)]
mod search;
mod sphere;
mod stages;
pub mod tiles;

pub use accuracy::{Accuracy, Exact, Fast, Stable};
pub use bvh::{Bvh, BvhLeaf, BvhNode, BvhSize};
pub use camera::Camera;
#[cfg(feature = "dispatch")]
pub use fearless_simd;
pub use float_environment::float_environment_is_sound;
pub use glam::Vec3;
pub use hit::{Hit, HitArrays, HitPacket};
pub use intersect::{any, nearest, nearest_hit, pairs, roots};
pub use lanes::{DoubleLanes, LaneArray, LaneMask, Lanes};
pub use ray::{Ray, RayArrays, RayPacket};
pub use sphere::{Sphere, SphereArrays, SpherePacket, Spheres, SpheresError};
pub use stages::{Question, Stages, stages};
pub use tiles::{DepthOrder, Viewpoint};
pub use wide::{f32x4, f32x8, f32x16};
