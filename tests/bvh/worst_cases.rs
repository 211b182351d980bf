//! Inputs that could make a tree deep, large or slow.

use crate::scenes::{camera, diffuse, point};
use crate::{bits, brute};
use spherule_kernel::{Bvh, Ray, Sphere, Vec3};
use spherule_tests::doors::Columns;
use spherule_tests::random::Random;
use spherule_tests::tree_ways::{Memory, ways};
use std::time::{Duration, Instant};

/// Builds, and asserts what no input may break: depth, size, and time (per sphere, generous).
fn tree_of<'a>(name: &str, memory: &'a mut Memory, spheres: &Columns, count: usize) -> Bvh<'a> {
    let start = Instant::now();
    let tree = memory.build(spheres);
    let elapsed = start.elapsed();
    let (size, needed) = (tree.size(), Bvh::needed(count));
    println!("{name}: {size:?} of {needed:?}, depth {}, {elapsed:?}", tree.depth());
    assert!(size.nodes <= needed.nodes && size.leaves <= needed.leaves, "{name}: {size:?}");
    assert!(size.nodes * 512 + size.leaves * 320 <= 40 * count + 1152, "{name}: {size:?}");
    assert!(tree.depth() <= 9, "{name}: depth {}", tree.depth());
    assert!(
        elapsed < Duration::from_secs(2) + Duration::from_micros(5) * count as u32,
        "{name}: {elapsed:?}"
    );
    tree
}

#[test]
fn worst_cases() {
    const COUNT: usize = 100_000;
    let mut random = Random::new(77, 0);
    let here = Sphere { center: Vec3::new(0.1, 0.2, 0.3), radius: 0.25 };
    let coincident = vec![here; COUNT];
    let shells: Vec<Sphere> =
        (0..COUNT).map(|i| Sphere { radius: 1.0 - i as f32 / COUNT as f32, ..here }).collect();
    let mut mixed: Vec<Sphere> = (0..COUNT)
        .map(|_| Sphere {
            center: point(&mut random, 1.0),
            radius: (0.001 * (random.uniform(-3.0, 3.0) + random.uniform(-3.0, 3.0)).exp()) as f32,
        })
        .collect();
    mixed[500] = Sphere { center: Vec3::new(0.0, -1000.0, 0.0), radius: 999.5 };
    let collinear: Vec<Sphere> =
        (0..COUNT).map(|i| Sphere { center: Vec3::new(i as f32, 0.0, 0.0), radius: 0.4 }).collect();
    let doubling: Vec<Sphere> = (0..COUNT)
        .map(|i| {
            let x = f32::from_bits(1 + (i as u32 % 0x5380_0000 / 64) * 12345 % 0x5380_0000);
            Sphere { center: Vec3::new(x, 0.0, 0.0), radius: x * 0.25 }
        })
        .collect();
    let points: Vec<Sphere> =
        (0..COUNT).map(|i| Sphere { center: Vec3::splat((i % 7) as f32), radius: 0.0 }).collect();
    let rays: Vec<Ray> = diffuse(48).into_iter().chain(camera(4)).collect();
    for (name, spheres) in [
        ("coincident", coincident),
        ("shells", shells),
        ("mixed", mixed),
        ("collinear", collinear),
        ("doubling", doubling),
        ("points", points),
    ] {
        let columns = Columns::new(&spheres);
        let mut memory = Memory::new(COUNT);
        let tree = tree_of(name, &mut memory, &columns, COUNT);
        let door = brute("exact");
        let expected: Vec<_> = (door.nearest)(&rays, &spheres).into_iter().map(bits).collect();
        let met: Vec<_> = expected.iter().map(Option::is_some).collect();
        for way in ways().filter(|way| way.tier == "exact" && way.lanes != "1 lane") {
            let start = Instant::now();
            let one_by_one = way.one_by_one(&rays, &columns, &tree);
            let coherent = way.coherent(&rays, &columns, &tree);
            println!("{name}, {}: {:?}", way.lanes, start.elapsed());
            for (hits, found) in [one_by_one, coherent] {
                let hits: Vec<_> = hits.into_iter().map(bits).collect();
                assert_eq!(hits, expected, "{name}, {}", way.lanes);
                assert_eq!(found, met, "{name}, {}", way.lanes);
            }
        }
    }
}
