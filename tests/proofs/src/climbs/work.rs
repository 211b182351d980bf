//! Searches for how much more work the plain call does than ray by ray, without a clock.
//!
//! The search climbs over scenes, and over rays of any order, count, spread and interval (`work/input.rs`). Work is
//! what `work.rs` counts and weighs. `SPHERULE_CLIMB` makes it longer.

mod input;
mod patience;
mod weights;

use self::input::{Bundle, Genes, Input, OF_TREE, RayInput, Scene, SceneInput, packed, step};
use crate::proofs::climb::{Random, climb};
use crate::proofs::work::{Work, while_groups_persist};
use crate::query::{AnyHit, ClosestHit, Query};
use crate::structures::Traverse;
use crate::{Bvh, Exact, Ray, RayPacket, Sphere, SphereTree, Trace, Vec3};
use std::collections::HashMap;
use std::println;
use std::vec;
use std::vec::Vec;
use wide::f32x16;

/// What a trace is told of its rays.
type Said = fn(Trace<'static>) -> Trace<'static>;
const PLAIN: Said = |trace| trace;

/// The work of a call, and its answers.
#[inline(never)]
fn call<Q: Query>(
    bvh: &Bvh<'_>,
    rays: &[RayPacket],
    said: Said,
) -> (Work, Vec<Q::Packet<[f32; 16]>>) {
    let mut answers = vec![Q::none::<[f32; 16]>(); rays.len()];
    let mut trace = said(Trace::new());
    let work = Work::of(|| {
        bvh.in_lanes::<f32x16, Q>(Exact, (), &mut trace, rays, &mut answers);
    });
    (work, answers)
}

/// The work of a call whose trace is told `said`, and ray by ray.
fn both(bvh: &Bvh<'_>, rays: &[RayPacket], any: bool, said: Said) -> [Work; 2] {
    if any {
        let (work, answers) = call::<AnyHit>(bvh, rays, said);
        let (apart, expected) = call::<AnyHit>(bvh, rays, Trace::incoherent);
        assert_eq!(answers, expected);
        [work, apart]
    } else {
        let (work, answers) = call::<ClosestHit>(bvh, rays, said);
        let (apart, expected) = call::<ClosestHit>(bvh, rays, Trace::incoherent);
        assert_eq!(answers, expected);
        [work, apart]
    }
}

/// The work of a packet besides its traversal, however that goes: that of a call by slices for sixteen rays and their
/// answers.
const A_PACKET: f64 = 80.0;

/// How many times the work of ray by ray.
fn times(packets: usize, [work, apart]: [Work; 2]) -> f64 {
    let beside = A_PACKET * packets as f64;
    (work.units() + beside) / (apart.units() + beside)
}

/// The same of an input.
fn times_of(input: &Input, said: Said) -> f64 {
    let packets = input.packets();
    times(packets.len(), both(&input.scene.tree().bvh(), &packets, input.any, said))
}

/// The highest `score` that a search finds, of the work of calls whose trace is told `said` and ray by ray. Prints the
/// input.
fn most(seed: u64, effort: [u32; 2], said: Said, score: impl Fn(usize, f64) -> f64) -> f64 {
    // Built anew only where the climb has changed it.
    let mut built: Option<([u16; OF_TREE], SphereTree)> = None;
    let mut of = |genes: &Genes| {
        let input = Input::of(genes);
        let of_tree: [u16; OF_TREE] = *genes.map(step).first_chunk().expect("genes of a tree");
        if built.as_ref().is_none_or(|(of, _)| *of != of_tree) {
            built = Some((of_tree, input.scene.tree()));
        }
        let (_, tree) = built.as_ref().expect("built");
        let rays = input.packets();
        (rays.len(), both(&tree.bvh(), &rays, input.any, said))
    };
    let mut seen = HashMap::new();
    let start = |random: &mut Random| {
        [(); _].map(|()| f32::from_bits(1.0_f32.to_bits() | random.bits() as u32 >> 9))
    };
    let (found, genes) = climb(seed, effort, None, start, |genes| {
        *seen.entry(genes.map(step)).or_insert_with(|| {
            let (packets, works) = of(genes);
            score(packets, times(packets, works))
        })
    });
    let (input, (packets, [work, apart])) = (Input::of(&genes), of(&genes));
    let (rays, times) = (input.rays.count, times(packets, [work, apart]));
    println!("{times:.2} times the work of ray by ray: {input:?}");
    println!("as said: {}\napart:   {}", work.per_ray(rays), apart.per_ray(rays));
    found
}

/// The control of the search: it finds what groups are for.
#[test]
fn groups_do_a_small_part_of_the_work_of_ray_by_ray() {
    let found = most(67, [8, 800], PLAIN, |_, times| 1.0 / times);
    assert!(found > 4.0, "1/{found:.2} of the work");
}

/// Many short climbs. (Twelve of 14,400 steps find 2.0, 2.8 and 3.9: the last two are calls of two packets, of which half the rays live.)
const LONG: [u32; 2] = [72, 2400];

/// Calls of fewer packets have one group or a few, so nothing that one group teaches serves the next.
const MANY: usize = 32;

/// The aim is twice the work. Above it, the search finds rays of which few live and few hit, in ten groups: what the first group teaches
/// serves few others.
#[test]
fn the_plain_call_does_little_more_than_twice_the_work_of_ray_by_ray() {
    let score = |packets, times| if packets < MANY { 0.25 * times } else { times };
    let found = most(62, LONG, PLAIN, score);
    assert!(found <= 2.3, "{found:.2} times the work");
}

/// The search finds a single group that is too wide, and in the end gives up, or packets that are
/// tried alone.
#[test]
fn a_short_call_does_at_most_three_times_the_work() {
    let found = most(62, LONG, PLAIN, |_, times| times);
    assert!(found <= 2.7, "{found:.2} times the work");
}

/// The search finds one group over 20 shells, half of whose rays live: all spheres are near a ray of each packet, and the group is not
/// asked whether it pays before a leaf ends. (Asked after each packet, the group gives up, and packets are tried alone: 4.0 times the work.
/// If packets are not tried either: 3.3 times, by one packet.)
#[test]
fn rays_falsely_said_to_be_coherent_take_little_more_than_three_times_the_work() {
    let found = most(63, LONG, Trace::coherent, |_, times| times);
    assert!(found <= 3.3, "{found:.2} times the work");
}

/// Parallel rays from anywhere, in no order.
const BEAM: Bundle = Bundle {
    from: Vec3::new(0.0, 0.0, -4.0),
    from_spread: 1.0,
    to: Vec3::new(0.1, 0.2, 0.0),
    to_spread: 0.0,
    parallel: 1.0,
};

const UNIFORM: SceneInput = SceneInput {
    scene: Scene::Uniform,
    spheres: 3000,
    radius: 0.01,
    scale: 1.0,
    shift: Vec3::ZERO,
    seed: 0,
};

const IN_NO_ORDER: RayInput = RayInput {
    bundles: [BEAM; 2],
    alternate: 0,
    run: 1,
    within_run: 0.0,
    lines: false,
    shuffled: 0.0,
    dead: 0.0,
    t_min: 0.0,
    t_max: f32::INFINITY,
    length: 1.0,
    count: 1024,
    seed: 0,
};

/// The control of the counts: that a group which is as wide as the scene is counted, if it goes on.
#[test]
fn a_beam_as_wide_as_the_scene_is_seen() {
    let input = Input { scene: UNIFORM, rays: IN_NO_ORDER, any: false };
    let found = while_groups_persist(|| times_of(&input, Trace::coherent));
    assert!(found > 10.0, "{found:.2} times the work");
}

/// Rays of a grid, parallel to the axes of a lattice, some of them tangents of many spheres: line by line, and `in_turn` lines in turn.
fn grid_on_a_lattice(in_turn: usize) -> (SphereTree, Vec<Ray>) {
    let scene = SceneInput { scene: Scene::Lattice, spheres: 4096, ..UNIFORM };
    let at = |number: usize| (number % 64, number / 64);
    let ray = |(x, y): (usize, usize)| {
        let [x, y] = [x, y].map(|i| i as f32 / 32.0 - 1.0);
        Ray::new(Vec3::new(x, y, -4.0), Vec3::Z)
    };
    let count = 64 * 64;
    let order = |i: usize| i % in_turn * (count / in_turn) + i / in_turn;
    (scene.tree(), (0..count / in_turn * in_turn).map(|i| ray(at(order(i)))).collect())
}

#[test]
fn tangents_of_many_spheres_are_not_decided_more_often_together() {
    for in_turn in [1, 7] {
        let (tree, rays) = grid_on_a_lattice(in_turn);
        let packets = packed(&rays);
        for any in [false, true] {
            let [grouped, apart] = both(&tree.bvh(), &packets, any, PLAIN);
            let found = times(packets.len(), [grouped, apart]);
            let per_ray = [grouped, apart].map(|work| work.per_ray(rays.len()));
            assert!(found < 1.5, "{found:.2} times the work, any: {any}: {per_ray:#?}");
        }
    }
}

/// Rays of real uses, in their orders.
fn orders() -> [RayInput; 11] {
    let camera =
        Bundle { from: Vec3::new(0.1, 0.2, -3.0), from_spread: 0.0, to_spread: 1.0, ..BEAM };
    let camera = Bundle { to: Vec3::ZERO, parallel: 0.0, ..camera };
    let lens = Bundle { from: Vec3::new(0.0, 0.0, -100.0), to_spread: 1.3, ..camera };
    let diffuse = Bundle { from: Vec3::ZERO, to: Vec3::ZERO, to_spread: 1.0, ..BEAM };
    let light = Bundle { from: Vec3::ZERO, to: Vec3::new(0.3, 3.0, 0.2), parallel: 0.0, ..BEAM };
    let of = |bundle| RayInput { bundles: [bundle; 2], count: 1 << 14, ..IN_NO_ORDER };
    [
        // A camera: line by line, shuffled, narrow and shuffled. A long lens, shuffled.
        RayInput { lines: true, ..of(camera) },
        of(camera),
        of(Bundle { to_spread: 0.6, ..camera }),
        of(lens),
        // A beam, and nearly parallel rays.
        of(BEAM),
        of(Bundle { to_spread: 0.05, ..BEAM }),
        // To one light, and to a far light.
        RayInput { t_max: 1.0, ..of(light) },
        RayInput { t_max: 1.0, ..of(Bundle { to: light.to * 3.0, ..light }) },
        // Diffuse: alone, in bursts of 16, in bursts of 64.
        of(diffuse),
        RayInput { run: 16, within_run: 0.02, ..of(diffuse) },
        RayInput { run: 64, within_run: 0.02, ..of(diffuse) },
    ]
}

/// Line by line to tiles of eight by eight.
fn in_tiles(rays: &[Ray]) -> Vec<Ray> {
    let wide = rays.len().isqrt();
    let at = |number: usize| {
        let (tile, within) = (number / 64, number % 64);
        let (x, y) = (tile % (wide / 8) * 8 + within % 8, tile / (wide / 8) * 8 + within / 8);
        rays[y * wide + x]
    };
    (0..rays.len()).map(at).collect()
}

/// Spheres of which many lie within a group's planes and few near its rays; and those that all rays come near.
fn where_groups_pay() -> [SphereTree; 3] {
    let tiny = SceneInput { spheres: 30_000, radius: 5e-4, ..UNIFORM };
    let sheet = SceneInput { scene: Scene::Sheet, spheres: 10_000, radius: 2e-3, ..UNIFORM };
    let nested = (0..1000).map(|i| (Vec3::ZERO, 0.5 + 5e-4 * i as f32));
    [tiny.tree(), sheet.tree(), SphereTree::new(nested.collect::<Vec<_>>())]
}

/// Large spheres end many rays at once, and any-hit queries meet them soon: a large sphere among tiny ones, with rays that end there.
#[test]
fn any_hit_meets_what_is_large_first() {
    let scene = SceneInput { spheres: 30_000, radius: 0.003, ..UNIFORM };
    let mut list = scene.list();
    list.push(Sphere { center: Vec3::ZERO, radius: 0.9 });
    let tree = SphereTree::new(list);

    let [_, _, rays, ..] = orders();
    let packets = Input { scene, rays, any: true }.packets();
    let found = times(packets.len(), both(&tree.bvh(), &packets, true, PLAIN));
    assert!(found < 0.4, "{found:.2} times the work");
}

/// A camera's tiles are what groups are for. (For a week they gave up: 3.7 times as long among nested spheres.)
#[test]
fn groups_of_a_camera_do_not_give_up() {
    let [lines, ..] = orders();
    let rays = in_tiles(&Input { scene: UNIFORM, rays: lines, any: false }.rays());
    let packets = packed(&rays);
    for (scene, tree) in where_groups_pay().iter().enumerate() {
        for any in [false, true] {
            let [work, _] = both(&tree.bvh(), &packets, any, PLAIN);
            let [persisting, _] = while_groups_persist(|| both(&tree.bvh(), &packets, any, PLAIN));
            let found = times(packets.len(), [work, persisting]);
            assert!(found < 1.1, "scene {scene}: {found:.2} times the work, any: {any}");
        }
    }
}
