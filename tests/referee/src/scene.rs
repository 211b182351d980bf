//! Rays and the spheres that they share, printed so that no bit is hidden.

use crate::case::{HexRay, HexSphere};
use spherule_kernel::{Ray, Sphere};
use std::fmt;

/// Rays, and a list of spheres that they share.
#[derive(Clone, PartialEq)]
pub struct Scene {
    /// The rays.
    pub rays: Vec<Ray>,
    /// The spheres.
    pub spheres: Vec<Sphere>,
}

impl fmt::Debug for Scene {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, ray) in self.rays.iter().enumerate() {
            write!(formatter, "\n  {index}: {}", HexRay(ray))?;
        }
        for (index, sphere) in self.spheres.iter().enumerate() {
            write!(formatter, "\n  {index}: {}", HexSphere(sphere))?;
        }
        Ok(())
    }
}
