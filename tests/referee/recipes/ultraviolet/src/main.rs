//! ultraviolet, which has only vectors: the intersector of its README, unchanged, on these vectors.

#[path = "../../answers_of.rs"]
mod answers_of;

use std::error::Error;
use ultraviolet as uv;

fn main() -> Result<(), Box<dyn Error>> {
    answers_of::answers_of(|[x, y, z, radius], [ox, oy, oz, dx, dy, dz, _, t_max]| {
        let (origin, direction) = (uv::Vec3::new(ox, oy, oz), uv::Vec3::new(dx, dy, dz));
        let center = uv::Vec3::new(x, y, z);
        let t = ray_sphere_intersect(origin, direction, center, radius * radius);
        (t < f32::MAX && t <= t_max).then_some(t)
    })
}

fn ray_sphere_intersect(
    ray_o: uv::Vec3,
    ray_d: uv::Vec3,
    sphere_o: uv::Vec3,
    sphere_r_sq: f32,
) -> f32 {
    let oc = ray_o - sphere_o;
    let b = oc.dot(ray_d);
    let c = oc.mag_sq() - sphere_r_sq;
    let descrim = b * b - c;

    if descrim > 0.0 {
        let desc_sqrt = descrim.sqrt();

        let t1 = -b - desc_sqrt;
        if t1 > 0.0 {
            t1
        } else {
            let t2 = -b + desc_sqrt;
            if t2 > 0.0 { t2 } else { f32::MAX }
        }
    } else {
        f32::MAX
    }
}
