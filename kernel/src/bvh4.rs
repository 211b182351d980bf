//! A tree of boxes for one lane, four children a node: for firmware, built there or linked as data.
//!
//! # Method
//!
//! Sphere i is in the box c -+ r, rounded outward. The list is cut at the middle of the longest axis of its centres, and
//! so is each part, until leaves of four spheres are left. k cuts one below the other leave equal parts, of which only
//! the last may be shorter. So the number of spheres says where every node and leaf lies (`shape.rs`), and a tree is no
//! more than the order of the spheres and the boxes of the nodes. All are words, which may lie in flash. [`Bvh4::load`]
//! checks them: it computes each box anew.
//!
//! A ray goes down by itself, the nearest box first, with a stack of as many places as the depth needs. The tier tests
//! each sphere of a leaf.
//!
//! # What is guaranteed
//!
//! The guarantee is that of the [tree](crate::bvh) with sixteen children: answers are bit for bit those of the list.
//! Boxes are made and rays are prepared as there: scaled by a power of two, with the margins that
//! `docs/traversal-margins.md` proves. Spheres that the bounds do not cover are tested as in a list, and rays that they
//! do not cover are tested against the whole list.

mod boxes;
mod load;
mod order;
mod shape;
mod tree;
pub(crate) mod walk;

pub use load::Bvh4Error;
pub use tree::Bvh4;
