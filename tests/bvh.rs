//! The tree answers as brute force does, bit for bit, in every tier, lane width and instruction
//! set; no input makes it deep, slow or large.

#[path = "bvh/equality.rs"]
mod equality;
#[path = "bvh/far.rs"]
mod far;
#[path = "bvh/limits.rs"]
mod limits;
#[path = "bvh/properties.rs"]
mod properties;
#[path = "bvh/scenes.rs"]
mod scenes;
#[path = "bvh/worst_cases.rs"]
mod worst_cases;

use scenes::{camera, uniform};
use spherule_kernel::dispatch::{Level, LevelName, Packet};
use spherule_kernel::{Hit, HitPacket, Ray, RayPacket, Sphere, Stable, dispatch};
use spherule_tests::case::HexRay;
use spherule_tests::doors::{Columns, DOORS, Door};
use spherule_tests::tree_ways::{Memory, ways};
use std::time::Instant;

const BOTH: &[&str] = &["exact", "stable"];
const EXACT: &[&str] = &["exact"];

fn brute(tier: &str) -> Door {
    let door = DOORS.into_iter().find(|door| door.tier == tier && door.lanes == 16);
    door.expect("every tier has sixteen lanes")
}

fn bits(hit: Option<Hit>) -> Option<(u32, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.sphere))
}

/// The first ray for which a way of one of `tiers` does not answer as brute force does.
fn difference(tiers: &[&str], rays: &[Ray], spheres: &[Sphere]) -> Option<String> {
    let columns = Columns::new(spheres);
    let mut memory = Memory::new(spheres.len());
    let tree = memory.build(&columns);
    for tier in tiers {
        let door = brute(tier);
        let (expected, met) = ((door.nearest)(rays, spheres), (door.any)(rays, spheres));
        for way in ways().filter(|way| way.tier == *tier) {
            let one_by_one = way.one_by_one(rays, &columns, &tree);
            let coherent = way.coherent(rays, &columns, &tree);
            for (kind, (hits, found)) in [("one by one", one_by_one), ("coherent", coherent)] {
                for (i, ray) in rays.iter().enumerate() {
                    if bits(hits[i]) != bits(expected[i]) || met[i] != found[i] {
                        return Some(format!(
                            "{tier}, {}, {kind}, ray {i} of {}, {} spheres: {:?} any {}, by brute \
                             force {:?} any {}; {}",
                            way.lanes,
                            rays.len(),
                            spheres.len(),
                            hits[i],
                            found[i],
                            expected[i],
                            met[i],
                            HexRay(ray)
                        ));
                    }
                }
            }
        }
    }
    None
}

#[track_caller]
fn assert_same(tiers: &[&str], rays: &[Ray], spheres: &[Sphere]) {
    if let Some(difference) = difference(tiers, rays, spheres) {
        panic!("{difference}");
    }
}

#[test]
fn every_level_of_this_cpu_runs() {
    let run: Vec<_> =
        LevelName::ALL.into_iter().filter(|&name| Level::named(name).is_some()).collect();
    println!("levels: {run:?}");
    let mut has = vec![LevelName::Baseline];
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::is_x86_feature_detected as has_feature;
        if has_feature!("avx2") && has_feature!("fma") {
            has.push(LevelName::Avx2);
        }
        if has_feature!("avx512f") && has_feature!("avx512vl") && has_feature!("avx512vbmi") {
            has.push(LevelName::Avx512);
        }
    }
    assert_eq!(run, has, "the levels that the CPU has");
    for name in run {
        assert!(ways().any(|way| way.lanes == name.as_str()), "no way at {name:?}");
    }
}

/// So the tree really is used.
#[test]
fn many_times_as_fast_as_brute_force() {
    let spheres = uniform(10_000);
    let columns = Columns::new(&spheres);
    let mut memory = Memory::new(spheres.len());
    let tree = memory.build(&columns);
    // A packet is a tile of 4 x 4 pixels.
    let (size, rays) = (256, camera(256));
    let corner = |tile: usize| tile / (size / 4) * 4 * size + tile % (size / 4) * 4;
    let tile = |tile| core::array::from_fn(|i| rays[corner(tile) + i / 4 * size + i % 4]);
    let rays: Vec<_> = (0..size * size / 16)
        .map(|number| RayPacket::<Packet>::new(&tile(number) as &[Ray; 16]))
        .collect();
    let mut hits = vec![HitPacket::<Packet>::none(); rays.len()];
    let (level, list) = (Level::best(), columns.spheres());
    let mut time = |by_tree: bool| {
        let start = Instant::now();
        if by_tree {
            dispatch::bvh::nearest_coherent::<Stable>(level, &rays, list, &tree, &mut hits);
        } else {
            dispatch::nearest::<Stable>(level, &rays, list, &mut hits);
        }
        start.elapsed().as_secs_f64()
    };
    // The least of several: other tests run beside this one.
    let mut least = |by_tree| (0..5).map(|_| time(by_tree)).fold(f64::INFINITY, f64::min);
    let ratio = least(false) / least(true);
    println!("brute force takes {ratio:.0} times as long");
    assert!(ratio >= 20.0, "{ratio}");
}
