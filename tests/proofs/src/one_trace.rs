//! A path tracer's calls by one trace: what the trace has learnt of bounces does not keep the camera's rays apart.

use super::climb::Random;
use super::scales::point;
use super::work::{Kind, Work};
use crate::bvh::owned::SphereTree;
use crate::{Exact, HitPacket, Intersect, Ray, RayPacket, Trace, Vec3};
use std::vec;
use std::vec::Vec;

/// Rays of a group.
const GROUP: usize = 64;

struct Calls {
    tree: SphereTree,
    random: Random,
}

impl Calls {
    fn new() -> Self {
        let mut random = Random(24);
        let spheres: Vec<_> = (0..3000).map(|_| (point(&mut random), 0.02)).collect();
        Self { tree: SphereTree::new(spheres), random }
    }

    /// `count` rays of a long lens, which go together.
    fn camera(&self, count: usize) -> Vec<Ray> {
        let direction = |i: usize| Vec3::new((i % 8) as f32, (i / 8) as f32, 4000.0);
        (0..count).map(|i| Ray::new(Vec3::new(0.1, 0.2, -3.0), direction(i))).collect()
    }

    /// Rays that look every way, which no planes fit.
    fn bounces(&mut self, count: usize) -> Vec<Ray> {
        let random = &mut self.random;
        (0..count).map(|_| Ray::new(point(random), point(random))).collect()
    }

    /// Rays that look the same way from everywhere, whose groups give up.
    fn beam(&mut self, count: usize) -> Vec<Ray> {
        let random = &mut self.random;
        (0..count).map(|_| Ray::new(point(random) - 2.0 * Vec3::Z, Vec3::Z)).collect()
    }

    /// How many nodes groups look into, for closest hits.
    fn groups(&self, trace: &mut Trace<'_>, rays: &[Ray]) -> u64 {
        let mut hits = vec![None; rays.len()];
        let work = Work::of(|| self.tree.closest_hits_with(Exact, trace, rays, &mut hits));
        work.count(Kind::GroupNode)
    }

    fn occluded(&self, trace: &mut Trace<'_>, rays: &[Ray]) {
        let mut occluded = vec![false; rays.len()];
        self.tree.any_hits_with(Exact, trace, rays, &mut occluded);
    }
}

#[test]
fn after_rays_that_fit_no_planes_a_call_begins_with_a_try() {
    let mut calls = Calls::new();
    for groups in [1, 3, 8] {
        let (camera, bounces) = (calls.camera(groups * GROUP), calls.bounces(4096));
        let fresh = calls.groups(&mut Trace::new(), &camera);
        let mut trace = Trace::new();
        assert_eq!(calls.groups(&mut trace, &bounces), 0, "bounces fit no planes");
        assert_eq!(calls.groups(&mut trace, &camera), fresh, "{groups} groups");
        assert!(fresh > 0);
    }
}

#[test]
fn after_groups_that_gave_up_eight_begin_with_a_try_and_fewer_wait() {
    let mut calls = Calls::new();
    let beam = calls.beam(16_384);
    for (groups, tries) in [(1, false), (7, false), (8, true)] {
        let camera = calls.camera(groups * GROUP);
        let fresh = calls.groups(&mut Trace::new(), &camera);
        let mut trace = Trace::new();
        let given_up = calls.groups(&mut trace, &beam);
        assert!(given_up > 0, "groups of a beam are tried");
        assert_eq!(calls.groups(&mut trace, &camera), if tries { fresh } else { 0 }, "{groups}");
    }
}

#[test]
fn any_hits_and_closest_hits_learn_apart() {
    let mut calls = Calls::new();
    let (beam, camera) = (calls.beam(16_384), calls.camera(GROUP));
    let mut trace = Trace::new();
    calls.occluded(&mut trace, &beam);
    let fresh = calls.groups(&mut Trace::new(), &camera);
    assert_eq!(calls.groups(&mut trace, &camera), fresh);
}

#[test]
fn few_rays_that_do_not_go_together_go_one_by_one() {
    let mut calls = Calls::new();
    for (count, stacks) in [(9, false), (16, false), (64, false), (65, false), (272, true)] {
        let rays = calls.bounces(count);
        let expected: Vec<_> = rays.iter().map(|ray| calls.tree.closest_hit(Exact, ray)).collect();
        for trace in [Trace::new(), Trace::new().coherent(), Trace::new().incoherent()] {
            let (mut trace, mut hits) = (trace, vec![None; count]);
            let tree = &calls.tree;
            let work = Work::of(|| tree.closest_hits_with(Exact, &mut trace, &rays, &mut hits));
            assert_eq!(work.count(Kind::RayStacks) > 0, stacks, "{count}, {:?}", trace.coherence);
            assert_eq!(hits, expected, "{count}");

            let packed = |rays: &[Ray]| rays.chunks(16).map(RayPacket::new).collect::<Vec<_>>();
            let (packets, others) = (packed(&rays), packed(&calls.beam(count)));
            let mut found = vec![HitPacket::none(); packets.len()];
            // Hits of other rays must not stay.
            let tree = &calls.tree;
            tree.closest_hit_packets(Exact, &mut Trace::new(), &others, &mut found);
            assert!(found.iter().flat_map(HitPacket::hits).any(|hit| hit.is_some()));
            let work = Work::of(|| {
                tree.closest_hit_packets(Exact, &mut trace, &packets, &mut found);
            });
            assert_eq!(work.count(Kind::RayStacks) > 0, stacks, "packets of {count}");
            let found: Vec<_> = found.iter().flat_map(HitPacket::hits).take(count).collect();
            assert_eq!(found, expected, "packets of {count}");

            let mut occluded = vec![u32::MAX; packets.len()];
            tree.any_hit_packets(Exact, &mut trace, &packets, &mut occluded);
            for (number, hit) in expected.iter().enumerate() {
                let is_hit = occluded[number / 16] >> (number % 16) & 1 == 1;
                assert_eq!(is_hit, hit.is_some(), "packets of {count}");
            }
        }
    }
}
