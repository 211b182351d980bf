//! All threads by one call: slices or columns of rays and hits are cut alike, and each piece is a call of its own.
//!
//! Prints how many times as fast all threads are as one, by the number of rays.

use rayon::prelude::*;
use spherule_kernel::{
    Exact, Hit, HitColumns, Intersect, Ray, RayColumns, SphereTree, Trace, Vec3,
};
use std::time::Instant;

/// Rays of a piece: enough that the beginning of a call costs nothing beside them, few enough that no thread waits long for
/// the last piece. (Two threads trace 262,144 diffuse rays 1.87 times as fast as one; in pieces of 4,096, each of which
/// learns anew how its rays are best traced, 1.47 times as fast. A tree does not sort fewer than 24,000 rays, so in smaller
/// pieces a shuffled camera runs at half of its speed.)
const PIECE: usize = 32_768;

/// The closest hit of every ray, on all threads. The tree is shared: nothing in it changes.
fn closest_hits(tree: &SphereTree, rays: &[Ray], hits: &mut [Option<Hit>]) {
    rays.par_chunks(PIECE)
        .zip(hits.par_chunks_mut(PIECE))
        .for_each(|(rays, hits)| tree.closest_hits(Exact, rays, hits));
}

/// The same for rays and hits in columns.
fn closest_hit_columns(tree: &SphereTree, rays: RayColumns<'_>, hits: HitColumns<'_>) {
    let HitColumns { t, sphere } = hits;
    t.par_chunks_mut(PIECE).zip(sphere.par_chunks_mut(PIECE)).enumerate().for_each(
        |(piece, (t, sphere))| {
            let rays = rays.part(piece * PIECE..(piece + 1) * PIECE);
            let hits = HitColumns { t, sphere };
            tree.closest_hit_columns(Exact, &mut Trace::new(), rays, hits);
        },
    );
}

/// Asserts that rays in columns have these hits.
fn check_columns(tree: &SphereTree, rays: &[Ray], expected: &[Option<Hit>]) {
    let column = |number: fn(&Ray) -> f32| -> Vec<f32> { rays.iter().map(number).collect() };
    let origin =
        [column(|ray| ray.origin.x), column(|ray| ray.origin.y), column(|ray| ray.origin.z)];
    let direction = [
        column(|ray| ray.direction.x),
        column(|ray| ray.direction.y),
        column(|ray| ray.direction.z),
    ];
    let (t_min, t_max) = (column(|ray| ray.t_min), column(|ray| ray.t_max));
    let rays = RayColumns {
        origin: origin.each_ref().map(Vec::as_slice),
        direction: direction.each_ref().map(Vec::as_slice),
        t_min: &t_min,
        t_max: &t_max,
    };
    let (mut t, mut sphere) = (vec![0.0; rays.len()], vec![0; rays.len()]);
    closest_hit_columns(tree, rays, HitColumns { t: &mut t, sphere: &mut sphere });
    let hits = HitColumns { t: &mut t, sphere: &mut sphere };
    assert!((0..expected.len()).all(|index| hits.hit(index) == expected[index]));
}

/// A number in [-1, 1): a linear congruence.
fn number(state: &mut u64) -> f32 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 40) as f32 / (1 << 23) as f32 - 1.0
}

fn point(state: &mut u64) -> Vec3 {
    Vec3::new(number(state), number(state), number(state))
}

/// The least of several times, in seconds.
fn seconds(mut work: impl FnMut()) -> f64 {
    let time = |_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    (0..5).map(time).fold(f64::INFINITY, f64::min)
}

fn main() {
    let mut state = 1;
    let tree = SphereTree::new(
        (0..10_000)
            .map(|_| (point(&mut state), 0.02 + 0.01 * number(&mut state)))
            .collect::<Vec<_>>(),
    );
    // A camera's rays, line by line and shuffled, and rays that have nothing in common.
    let side = 1 << 9;
    let pixel = |i: i32| (i % side - side / 2, side / 2 - i / side);
    let camera: Vec<Ray> = (0..side * side)
        .map(pixel)
        .map(|(x, y)| Vec3::new(x as f32, y as f32, -1.2 * side as f32))
        .map(|direction| Ray::new(Vec3::new(0.0, 0.0, 3.0), direction))
        .collect();
    let mut shuffled = camera.clone();
    for last in (1..shuffled.len()).rev() {
        let other = (number(&mut state) + 1.0) / 2.0 * last as f32;
        shuffled.swap(last, other as usize);
    }
    let diffuse: Vec<Ray> =
        camera.iter().map(|_| Ray::new(point(&mut state), point(&mut state))).collect();

    println!("{} threads", rayon::current_num_threads());
    for (kind, rays) in [("camera", camera), ("shuffled", shuffled), ("diffuse", diffuse)] {
        for count in [1 << 14, 1 << 15, 1 << 16, rays.len()] {
            let rays = &rays[..count];
            let (mut alone, mut together) = (vec![None; count], vec![None; count]);
            let one = seconds(|| tree.closest_hits(Exact, rays, &mut alone));
            let all = seconds(|| closest_hits(&tree, rays, &mut together));
            assert_eq!(alone, together);
            check_columns(&tree, rays, &alone);
            let rate = count as f64 / all / 1e6;
            println!(
                "{kind:8} {count:7} rays: {:.2} of one thread, {rate:.1} million a second",
                one / all
            );
        }
    }
}
