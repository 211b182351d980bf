//! The surface that a ray has hit, as shading sees it: turned to the viewer, and where rays to the lights leave it.
//!
//! Normals and points come from the sphere's centre, never through t; shadow rays start where the kernel proves that they do not
//! meet the sphere that they leave. So there is no distance to choose: nothing shadows itself, and no shadow is lost.

use crate::scene::{Light, Source};
use spherule_kernel::{Ray, Side, Sphere, Surface, Tier, Vec3, surface};

/// A point of a sphere, from the side that a ray came from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    surface: Surface,
    sphere: Sphere,
    side: Side,
}

impl SurfacePoint {
    /// The point of `sphere` that `ray` hits at `t`, the answer of `tier`.
    ///
    /// On a sphere of radius 0 the normal points back along the ray.
    #[must_use]
    #[inline]
    pub fn new(tier: Tier, ray: &Ray, t: f32, sphere: &Sphere) -> Self {
        let surface = surface(tier, ray, t, sphere);
        let from_inside = surface.normal.dot(ray.direction) > 0.0;
        let side = if from_inside { Side::Inside } else { Side::Outside };
        Self { surface, sphere: *sphere, side }
    }

    /// Of length one, towards the side that the ray came from.
    #[must_use]
    #[inline]
    pub fn normal(&self) -> Vec3 {
        match self.side {
            Side::Outside => self.surface.normal,
            Side::Inside => -self.surface.normal,
        }
    }

    /// The cosine of the angle between the normal and the way to the light; `None` if the surface faces away.
    #[must_use]
    #[inline]
    pub fn cosine(&self, light: &Light) -> Option<f32> {
        let direction = match light.source {
            Source::Direction(direction) => direction,
            Source::Position(position) => position - self.surface.position(&self.sphere),
        };
        let cosine = self.normal().dot(direction) / direction.length();
        (cosine > 0.0).then_some(cosine)
    }

    /// The ray to the light; `None` past the end of numbers.
    #[must_use]
    #[inline]
    pub fn ray_to(&self, tier: Tier, light: &Light) -> Option<Ray> {
        let Self { surface, sphere, side } = self;
        match light.source {
            Source::Direction(direction) => surface.leave(tier, sphere, *side, direction),
            Source::Position(position) => surface.leave_to(tier, sphere, *side, position),
        }
    }
}
