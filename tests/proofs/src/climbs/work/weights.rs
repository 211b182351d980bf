//! The work that groups are held to, in the mean of many short calls: a changed weight is seen here, even where the worst case does not
//! need it.

use super::input::{Input, RayInput, Scene, SceneInput};
use super::{PLAIN, UNIFORM, orders, times_of};
use std::vec::Vec;

/// Apart, overlapping, around each other, and in a sheet.
const SCENES: [SceneInput; 4] = [
    UNIFORM,
    SceneInput { radius: 0.06, ..UNIFORM },
    SceneInput { scene: Scene::Shells, spheres: 400, radius: 0.1, ..UNIFORM },
    SceneInput { scene: Scene::Sheet, radius: 0.02, ..UNIFORM },
];

/// Work over that of ray by ray: the geometric mean over scenes and orders.
fn mean(scenes: &[SceneInput], count: usize, any: bool) -> f64 {
    let mut logarithms = Vec::new();
    for &scene in scenes {
        for rays in orders() {
            let rays = RayInput { count, ..rays };
            logarithms.push(times_of(&Input { scene, rays, any }, PLAIN).ln());
        }
    }
    (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exp()
}

/// Each call has a trace of its own. A lower mean is worth publishing, and a higher one is a loss.
#[test]
fn calls_take_what_is_published_in_the_mean() {
    let few = [SceneInput { spheres: 64, radius: 0.1, ..UNIFORM }];
    let table: [(&str, &[SceneInput], usize, [f64; 2]); 3] = [
        // Four groups. (Closest hits with half the weight of a ray's roots: 0.8625; with twice that weight: 0.8583; with twice the weight
        // of a ray: 0.8577; with groups that may do no more than those of any hit: 0.8856.)
        ("short calls", &SCENES, 256, [0.8573, 0.8580]),
        // Over few spheres, where trying a group in vain takes as much work as its rays do. (With one group passed over after the first in
        // vain, instead of three: 1.0612. With six: 1.0036, but a scanner, whose groups pay, loses.)
        ("short calls over few spheres", &few, 512, [1.0069, 0.9325]),
        // 32 groups, most of which follow a group that has paid.
        ("long calls", &SCENES, 2048, [0.7187, 0.7336]),
    ];
    for (calls, scenes, count, published) in table {
        for (any, published) in [false, true].into_iter().zip(published) {
            let found = mean(scenes, count, any);
            let off = (found - published).abs();
            assert!(off < 0.0002, "{calls}: {found:.4} times the work, any: {any}");
        }
    }
}
