//! Spheres that are none, memory that is too small, and whoever builds the tree.

use super::scenes::{EYE, camera, mixed, parallel, uniform};
use super::{BOTH, EXACT};
use spherule_kernel::bvh::Join;
use spherule_kernel::{
    Bvh, BvhLeaf, BvhNode, DepthList, Sphere, SphereList, SphereTree, Vec3, Viewpoint,
};
use spherule_tests::random::Random;
use spherule_tests::variants::{assert_same, assert_same_from};

#[test]
fn invalid_and_immense_spheres() {
    let mut spheres = uniform(300);
    let numbers = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 3e38, 2e12, 1e30];
    let mut random = Random::new(78, 0);
    for (i, sphere) in spheres.iter_mut().enumerate().filter(|(i, _)| i % 3 == 0) {
        let number = random.pick(&numbers);
        if i % 2 == 0 { sphere.radius = number } else { sphere.center[i % 3] = number }
    }
    // Nothing but such.
    let none = vec![Sphere { center: Vec3::ZERO, radius: f32::NAN }; 100];
    let immense = vec![Sphere { center: Vec3::new(0.0, 3e12, 0.0), radius: 3e12 }; 40];
    for (tiers, spheres) in [(EXACT, spheres), (BOTH, none), (EXACT, immense), (BOTH, Vec::new())] {
        assert_same(tiers, &mixed(250, 16), &spheres);
        assert_same(tiers, &camera(EYE, Vec3::ZERO, 0.364, 32), &spheres);
        let parallel = parallel(EYE, -EYE, 1.2, 32);
        assert_same_from(Viewpoint::Direction(-EYE), tiers, &parallel, &spheres);
    }
}

#[test]
fn too_little_memory_for_a_tree() {
    for count in [0, 1, 16, 17, 1000] {
        let list = SphereList::from(uniform(count));
        let needed = Bvh::needed(count);
        let mut nodes = vec![BvhNode::EMPTY; needed.nodes];
        let mut leaves = vec![BvhLeaf::EMPTY; needed.leaves];
        for (n, l) in [(needed.nodes - 1, needed.leaves), (needed.nodes, needed.leaves - 1), (0, 0)]
        {
            let error = Bvh::build(list.spheres(), &mut nodes[..n], &mut leaves[..l])
                .expect_err("less than needed");
            assert!(error.given < error.needed, "{error:?}");
            assert!(error.to_string().contains(&error.needed.to_string()), "{error}");
        }
        assert!(Bvh::build(list.spheres(), &mut nodes, &mut leaves).is_ok());
    }
    let all = Bvh::needed(u32::MAX as usize);
    assert_eq!(all.leaves, (1 << 28) + 1);
}

#[test]
fn too_little_memory_for_a_depth_list() {
    let viewpoint = Viewpoint::Origin(Vec3::ZERO);
    for count in [0, 1, 15, 16, 17, 1000] {
        let list = SphereList::from(uniform(count));
        let needed = DepthList::needed(count);
        let mut memory = vec![0.0; needed];
        for words in [0, needed / 2, needed - 1] {
            let error = DepthList::sort(list.spheres(), viewpoint, &mut memory[..words])
                .expect_err("less than needed");
            assert_eq!((error.needed, error.given), (needed, words));
            assert!(error.to_string().contains(&needed.to_string()), "{error}");
        }
        assert!(DepthList::sort(list.spheres(), viewpoint, &mut memory).is_ok());
        assert!(needed * 4 <= 24 * count + 768, "{needed} words for {count}");
    }
    assert_eq!(DepthList::needed(usize::MAX), usize::MAX);
    assert_eq!(DepthList::scratch(usize::MAX), usize::MAX);
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
        let list = SphereList::from(uniform(count));
        let alone = SphereTree::new(list.clone());
        let together = SphereTree::build_with(&Threads, list).expect("enough memory");
        let (alone, together) = (format!("{:?}", alone.bvh()), format!("{:?}", together.bvh()));
        assert!(alone == together, "{count} spheres");
    }
}
