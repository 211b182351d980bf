//! When rays of one viewpoint go through a list by depth, and when they return to the tree.

extern crate std;

use super::{FEWEST, MANY, is_worth_sorting};
use crate::coherent::ray_order::tests::{point, rays};
use crate::proofs::climb::Random;
use crate::proofs::work::{Kind, Work};
use crate::{
    Coherence, DepthList, Exact, Fast, Hit, HitPacket, Intersect, Level, LevelName, Ray, RayPacket,
    SphereList, SphereTree, Trace, Vec3,
};
use std::vec;
use std::vec::Vec;

/// Where all rays start: inside many of the spheres below.
const INSIDE: Vec3 = Vec3::new(0.11, 0.07, -0.13);

/// Spheres one within the other, not quite around one point.
fn nested(count: usize) -> SphereTree {
    let mut random = Random(113);
    let sphere = |number: usize| {
        let radius = (number + 1) as f32 / count as f32;
        (0.1 * radius * point(&mut random), radius)
    };
    SphereTree::new((0..count).map(sphere).collect::<SphereList>())
}

/// Spheres of which none contains another.
fn apart(count: usize) -> SphereTree {
    let mut random = Random(127);
    let radius = 0.5 / (count as f32).cbrt();
    SphereTree::new((0..count).map(|_| (point(&mut random), radius)).collect::<SphereList>())
}

/// In all directions, in no order.
fn all_around(count: usize) -> Vec<Ray> {
    rays(count, |random| Ray::new(INSIDE, point(random)))
}

/// What each ray hits by itself, which is what it must hit in any call.
fn one_by_one(tree: &SphereTree, rays: &[Ray]) -> Vec<Option<Hit>> {
    rays.iter().map(|ray| tree.closest_hit(Exact, ray)).collect()
}

/// Answers the rays as a caller says who says nothing, and checks the answers.
fn checked(tree: &SphereTree, rays: &[Ray]) -> Work {
    let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
    let work = Work::of(|| tree.closest_hits(Exact, rays, &mut hits));
    tree.any_hits(Exact, rays, &mut occluded);
    let expected = one_by_one(tree, rays);
    assert!(hits == expected);
    // Packets of the caller's do no more.
    let packets: Vec<_> = rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect();
    let mut in_packets = vec![HitPacket::none(); packets.len()];
    let trace = &mut Trace::new();
    let of_packets = Work::of(|| tree.closest_hit_packets(Exact, trace, &packets, &mut in_packets));
    let lanes =
        in_packets.iter().flat_map(|packet| (0..RayPacket::COUNT).map(|lane| packet.hit(lane)));
    assert!(lanes.take(rays.len()).eq(expected.iter().copied()));
    let [boxes, of_packets] = [work, of_packets].map(|work| boxes_and_packets(work, rays.len())[0]);
    assert!(of_packets < 1.2 * boxes + 8.0, "{boxes} boxes a ray, {of_packets} in packets");
    assert!(occluded.iter().zip(&expected).all(|(occluded, hit)| *occluded == hit.is_some()));
    work
}

/// Boxes that a ray entered, and packets that are of a list or of a group.
fn boxes_and_packets(work: Work, rays: usize) -> [f64; 2] {
    let boxes =
        work.count(Kind::RayNode) + work.count(Kind::RayLeaf) + work.count(Kind::StreamLeaf);
    [boxes, work.count(Kind::GroupPacket)].map(|count| count as f64 / rays as f64)
}

#[test]
fn among_nested_spheres_rays_of_one_point_enter_few_boxes() {
    let tree = nested(900);
    let rays = all_around(MANY + 2000);
    let [boxes, _] = boxes_and_packets(checked(&tree, &rays), rays.len());
    let said = |coherence| {
        let (mut trace, mut hits) = (Trace::new().with(coherence), vec![None; rays.len()]);
        let work = Work::of(|| tree.closest_hits_with(Exact, &mut trace, &rays, &mut hits));
        boxes_and_packets(work, rays.len())[0]
    };
    assert!(boxes < 3.0, "{boxes} boxes a ray");
    // So it is if they are said to run the same way; not if they are said not to.
    assert!(said(Coherence::Coherent) < 3.0 && said(Coherence::Incoherent) > 40.0);
}

