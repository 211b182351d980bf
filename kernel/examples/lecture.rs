//! The lecture's loop: for each pixel make the viewing ray, intersect, store. White where a ray hits.

use spherule_kernel::{Camera, Exact, Intersect, Projection, SphereList, Vec3};

const WIDTH: u32 = 72;
const HEIGHT: u32 = 24;

fn main() {
    // x, y, z, radius.
    let spheres = SphereList::from([[-0.9, 0.0, -4.0, 1.0], [0.9, 0.2, -5.0, 0.9]]);
    // A character is twice as high as it is wide.
    let camera = Camera {
        projection: Projection::Perspective { eye: Vec3::ZERO },
        // The centre of the first pixel: the picture's edges are half a step farther out, at 0.72 and 0.48 to each side.
        corner: Vec3::new(-0.71, 0.46, -1.0),
        step_x: Vec3::new(0.02, 0.0, 0.0),
        step_y: Vec3::new(0.0, -0.04, 0.0),
    };
    for iy in 0..HEIGHT {
        let mut row = String::new();
        for ix in 0..WIDTH {
            let hit = spheres.closest_hit(Exact, &camera.get_ray(ix, iy));
            row.push(if hit.is_some() { '#' } else { '.' });
        }
        println!("{row}");
    }
}
