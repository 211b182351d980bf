//! A tree of boxes over many spheres, sixteen children a node, in memory that the caller provides.
//!
//! # Method
//!
//! Sphere i is in the box c -+ r, rounded outward. A node holds the boxes of up to sixteen children, coordinate by
//! coordinate, so that one ray is tested against all of them at once. A leaf holds up to sixteen spheres in the same
//! way, and takes no more room than they need: leaves lie one behind the other. The [build](Bvh::build) goes from the
//! root down by the surface area heuristic (Wald 2007: sixteen bins an axis), and a budget of nodes and places bounds
//! the memory (`bvh/build/budget.rs`). Of spheres that are the same, a leaf holds only the one with the lowest index.
//!
//! Incoherent rays are traced ray by ray (`bvh/traverse/wavefront.rs`), or, with memory for it, in queues that go
//! down together (`bvh/traverse/stream.rs`); packets that look the same way go down as groups
//! (`coherent/tree_source.rs`).
//!
//! # What is guaranteed
//!
//! A tree answers bit for bit what the list of spheres answers: by [`Exact`](crate::Exact) for every input, by
//! [`Stable`](crate::Stable) in its domain, by [`Fast`](crate::Fast) and [`Geometric`](crate::Geometric) except for
//! false hits on lines that miss a sphere's box. Boxes and filters only decide what is skipped,
//! under bounds that `docs/traversal-margins.md` proves; every t is a tier's.
//!
//! # Units
//!
//! Boxes and leaves hold the spheres times a power of two, which follows from the sizes of most spheres, and rays are
//! scaled in the same way (`scale`). So a scene times 2^k has the same tree and takes the same time, and a ray of any
//! length takes the same time. Tiers get spheres and rays as they were given. What the bounds do not cover is not
//! skipped: spheres larger or smaller than most by 2^40 or more are kept apart, and tested as a list is; rays that
//! start beyond 2^56 times the scene's size are tested against all spheres, if they come near any.
//!
//! # Depth
//!
//! A node over n spheres gives none of its children more than n/8 of them, rounded up, or 256, where the heuristic
//! chooses (`bvh/build/children.rs`). Where the node is cut in equal parts, no child has more than the largest 16^k
//! below n. A node over at most 256 spheres has only leaves for children. So 2^27 spheres, which are the most, make
//! ten nodes one below the other.

pub(crate) mod boxes_per_ray;
pub(crate) mod build;
mod built;
pub(crate) mod leaf;
pub(crate) mod memory;
pub(crate) mod node;
#[cfg(feature = "alloc")]
pub(crate) mod owned;
pub(crate) mod prefetch;
pub(crate) mod source;
pub(crate) mod traverse;
pub(crate) mod tree;
mod unplaced;

#[cfg(feature = "alloc")]
pub use self::owned::SphereTree;
pub use build::budget::BvhSize;
pub use build::join::{InTurn, Join};
pub use memory::{BvhMemory, RefitError};
pub use node::BvhNode;
pub use traverse::stream::{QueuedRay, StreamMemory, StreamRay};
pub use tree::Bvh;
