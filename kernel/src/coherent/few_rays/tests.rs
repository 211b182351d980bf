//! Which few rays go one by one, and how many leaves planes around them hold.

extern crate std;

use super::{ManyRays, WIDTH};
use crate::coherent::ray_order::tests::point;
use crate::proofs::climb::Random;
use crate::proofs::work::{Kind, Work};
use crate::{Exact, Intersect, Ray, SphereList, SphereTree, Trace, Vec3};
use std::vec::Vec;

/// Returns whether rays are packed: a ray that goes by itself clears no stack, begins no run, and is in no group.
fn are_packed(tree: &SphereTree, mut trace: Trace<'_>, rays: &[Ray]) -> bool {
    let mut hits = std::vec![None; rays.len()];
    let work = Work::of(|| tree.closest_hits_with(Exact, &mut trace, rays, &mut hits));
    for (ray, hit) in rays.iter().zip(&hits) {
        assert_eq!(*hit, tree.closest_hit(Exact, ray));
    }
    [Kind::RayRun, Kind::RayStacks, Kind::GroupPacket].iter().any(|&kind| work.count(kind) > 0)
}

/// A tree of so many spheres between -8 and 8.
fn tree(spheres: usize) -> SphereTree {
    let mut random = Random(61);
    let mut sphere = || (8.0 * point(&mut random), 0.25);
    SphereTree::new((0..spheres).map(|_| sphere()).collect::<SphereList>())
}

/// Diffuse rays, parallel rays that fill the tree, and a row of a camera's rays.
fn rays(count: usize) -> [Vec<Ray>; 3] {
    let mut random = Random(67);
    let mut points = || [8.0 * point(&mut random), point(&mut random)];
    let diffuse = (0..count).map(|_| points()).map(|[o, d]| Ray::new(o, d)).collect();
    let beam = (0..count).map(|_| points()[0]);
    let beam = beam.map(|o| Ray::new(Vec3 { z: -9.0, ..o }, Vec3::Z)).collect();
    let eye = Vec3::new(0.1, 0.2, -20.0);
    let row = (0..count).map(|x| Ray::new(eye, Vec3::new(0.004 * x as f32, 0.05, 1.0)));
    [diffuse, beam, row.collect()]
}

#[test]
fn few_rays_that_differ_go_one_by_one() {
    let (large, small, listed) = (tree(4000), tree(40), tree(4));
    for (tree, count, packed) in [
        (&large, 9, [false, false, true]),
        (&large, 16, [false, false, true]),
        (&large, 17, [false, false, true]),
        (&large, 64, [false, false, true]),
        (&large, 65, [true; 3]),
        (&small, 16, [false, false, true]),
        (&small, 33, [true; 3]),
        (&listed, 8, [false; 3]),
    ] {
        let are = rays(count).map(|rays| are_packed(tree, Trace::new(), &rays));
        assert_eq!(are, packed, "{count} rays");
    }
}

#[test]
fn a_tree_that_is_met_as_a_list_is_met_by_packets() {
    let tree = tree(4);
    let [diffuse, ..] = rays(16);
    let groups = |rays: &[Ray]| {
        let work = Work::of(|| tree.closest_hits(Exact, rays, &mut [None; 16]));
        work.count(Kind::ListGroup)
    };
    assert_eq!([groups(&diffuse[..8]), groups(&diffuse)], [0, 1]);
}

/// Returns whether `few_rays` says that rays along z differ whose first four span a square of this side at z = 0. All begin at one
/// point of depth `point`, or each above its own corner.
fn square_differs(tree: &SphereTree, count: usize, side: f32, point: Option<f32>) -> bool {
    let bvh = tree.bvh();
    let corner = |number: usize| {
        let (x, y) = (number / 5 % 2, number / 10 % 2);
        side * Vec3::new(x as f32 - 0.5, y as f32 - 0.5, 0.0)
    };
    let ray = |number: usize| {
        let to = corner(number % 16);
        let from = match point {
            Some(depth) => Vec3::new(0.0, 0.0, depth),
            None => to - 9.0 * Vec3::Z,
        };
        Ray::new(from, to - from)
    };
    let rays: Vec<Ray> = (0..count).map(ray).collect();
    let held = |asked: &_| super::leaves_held::<wide::f32x16>((), &bvh, asked);
    super::differ(&bvh, &ManyRays::Slice(&rays), 0..count, held)
}

