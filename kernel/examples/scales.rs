//! What a scene's units cost: nothing. Times of a scene multiplied by powers of two, and of rays of other lengths, over
//! those of the scene as it is.

use spherule_kernel::{
    Coherence, DepthList, Exact, HitPacket, Intersect, Ray, RayPacket, Sphere, SphereList,
    SphereTree, Trace, Vec3, Viewpoint,
};
use std::time::Instant;

/// Exponents of the scene, and of directions.
const SCALES: [(i32, i32); 7] =
    [(41, 0), (100, 0), (-60, 0), (-100, 0), (0, 51), (0, -51), (-100, -100)];
const WAYS: [&str; 4] = ["list", "depth list", "tree, packets", "tree, ray by ray"];

/// 2,000 spheres between -1 and 1, by the fractions of multiples of roots.
fn spheres(scale: f32) -> SphereList {
    let place = |i: usize, root: f32| 2.0 * (i as f32 * root).fract() - 1.0;
    let roots = [2.0_f32.sqrt(), 3.0_f32.sqrt(), 5.0_f32.sqrt()];
    let center = |i| Vec3::from_array(roots.map(|root| place(i, root))) * scale;
    (0..2000).map(|i| Sphere { center: center(i), radius: 0.04 * scale }).collect()
}

/// 64 by 64 rays of a camera, block by block.
fn rays(scale: f32, length: f32) -> Vec<RayPacket> {
    let origin = Vec3::new(0.3, 0.4, 4.0) * scale;
    let ray = |i: usize| {
        let (block, lane) = (i / 16, i % 16);
        let (x, y) = (block % 16 * 4 + lane % 4, block / 16 * 4 + lane / 4);
        let [u, v] = [x, y].map(|pixel| pixel as f32 / 63.0 - 0.5);
        Ray::new(origin, Vec3::new(0.7 * u - 0.08, 0.7 * v - 0.1, -1.0) * length)
    };
    let rays: Vec<Ray> = (0..64 * 64).map(ray).collect();
    rays.chunks(16).map(RayPacket::new).collect()
}

/// The seconds that each way takes.
fn times(list: &SphereList, tree: &SphereTree, rays: &[RayPacket]) -> [f64; 4] {
    let mut memory = vec![0.0; DepthList::needed(list.spheres().len())];
    let mut scratch = vec![0.0; DepthList::scratch(list.spheres().len())];
    let eye = Viewpoint::Origin(rays[0].ray(0).origin);
    let depth = DepthList::sort(list.spheres(), eye, &mut memory).expect("enough memory");
    let mut hits = vec![HitPacket::none(); rays.len()];
    WAYS.map(|way| {
        let coherence = if way == WAYS[3] { Coherence::Incoherent } else { Coherence::Coherent };
        let trace = &mut Trace { coherence, ..Trace::new().with_scratch(&mut scratch) };
        let start = Instant::now();
        match way {
            "list" => list.closest_hit_packets(Exact, trace, rays, &mut hits),
            "depth list" => depth.closest_hit_packets(Exact, trace, rays, &mut hits),
            _ => tree.closest_hit_packets(Exact, trace, rays, &mut hits),
        }
        start.elapsed().as_secs_f64()
    })
}

fn main() {
    let scene = |exponent: i32| {
        let list = spheres(2.0_f32.powi(exponent));
        (SphereTree::new(list.clone()), list)
    };
    let (plain_tree, plain_list) = scene(0);
    let plain_rays = rays(1.0, 1.0);
    println!("times over those of the scene as it is, medians of nine: {}", WAYS.join(", "));
    for (exponent, length) in SCALES {
        let (tree, list) = scene(exponent);
        let rays = rays(2.0_f32.powi(exponent), 2.0_f32.powi(length));
        let mut ratios = [const { Vec::new() }; 4];
        for _ in 0..9 {
            let plain = times(&plain_list, &plain_tree, &plain_rays);
            let scaled = times(&list, &tree, &rays);
            for (ratios, (scaled, plain)) in ratios.iter_mut().zip(scaled.iter().zip(plain)) {
                ratios.push(scaled / plain);
            }
        }
        let medians = ratios.map(|mut ratios| {
            ratios.sort_by(f64::total_cmp);
            format!("{:.2}", ratios[ratios.len() / 2])
        });
        println!("scene 2^{exponent}, |d| 2^{length}: {}", medians.join(", "));
    }
}
