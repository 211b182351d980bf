//! collision: where a `Ray3` meets the volume `Sphere`; t by projection of the point onto the ray.

#[path = "../../answers_of.rs"]
mod answers_of;

use cgmath::{InnerSpace, Point3, Vector3};
use collision::{Continuous, Ray3, Sphere};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    answers_of::answers_of(|[x, y, z, radius], [ox, oy, oz, dx, dy, dz, t_min, t_max]| {
        let (origin, direction) = (Point3::new(ox, oy, oz), Vector3::new(dx, dy, dz));
        let sphere = Sphere { center: Point3::new(x, y, z), radius };
        let point = sphere.intersection(&Ray3::new(origin, direction))?;
        let double = |v: Vector3<f32>| v.map(f64::from);
        let way = point.map(f64::from) - origin.map(f64::from);
        let t = (way.dot(double(direction)) / double(direction).magnitude2()) as f32;
        // The library has no interval.
        (t.is_finite() && t_min <= t && t <= t_max).then_some(t)
    })
}
