//! The work of trying groups and packets in vain.

use super::input::{Input, RayInput, SceneInput, packed};
use super::{IN_NO_ORDER, PLAIN, Said, UNIFORM, both, call, in_tiles, orders, times, times_of};
use crate::proofs::climb::Random;
use crate::proofs::work::Work;
use crate::query::ClosestHit;
use crate::{Bvh, RayPacket, SphereTree, Trace, Vec3};
use std::vec::Vec;

/// A camera's tiles, and as many rays of a beam as wide as the scene, in packets.
fn narrow_and_wide() -> [Vec<RayPacket>; 2] {
    let [lines, ..] = orders();
    let narrow = in_tiles(&Input { scene: UNIFORM, rays: lines, any: false }.rays());
    let beam = RayInput { count: narrow.len(), ..IN_NO_ORDER };
    [packed(&narrow), Input { scene: UNIFORM, rays: beam, any: false }.packets()]
}

/// The work of one call for packets of two sources, over that of one call for each source in the way that is best for
/// it: the plain one, and ray by ray.
fn of_the_best(
    bvh: &Bvh<'_>,
    [narrow, wide]: [&[RayPacket]; 2],
    are_wide: impl Fn(usize) -> bool,
) -> f64 {
    let at = |place: usize| if are_wide(place) { wide[place] } else { narrow[place] };
    let of = |wanted: bool| {
        let chosen = (0..narrow.len()).filter(|&place| are_wide(place) == wanted);
        chosen.map(at).collect::<Vec<_>>()
    };
    let mixed: Vec<_> = (0..narrow.len()).map(at).collect();
    let (together, _) = call::<ClosestHit>(bvh, &mixed, PLAIN);
    let each = Work::of(|| {
        call::<ClosestHit>(bvh, &of(false), PLAIN);
        call::<ClosestHit>(bvh, &of(true), Trace::incoherent);
    });
    times(mixed.len(), [together, each])
}

/// Packets as of a scanner's fan, part of which looks where spheres are dense, and as of two sources by turns. (Before the trace learnt for
/// each place of a group: 1.5 times.)
#[test]
fn packets_that_never_pay_are_passed_over_among_those_that_do() {
    let tree = UNIFORM.tree();
    let [narrow, wide] = narrow_and_wide();
    // Scattered, so that four together are too wide.
    let narrow: Vec<_> = (0..narrow.len()).map(|i| narrow[i * 389 % narrow.len()]).collect();
    for places in [0b0001_u32, 0b1000, 0b0101, 0b1010, 0b0111, 0b1110] {
        let are_wide = |place: usize| places >> (place % 4) & 1 == 1;
        let found = of_the_best(&tree.bvh(), [&narrow, &wide], are_wide);
        assert!(found < 0.95, "{found:.3} times, at {places:04b}");
    }
}

/// A group that pays is worth more than one that does not. (While one group in vain kept the next from being tried: 1.4 times.)
#[test]
fn groups_are_tried_where_every_second_pays() {
    let tree = UNIFORM.tree();
    let [narrow, wide] = narrow_and_wide();
    let mut random = Random(5);
    let mut are_wide = Vec::new();
    are_wide.resize_with(narrow.len() / 4, || random.below(2) == 1);
    let by_chance = |group: usize| are_wide[group % are_wide.len()];
    let in_turn = |group: usize| group % 2 == 1;
    let fourth = |group: usize| group % 4 == 3;
    let rules: [&dyn Fn(usize) -> bool; 3] = [&in_turn, &fourth, &by_chance];
    for (rule, is_wide) in rules.into_iter().enumerate() {
        let are_wide = |place: usize| is_wide(place / 4);
        let found = of_the_best(&tree.bvh(), [&narrow, &wide], are_wide);
        assert!(found < 1.3, "{found:.3} times, by rule {rule}");
    }
}

/// A long call, in which no group pays. Packets that go by themselves are streams, which take less work than ray by
/// ray.
#[test]
fn few_groups_of_a_beam_are_tried() {
    let rays = RayInput { count: 1 << 15, ..IN_NO_ORDER };
    let input = Input { scene: UNIFORM, rays, any: false };
    for (said, most) in [(PLAIN, 0.845), (Trace::coherent as Said, 0.865)] {
        let found = times_of(&input, said);
        assert!(found < most, "{found:.3} times the work of ray by ray");
    }
}

/// A short call over few spheres, where a group in vain takes as much work as its rays do. (While one group was passed over after the
/// first, instead of three: 1.20 times.)
#[test]
fn a_short_call_over_few_spheres_tries_two_groups_of_eight() {
    let few = SceneInput { spheres: 64, ..UNIFORM };
    let rays = RayInput { count: 512, ..IN_NO_ORDER };
    for any in [false, true] {
        let found = times_of(&Input { scene: few, rays, any }, PLAIN);
        assert!(found < 1.15, "{found:.3} times the work of ray by ray");
    }
}

/// Any hits among nested spheres, by a long lens in no order: the first group is not trusted. (Where it was trusted: 1.29 times.)
#[test]
fn of_any_hits_among_nested_spheres_a_first_group_gives_up_soon() {
    // In no order of sizes.
    let nested = (0..4000_usize).map(|i| (Vec3::ZERO, (i * 1021 % 4000 + 1) as f32 / 4000.0));
    let tree = SphereTree::new(nested.collect::<Vec<_>>());
    let lens = orders()[3];
    let packets =
        Input { scene: UNIFORM, rays: RayInput { count: 512, ..lens }, any: true }.packets();
    let found = times(packets.len(), both(&tree.bvh(), &packets, true, PLAIN));
    assert!(found < 1.2, "{found:.3} times the work of ray by ray");
}
