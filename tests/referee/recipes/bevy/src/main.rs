//! Bevy: a `RayCast3d` against a `BoundingSphere`.

#[path = "../../answers_of.rs"]
mod answers_of;

use bevy_math::{Dir3A, Vec3A};
use bevy_shape::{BoundingSphere, RayCast3d};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    answers_of::answers_of(|[x, y, z, radius], [ox, oy, oz, dx, dy, dz, _, t_max]| {
        // The direction is already normalized wherever Bevy promises anything.
        let direction = Dir3A::from_xyz_unchecked(dx, dy, dz);
        let ray = RayCast3d::new(Vec3A::new(ox, oy, oz), direction, t_max);
        let distance =
            ray.sphere_intersection_at(&BoundingSphere::new(Vec3A::new(x, y, z), radius))?;
        Some(distance).filter(|t| t.is_finite())
    })
}
