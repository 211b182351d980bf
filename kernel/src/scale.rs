//! The powers of two by which bounds see spheres and rays, so that no bound depends on the units of a scene.
//!
//! A structure chooses one from its spheres (`scene`). How it sees a ray follows from that power and from the length
//! of the ray's direction (`rays`). Tiers see spheres and rays as they were given.

pub(crate) mod rays;
pub(crate) mod scene;
