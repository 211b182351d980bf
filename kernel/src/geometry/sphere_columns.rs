//! Sixteen spheres as bounds see them.

use crate::lanes::WIDTH;

/// Sixteen spheres, coordinate by coordinate, as leaves and depth lists have them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SphereColumns<'a> {
    pub(crate) center: [&'a [f32; WIDTH]; 3],
    pub(crate) radius: &'a [f32; WIDTH],
}