#[test]
fn where_boxes_are_few_nothing_is_sorted() {
    let tree = apart(3000);
    assert_eq!(checked(&tree, &all_around(MANY + 2000)).count(Kind::SphereSorted), 0);
}

/// The rays that are counted go by themselves differently at each level.
#[test]
fn at_every_level_rays_inside_nested_spheres_enter_few_boxes() {
    let (tree, rays) = (nested(900), all_around(MANY + 2000));
    let expected = one_by_one(&tree, &rays);
    for level in LevelName::ALL.into_iter().filter_map(Level::named) {
        let (mut trace, mut hits) = (Trace::new().at(level), vec![None; rays.len()]);
        let work = Work::of(|| tree.closest_hits_with(Exact, &mut trace, &rays, &mut hits));
        let [boxes, _] = boxes_and_packets(work, rays.len());
        assert!(boxes < 3.0 && hits == expected, "{level:?}: {boxes} boxes a ray");
    }
}

/// The first rays meet nested spheres, the others begin behind them, where the tree does less than the list: that is found.
#[test]
fn what_the_first_rays_do_is_not_believed_for_long() {
    let mut random = Random(131);
    let mut spheres: Vec<_> = (0..1000).map(|_| (8.0 * point(&mut random), 0.01)).collect();
    spheres.extend((0..300).map(|number| (INSIDE, 0.2 + number as f32 / 1000.0)));
    let tree = SphereTree::new(spheres.into_iter().collect::<SphereList>());
    let ray = |number: usize| {
        let [y, z] = [number % 256, number / 256 % 256].map(|pixel| pixel as f32 / 512.0);
        let t_min = if number < 600 { 0.0 } else { 2.0 };
        Ray { t_min, ..Ray::new(INSIDE, Vec3::new(1.0, y, z)) }
    };
    let rays: Vec<_> = (0..200_000).map(ray).collect();
    let [all, later] = [&rays[..], &rays[600..]].map(|rays| checked(&tree, rays).units());
    assert!(all < 2.0 * later, "{all} units, {later} without the first rays");
}

/// What calls have seen (AVX2), and whether sorting paid there.
#[test]
fn trials_tell_where_sorting_pays() {
    for (scene, spheres, left, in_tree, passed, pays) in [
        ("64 apart, a scanner", 64, 65_280, 3.50, 52.2, true),
        ("200 apart, scan lines", 200, 65_280, 3.22, 135.0, false),
        ("2,000 apart, shuffled", 2000, 65_280, 88.6, 669.0, false),
        ("2,000 apart, all around", 2000, 65_280, 55.3, 658.0, false),
        ("10,000 that overlap, scan lines", 10_000, 65_280, 157.0, 0.0, true),
        ("10,000 that overlap, shuffled, any hits", 10_000, 65_280, 65.7, f32::INFINITY, false),
        ("10,000 that overlap, shuffled, few rays", 10_000, 4744, 322.0, 0.0, false),
        ("30 nests, rings of rays from their edge", 9000, 65_280, 132.0, 1209.0, false),
        ("4,000 nested, all around, few rays", 4000, 1044, 1474.0, 2.0, true),
    ] {
        assert_eq!(is_worth_sorting(spheres, left, in_tree, || passed), pays, "{scene}");
    }
}

/// How many spheres a call sorts.
fn sorted(tree: &SphereTree, rays: &[Ray]) -> u64 {
    let mut hits = vec![None; rays.len()];
    Work::of(|| tree.closest_hits(Exact, rays, &mut hits)).count(Kind::SphereSorted)
}

/// As `Intersect::closest_hits` says.
#[test]
fn spheres_are_sorted_from_1280_rays_on() {
    let (tree, rays) = (nested(900), all_around(MANY));
    assert_eq!([1279, 1280].map(|count| sorted(&tree, &rays[..count])), [0, 900]);
    let packets: Vec<_> = rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect();
    let of_packets = |count: usize| {
        let (trace, mut hits) = (&mut Trace::new(), vec![HitPacket::none(); count]);
        let work =
            Work::of(|| tree.closest_hit_packets(Exact, trace, &packets[..count], &mut hits));
        work.count(Kind::SphereSorted)
    };
    assert_eq!([511, 512].map(of_packets), [0, 900]);
}

