//! Scenes and rays that could trip structures.

use spherule_kernel::{Ray, Sphere, Tier, Vec3};
use spherule_referee::aim::single;
use spherule_referee::random::Random;
use spherule_tests::variants::brute;

/// The eye of most pictures.
pub(super) const EYE: Vec3 = Vec3::new(0.3, 0.4, 4.0);

pub(super) fn point(random: &mut Random, size: f64) -> Vec3 {
    single([(); 3].map(|()| random.uniform(-size, size)))
}

pub(super) fn unit(random: &mut Random) -> Vec3 {
    single(random.unit())
}

/// Centres in [-1, 1]^3, some eight radii apart.
pub(super) fn uniform(count: usize) -> Vec<Sphere> {
    let mut random = Random::new(70, count as u64);
    let size = 0.5 * (count as f64).powf(-1.0 / 3.0);
    let sphere = |_| Sphere {
        center: point(&mut random, 1.0),
        radius: (size * random.uniform(0.5, 1.5)) as f32,
    };
    (0..count).map(sphere).collect()
}

/// A sphere, six spheres of half its size on it, and so on.
fn flake(depth: u32) -> Vec<Sphere> {
    let mut spheres = vec![Sphere { center: Vec3::ZERO, radius: 0.5 }];
    let mut from = 0;
    for _ in 0..depth {
        let parents = spheres[from..].to_vec();
        from = spheres.len();
        for parent in parents {
            for axis in 0..6 {
                let mut way = Vec3::ZERO;
                way[axis / 2] = if axis % 2 == 0 { 1.0 } else { -1.0 };
                let radius = parent.radius * 0.5;
                spheres.push(Sphere { center: parent.center + 3.0 * radius * way, radius });
            }
        }
    }
    spheres
}

/// Every scene, by name.
pub(super) fn all() -> Vec<(&'static str, Vec<Sphere>)> {
    let mut random = Random::new(81, 0);
    let here = Sphere { center: Vec3::new(0.1, 0.2, 0.3), radius: 0.25 };
    let shells = (0..200).map(|i| Sphere { radius: 1.2 - i as f32 / 200.0, ..here }).collect();
    let mut ground = uniform(1000);
    for sphere in &mut ground {
        sphere.radius *= (random.uniform(-3.0, 1.0) as f32).exp();
    }
    ground[500] = Sphere { center: Vec3::new(0.0, -1000.5, 0.0), radius: 1000.0 };
    // Ties: each sphere twice, at different places of the list.
    let mut twice = uniform(150);
    twice.extend(uniform(150).into_iter().rev());
    let points = uniform(500).into_iter().map(|sphere| Sphere { radius: 0.0, ..sphere }).collect();
    vec![
        ("one", vec![here]),
        ("64", uniform(64)),
        ("3000", uniform(3000)),
        ("flake", flake(4)),
        ("coincident", vec![here; 300]),
        ("shells", shells),
        ("ground", ground),
        ("twice", twice),
        ("points", points),
    ]
}

/// A picture of `size` x `size` pixels in tiles of 4 x 4, from `eye` towards `target`; the slopes at
/// its edges are -+`slope`.
pub(super) fn camera(eye: Vec3, target: Vec3, slope: f32, size: usize) -> Vec<Ray> {
    let way = (target - eye).normalize();
    let (right, up) = screen(way);
    let ray = |[x, y]: [f32; 2]| Ray::new(eye, way + slope * (x * right + y * up));
    pixels(size).map(ray).collect()
}

/// The same for parallel rays, from a square that reaches `reach` to each side.
pub(super) fn parallel(eye: Vec3, direction: Vec3, reach: f32, size: usize) -> Vec<Ray> {
    let (right, up) = screen(direction.normalize());
    let ray = |[x, y]: [f32; 2]| Ray::new(eye + reach * (x * right + y * up), direction);
    pixels(size).map(ray).collect()
}

fn screen(way: Vec3) -> (Vec3, Vec3) {
    let right = way.cross(Vec3::Y).normalize();
    (right, right.cross(way))
}

/// The middles of pixels, from -1 to 1.
fn pixels(size: usize) -> impl Iterator<Item = [f32; 2]> {
    let at = move |i: usize| 2.0 * (i as f32 + 0.5) / size as f32 - 1.0;
    let tiles = (0..size * size).step_by(16).map(move |i| (i / 16 % (size / 4), i / (4 * size)));
    tiles.flat_map(move |(x, y)| (0..16).map(move |i| [at(4 * x + i % 4), at(4 * y + i / 4)]))
}

/// Rays that have nothing in common.
pub(super) fn diffuse(count: usize) -> Vec<Ray> {
    let mut random = Random::new(71, 0);
    (0..count).map(|_| Ray::new(point(&mut random, 1.0), unit(&mut random))).collect()
}

/// Diffuse rays, and a picture from [`EYE`].
pub(super) fn mixed(count: usize, size: usize) -> Vec<Ray> {
    let picture = camera(EYE, Vec3::ZERO, 0.364, size);
    diffuse(count).into_iter().chain(picture).collect()
}

/// Makes intervals end at answers, and at their neighbours.
pub(super) fn end_at_answers(random: &mut Random, rays: &mut [Ray], spheres: &[Sphere]) {
    let hits = brute(Tier::Exact).closest(spheres, rays);
    for (ray, hit) in rays.iter_mut().zip(hits) {
        let Some(hit) = hit else { continue };
        let end = random.pick(&[hit.t, hit.t.next_up(), hit.t.next_down()]);
        let before = random.one_in(2) || end < 0.0 && random.one_in(2);
        if before { ray.t_max = end } else { ray.t_min = end }
    }
}
