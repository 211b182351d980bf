//! What a scene is made of, and what comes of it: rays, spheres, hits, and cameras that make rays.

pub(crate) mod camera;
pub(crate) mod columns;
pub(crate) mod hit;
pub(crate) mod many;
pub(crate) mod many_answers;
#[cfg(feature = "alloc")]
pub(crate) mod moved_spheres;
pub(crate) mod ray;
pub(crate) mod ray_packet;
pub(crate) mod sphere;
pub(crate) mod sphere_columns;
#[cfg(feature = "alloc")]
pub(crate) mod sphere_list;
pub(crate) mod sphere_run;
pub(crate) mod surface;
