//! When closest hits in a tree that is near are sorted: what a trial of some groups says.

extern crate std;

use crate::coherent::ray_order::FEWEST_IN_GROUPS;
use crate::coherent::ray_order::tests::{EYE, beam, point, rays};
use crate::proofs::climb::Random;
use crate::proofs::work::{Kind, Work};
use crate::{Exact, Intersect, Ray, SphereList, SphereTree, Vec3};
use std::vec;
use std::vec::Vec;

/// The work of closest hits, and that of any hits.
fn works(tree: &SphereTree, rays: &[Ray]) -> [Work; 2] {
    let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
    [
        Work::of(|| tree.closest_hits(Exact, rays, &mut hits)),
        Work::of(|| tree.any_hits(Exact, rays, &mut occluded)),
    ]
}

/// Few rays over many small spheres in clusters make no groups: closest hits are left as they come, any hits are sorted.
#[test]
fn where_groups_do_not_pay_closest_hits_are_left_in_their_order() {
    let mut random = Random(101);
    let mut tree = |clusters: usize, spheres: usize, radius: f32| {
        let middles: Vec<_> = (0..clusters).map(|_| point(&mut random)).collect();
        let sphere =
            |number: usize| (middles[number % clusters] + 0.08 * point(&mut random), radius);
        SphereTree::new((0..spheres).map(sphere).collect::<SphereList>())
    };
    let pixel = |random: &mut Random| {
        let at = point(random);
        Ray::new(EYE, Vec3::new(at.x / 2.0, at.y / 2.0, 1.5))
    };
    let rays = rays(FEWEST_IN_GROUPS + 300, pixel);
    for (tree, expected) in
        [(tree(60, 60_000, 0.002), [false, true]), (tree(1000, 1000, 0.05), [true; 2])]
    {
        let [closest, any] = works(&tree, &rays);
        let are_tried = [closest, any].map(|work| work.count(Kind::GroupFit) > 300);
        assert_eq!(are_tried, expected, "{} | {}", closest.per_ray(1), any.per_ray(1));
    }
}

/// A beam through a thin sheet of many small spheres: packets go through together, but do more work than their rays would do
/// apart. In a cube they do less, but not by much.
#[test]
fn where_groups_do_more_than_rays_apart_closest_hits_are_left_in_their_order() {
    let mut random = Random(103);
    let sphere = |number: usize| {
        let [x, y] = [number % 200, number / 200].map(|place| place as f32 / 100.0 - 1.0);
        (Vec3::new(x, y, 0.05 * point(&mut random).z), 0.006)
    };
    let sheet = SphereTree::new((0..40_000).map(sphere).collect::<SphereList>());
    let along = Vec3::new(1.0, 0.7, -1.0);
    let through = rays(45_000, |random| Ray::new(1.3 * point(random) - 3.0 * along, along));
    let mut random = Random(97);
    let cube =
        SphereTree::new((0..60_000).map(|_| (point(&mut random), 0.008)).collect::<SphereList>());
    for (tree, rays, is_sorted) in [(sheet, through, false), (cube, beam(30_000), true)] {
        let mut hits = vec![None; rays.len()];
        let work = Work::of(|| tree.closest_hits(Exact, &rays, &mut hits));
        // If rays are sorted, there is at least a group for every 64 of them.
        assert_eq!(work.count(Kind::GroupFit) > 400, is_sorted, "{}", work.count(Kind::GroupFit));
    }
}

/// By chance, more than an eighth of the groups on trial goes apart; the others do so little that it does not matter.
#[test]
fn one_more_group_in_vain_among_nested_spheres_does_not_leave_a_beam_unsorted() {
    let mut random = Random(107);
    let nested = |number: usize| (0.1 * point(&mut random), 0.05 + number as f32 / 2500.0);
    let tree = SphereTree::new((0..2000).map(nested).collect::<SphereList>());
    let along = Vec3::new(1.0, 0.7, -1.0);
    let rays = rays(70_000, |random| Ray::new(1.3 * point(random) - 3.0 * along, along));
    for count in (26_000..70_000).step_by(2000) {
        let mut hits = vec![None; count];
        let work = Work::of(|| tree.closest_hits(Exact, &rays[..count], &mut hits));
        assert!(work.count(Kind::GroupFit) > count as u64 / 200, "{count} rays");
    }
}

