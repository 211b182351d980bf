//! parry3d: a ray cast at a `Ball`, which is hollow.

#[path = "../../answers_of.rs"]
mod answers_of;

use parry3d::math::{Pose, Vector};
use parry3d::query::{Ray, RayCast};
use parry3d::shape::Ball;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    answers_of::answers_of(|[x, y, z, radius], [ox, oy, oz, dx, dy, dz, _, t_max]| {
        let ray = Ray::new(Vector::new(ox, oy, oz), Vector::new(dx, dy, dz));
        let t = Ball::new(radius).cast_ray(&Pose::translation(x, y, z), &ray, t_max, false);
        t.filter(|t| t.is_finite())
    })
}
