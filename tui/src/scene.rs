//! What there is to see.

/// Spheres, lights and a first view.
#[derive(Clone, Debug)]
pub struct Scene {}
