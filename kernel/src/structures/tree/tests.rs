//! Rays that groups leave over, and that go one by one: how many they are, and which of their
//! answers are kept.

extern crate std;

use crate::coherent::ray_order::tests::point;
use crate::proofs::climb::Random;
use crate::proofs::work::{Kind, Work};
use crate::{Exact, Intersect, Level, LevelName, Ray, SphereList, SphereTree, Trace, Vec3};
use core::array::from_fn;
use std::vec::Vec;

/// Rays that each go another way.
fn diffuse(count: usize) -> Vec<Ray> {
    let mut random = Random(67);
    (0..count).map(|_| Ray::new(point(&mut random), point(&mut random))).collect()
}

/// So many spheres beside each other.
fn apart(spheres: usize) -> SphereTree {
    let mut random = Random(61);
    SphereTree::new((0..spheres).map(|_| (point(&mut random), 0.03)).collect::<SphereList>())
}

/// Spheres around each other.
fn nested() -> SphereTree {
    let mut random = Random(83);
    let sphere = |number| (0.2 * point(&mut random), 0.02 + 0.0045 * number as f32);
    SphereTree::new((0..200).map(sphere).collect::<SphereList>())
}

/// Parallel rays that fill the nested spheres: a group of them hits much before it gives up.
fn beam() -> [Ray; 65] {
    let mut random = Random(89);
    let mut origin = || 0.9 * point(&mut random) + Vec3::new(-0.2, 0.6, 2.0);
    from_fn(|_| Ray::new(origin(), Vec3::new(0.1, -0.3, -1.0)))
}

/// Whether some rays, of closest or any hits, were traced as many rays are: not one by one.
fn ran(tree: &SphereTree, mut trace: Trace<'_>, rays: &[Ray], is_any: bool) -> bool {
    let mut hits = std::vec![None; rays.len()];
    let mut occluded = std::vec![false; rays.len()];
    let work = Work::of(|| match is_any {
        false => tree.closest_hits_with(Exact, &mut trace, rays, &mut hits),
        true => tree.any_hits_with(Exact, &mut trace, rays, &mut occluded),
    });
    for (number, ray) in rays.iter().enumerate() {
        match is_any {
            false => assert_eq!(hits[number], tree.closest_hit(Exact, ray)),
            true => assert_eq!(occluded[number], tree.any_hit(Exact, ray)),
        }
    }
    work.count(Kind::RayRun) > 0
}

#[test]
fn as_many_packets_go_one_by_one_as_are_few_at_the_level() {
    let diffuse = diffuse(1024);
    let eye = Vec3::new(0.1, 0.2, -20.0);
    let row: Vec<Ray> =
        (0..64).map(|x| Ray::new(eye, Vec3::new(1e-5 * x as f32, 0.0, 1.0))).collect();
    for (spheres, is_any, few) in [
        (40, false, [2; 3]),
        (40, true, [2; 3]),
        (4000, false, [16, 8, 8]),
        (4000, true, [64, 8, 8]),
        (80_000, false, [16, 8, 8]),
        (80_000, true, [16, 8, 8]),
    ] {
        let tree = apart(spheres);
        for (name, few) in LevelName::ALL.into_iter().zip(few) {
            let Some(level) = Level::named(name) else { continue };
            for (packets, are_many) in [(few, false), (few + 1, true)] {
                // No more packets of a call are noted.
                let Some(rays) = diffuse.get(..16 * packets) else { continue };
                let what = std::format!("{packets} of {spheres} spheres, {name:?}, any: {is_any}");
                let trace = || Trace::new().at(level);
                assert_eq!(ran(&tree, trace(), rays, is_any), are_many, "{what}");
                let incoherent = ran(&tree, trace().incoherent(), rays, is_any);
                assert_eq!(incoherent, are_many, "{what}, incoherent");
                // So many packets are left over from more.
                let mut rays = rays.to_vec();
                rays.splice(..0, row.iter().copied());
                assert_eq!(ran(&tree, trace(), &rays, is_any), are_many, "{what}, left");
            }
        }
    }
}

#[test]
fn any_hit_that_a_group_has_found_is_not_looked_for_again() {
    let (tree, rays) = (nested(), beam());
    let (mut alone, mut found) = ([false; 65], [false; 65]);
    let works = [
        Work::of(|| alone = from_fn(|number| tree.any_hit(Exact, &rays[number]))),
        Work::of(|| tree.any_hits(Exact, &rays, &mut found)),
    ];
    assert_eq!(found, alone);
    assert_eq!(works[1].count(Kind::RayRun), 0);
    let [nodes, left] = works.map(|work| work.count(Kind::RayNode));
    assert!(0 < left && 2 * left < nodes, "{left} nodes, {nodes} without");
}

#[test]
fn what_goes_one_by_one_at_first_is_a_stream_later() {
    // At the baseline all of a call's first rays go one by one.
    let Some(level) = Level::named(LevelName::Baseline) else { return };
    let (tree, rays) = (apart(1000), diffuse(1 << 14));
    let mut occluded = std::vec![false; rays.len()];
    let mut trace = Trace::new().at(level);
    let work = Work::of(|| tree.any_hits_with(Exact, &mut trace, &rays, &mut occluded));
    assert!(work.count(Kind::StreamNode) > 0);
    for (ray, is_hit) in rays.iter().zip(&occluded) {
        assert_eq!(*is_hit, tree.any_hit(Exact, ray));
    }
}
