//! A tree, the closest hits of a camera's rays, and shadow rays from these hits to a light.

use spherule_kernel::{
    Camera, Exact, Intersect, Projection, Ray, Side, SphereList, SphereTree, Trace, Vec3, surface,
};

const WIDTH: u32 = 72;
const HEIGHT: u32 = 24;

fn main() {
    let mut spheres = SphereList::from([[0.0, -1000.0, 0.0, 1000.0]]); // the ground
    for i in 0..40 {
        let angle = i as f32 * 2.4;
        let away = (i as f32).sqrt() * 0.7;
        spheres.push((Vec3::new(away * angle.cos(), 0.35, away * angle.sin()), 0.35));
    }
    let tree = SphereTree::new(spheres);
    let towards_light = Vec3::new(1.0, 1.5, 0.5);

    let camera = Camera {
        projection: Projection::Perspective { eye: Vec3::new(0.0, 4.0, 8.0) },
        // The centre of the first pixel, half a step from the picture's edges: 0.72 to each side, and the horizon.
        corner: Vec3::new(-0.71, -0.02, -1.0),
        step_x: Vec3::new(0.02, 0.0, 0.0),
        step_y: Vec3::new(0.0, -0.04, 0.0),
    };
    let rays: Vec<Ray> =
        (0..WIDTH * HEIGHT).map(|i| camera.get_ray(i % WIDTH, i / WIDTH)).collect();
    let mut hits = vec![None; rays.len()];
    tree.closest_hits_with(Exact, &mut Trace::new().coherent(), &rays, &mut hits);

    // Shadow rays start on the surface itself: there is no distance to choose, and nothing shadows
    // itself.
    let shadow_rays: Vec<Ray> = rays
        .iter()
        .zip(&hits)
        .map(|(ray, hit)| {
            let hit = hit.as_ref()?;
            let sphere = tree.list().spheres().get(hit.sphere as usize)?;
            surface(Exact, ray, hit.t, &sphere).spawn_ray(
                Exact,
                &sphere,
                Side::Outside,
                towards_light,
            )
        })
        .map(|ray| ray.unwrap_or(Ray::INACTIVE))
        .collect();
    let mut in_shadow = vec![false; rays.len()];
    tree.any_hits(Exact, &shadow_rays, &mut in_shadow);

    for row in 0..HEIGHT as usize {
        let columns = row * WIDTH as usize..(row + 1) * WIDTH as usize;
        let line: String = columns
            .map(|i| match hits[i] {
                None => ' ',
                Some(_) if in_shadow[i] => ':',
                Some(hit) if hit.sphere == 0 => '.',
                Some(_) => '#',
            })
            .collect();
        println!("{line}");
    }
}
