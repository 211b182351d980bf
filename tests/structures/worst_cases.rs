//! Inputs that could make a tree deep, large or slow.

use super::EXACT;
use super::scenes::{mixed, point};
use spherule_kernel::{Bvh, Sphere, SphereTree, Vec3};
use spherule_referee::random::Random;
use spherule_tests::variants::assert_same;
use std::time::{Duration, Instant};

/// Builds a tree, and asserts what no input may break: depth, size, and time (per sphere,
/// generous).
fn build(name: &str, spheres: &[Sphere]) {
    let (start, count) = (Instant::now(), spheres.len());
    let tree = SphereTree::new(spheres);
    let elapsed = start.elapsed();
    let (size, depth, needed) = (tree.bvh().size(), tree.bvh().depth(), Bvh::needed(count));
    println!("{name}: {size:?} of {needed:?}, depth {depth}, {elapsed:?}");
    assert!(size.nodes <= needed.nodes && size.places <= needed.places, "{name}: {size:?}");
    assert!(size.nodes * 512 + size.places * 20 <= 40 * count + 700, "{name}: {size:?}");
    assert!(depth <= 8, "{name}: depth {depth}");
    let most = Duration::from_secs(2) + Duration::from_micros(5) * count as u32;
    assert!(elapsed < most, "{name}: {elapsed:?}");
}

#[test]
fn worst_cases() {
    const COUNT: usize = 100_000;
    let mut random = Random::new(77, 0);
    let here = Sphere { center: Vec3::new(0.1, 0.2, 0.3), radius: 0.25 };
    let coincident = vec![here; COUNT];
    let shells: Vec<Sphere> =
        (0..COUNT).map(|i| Sphere { radius: 1.0 - i as f32 / COUNT as f32, ..here }).collect();
    let mut sizes: Vec<Sphere> = (0..COUNT)
        .map(|_| Sphere {
            center: point(&mut random, 1.0),
            radius: (0.001 * (random.uniform(-3.0, 3.0) + random.uniform(-3.0, 3.0)).exp()) as f32,
        })
        .collect();
    sizes[500] = Sphere { center: Vec3::new(0.0, -1000.0, 0.0), radius: 999.5 };
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
    let rays = mixed(48, 4);
    for (name, spheres) in [
        ("coincident", coincident),
        ("shells", shells),
        ("mixed", sizes),
        ("collinear", collinear),
        ("doubling", doubling),
        ("points", points),
    ] {
        build(name, &spheres);
        let start = Instant::now();
        assert_same(EXACT, &rays, &spheres);
        println!("{name}: {:?}", start.elapsed());
    }
}