/// The memory is bounded.
#[test]
fn up_to_a_hundred_thousand_spheres_are_sorted() {
    let rays = all_around(1300);
    let of = |count| sorted(&nested(count), &rays);
    assert_eq!([100_000, 100_001].map(of), [100_000, 0]);
    let bytes = 4 * DepthList::needed(100_000);
    assert!(bytes < 2_410_000, "{bytes}");
}

/// No packet fits a frustum, and the list is too short to be gone through without: it gains nothing.
#[test]
fn packets_that_a_list_leaves_to_the_tree_return_to_it() {
    let rays = all_around(8 * MANY);
    let work = checked(&apart(64), &rays);
    let [_, packets] = boxes_and_packets(work, rays.len());
    assert_eq!(work.count(Kind::SphereSorted), 64);
    assert!(packets < 0.02, "{packets} packets a ray");
}

/// Shuffled, the rays of a camera do much in the tree; sorted, they do less than in a list.
#[test]
fn rays_that_gain_more_by_being_sorted_themselves_are() {
    let tree = apart(200);
    let eye = Vec3::new(-0.8, 0.05, 0.09);
    let rays = rays(40_000, |random| {
        let pixel = point(random) / 2.0;
        Ray::new(eye, Vec3::new(1.0, pixel.y, pixel.z))
    });
    let work = checked(&tree, &rays);
    assert_eq!(work.count(Kind::SphereSorted), 200);
    let nodes = work.count(Kind::GroupNode);
    assert!(nodes > rays.len() as u64 / 100, "{nodes} nodes by groups");
}

/// Too few rays, for the call or for the spheres, and tiers whose false hits differ.
#[test]
fn others_go_down_the_tree() {
    let (tree, rays) = (nested(900), all_around(MANY + 2000));
    let boxes = |rays: &[Ray]| {
        let mut hits = vec![None; rays.len()];
        let work = Work::of(|| tree.closest_hits(Exact, rays, &mut hits));
        boxes_and_packets(work, rays.len())[0]
    };
    assert!(boxes(&rays[..FEWEST - 1]) > 40.0);
    let (mut hits, mut one) = (vec![None; rays.len()], vec![None; rays.len()]);
    let work = Work::of(|| tree.closest_hits(Fast, &rays, &mut hits));
    assert!(boxes_and_packets(work, rays.len())[0] > 40.0);
    for (ray, hit) in rays.iter().zip(&mut one) {
        *hit = tree.closest_hit(Fast, ray);
    }
    assert!(hits == one);
    // So far away that no bound covers the viewpoint.
    let far: Vec<_> = rays.iter().map(|ray| Ray { origin: 1e30 * Vec3::X, ..*ray }).collect();
    assert_eq!(checked(&tree, &far).count(Kind::ListGroup), 0);
}

/// Rays of other points, each at another place of its packet; dead ones; rays that start past all hits nearby, and before their origin.
#[test]
fn strangers_are_answered_as_they_are_alone() {
    let tree = nested(400);
    let mut rays = all_around(MANY + 3000);
    for (number, ray) in rays.iter_mut().enumerate().skip(1024) {
        match number % 977 {
            0 => ray.origin += 0.3 * Vec3::X,
            20 => ray.direction = Vec3::ZERO,
            40 => ray.origin.y = f32::NAN,
            60 => ray.t_min = 0.2,
            70 => ray.t_min = -3.0,
            80 => ray.t_max = 1e-3,
            90 => ray.direction *= 1e30,
            _ => {}
        }
    }
    let [boxes, packets] = boxes_and_packets(checked(&tree, &rays), rays.len());
    assert!(boxes < 40.0 && packets > 0.05, "{boxes} boxes, {packets} packets a ray");
}

/// One scan after the other in a call: each has a list of its own.
#[test]
fn rays_of_a_second_point_have_a_list_of_their_own() {
    let tree = nested(900);
    let mut rays = all_around(4 * MANY);
    let [second, third] = [3, 6].map(|halves| halves * MANY / 2);
    for ray in &mut rays[second..] {
        ray.origin = Vec3::new(-0.2, 0.3, 0.1);
    }
    for (number, ray) in rays[third..].iter_mut().enumerate() {
        ray.origin.x += number as f32 / MANY as f32;
    }
    let boxes = |rays: &[Ray]| boxes_and_packets(checked(&tree, rays), 1)[0];
    let [all, of_third] = [&rays[..], &rays[third..]].map(boxes);
    assert!(all - of_third < 8.0 * third as f64, "{} boxes in the two scans", all - of_third);
}
