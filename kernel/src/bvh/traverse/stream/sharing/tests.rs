//! When rays go as a stream, and when it ends.

extern crate std;

mod samples;

use super::*;
use crate::bvh::{QueuedRay, StreamRay};
use crate::proofs::climb::Random;
use crate::proofs::work::{Kind, Work};
use crate::query::{AnyHit, ClosestHit};
use crate::{Exact, Intersect, Ray, RayPacket, SphereList, SphereTree, Trace, Vec3};
use std::vec;
use std::vec::Vec;

/// Spheres anywhere, and rays along an axis from anywhere.
fn scene(spheres: usize, rays: usize) -> (SphereTree, Vec<Ray>) {
    let mut random = Random(53);
    let mut point = || Vec3::from_array([(); 3].map(|()| random.below(1 << 20) as f32));
    let list: SphereList = (0..spheres).map(|_| (point(), 30_000.0)).collect();
    let mut ray = |_| Ray::new(Vec3 { z: -1e6, ..point() }, Vec3::new(0.1, 0.2, 1.0));
    (SphereTree::new(list), (0..rays).map(&mut ray).collect())
}

/// What a stream of so many rays has seen, which entered so many boxes, counted once for all and once for each.
fn seen(rays: u32, boxes: u32, entered: u32) -> Seen {
    Seen { streams: 1, rays, boxes, entered, ..Seen::default() }
}

/// What is learnt of a stream by closest hits, and by any hits after some rays by themselves.
fn after(tree: &Bvh<'_>, alone: Entered, stream: Seen) -> [Sharing; 2] {
    let (mut closest, mut any) = (Sharing::NOTHING, Sharing::NOTHING);
    closest.take::<ClosestHit>(tree, stream);
    any.take_alone(alone);
    any.take::<AnyHit>(tree, stream);
    [closest, any]
}

