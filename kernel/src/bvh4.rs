//! A tree of boxes for one lane, four children a node: for firmware, built there or linked as data.
//!
//! # Method
//!
//! Sphere i is in the box c -+ r, rounded outward. The list is cut at the middle of the longest axis of its centres, and
//! so on until a leaf is left of four spheres: k cuts one below the other leave equal parts, of which the last alone may
//! be shorter. So the number of spheres says where every node and leaf lies (`shape.rs`), and a tree is no more than the
//! order of the spheres and the boxes of the nodes: words, which may lie in flash. What they may be, [`Bvh4::load`]
//! checks: it computes each box anew.
//!
//! A ray goes down by itself, the nearest box first, with a stack of as many places as the depth needs. The tier is
//! asked about each sphere of a leaf.
//!
//! # What is guaranteed
//!
//! As of the [tree](crate::bvh) with sixteen children: bit for bit what the list answers. Boxes are made and rays are
//! prepared as there, scaled by a power of two, and by the proofs of `docs/traversal-margins.md`. Spheres that the bounds
//! do not cover are met as in a list, and rays that they do not cover meet the list.

mod boxes;
mod load;
mod order;
mod shape;
mod tree;
pub(crate) mod walk;

pub use load::Bvh4Error;
pub use tree::Bvh4;