#[test]
fn rays_differ_where_planes_around_them_hold_more_leaves_than_pays() {
    let (large, small) = (tree(4000), tree(40));
    // Where the answer turns, as a part of the side that a square would have if leaves were spread evenly over a cube of 16.5.
    for (tree, count, most, point, turns) in [
        (&large, 12, 4.0, None, [0.77, 0.9]),
        (&large, 16, 16.0 / 3.0, None, [0.78, 0.92]),
        (&large, 64, 7.0, None, [0.8, 0.93]),
        (&large, 16, 16.0 / 3.0, Some(-60.0), [0.87, 1.02]),
        (&large, 64, 7.0, Some(-60.0), [0.8, 0.94]),
        (&small, 16, 16.0 / 40.0, None, [0.95, 1.1]),
        (&small, 16, 16.0 / 40.0, Some(-60.0), [0.95, 1.1]),
    ] {
        let leaves = (tree.bvh().indices.len() / WIDTH) as f32;
        // Four of many rays span three fifths of what all span.
        let side = 0.6 * (16.5f32 * 16.5 * most / leaves).sqrt();
        let differ = turns.map(|part| square_differs(tree, count, part * side, point));
        assert_eq!(differ, [false, true], "{count} rays, {point:?}");
    }
}

#[test]
fn directions_differ_by_the_tangent_of_their_angle() {
    let tree = tree(4000);
    // Away from the tree, where planes hold nothing, and towards it from afar, where they hold all of it.
    let differ = |from: f32, tangent: f32| {
        let ray = |number: usize| {
            let (x, y) = (number / 5 % 2, number / 10 % 2);
            Ray::new(
                Vec3::Z * from,
                Vec3::new(x as f32, y as f32, 0.0) * (tangent / 2f32.sqrt()) + Vec3::Z,
            )
        };
        let rays: Vec<Ray> = (0..16).map(ray).collect();
        let held = |asked: &_| super::leaves_held::<wide::f32x16>((), &tree.bvh(), asked);
        super::differ(&tree.bvh(), &ManyRays::Slice(&rays), 0..16, held)
    };
    assert_eq!([0.48, 0.52].map(|tangent| differ(9.0, tangent)), [false, true], "a half");
    assert_eq!([30.0, 34.0].map(|part| differ(-500.0, 1.0 / part)), [true, false], "1/32");
}

#[test]
fn a_ground_hides_nothing() {
    let mut random = Random(73);
    let mut spheres: SphereList = (0..4000).map(|_| (8.0 * point(&mut random), 0.25)).collect();
    spheres.push((Vec3::new(0.0, -1010.0, 0.0), 1000.0));
    let tree = SphereTree::new(spheres);
    assert_eq!([0.5, 4.0].map(|side| square_differs(&tree, 16, side, None)), [false, true]);
}

#[test]
fn what_lies_behind_is_not_held() {
    let tree = tree(4000);
    let beside = |depth| square_differs(&tree, 16, 9.0, Some(depth));
    // Towards the tree, and away from it; across half of it.
    let away = |from: f32| {
        let bvh = tree.bvh();
        let ray = |x: f32, y: f32| Ray::new(Vec3::new(x, y, from), Vec3::Z);
        let asked = [ray(-4.0, -4.0), ray(4.0, -4.0), ray(-4.0, 4.0), ray(4.0, 4.0)];
        super::leaves_held::<wide::f32x16>((), &bvh, &asked)
    };
    assert!(beside(-40.0));
    assert_eq!(away(9.0), 0.0);
    assert!(away(-9.0) > 1.5 * away(4.0) && away(4.0) > 0.0);
}

#[test]
fn pixels_beside_each_other_are_packed_and_shuffled_ones_are_not() {
    let (tree, small) = (tree(4000), tree(40));
    let mut random = Random(79);
    let eye = Vec3::new(0.1, 0.2, -20.0);
    let pixel =
        |x: u64, y: u64| Ray::new(eye, Vec3::new(x as f32 - 128.0, y as f32 - 128.0, 320.0));
    let tile: Vec<Ray> = (0..64).map(|number| pixel(100 + number % 8, 100 + number / 8)).collect();
    let shuffled: Vec<Ray> = (0..64).map(|_| pixel(random.below(256), random.below(256))).collect();
    for count in [9, 16, 64] {
        let are = [&tile, &shuffled].map(|rays| are_packed(&tree, Trace::new(), &rays[..count]));
        assert_eq!(are, [true, false], "{count} rays");
    }
    for count in [9, 16, 32] {
        let are = [&tile, &shuffled].map(|rays| are_packed(&small, Trace::new(), &rays[..count]));
        assert_eq!(are, [true, false], "{count} rays, few spheres");
    }
}

#[test]
fn a_narrow_beam_and_the_end_of_a_row_are_packed() {
    let tree = tree(4000);
    let [_, mut beam, row] = rays(48);
    for ray in &mut beam {
        ray.origin *= Vec3::new(0.1, 0.1, 1.0);
    }
    assert!(are_packed(&tree, Trace::new(), &beam));
    // The first packet has the last pixels of a row and the first of the next.
    let mut rows = row.clone();
    for ray in &mut rows[..8] {
        ray.direction = Vec3::new(1.0, 0.1, 1.0);
    }
    assert!(are_packed(&tree, Trace::new(), &rows));
    assert!(!are_packed(&tree, Trace::new(), &rows[..16]));
}
