//! Trees with nothing to spend, with all there may be, and of spheres that are the same.

extern crate std;

use super::build;
use crate::bvh::build::budget::nodes_needed;
use crate::bvh::build::join::InTurn;
use crate::bvh::leaf::{BEFORE, BEHIND, STEP, extent_of};
use crate::bvh::node::{BvhNode, DEPTH, LEAF, NO_CHILD, WIDTH};
use crate::bvh::tree::Bvh;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::proofs::climb::Random;
use glam::Vec3;
use std::vec;
use std::vec::Vec;

/// `count` spheres of many sizes, in clusters, between which cuts go.
fn clusters(random: &mut Random, count: usize) -> Vec<Sphere> {
    let mut place = |size: f32| {
        Vec3::from_array(
            [(); 3].map(|()| (random.below(1 << 24) as f32 / (1 << 24) as f32 - 0.5) * size),
        )
    };
    let mut middle = Vec3::ZERO;
    let mut spheres = Vec::new();
    for number in 0..count {
        if number % 17 == 0 {
            middle = place(100.0);
        }
        spheres.push(Sphere { center: middle + place(1.0), radius: place(0.2).x.abs() });
    }
    spheres
}

/// Builds a tree with so many nodes and places more than a tree in equal parts needs; asserts that its boxes hold
/// what is in them, and returns the indices that are in the tree, sorted, and how many nodes there are.
fn built(spheres: &[Sphere], nodes: usize, places: usize) -> (Vec<u32>, usize) {
    let column = |of: fn(&Sphere) -> f32| spheres.iter().map(of).collect::<Vec<f32>>();
    let [x, y, z] = [column(|s| s.center.x), column(|s| s.center.y), column(|s| s.center.z)];
    let radius = column(|s| s.radius);
    let list = Spheres::new(&x, &y, &z, &radius).expect("equal lengths");
    let count = spheres.len();
    let places = count.next_multiple_of(STEP) + BEFORE + BEHIND + STEP + places;
    let mut nodes = vec![BvhNode::EMPTY; nodes_needed(count) + nodes];
    let (mut places, mut indices) = (vec![[f32::NAN; 4]; places], vec![7; places]);
    let built = build(&InTurn, &list, &mut nodes, &mut places, &mut indices);
    let tree = Bvh::of(built, list, &nodes, &places, &indices);
    assert!(tree.depth() <= DEPTH);

    let mut found = Vec::new();
    let everywhere = ([f32::NEG_INFINITY; 3], [f32::INFINITY; 3]);
    let mut waiting = vec![(tree.root, everywhere)];
    while let Some((child, (low, high))) = waiting.pop() {
        if child == NO_CHILD {
            continue;
        }
        if child & LEAF != 0 {
            let (begin, lanes) = extent_of(child & !LEAF);
            let there = &tree.indices[begin..begin + lanes];
            let radii = &tree.numbers[4 * begin + 3 * lanes..][..lanes];
            for (&index, _) in there.iter().zip(radii).filter(|(_, radius)| !radius.is_nan()) {
                let sphere = tree.scale.scaled(&spheres[index as usize]).expect("in the tree");
                for axis in 0..3 {
                    assert!(low[axis] <= sphere.center[axis] - sphere.radius, "{index}");
                    assert!(sphere.center[axis] + sphere.radius <= high[axis], "{index}");
                }
                found.push(index);
            }
            continue;
        }
        let node = &tree.nodes[child as usize];
        for slot in 0..WIDTH {
            let corner = |of: &[[f32; WIDTH]; 3]| [of[0][slot], of[1][slot], of[2][slot]];
            waiting.push((node.child[slot], (corner(&node.low), corner(&node.high))));
        }
    }
    found.sort_unstable();
    (found, tree.nodes.len())
}

#[test]
fn what_is_needed_is_enough_and_more_is_used() {
    let mut random = Random(12);
    for count in [1, 4, 16, 17, 33, 64, 65, 255, 256, 257, 700, 4095, 4097, 20_000] {
        let spheres = clusters(&mut random, count);
        let all: Vec<u32> = (0..count as u32).collect();
        let (found, least) = built(&spheres, 0, 0);
        assert_eq!(found, all, "{count} spheres, nothing to spend");
        let mut used = 0;
        for (nodes, places) in [(0, count / 4), (1, 4), (count / 41, 8), (count / 41, count / 4)] {
            let (found, number) = built(&spheres, nodes, places);
            assert_eq!(found, all, "{count} spheres, {nodes} nodes and {places} places to spend");
            used = number;
        }
        // The control: the heuristic spends what is there.
        assert!(used > least || count <= 700, "{count} spheres: {used} nodes, {least}");
    }
}

/// Of each sphere that is there more than once, the lowest index stays, wherever the others are.
#[test]
fn the_same_sphere_is_kept_once() {
    let mut random = Random(13);
    let own = clusters(&mut random, 40);
    for times in [1, 2, 16, 40, 500] {
        let spheres: Vec<Sphere> = (0..times).flat_map(|_| own.iter().copied()).collect();
        let (found, _) = built(&spheres, spheres.len() / 41, spheres.len() / 4);
        assert!(
            own.iter().enumerate().all(|(index, _)| found.contains(&(index as u32))),
            "{times}"
        );
        // Some stand in two leaves that a cut in equal parts has made.
        assert!(found.len() <= 4 * own.len(), "{times}: {}", found.len());
    }
}

/// A path through a tree is longest where cuts in equal parts take turns with the heuristic's: equal parts of more
/// than 16^k spheres are of 16^k, and the heuristic's parts of n are n/8 at most.
#[test]
fn no_tree_is_deeper_than_stacks_are() {
    fn depth(count: usize) -> usize {
        if count <= WIDTH {
            return 0;
        }
        if count <= WIDTH * WIDTH {
            return 1;
        }
        let mut equal = WIDTH;
        while equal * WIDTH < count {
            equal *= WIDTH;
        }
        1 + depth(equal).max(depth(count.div_ceil(8).max(WIDTH * WIDTH)))
    }
    assert_eq!(depth(1 << 27), DEPTH);
}
