//! The powers of two by which bounds see spheres and rays, so that none depends on the units of a scene.
//!
//! A structure chooses one from its spheres (`scene`), and sees a ray as it follows from that and from the ray's own
//! length (`rays`). Tiers see both as they were given.

pub(crate) mod rays;
pub(crate) mod scene;