/// Does something with as much memory as a stream can use.
fn with_memory(work: impl FnOnce(&StreamMemory<'_>)) {
    let mut rays = vec![StreamRay::EMPTY; TOGETHER];
    let mut queues = vec![QueuedRay::EMPTY; 64 * TOGETHER];
    work(&StreamMemory::new(&mut rays, &mut queues).expect("enough"));
}

#[test]
fn rays_that_meet_go_as_a_stream_in_memory_that_a_call_takes() {
    for (spheres, rays, is_stream) in
        [(2000, 8192, true), (2000, 1000, false), (60, 8192, false), (3, 8192, false)]
    {
        let (tree, rays) = scene(spheres, rays);
        let mut hits = vec![None; rays.len()];
        let work = Work::of(|| tree.closest_hits(Exact, &rays, &mut hits));
        let by_streams = work.count(Kind::StreamNode);
        assert_eq!(by_streams > 0, is_stream, "{spheres} spheres, {by_streams}");
        let mut trace = Trace::new().incoherent();
        let work = Work::of(|| tree.closest_hits_with(Exact, &mut trace, &rays, &mut hits));
        assert_eq!(work.count(Kind::StreamNode), 0);
    }
}

/// In lent memory: for few rays, for many with few places in queues, and for as many as go down together.
#[test]
fn memory_that_is_too_little_to_gain_by_is_not_used() {
    let (tree, rays) = scene(2000, 1 << 14);
    let nodes = |places: usize, queues: usize| {
        let mut hits = vec![None; rays.len()];
        let mut of_rays = vec![StreamRay::EMPTY; places];
        let mut of_queues = vec![QueuedRay::EMPTY; queues];
        let memory = StreamMemory::new(&mut of_rays, &mut of_queues).expect("enough");
        let mut trace = Trace::new().incoherent().with_stream(memory);
        let work = Work::of(|| tree.closest_hits_with(Exact, &mut trace, &rays, &mut hits));
        work.count(Kind::StreamNode)
    };
    for [places, queues] in [[16, 272], [63, 4096], [1008, 1 << 16], [TOGETHER, 7 * TOGETHER]] {
        assert_eq!(nodes(places, queues), 0, "{places}");
    }
    // However many rays there is memory for, those that go down together are as many.
    let queues = 8 * TOGETHER + 256;
    let together = nodes(TOGETHER, queues);
    assert!(together > 0);
    assert_eq!(nodes(8 * TOGETHER, queues), together);
}

#[test]
fn few_that_meet_or_much_in_vain_end_it_and_all_is_tried_again() {
    let (tree, _) = scene(2000, 0);
    let tree = tree.bvh();
    assert!(tree.is_near());
    for (alone, boxes, expected) in [
        // If 1,024 rays are two at a box, eight times as many are five; if 3.4, they are 10.6.
        (8, 4096, [false; 2]),
        (8, 2400, [true; 2]),
        (7, 2400, [true, false]),
        (8, 2600, [true, false]),
        // More boxes by itself change nothing.
        (16, 2600, [true, false]),
        // Five of eight boxes are a large enough share, and four are not.
        (5, 1024, [true; 2]),
        (4, 1024, [true, false]),
    ] {
        let by_themselves = Entered { rays: 128, boxes: 128 * alone };
        let [closest, mut any] = after(&tree, by_themselves, seen(1024, boxes, 8192));
        let pay = [closest.may_pay::<ClosestHit>(&tree, 8192), any.may_pay::<AnyHit>(&tree, 8192)];
        assert_eq!(pay, expected, "{alone} {boxes}");
        any.pass_over(PASSED_OVER[0]);
        assert!(any.may_pay::<AnyHit>(&tree, 8192), "{alone} {boxes}");
    }
}

/// Of few rays a call too few meet, though of 8,192 enough would: that is not believed for ever.
#[test]
fn rays_that_are_too_few_for_a_stream_are_tried_again() {
    let (tree, _) = scene(2000, 0);
    let tree = tree.bvh();
    let mut sharing = Sharing::NOTHING;
    sharing.take::<ClosestHit>(&tree, seen(224, 1000, 1800));
    let pays = |sharing: &Sharing, rays| sharing.may_pay::<ClosestHit>(&tree, rays);
    assert!(pays(&sharing, 8192) && !pays(&sharing, 1792));
    sharing.pass_over(PASSED_OVER[0] - 1);
    assert!(!pays(&sharing, 1792));
    sharing.pass_over(1);
    assert!(pays(&sharing, 1792));
}

#[test]
fn where_rays_enter_many_boxes_fewer_at_each_are_enough() {
    let (tree, _) = scene(2000, 0);
    let tree = tree.bvh();
    // Rays at a box; boxes that each enters in a stream, and by itself for any hit.
    for (at_a_box, of_each, alone, expected) in [
        (3, 20, 20, [false; 2]),
        (4, 19, 19, [false; 2]),
        (4, 20, 20, [true; 2]),
        (4, 20, 19, [true, false]),
    ] {
        let entered = 8192 * of_each;
        let by_itself = Entered { rays: 1, boxes: alone };
        let [closest, any] = after(&tree, by_itself, seen(8192, entered / at_a_box, entered));
        let pays =
            [closest.may_pay::<ClosestHit>(&tree, 8192), any.is_enough::<AnyHit>(&tree, 8192)];
        assert_eq!(pays, expected, "{at_a_box} {of_each} {alone}");
    }
}

#[test]
fn what_other_rays_entered_by_themselves_condemns_no_stream() {
    let (tree, _) = scene(2000, 0);
    let tree = tree.bvh();
    let stream = |of_each: u32| seen(1024, 1024 * of_each / 20, 1024 * of_each);
    // Rays that enter two boxes; then streams of rays that enter as many, and of others.
    for (of_each, counted_anew) in [(2, false), (4, true), (1, true)] {
        let mut sharing = Sharing::NOTHING;
        sharing.take_alone(Entered { rays: 1024, boxes: 2048 });
        sharing.believed = BELIEVED;
        sharing.take::<AnyHit>(&tree, stream(2));
        assert!(sharing.believed > 0 && sharing.may_pay::<AnyHit>(&tree, 8192));
        sharing.take::<AnyHit>(&tree, stream(of_each));
        assert_eq!(sharing.believed == 0, counted_anew, "{of_each}");
        assert!(sharing.may_pay::<AnyHit>(&tree, 8192), "{of_each}");
    }
    // A count of rays that came right before the stream does condemn it.
    let mut sharing = Sharing::NOTHING;
    sharing.take_alone(Entered { rays: 1024, boxes: 2048 });
    sharing.take::<AnyHit>(&tree, stream(4));
    assert!(!sharing.may_pay::<AnyHit>(&tree, 8192));
}

#[test]
fn of_bunches_that_have_nothing_in_common_a_sample_goes_as_a_stream() {
    let (tree, _) = scene(100_000, 0);
    let mut random = Random(67);
    let mut point = || Vec3::from_array([(); 3].map(|()| random.below(1 << 20) as f32));
    // Two scan lines of a picture of 32 by 32 pixels, then 64 rays from anywhere to anywhere.
    let eye = Vec3::new(5e5, 5e5, -1.5e6);
    let pixel = |at: u32| Vec3::new((at % 32) as f32 * 32_768.0, (at / 32) as f32 * 32_768.0, 0.0);
    let in_turns = |at: u32| {
        let (turn, place) = (at / 128, at % 128);
        let from = point();
        let anywhere = Ray::new(from, point() - from);
        if place < 64 { Ray::new(eye, pixel(64 * turn + place) - eye) } else { anywhere }
    };
    let rays: Vec<Ray> = (0..2048).map(in_turns).collect();
    let mut hits = vec![None; rays.len()];
    let work = Work::of(|| tree.closest_hits(Exact, &rays, &mut hits));
    // A ray enters some 12 boxes, and an eighth of the rays are the sample.
    let in_streams = work.count(Kind::StreamNode);
    assert!(in_streams > 0 && in_streams < 256 * 12, "{in_streams}");
}

#[test]
fn short_runs_are_bunches_and_scattered_rays_are_not() {
    // As counted: a camera's rays and diffuse ones by turns, two cameras, rays to a light.
    for ([leaves, at_leaves, together], expected) in
        [([479, 719, 209], true), ([156, 737, 477], true), ([430, 782, 52], false)]
    {
        let seen = Seen { leaves, at_leaves, together, ..Seen::default() };
        assert_eq!(seen.is_in_bunches(), expected, "{leaves}");
    }
}

#[test]
fn few_rays_and_those_that_all_enter_the_same_few_boxes_tell_nothing() {
    let (tree, _) = scene(2000, 0);
    let tree = tree.bvh();
    let packets = vec![RayPacket::<[f32; 16]>::inactive(); 512];
    with_memory(|memory| {
        for (rays, boxes, expected) in
            [(1024, 4, 1024), (1024, 40, TOGETHER), (63, 40, 1024), (64, 40, TOGETHER)]
        {
            let mut sharing = Sharing::NOTHING;
            sharing.take::<ClosestHit>(&tree, seen(rays, boxes, 1024 * 2));
            let (_, next) = sharing.next::<_, ClosestHit>(&tree, memory, &packets);
            assert_eq!(next, expected, "{rays} {boxes}");
        }
    });
}

#[test]
fn in_a_tree_that_is_far_a_smaller_part_is_good() {
    // Trees of some 0.6 MB and 1.2 MB.
    for (spheres, is_near, enough) in [(30_000, true, 5), (60_000, false, 3)] {
        let (tree, _) = scene(spheres, 0);
        let tree = tree.bvh();
        assert_eq!(tree.is_near(), is_near, "{}", tree.bytes());
        for (alone, pays) in [(enough, true), (enough - 1, false)] {
            let by_themselves = Entered { rays: 128, boxes: 128 * alone };
            let [_, any] = after(&tree, by_themselves, seen(1024, 1024, 8192));
            assert_eq!(any.may_pay::<AnyHit>(&tree, 8192), pays, "{spheres} {alone}");
        }
        // Fewer rays at a box are enough there, too.
        for (at_a_box, pays) in [(6.9, [false; 2]), (7.1, [true, false]), (10.2, [true; 2])] {
            let boxes = (65_536.0 / at_a_box) as u32;
            let by_itself = Entered { rays: 1, boxes: 8 };
            let [_, any] = after(&tree, by_itself, seen(8192, boxes, 65_536));
            let pays = pays[usize::from(is_near)];
            assert_eq!(any.may_pay::<AnyHit>(&tree, 8192), pays, "{spheres} {at_a_box}");
        }
    }
}

#[test]
fn rays_that_stop_at_the_first_leaf_go_by_themselves() {
    let mut random = Random(59);
    let mut point = || Vec3::from_array([(); 3].map(|()| random.below(1 << 20) as f32 - 5e5));
    // One around the other, and rays from all around.
    let list: SphereList = (1..2000).map(|size| (Vec3::ZERO, 100.0 * size as f32)).collect();
    let tree = SphereTree::new(list);
    let rays: Vec<_> = (0..1 << 14).map(|_| point().normalize()).collect();
    let rays: Vec<_> =
        rays.iter().map(|&from| Ray::new(1e6 * from, point() - 1e6 * from)).collect();
    let mut any = vec![false; rays.len()];
    let work = Work::of(|| tree.any_hits(Exact, &rays, &mut any));
    let in_streams = work.count(Kind::StreamNode);
    assert!(in_streams > 0 && in_streams < 1 << 16, "{in_streams}");
}

/// As tests of streams need it.
#[test]
fn few_rays_go_as_a_stream_in_memory_that_is_lent_for_all() {
    let (tree, few) = scene(2000, 200);
    let mut rays = vec![StreamRay::EMPTY; 200];
    let mut queues = vec![QueuedRay::EMPTY; StreamMemory::queues_needed(200)];
    let memory = StreamMemory::new(&mut rays, &mut queues).expect("enough").everywhere();
    let mut trace = Trace::new().incoherent().with_stream(memory);
    let mut hits = vec![None; few.len()];
    let work = Work::of(|| tree.closest_hits_with(Exact, &mut trace, &few, &mut hits));
    assert!(work.count(Kind::StreamNode) > 0);
}

#[test]
fn of_the_fewest_rays_that_are_a_stream_any_hits_go_as_one_too() {
    let (tree, rays) = scene(2000, LEAST_RAYS);
    let mut occluded = vec![false; rays.len()];
    let work = Work::of(|| tree.any_hits(Exact, &rays, &mut occluded));
    assert!(work.count(Kind::StreamNode) > 0);
}
