//! Spheres that are none, memory that is too small, a list that the tree was not built from.

use crate::scenes::{camera, diffuse, uniform};
use crate::{BOTH, EXACT, assert_same, bits, brute};
use spherule_kernel::bvh::Join;
use spherule_kernel::{Bvh, Ray, Sphere, Vec3};
use spherule_tests::doors::Columns;
use spherule_tests::random::Random;
use spherule_tests::tree_ways::{Memory, ways};

#[test]
fn invalid_and_immense_spheres() {
    let mut spheres = uniform(300);
    let numbers = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 3e38, 2e12, 1e30];
    let mut random = Random::new(78, 0);
    for (i, sphere) in spheres.iter_mut().enumerate().filter(|(i, _)| i % 3 == 0) {
        let number = random.pick(&numbers);
        if i % 2 == 0 { sphere.radius = number } else { sphere.center[i % 3] = number }
    }
    let rays: Vec<Ray> = diffuse(500).into_iter().chain(camera(16)).collect();
    assert_same(EXACT, &rays, &spheres);
    // Nothing but such.
    let none = vec![Sphere { center: Vec3::ZERO, radius: f32::NAN }; 100];
    assert_same(BOTH, &rays, &none);
    let immense = vec![Sphere { center: Vec3::new(0.0, 3e12, 0.0), radius: 3e12 }; 100];
    assert_same(EXACT, &rays, &immense);
}

#[test]
fn too_little_memory() {
    for count in [0, 1, 16, 17, 1000] {
        let columns = Columns::new(&uniform(count));
        let needed = Bvh::needed(count);
        let mut memory = Memory::new(count);
        let (nodes, leaves) = (&mut memory.nodes, &mut memory.leaves);
        for (n, l) in [(needed.nodes - 1, needed.leaves), (needed.nodes, needed.leaves - 1), (0, 0)]
        {
            let error = Bvh::build(columns.spheres(), &mut nodes[..n], &mut leaves[..l])
                .expect_err("less than needed");
            assert_eq!(error.needed, needed);
            assert!(error.to_string().contains(&needed.leaves.to_string()), "{error}");
        }
        assert!(Bvh::build(columns.spheres(), nodes, leaves).is_ok());
    }
    let all = Bvh::needed(u32::MAX as usize);
    assert_eq!(all.leaves, (1 << 28) + 1);
}

#[test]
fn other_spheres_than_built_from() {
    let rays: Vec<Ray> = diffuse(200).into_iter().chain(camera(8)).collect();
    let built = uniform(500);
    let mut memory = Memory::new(500);
    let tree = memory.build(&Columns::new(&built));
    for way in ways().filter(|way| way.tier != "fast") {
        let answers = |spheres: &Columns| {
            [way.one_by_one(&rays, spheres, &tree), way.coherent(&rays, spheres, &tree)]
        };
        // Of the same length: those that it was built from.
        let same = Columns::new(&vec![Sphere { center: Vec3::ZERO, radius: f32::NAN }; 500]);
        let expected: Vec<_> =
            (brute(way.tier).nearest)(&rays, &built).into_iter().map(bits).collect();
        for (hits, _) in answers(&same) {
            assert_eq!(hits.into_iter().map(bits).collect::<Vec<_>>(), expected, "{}", way.lanes);
        }
        // Of another: those given.
        for count in [0, 3, 499, 501] {
            let given = uniform(count);
            let expected: Vec<_> =
                (brute(way.tier).nearest)(&rays, &given).into_iter().map(bits).collect();
            for (hits, met) in answers(&Columns::new(&given)) {
                assert_eq!(met, expected.iter().map(Option::is_some).collect::<Vec<_>>());
                let hits: Vec<_> = hits.into_iter().map(bits).collect();
                assert_eq!(hits, expected, "{}", way.lanes);
            }
        }
    }
}

/// Two threads wherever two pieces of work are apart.
struct Threads;

impl Join for Threads {
    fn join<A: Send, B: Send>(
        &self,
        one: impl FnOnce() -> A + Send,
        other: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        std::thread::scope(|scope| {
            let one = scope.spawn(one);
            let other = other();
            (one.join().expect("no panic"), other)
        })
    }
}

#[test]
fn threads_build_the_same_tree() {
    // More leaves than are counted by one thread, and few.
    for count in [40_000, 5000, 300, 17, 16, 1, 0] {
        let columns = Columns::new(&uniform(count));
        let (mut memory, mut other) = (Memory::new(count), Memory::new(count));
        let alone = memory.build(&columns);
        let together =
            Bvh::build_with(&Threads, columns.spheres(), &mut other.nodes, &mut other.leaves)
                .expect("enough memory");
        assert!(format!("{alone:?}") == format!("{together:?}"), "{count} spheres");
    }
}