/// A long lens over clusters: groups do less than their rays apart, but not so much less that more than an eighth may go apart.
#[test]
fn groups_that_do_little_less_may_not_go_apart_as_often() {
    let mut random = Random(101);
    let middles: [Vec3; 60] = core::array::from_fn(|_| point(&mut random));
    let sphere = |number: usize| (middles[number % 60] + 0.05 * point(&mut random), 0.002);
    let tree = SphereTree::new((0..60_000).map(sphere).collect::<SphereList>());
    let eye = 20.0 * EYE;
    for count in [45_000, 50_000, 55_000] {
        let lens = rays(count, |random| {
            let pixel = 1.2 * point(random).with_z(0.0);
            Ray::new(eye, pixel - eye)
        });
        let mut hits = vec![None; count];
        let work = Work::of(|| tree.closest_hits(Exact, &lens, &mut hits));
        assert!(work.count(Kind::GroupFit) < count as u64 / 150, "{count} rays");
    }
}

/// Two cameras that take turns of a few rays: each has its groups, where these do much less than their rays apart, as among large
/// spheres; not in clusters of small ones, where a stream is faster.
#[test]
fn cameras_that_take_turns_are_told_apart_where_it_pays() {
    let mut random = Random(109);
    let large =
        SphereTree::new((0..1000).map(|_| (point(&mut random), 0.06)).collect::<SphereList>());
    let middles: [Vec3; 60] = core::array::from_fn(|_| point(&mut random));
    let sphere = |number: usize| (middles[number % 60] + 0.08 * point(&mut random), 0.002);
    let clusters = SphereTree::new((0..60_000).map(sphere).collect::<SphereList>());
    let by_turns = |count: usize, run: usize| {
        let width = (count as f32 / 2.0).sqrt();
        let ray = |number: usize| {
            let pixel = (number / (2 * run) * run + number % run) as f32;
            let [x, y] = [pixel % width, pixel / width].map(|place| place / width - 0.5);
            let along = Vec3::new(x, y, 1.5);
            let is_second = number / run % 2 == 1;
            if is_second { Ray::new(-EYE, -along) } else { Ray::new(EYE, along) }
        };
        (0..count).map(ray).collect::<Vec<_>>()
    };
    // The sampled rays of 50,000 are a multiple of three apart.
    for (count, run) in [(32_000, 1), (32_000, 2), (50_000, 3), (65_536, 1)] {
        let rays = by_turns(count, run);
        for (tree, is_sorted) in [(&large, true), (&clusters, false)] {
            let streams = works(tree, &rays).map(|work| work.count(Kind::StreamNode));
            assert_eq!(
                streams.map(|nodes| nodes == 0),
                [is_sorted; 2],
                "{count} {run} {streams:?}"
            );
        }
    }
}

/// What groups on trial were seen to do, and how fast the call was sorted, by that unsorted: 65,536 rays of two cameras by turns, AVX2.
#[test]
fn trials_tell_where_cameras_by_turns_gain() {
    for (packets_apart, efforts, speed) in [
        // 10,000 spheres from opposite sides, any and closest; from between them.
        (1, [13_561, 23_408], 1.4),
        (1, [13_893, 22_140], 1.4),
        (1, [10_454, 40_050], 2.7),
        // 100,000 from between them, any and closest; from opposite sides.
        (10, [23_556, 51_051], 1.7),
        (2, [32_254, 42_539], 1.8),
        (5, [47_796, 36_097], 0.74),
        // Chains, from between and from outside; the last by turns of three, any.
        (1, [19_566, 22_694], 1.35),
        (7, [20_831, 16_906], 0.74),
        (14, [12_503, 18_458], 0.75),
        // Clusters, and a sheet from outside and from within.
        (5, [6873, 9345], 0.68),
        (1, [2156, 6976], 0.83),
        (1, [6397, 12_449], 1.29),
        // Shells, closest and any.
        (1, [119_309, 144_511], 2.2),
        (5, [11_633, 35_803], 2.6),
    ] {
        let sorting = 4096;
        assert_eq!(super::turns_pay(packets_apart, efforts, sorting), speed > 1.0, "{efforts:?}");
    }
    assert!(!super::turns_pay(0, [0; 2], 0));
}

/// Shuffled, two cameras gain by being sorted whatever the spheres, so no groups are tried before: among small spheres, too, where a trial
/// would leave them to a stream.
#[test]
fn two_cameras_that_are_shuffled_are_sorted() {
    let mut random = Random(113);
    let mut tree = |count: usize, radius: f32| {
        SphereTree::new((0..count).map(|_| (point(&mut random), radius)).collect::<SphereList>())
    };
    let trees = [tree(1000, 0.06), tree(10_000, 0.02)];
    let mut is_second = false;
    let shuffled = rays(1 << 16, |random| {
        is_second = !is_second;
        let at = point(random);
        let along = Vec3::new(at.x / 2.0, at.y / 2.0, 1.5);
        if is_second { Ray::new(-EYE, -along) } else { Ray::new(EYE, along) }
    });
    for tree in trees {
        let streams = works(&tree, &shuffled).map(|work| work.count(Kind::StreamNode));
        assert_eq!(streams, [0; 2]);
    }
}
